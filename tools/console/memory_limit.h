#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace sphparam::cli {

/// The bytes of "65536", "512M" or "2G" (powers of 1024); nothing if the text is no such size.
std::optional<std::uint64_t> parse_size(const std::string& text);

/// Declares --max-memory: beyond it, memory ends in std::bad_alloc, on every thread. Counted is
/// what the program allocates, with the stacks of its threads (8 MiB each; where they do not fit,
/// fewer threads do the work), not the input file, which is mapped.
void add_memory_limit(CLI::App& command);

/// What is to be said when memory ran out. Allocates nothing: there may be none.
const char* out_of_memory_message() noexcept;

}  // namespace sphparam::cli
