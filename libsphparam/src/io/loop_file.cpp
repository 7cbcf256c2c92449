#include "sphparam/io/loop_file.h"

#include "number_text.h"
#include "sphparam/io/paths.h"
#include "sphparam/words.h"

namespace sphparam {

namespace {

std::string point_text(const Vector3& p) {
  return shortest(p.x()) + " " + shortest(p.y()) + " " + shortest(p.z()) + "\n";
}

std::string as_obj(const std::vector<HandleLoop>& loops) {
  std::string text = "# loops that handles were cut along\n";
  size_t first = 1;
  for (size_t i = 0; i < loops.size(); ++i) {
    const HandleLoop& loop = loops[i];
    const std::string number = std::to_string(i + 1);
    text += "# " + number + ": " + handle_line(loop) + "\no " + (loop.filled ? "fill" : "cut") +
            "_" + number + "\n";
    for (const Vector3& p : loop.points) text += "v " + point_text(p);
    text += "l";
    for (size_t k = 0; k <= loop.points.size(); ++k) {
      text += " " + std::to_string(first + k % loop.points.size());
    }
    text += "\n";
    first += loop.points.size();
  }
  return text;
}

std::string as_ply(const std::vector<HandleLoop>& loops) {
  std::string vertices, edges;
  size_t first = 0;
  for (size_t i = 0; i < loops.size(); ++i) {
    const size_t count = loops[i].points.size();
    for (size_t k = 0; k < count; ++k) {
      vertices += point_text(loops[i].points[k]);
      edges += std::to_string(first + k) + " " + std::to_string(first + (k + 1) % count) + " " +
               std::to_string(i + 1) + " " + (loops[i].filled ? "1" : "0") + "\n";
    }
    first += count;
  }
  const std::string count = std::to_string(first);
  return "ply\nformat ascii 1.0\ncomment loops that handles were cut along\nelement vertex " +
         count + "\nproperty double x\nproperty double y\nproperty double z\nelement edge " +
         count +
         "\nproperty int vertex1\nproperty int vertex2\nproperty int loop\nproperty uchar filled\n"
         "end_header\n" +
         vertices + edges;
}

}  // namespace

bool is_loop_file(const std::string& path) {
  const std::string extension = extension_of(path);
  return extension == ".obj" || extension == ".ply";
}

std::string serialise_loops(const std::string& path, const std::vector<HandleLoop>& loops) {
  return extension_of(path) == ".ply" ? as_ply(loops) : as_obj(loops);
}

}  // namespace sphparam
