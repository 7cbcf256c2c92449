// Folders before links: what lies in the folder has the name that it has there, whatever links to
// it.

#include "survey/mesh_files.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "io/shell_word.h"
#include "sphparam/errors.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/paths.h"

namespace sphparam {
namespace {

namespace fs = std::filesystem;

/// By its name. Folders hold other things that are packed by gzip, and of GIFTI files data, too.
bool is_looked_at(const std::string& path) {
  std::string name = path;
  if (is_packed_name(name)) name.resize(name.size() - 3);
  if (!is_mesh_name(name)) return false;
  const std::string kind = extension_of(fs::path(name).stem().string());
  return extension_of(name) != ".gii" || (kind != ".shape" && kind != ".func" && kind != ".label");
}

bool lies_in(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

class Search {
 public:
  explicit Search(const std::string& folder) : folder_(folder) {
    std::error_code error;
    root_ = fs::canonical(folder_, error);
    if (error) throw ReadError(folder, error.message());
    if (!fs::is_directory(root_, error))
      throw ReadError(
          folder, "Not a directory: `sphparam info " + shell_file(folder) + "` tells of one mesh");
  }

  std::vector<std::string> run() {
    look_into(folder_);
    while (!links_.empty()) {
      std::set<fs::path> links;
      links.swap(links_);
      for (const fs::path& link : links) follow(link);
    }
    std::sort(names_.begin(), names_.end());
    return std::move(names_);
  }

 private:
  void look_into(const fs::path& folder) {
    std::error_code error;
    if (!known_.insert(fs::canonical(folder, error)).second) return;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
      look_at(*at);
    if (error) throw ReadError(folder.string(), error.message());
  }

  void look_at(const fs::directory_entry& entry) {
    std::error_code gone;  // between two looks: it is passed over
    const bool is_link = entry.is_symlink(gone);
    if (entry.is_directory(gone)) {
      if (is_link)
        links_.insert(entry.path());
      else
        look_into(entry.path());
    } else if (is_looked_at(entry.path().string()) &&
               (entry.is_regular_file(gone) || (is_link && !entry.exists(gone)))) {
      names_.push_back(entry.path().lexically_relative(folder_).string());
    }
  }

  void follow(const fs::path& link) {
    std::error_code gone;
    if (!lies_in(root_, fs::canonical(link, gone))) look_into(link);
  }

  fs::path folder_, root_;
  std::set<fs::path> known_,
      links_;  // folders by their own names; links to folders, to be followed
  std::vector<std::string> names_;
};

}  // namespace

std::vector<std::string> mesh_files(const std::string& folder) {
  std::vector<std::string> names = Search(folder).run();
  if (names.empty())
    throw ReadError(folder, "holds no mesh files; " + readable_formats("and") + " files are such");
  return names;
}

}  // namespace sphparam
