// Lists shapes for same_maps: two thirds of the campaigns' hard ones and one of those that hurt, as
// they come but for large ones, and the closed genus-0 meshes of a folder.
//
//     same_shapes FILE [--count 1000] [--seed 1] [--most-triangles 500] [--meshes FOLDER]

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <string>

#include "hurting_shapes.h"
#include "shape_list.h"
#include "specimens.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/mesh/mesh_defects.h"

using namespace sphparam;
using namespace sphparam::campaign;

namespace {

TriangleMesh generated(std::uint64_t seed, std::uint64_t number) {
  return number % 3 == 2 ? make_hurting_shape(seed, number / 3).mesh
                         : make_specimen(seed, number).mesh;
}

void list_generated(std::ostream& out, std::uint64_t seed, int count, long most_triangles) {
  for (std::uint64_t number = 0; count > 0; ++number) {
    const TriangleMesh mesh = generated(seed, number);
    if (mesh.face_count() > most_triangles) continue;
    write_shape(out, {std::to_string(number), mesh});
    --count;
  }
}

/// Without blanks, which would end it.
std::string word(std::string name) {
  std::ranges::replace(name, ' ', '_');
  return name;
}

void list_meshes(std::ostream& out, const std::filesystem::path& folder) {
  std::set<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) paths.insert(entry.path());
  for (const auto& path : paths) {
    if (!is_mesh_name(path.string())) continue;
    const TriangleMesh mesh = read_mesh(path.string()).mesh;
    if (inspect_mesh(mesh).is_sphere()) write_shape(out, {word(path.filename().string()), mesh});
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("shapes that every build is to map alike");
  std::string file, meshes;
  std::uint64_t seed = 1;
  int count = 1000;
  long most_triangles = 500;
  app.add_option("FILE", file)->required();
  app.add_option("--count", count);
  app.add_option("--seed", seed);
  app.add_option("--most-triangles", most_triangles);
  app.add_option("--meshes", meshes);
  CLI11_PARSE(app, argc, argv);
  std::ofstream out(file);
  list_generated(out, seed, count, most_triangles);
  if (!meshes.empty()) list_meshes(out, meshes);
  return out.flush() ? 0 : 1;
}
