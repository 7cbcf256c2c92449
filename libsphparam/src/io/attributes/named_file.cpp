#include "io/attributes/named_file.h"

#include <algorithm>
#include <functional>
#include <system_error>
#include <vector>

#include "lower_case.h"
#include "number_text.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/read_options.h"

namespace sphparam {
namespace {

namespace fs = std::filesystem;

std::string with_slashes(std::string text) {
  std::ranges::replace(text, '\\', '/');
  return text;
}

/// Out of the folder that it is named in.
bool leads_elsewhere(const std::string& text) {
  const fs::path path(text);
  return path.is_absolute() || text.find(':') < text.find('/') ||
         std::find(path.begin(), path.end(), "..") != path.end();
}

/// The path as a file of its own folder, where that can be said of it at all.
fs::path path_below(const std::string& text) {
  const fs::path path(with_slashes(text));
  return leads_elsewhere(path.string()) ? path.filename() : path;
}

bool is_there(const fs::path& path) {
  std::error_code hidden;
  return fs::exists(path, hidden);
}

/// Names in a folder, sorted; none where it cannot be read.
std::vector<std::string> names_in(const fs::path& folder,
                                  const std::function<bool(const fs::path&)>& is_meant) {
  std::vector<std::string> names;
  std::error_code error;
  fs::directory_iterator at(folder.empty() ? fs::path(".") : folder, error);
  for (; !error && at != fs::directory_iterator(); at.increment(error)) {
    const fs::path name = at->path().filename();
    if (is_meant(name)) names.push_back(name.string());
  }
  std::ranges::sort(names);
  return names;
}

/// Of ASCII letters: those are what Windows' programs change.
std::vector<std::string> names_in_other_case(const fs::path& folder, const fs::path& part) {
  const std::string wanted = in_lower_case(part.string());
  return names_in(folder,
                  [&](const fs::path& name) { return in_lower_case(name.string()) == wanted; });
}

std::vector<std::string> names_of_other_kind(const fs::path& folder, const fs::path& part) {
  const std::string wanted = in_lower_case(part.stem().string());
  return names_in(
      folder, [&](const fs::path& name) { return in_lower_case(name.stem().string()) == wanted; });
}

std::string problem_beside(const std::vector<std::string>& others) {
  std::vector<std::string> words;
  for (const std::string& name : others) words.push_back(sphparam::quoted(name));
  return words.empty() ? ""
                       : "there is no file of that name; beside it " +
                             std::string(words.size() == 1 ? "is " : "are ") + enumerated(words);
}

/// Of a name that was looked for by its last part, and is not there.
std::string problem_elsewhere(const std::string& name, const NamedFile& file) {
  return sphparam::quoted(one_line(name)) + " leads to another folder, which is not followed" +
         (file.problem.empty() ? ": copy it beside the file that names it" : "; " + file.problem);
}

/// Folder by folder, each by its name, or else by one that differs in case.
NamedFile found_on_disk(const fs::path& start, const fs::path& path) {
  fs::path found;
  for (const fs::path& part : path) {
    const fs::path folder = start / found;
    if (is_there(folder / part)) {
      found /= part;
      continue;
    }
    const std::vector<std::string> others = names_in_other_case(folder, part);
    if (others.size() == 1) {
      found /= others.front();
      continue;
    }
    const bool last = part == path.filename();
    return {path, "",
            problem_beside(others.empty() && last ? names_of_other_kind(folder, part) : others)};
  }
  return {found, found == path
                     ? ""
                     : sphparam::quoted(path.string()) + " is " + sphparam::quoted(found.string())};
}

bool has_quotes(const std::string& text) {
  return text.size() > 2 && text.front() == text.back() &&
         (text.front() == '"' || text.front() == '\'');
}

}  // namespace

NamedFile file_below(const fs::path& folder, const fs::path& inside, const std::string& text) {
  const fs::path start = folder / inside;
  const bool unquoted = has_quotes(text) && !is_there(start / path_below(text));
  const std::string name = unquoted ? text.substr(1, text.size() - 2) : text;
  const fs::path path = path_below(name);
  if (path.empty() || is_there(start / path)) return {path};
  NamedFile file = found_on_disk(start, path);
  if (path != fs::path(with_slashes(name)) && !is_there(start / file.path))
    file.problem = problem_elsewhere(name, file);
  return file;
}

std::optional<fs::path> folder_behind(const fs::path& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error)) return std::nullopt;
  const fs::path target = fs::canonical(path, error).parent_path();
  const fs::path own = path.parent_path().empty() ? "." : path.parent_path();
  if (error || fs::equivalent(own, target, error)) return std::nullopt;
  return target;
}

void note_taken_names(MeshFile& file, const std::vector<std::string>& taken) {
  if (!taken.empty())
    file.notes.push_back("names of files that differ in case on the disk: " + enumerated(taken));
}

}  // namespace sphparam
