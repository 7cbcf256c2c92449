#pragma once

#include <string>
#include <vector>

namespace sphparam::cli {

/// Options that (nearly) all subcommands have, -q, -v, --fail-on-warnings, --progress, --threads,
/// --max-memory and --limit, may stand before the subcommand too: puts the subcommand in front of
/// them, in place. Words are left as they are where anything else stands there.
void put_subcommand_first(int argc, char** argv);

/// Of `batch plan`, takes the first `--` away and all behind it, which are command lines of their
/// own and no options of this one.
void take_steps(int& argc, char** argv);

/// The words that were taken; the first is `--`, or there is none.
const std::vector<std::string>& taken_steps();

}  // namespace sphparam::cli
