// make_samples DIRECTORY [NAME…] [--frequency N]: writes the sample meshes as PLY files.

#include <charconv>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <set>
#include <string>

#include "image/image_codec.h"
#include "sample_meshes.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/vertex_data.h"
#include "sphparam/mesh/mesh_defects.h"

namespace {

using sphparam::MeshFile;

constexpr char usage[] =
    "Make the sample meshes: closed genus-0 triangle meshes with vertex colours, as PLY.\n"
    "\n"
    "  make_samples samples-out                       body, creature and cortex\n"
    "  make_samples samples-out body                  body.ply and its texture body.png\n"
    "  make_samples samples-out body --frequency 59   20·59² = 69,620 triangles\n"
    "\n"
    "Names: body (20,480 triangles unless --frequency says otherwise), creature, cortex; and "
    "comet\n"
    "and brain (lh.white, lh.sulc, lh.lobes.annot: the cortex as FreeSurfer has one), which are "
    "made "
    "only\nwhere they are named.\n";

struct Arguments {
  std::string directory;
  std::set<std::string> names;
  int frequency = 32;
};

/// Throws std::invalid_argument with what is wrong.
Arguments parse(int count, char** values) {
  Arguments arguments;
  for (int i = 1; i < count; ++i) {
    const std::string value = values[i];
    if (value == "--frequency") {
      const std::string number = ++i < count ? values[i] : "";
      const auto end =
          std::from_chars(number.data(), number.data() + number.size(), arguments.frequency);
      if (end.ec != std::errc() || end.ptr != number.data() + number.size() ||
          arguments.frequency < 1 || arguments.frequency > 2000) {
        throw std::invalid_argument("--frequency wants a number from 1 to 2000");
      }
    } else if (arguments.directory.empty()) {
      arguments.directory = value;
    } else if (value == "body" || value == "creature" || value == "cortex" || value == "comet" ||
               value == "brain") {
      arguments.names.insert(value);
    } else {
      throw std::invalid_argument("no sample is called " + value);
    }
  }
  if (arguments.directory.empty()) throw std::invalid_argument("which directory?");
  if (arguments.names.empty()) arguments.names = {"body", "creature", "cortex"};
  return arguments;
}

void write_mesh(const std::filesystem::path& path, const MeshFile& file) {
  sphparam::require_sphere(file.mesh);
  const std::string bytes = sphparam::serialise_mesh(path.string(), file);
  std::ofstream out(path, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw std::runtime_error(path.string() + ": cannot be written");
  std::printf("%s: %ld vertices, %ld triangles\n", path.c_str(),
              static_cast<long>(file.mesh.vertex_count()),
              static_cast<long>(file.mesh.face_count()));
}

/// The cortex as FreeSurfer would have it: in millimetres, with the depth of its folds and with
/// lobes, those of both sides by one name.
void make_brain(const std::filesystem::path& directory) {
  constexpr double millimetres = 70;
  MeshFile cortex = sphparam::samples::make_cortex();
  sphparam::samples::add_lobes(cortex);
  cortex.mesh.positions *= millimetres;
  sphparam::VertexData depth, lobes;
  depth.columns.resize(1);
  lobes.columns.resize(1);
  const Eigen::VectorXd radius = cortex.mesh.positions.rowwise().norm();
  for (const double r : radius) depth.columns[0].values.push_back(radius.mean() - r);
  for (const double lobe : cortex.find_vertex_property("lobe")->values)
    lobes.columns[0].values.push_back(std::ceil(lobe / 2));
  lobes.kind = sphparam::DataKind::Labels;
  lobes.labels = {{0, {{0, 0, 0, 0}}, "???"},
                  {1, {{0.86F, 0.37F, 0.3F, 1}}, "frontal"},
                  {2, {{0.95F, 0.77F, 0.3F, 1}}, "parietal"},
                  {3, {{0.33F, 0.62F, 0.42F, 1}}, "temporal"},
                  {4, {{0.3F, 0.45F, 0.76F, 1}}, "occipital"}};
  MeshFile white;
  white.mesh = cortex.mesh;
  write_mesh(directory / "lh.white", white);
  for (const auto& [name, data] :
       {std::pair("lh.sulc", depth), std::pair("lh.lobes.annot", lobes)}) {
    sphparam::write_vertex_data((directory / name).string(), data);
    std::printf("%s\n", (directory / name).c_str());
  }
}

void make(const Arguments& arguments) {
  const std::filesystem::path directory = arguments.directory;
  std::filesystem::create_directories(directory);
  const std::set<std::string>& names = arguments.names;
  if (names.contains("body")) {
    MeshFile body = sphparam::samples::make_body(arguments.frequency);
    body.comments.push_back("TextureFile body.png");
    write_mesh(directory / "body.ply", body);
    const std::string texture = (directory / "body.png").string();
    sphparam::write_image(texture, sphparam::samples::make_body_texture());
    std::printf("%s\n", texture.c_str());
  }
  if (names.contains("creature")) {
    write_mesh(directory / "creature.ply", sphparam::samples::make_creature());
  }
  if (names.contains("comet")) {
    write_mesh(directory / "comet.ply", sphparam::samples::make_comet());
  }
  if (names.contains("brain")) make_brain(directory);
  if (names.contains("cortex")) {
    MeshFile cortex = sphparam::samples::make_cortex();
    sphparam::samples::add_lobes(cortex);
    write_mesh(directory / "cortex.ply", cortex);
  }
}

}  // namespace

int main(int count, char** values) try {
  if (count == 2 && std::string(values[1]) == "--help") {
    std::cout << usage;
    return 0;
  }
  make(parse(count, values));
  return 0;
} catch (const std::invalid_argument& e) {
  std::cerr << "make_samples: " << e.what() << "\n\n" << usage;
  return 2;
} catch (const std::exception& e) {
  std::cerr << "make_samples: " << e.what() << '\n';
  return 1;
}
