// RLIMIT_DATA counts private writable memory: heap and stacks of threads. RLIMIT_AS would count
// what malloc only reserves, 64 MiB a thread, and refuse work that fits.

#include "console/memory_limit.h"

#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>

namespace sphparam::cli {

namespace {

char message[128] = "sphparam: error: out of memory\n";

void limit_memory(const std::string& text) {
  const std::optional<std::uint64_t> bytes = parse_size(text);
  const rlimit limit = {*bytes, *bytes};
  if (setrlimit(RLIMIT_DATA, &limit) != 0) {
    throw CLI::ValidationError("--max-memory", "the system does not allow " + text);
  }
  std::snprintf(message, sizeof message,
                "sphparam: error: out of memory: this takes more than --max-memory %.40s\n",
                text.c_str());
}

std::string check_size(const std::string& text) {
  return parse_size(text) ? "" : "expected a size, as in 512M or 2G";
}

}  // namespace

std::optional<std::uint64_t> parse_size(const std::string& text) {
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || number == 0) return std::nullopt;
  int shift = 0;
  if (stop != end) {
    constexpr std::string_view units = "KMGT";
    const std::size_t unit = units.find(*stop);
    if (unit == std::string_view::npos || stop + 1 != end) return std::nullopt;
    shift = 10 * (static_cast<int>(unit) + 1);
  }
  const std::uint64_t bytes = number << shift;
  return bytes >> shift == number ? std::optional(bytes) : std::nullopt;
}

void add_memory_limit(CLI::App& command) {
  command
      .add_option_function<std::string>(
          "--max-memory", limit_memory,
          "Exit with status 1 rather than take more memory, as in 512M or 2G")
      ->check(CLI::Validator(check_size, ""))
      ->type_name("SIZE");
}

const char* out_of_memory_message() noexcept { return message; }

}  // namespace sphparam::cli
