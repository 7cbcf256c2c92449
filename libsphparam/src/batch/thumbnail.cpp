#include "batch/thumbnail.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "sphparam/io/safe_file.h"
#include "sphparam/render/picture.h"

namespace sphparam {

namespace {

namespace fs = std::filesystem;

/// The shortest name: ID.sph.ply comes before ID_remesh.sph.ply.
std::string first_map() {
  std::vector<std::string> maps;
  for (const auto& entry : fs::directory_iterator(".")) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".sph.ply")) maps.push_back(name);
  }
  const auto before = [](const std::string& a, const std::string& b) {
    return a.size() != b.size() ? a.size() < b.size() : a < b;
  };
  const auto first = std::ranges::min_element(maps, before);
  return first == maps.end() ? "" : *first;
}

}  // namespace

void add_thumbnail(int pixels) try {
  const std::string map = first_map();
  if (pixels == 0 || map.empty()) return;
  const DrawnMesh drawn = load_drawn(map);
  write_file("thumbnail.png", draw_png(drawn.file, drawn.map,
                                       {.view = View::Both,
                                        .colouring = Colouring::Area,
                                        .legend = false,
                                        .size = pixels,
                                        .threads = 1}));
} catch (const std::exception& error) {
  std::fprintf(stderr, "sphparam: warning: no picture of it: %s\n", error.what());
}

}  // namespace sphparam
