#include <filesystem>

#include "sphparam/bake/bake.h"

namespace sphparam {

namespace {

/// The name of a field as it stands in a name of a file.
std::string in_file_name(std::string field) {
  for (char& c : field) {
    if (c == ':' || c == '/' || c == '\\') c = '-';
  }
  return field;
}

std::string replaced(std::string path, const std::string& word) {
  const std::string pattern = "{map}";
  for (size_t at = path.find(pattern); at != std::string::npos; at = path.find(pattern, at)) {
    path.replace(at, pattern.size(), word);
    at += word.size();
  }
  return path;
}

}  // namespace

std::vector<BakeRequest> requests_for(const std::vector<std::string>& fields,
                                      const std::string& pattern, const std::string& stem) {
  std::error_code error;
  const std::filesystem::path folder(pattern);
  const bool is_folder = pattern.ends_with('/') || std::filesystem::is_directory(folder, error);
  const std::string path = is_folder ? (folder / (stem + "_{map}.png")).string() : pattern;
  std::vector<BakeRequest> requests;
  for (const std::string& field : fields)
    requests.push_back({field, replaced(path, in_file_name(field))});
  return requests;
}

}  // namespace sphparam
