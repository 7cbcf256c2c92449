#pragma once

#include "sphparam/io/read_options.h"

namespace CLI {
class App;
}

namespace sphparam::cli {

/// Declares --limit NAME=N, once for each limit of `ReadOptions` that is to be another than its
/// default.
void add_input_limits(CLI::App& command);

/// The limits of input files that the command line asks for.
const ReadOptions& input_limits();

}  // namespace sphparam::cli
