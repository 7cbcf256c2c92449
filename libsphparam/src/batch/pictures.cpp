#include "batch/pictures.h"

#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>

#include "batch/thumbnail.h"
#include "sphparam/io/safe_file.h"

namespace sphparam {

namespace {

namespace fs = std::filesystem;

constexpr int pixels = 128;

/// The shortest name: ID.sph.ply comes before ID_remesh.sph.ply.
const BatchFile* map_among(const std::vector<BatchFile>& files) {
  const BatchFile* map = nullptr;
  for (const BatchFile& file : files) {
    if (!file.name.ends_with(".sph.ply")) continue;
    if (!map || file.name.size() < map->name.size()) map = &file;
  }
  return map;
}

/// Renamed as a whole, but not brought to the disk: it can be drawn again.
void write_picture(const fs::path& path, const std::string& bytes) {
  const fs::path temporary =
      path.parent_path() / ("." + path.filename().string() + "~" + std::to_string(::getpid()));
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  std::ofstream out(temporary, std::ios::binary);
  out << bytes;
  out.close();
  if (!out) error = std::error_code(errno, std::generic_category());
  if (!error) fs::rename(temporary, path, error);
  if (!error) return;
  std::error_code hidden;
  fs::remove(temporary, hidden);
  throw WriteError(path.string(), error.message());
}

}  // namespace

std::string picture_of(const std::string& folder, const std::string& id,
                       const std::vector<BatchFile>& files) {
  const BatchFile* const map = map_among(files);
  if (!map) return "";
  const std::string name = "pictures/" + id + "-" + map->hash.substr(0, 8) + ".png";
  const fs::path path = fs::path(folder) / name;
  if (fs::exists(path)) return name;
  try {
    ReadOptions options;
    options.only_map = true;
    const DrawnMesh drawn = load_drawn(result_folder(folder, id) + "/" + map->name, "", options);
    if (!drawn.map) return "";
    write_picture(path, draw_thumbnail(drawn, pixels));
  } catch (const ReadError&) {  // a map that was removed: the page says that there is no picture
    return "";
  }
  return name;
}

}  // namespace sphparam
