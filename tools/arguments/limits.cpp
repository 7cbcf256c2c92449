// RLIMIT_DATA counts private writable memory: heap and stacks of threads. RLIMIT_AS would count
// what malloc only reserves, 64 MiB a thread, and refuse work that fits.

#include "arguments/limits.h"

#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <limits>

#include "arguments/declaration.h"
#include "console/exit_codes.h"
#include "number_text.h"

namespace sphparam::cli {

namespace {

char message[128] = "sphparam: error: out of memory\n";

bool limit_memory(const std::string& text) {
  const std::optional<std::uint64_t> bytes = parse_size(text);
  if (!bytes) return false;
  const rlimit limit = {*bytes, *bytes};
  if (setrlimit(RLIMIT_DATA, &limit) != 0) {
    throw CLI::ValidationError("--max-memory", "the system does not allow " + text);
  }
  std::snprintf(message, sizeof message,
                "sphparam: error: out of memory: this takes more than --max-memory %.40s\n",
                text.c_str());
  return true;
}

ReadOptions limits;

struct NamedLimit {
  const char* name;
  std::int64_t ReadOptions::*value;
};

constexpr NamedLimit named_limits[] = {{"vertices", &ReadOptions::max_vertices},
                                       {"faces", &ReadOptions::max_faces},
                                       {"degree", &ReadOptions::max_polygon_degree},
                                       {"line", &ReadOptions::max_line_bytes},
                                       {"ply-elements", &ReadOptions::max_ply_elements},
                                       {"ply-properties", &ReadOptions::max_ply_properties},
                                       {"json", &ReadOptions::max_json_bytes},
                                       {"json-depth", &ReadOptions::max_json_depth},
                                       {"json-values", &ReadOptions::max_json_values},
                                       {"json-objects", &ReadOptions::max_json_objects}};

Words limit_names() {
  Words names = names_of(named_limits, &NamedLimit::name);
  names.insert(names.begin(), "file");
  return names;
}

void set_limit(const std::string& text) {
  const auto refuse = [](const std::string& why) { throw CLI::ValidationError("--limit", why); };
  const std::string name = text.substr(0, text.find('='));
  if (std::ranges::count(limit_names(), name) == 0) refuse(no_such_word(name, limit_names()));
  const auto parts = name_and_file(text);
  const auto size = parts ? parse_size(parts->second) : std::nullopt;
  if (!size || *size > std::numeric_limits<std::int64_t>::max())
    refuse("expected " + name + "=N, as in vertices=500000 or file=4G");
  if (name == "file") limits.max_file_bytes = *size;
  for (const NamedLimit& limit : named_limits) {
    if (name == limit.name) limits.*limit.value = static_cast<std::int64_t>(*size);
  }
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

void declare_limits(Declaration& command) {
  command.parsed("--max-memory", "SIZE", limit_memory, "expected a size, as in 512M or 2G",
                 "Exit with status 1 rather than take more memory, as in 512M or 2G");
  command.app()
      .add_option_function<Words>(
          "--limit", [](const Words& texts) { std::ranges::for_each(texts, set_limit); },
          "Of input files: " + joined(limit_names()))
      ->type_name("NAME=N")
      ->type_size(1)
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
}

const ReadOptions& input_limits() { return limits; }

const char* out_of_memory_message() noexcept { return message; }

void require_memory(const std::string& what, double bytes) {
  constexpr double giga = 1e9;
  const double there =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  if (there > 0 && bytes > there)
    throw UsageMistake(what + " take " + short_number(bytes / giga) +
                       " GB of memory or more, and this machine has " + short_number(there / giga) +
                       " GB");
}

}  // namespace sphparam::cli
