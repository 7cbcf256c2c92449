#include "arguments/part_files.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

#include "arguments/limits.h"
#include "console/exit_codes.h"
#include "console/places.h"
#include "sphparam/errors.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/version.h"

namespace sphparam::cli {

namespace fs = std::filesystem;

namespace {

/// FNV-1a.
std::uint64_t digest(std::uint64_t value, const void* data, std::size_t size) {
  constexpr std::uint64_t prime = 0x100000001b3;
  const auto* const bytes = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < size; ++i) value = (value ^ bytes[i]) * prime;
  return value;
}

/// " of 3 of 0123456789abcdef"; empty where the file does not say, nothing where it cannot be read,
/// which whoever reads it in earnest tells.
std::optional<std::string> run_of(const std::string& file) try {
  ReadOptions options = input_limits();
  options.only_map = true;
  for (const auto& [key, value] : read_provenance(read_mesh(file, options)))
    if (key == component_key) return value.substr(std::min(value.size(), value.find(" of ")));
  return "";
} catch (const ReadError&) {
  return std::nullopt;
}

/// Of which run all of them are; as `run_of`.
std::optional<std::string> require_one_run(const std::string& path,
                                           const std::vector<int>& numbers) {
  std::optional<std::string> first_run;
  std::string first;
  for (const int number : numbers) {
    const std::string file = path_of_part(path, number);
    const std::optional<std::string> run = run_of(file);
    if (!first_run && run) {
      first_run = run;
      first = file;
    }
    if (run && run != first_run)
      throw UsageMistake("--all-components: " + file + " is of another run of map than " + first +
                         ": remove the older of them, or map into files of another name");
  }
  return first_run;
}

/// A run leaves out specks that cannot be mapped; else somebody has taken a file away.
void tell_missing(const std::string& path, const std::vector<int>& numbers, const std::string& run,
                  Console& console) {
  constexpr std::size_t skipped = std::string_view(" of ").size();
  int count = 0;
  if (run.size() > skipped) std::from_chars(run.data() + skipped, run.data() + run.size(), count);
  int first = 1;  // that is missing
  for (const int number : numbers) first += number == first;
  if (first > count) return;
  console.say("  --all-components: " + std::to_string(numbers.size()) + " of " +
              std::to_string(count) + " parts are there: no " + path_of_part(path, first));
}

}  // namespace

std::string mark_of(const TriangleMesh& mesh) {
  std::uint64_t value = 0xcbf29ce484222325;
  value = digest(value, mesh.positions.data(), sizeof(double) * mesh.positions.size());
  value = digest(value, mesh.triangles.data(), sizeof(int) * mesh.triangles.size());
  std::string digits(16, '0');
  for (std::size_t i = digits.size(); i-- > 0; value >>= 4)
    digits[i] = "0123456789abcdef"[value & 15];
  return digits;
}

std::string component_words(std::size_t number, std::size_t count, const std::string& mark) {
  return std::to_string(number) + " of " + std::to_string(count) + " of " + mark;
}

std::vector<int> parts_on_disk(const std::string& path) {
  std::vector<int> numbers;
  if (path.empty() || is_stream(path)) return numbers;
  const fs::path folder = fs::path(path).parent_path();
  const std::string name = fs::path(path).filename().string(), stem = stem_of(path) + "_";
  const std::string ending = name.substr(std::min(name.size(), stem.size() - 1));
  std::error_code error;
  for (fs::directory_iterator at(folder.empty() ? "." : folder, error), end; !error && at != end;
       at.increment(error)) {
    const std::string other = at->path().filename().string();
    if (!other.starts_with(stem) || other.size() <= stem.size() + ending.size()) continue;
    int number = 0;
    std::from_chars(other.data() + stem.size(), other.data() + other.size(), number);
    if (number > 0 && fs::path(path_of_part(path, number)).filename() == other)
      numbers.push_back(number);
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

std::vector<int> numbers_of_parts(const std::string& path, Console& console) {
  if (is_stream(path)) throw UsageMistake("--all-components: parts are files, not a stream");
  std::vector<int> numbers = parts_on_disk(path);
  if (numbers.empty())
    throw UsageMistake("--all-components: there is no " + path_of_part(path, 1) +
                       "; `sphparam map MESH --all-components -o " + path + "` makes such files");
  if (const std::optional<std::string> run = require_one_run(path, numbers))
    tell_missing(path, numbers, *run, console);
  return numbers;
}

std::string file_for_part(const std::string& path, int part) {
  if (path.empty() || is_stream(path)) return path;
  const std::string own = path_of_part(path, part);
  return fs::exists(own) ? own : path;
}

void report_each(const std::string& command, bool of_parts, const std::string& input,
                 Session& session, const std::function<std::string(int part)>& run) {
  if (!of_parts) {
    const std::string report = run(0);
    session.add_report([&] { return report; });
    return;
  }
  std::string reports;
  for (const int part : numbers_of_parts(input, session.console))
    reports += (reports.empty() ? "" : ", ") + run(part);
  session.add_report([&] { return report_of_parts(command, reports); });
}

std::string report_of_parts(const std::string& command, const std::string& reports) {
  return std::string("{\"sphparam\": \"") + version + "\", \"command\": \"" + command +
         "\", \"parts\": [" + reports + "]}\n";
}

}  // namespace sphparam::cli
