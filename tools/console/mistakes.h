#pragma once

#include <string>

#include "arguments/words.h"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace sphparam::cli {

/// The names of its subcommands.
Words command_names(const CLI::App& program);

/// What is wrong with a command line, the mistyped word first: the other complaints follow from it.
/// Requires: the program has just refused it with this error.
std::string explain(const CLI::App& program, const CLI::ParseError& error);

}  // namespace sphparam::cli
