#pragma once

namespace sphparam::cli {

/// The program: what `main` is called with → its exit code. Sets the signal handlers and limits of
/// the whole process, and is to be called once in it.
int run_sphparam(int argc, char** argv);

}  // namespace sphparam::cli
