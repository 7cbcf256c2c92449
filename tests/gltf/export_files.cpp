// Writes a mesh as glTF with every option and every pair of options that go together, for the
// validator: export_files FOLDER MESH…

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "gltf/export_asset.h"
#include "gltf/gltf_writer.h"
#include "gltf/variant_images.h"
#include "gltf/written_check.h"
#include "image/image_codec.h"
#include "mesh_io/mesh_reader.h"
#include "mesh_io/sphere_file.h"
#include "mesh_io/welding.h"
#include "sphparam/parameterize.h"

using namespace sphparam;
using namespace sphparam::tools;

namespace {

namespace fs = std::filesystem;

struct Trial {
  std::string name;
  ExportChartOptions chart = {};
  GeometryOptions geometry = {};
  GltfOptions file = {};
  bool normal_map = false, variants = false, unlit = false, two_levels = false;
};

/// One option at a time, and what most often goes together.
std::vector<Trial> trials() {
  std::vector<Trial> all = {{.name = "plain"}};
  const auto add = [&](const std::string& name, auto&& change) {
    Trial trial{.name = name};
    change(trial);
    all.push_back(trial);
  };
  for (const ConventionInfo& info : all_conventions())
    add(info.name, [&](Trial& t) {
      t.chart.convention = info.convention;
      t.normal_map = true;
    });
  add("kept", [](Trial& t) {
    t.chart.keep_topology = true;
    t.normal_map = true;
  });
  add("poles", [](Trial& t) { t.chart.refine_poles = 7; });
  add("unlit", [](Trial& t) { t.unlit = true; });
  add("variants", [](Trial& t) { t.variants = true; });
  add("sphere", [](Trial& t) {
    t.geometry.shape = ShapeKind::Sphere;
    t.geometry.buffers.position_lo = true;
  });
  add("flat", [](Trial& t) { t.geometry.shape = ShapeKind::Flat; });
  add("theta", [](Trial& t) { t.geometry.buffers.theta_phi = true; });
  add("up", [](Trial& t) { t.geometry.up = Up::Y; });
  add("levels", [](Trial& t) { t.two_levels = true; });
  for (const bool quantised : {false, true}) {
    for (const bool compressed : {false, true}) {
      for (const Morph morph : {Morph::None, Morph::Sphere, Morph::Flat}) {
        for (const auto container :
             {GltfContainer::Binary, GltfContainer::Embedded, GltfContainer::Separate}) {
          const std::string name = std::string(quantised ? "q" : "f") + (compressed ? "c" : "r") +
                                   std::to_string(static_cast<int>(morph)) +
                                   std::to_string(static_cast<int>(container));
          add(name, [&](Trial& t) {
            t.geometry.morph = morph;
            t.geometry.buffers.theta_phi = true;
            t.normal_map = true;
            t.file = {.container = container, .quantise = quantised, .compress = compressed};
          });
        }
      }
    }
  }
  return all;
}

void write(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

void run(const Trial& trial, const MeshFile& file, const SphereMap& map, const Topology& topology,
         const std::string& stem, const fs::path& folder, const std::vector<AssetImage>& images) {
  GeometryOptions geometry = trial.geometry;
  geometry.buffers.tangents = trial.normal_map;
  geometry.buffers.colours = true;
  const ExportChart chart = export_chart(file.mesh, topology, map, trial.chart);
  ExportGeometry made = export_geometry(chart, file, geometry);
  Material material{.name = "checker", .base_colour = 0, .unlit = trial.unlit};
  if (trial.normal_map) material.normal = 1;
  Asset asset{.name = stem,
              .levels = {},
              .images = {images[0]},
              .materials = {material},
              .extras = chart_extras(chart, made, trial.chart)};
  if (trial.normal_map) asset.images.push_back(images[1]);
  if (trial.variants) {
    asset.images.push_back(images[2]);
    asset.materials.push_back({.name = "graticule", .base_colour = 1});
  }
  if (trial.two_levels) asset.levels.push_back(made.surface);
  asset.levels.push_back(std::move(made.surface));
  GltfOptions options = trial.file;
  options.stem = stem + "_" + trial.name;
  if (!options.compress) check_written(glb_bytes(asset, options), stem, asset, options);
  const char* extension = options.container == GltfContainer::Binary ? ".glb" : ".gltf";
  for (const auto& [name, bytes] : write_gltf(asset, options))
    write(folder / (name.empty() ? options.stem + extension : name), bytes);
  if (!made.stored.folded.empty() && !trial.chart.keep_topology &&
      trial.file.container == GltfContainer::Binary)
    std::printf("%s %s: %zu of %ld triangles fold as stored\n", stem.c_str(), trial.name.c_str(),
                made.stored.folded.size(), static_cast<long>(chart.chart.triangles.rows()));
}

}  // namespace

int main(int argc, char** argv) {
  const fs::path folder = argv[1];
  fs::create_directories(folder);
  Image flat(4, 2, 3);
  for (size_t i = 0; i < flat.pixels.size(); ++i) flat.pixels[i] = i % 3 == 2 ? 1.0F : 0.5F;
  const std::vector<char> normal = encode_image(flat, ImageFormat::Png);
  const std::vector<AssetImage> images = {
      test_asset_image(TestImage::Checker, 64, Convention::Sphparam),
      {"normal", {normal.begin(), normal.end()}},
      test_asset_image(TestImage::Graticule, 64, Convention::Sphparam)};
  for (int i = 2; i < argc; ++i) {
    const MeshFile file = prepare_for_mapping(read_mesh(argv[i]));
    const Topology topology(file.mesh);
    std::optional<SphereMap> map = read_sphere(file);
    if (!map) map = parameterize(file.mesh).map;
    for (const Trial& trial : trials())
      run(trial, file, *map, topology, fs::path(argv[i]).stem().string(), folder, images);
  }
}
