#include "arguments/part_files.h"

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "console/exit_codes.h"
#include "console/places.h"
#include "sphparam/io/paths.h"

namespace sphparam::cli {

namespace fs = std::filesystem;

std::vector<int> numbers_of_parts(const std::string& path) {
  if (is_stream(path)) throw UsageMistake("--all-components: parts are files, not a stream");
  const fs::path folder = fs::path(path).parent_path();
  const std::string name = fs::path(path).filename().string(), stem = stem_of(path) + "_";
  const std::string ending = name.substr(std::min(name.size(), stem.size() - 1));
  std::vector<int> numbers;
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
  if (numbers.empty())
    throw UsageMistake("--all-components: there is no " + path_of_part(path, 1) +
                       "; `sphparam map MESH --all-components -o " + path + "` makes such files");
  return numbers;
}

std::string file_for_part(const std::string& path, int part) {
  if (path.empty() || is_stream(path)) return path;
  const std::string own = path_of_part(path, part);
  return fs::exists(own) ? own : path;
}

void report_each(bool of_parts, const std::string& input, Session& session,
                 const std::function<std::string(int part)>& run) {
  if (!of_parts) {
    const std::string report = run(0);
    session.add_report([&] { return report; });
    return;
  }
  std::string reports;
  for (const int part : numbers_of_parts(input))
    reports += (reports.empty() ? "" : ", ") + run(part);
  session.add_report([&] { return "{\"parts\": [" + reports + "]}\n"; });
}

}  // namespace sphparam::cli
