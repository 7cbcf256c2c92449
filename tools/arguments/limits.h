#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sphparam/io/read_options.h"

namespace sphparam::cli {

class Declaration;

/// The bytes of "65536", "512M" or "2G" (powers of 1024); nothing if the text is no such size.
std::optional<std::uint64_t> parse_size(const std::string& text);

/// Declares --max-memory: beyond it, memory ends in std::bad_alloc, on every thread. Counted is
/// what the program allocates, with the stacks of its threads (8 MiB each; where they do not fit,
/// fewer threads do the work), not the input file, which is mapped. And --limit NAME=N, once for
/// each limit of `ReadOptions` that is to be another than its default: there are many, and hardly
/// anybody needs one.
void declare_limits(Declaration& command);

/// The limits of input files that the command line asks for.
const ReadOptions& input_limits();

/// What is to be said when memory ran out. Allocates nothing: there may be none.
const char* out_of_memory_message() noexcept;

/// Refuses, before any work is done, what this machine cannot hold: the system would end the
/// program after minutes. `what`: "--grid ico:12: its 167772162 vertices". Throws: UsageMistake.
void require_memory(const std::string& what, double bytes);

}  // namespace sphparam::cli
