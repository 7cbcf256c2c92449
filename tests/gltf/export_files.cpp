// Writes a mesh as glTF with every option and every pair of options that go together, for the
// validator: export_files FOLDER [MESH…]. Without meshes: some of our own, small and nasty.

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "gltf/export_asset.h"
#include "gltf/images/texture_format.h"
#include "gltf/images/variant_images.h"
#include "gltf/written_check.h"
#include "image/image_codec.h"
#include "io/attributes/hard_edges.h"
#include "io/polygons/welding.h"
#include "sphparam/gltf/gltf_writer.h"
#include "sphparam/gltf/morph.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/parameterize.h"
#include "support/test_meshes.h"

using namespace sphparam;

namespace {

namespace fs = std::filesystem;

struct Trial {
  std::string name;
  ExportChartOptions chart = {};
  GeometryOptions geometry = {};
  GltfOptions file = {};
  bool source_uv = false;  // where the mesh has them
  bool normal_map = false, variants = false, unlit = false, two_levels = false;
  TextureFormat textures = TextureFormat::Given;
  MaterialFinish finish = {};
  bool double_sided = false;
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
  add("finish", [](Trial& t) {
    t.finish = {.clearcoat = 1,
                .clearcoat_roughness = 0.5,
                .sheen = {1, 0.5, 0},
                .sheen_roughness = 0.25,
                .transmission = 0.5,
                .ior = 1.33,
                .specular = 0.5,
                .specular_colour = {2, 1, 0.5},
                .iridescence = 1,
                .iridescence_ior = 1.8,
                .iridescence_thickness = 300,
                .thickness = 0.5,
                .attenuation_distance = 2,
                .attenuation_colour = {1, 0.5, 0.25},
                .dispersion = 0.1};
    t.normal_map = t.double_sided = true;
  });
  add("effectless", [](Trial& t) {
    t.finish.clearcoat_roughness = t.finish.thickness = t.finish.dispersion = 1;
    t.finish.iridescence_thickness = 3;
    t.double_sided = true;
  });
  add("variants", [](Trial& t) { t.variants = true; });
  for (const bool compressed : {false, true}) {
    for (const auto container :
         {GltfContainer::Binary, GltfContainer::Embedded, GltfContainer::Separate}) {
      const std::string name =
          std::string(compressed ? "webpc" : "webp") + std::to_string(static_cast<int>(container));
      add(name, [&](Trial& t) {
        t.textures = TextureFormat::Webp;
        t.normal_map = t.variants = true;
        t.file = {.container = container, .compress = compressed};
      });
    }
  }
  add("sphere", [](Trial& t) {
    t.geometry.shape = ShapeKind::Sphere;
    t.geometry.buffers.position_lo = true;
  });
  add("flat", [](Trial& t) { t.geometry.shape = ShapeKind::Flat; });
  add("theta", [](Trial& t) { t.geometry.buffers.theta_phi = true; });
  add("up", [](Trial& t) { t.geometry.up = {Vector3::UnitY(), Vector3::UnitZ()}; });
  add("own", [](Trial& t) { t.source_uv = true; });
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
  geometry.buffers.source_texcoords = trial.source_uv && file.corner_texcoords.has_value();
  ExportChart chart = export_chart(file.mesh, topology, map, trial.chart);
  if (geometry.shape == ShapeKind::Mesh)
    chart.wedge_normals = split_at_hard_edges(chart.chart, file);
  ExportGeometry made = export_geometry(chart, file, geometry);
  Material material{.name = "checker",
                    .base_colour = 0,
                    .double_sided = trial.double_sided,
                    .unlit = trial.unlit,
                    .finish = trial.finish};
  if (trial.normal_map) material.normal = 1;
  Asset asset{.name = stem,
              .levels = {},
              .images = {images[0]},
              .materials = {material},
              .extras = chart_extras(chart, made, trial.chart)};
  if (trial.normal_map) asset.images.push_back(images[1]);
  if (trial.variants) {
    asset.images.push_back(images[2]);
    asset.materials.push_back(
        {.name = "graticule", .base_colour = static_cast<int>(asset.images.size()) - 1});
  }
  Look look{.images = std::move(asset.images), .materials = std::move(asset.materials)};
  encode_textures(look, {.textures = trial.textures}, 1);
  asset.images = std::move(look.images);
  asset.materials = std::move(look.materials);
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

std::vector<AssetImage> make_images() {
  Image flat(4, 2, 3);
  for (size_t i = 0; i < flat.pixels.size(); ++i) flat.pixels[i] = i % 3 == 2 ? 1.0F : 0.5F;
  return {test_asset_image(TestImage::Checker, 64, Convention::Sphparam), as_png("normal", flat),
          test_asset_image(TestImage::Graticule, 64, Convention::Sphparam)};
}

struct Named {
  std::string name;
  MeshFile file;
};

/// Four triangles; many faces without area; faces too small for float32; colours and own (u, v),
/// and a normal of its own at every corner.
std::vector<Named> own_meshes() {
  std::vector<Named> meshes(4);
  meshes[0] = {"tetrahedron", {}};
  meshes[0].file.mesh = tests::tetrahedron();
  meshes[1] = {"collapsed", {}};
  meshes[1].file.mesh = tests::random_sphere_mesh(200, 5);
  Points& collapsed = meshes[1].file.mesh.positions;
  for (Eigen::Index v = 0; v < 120; ++v) collapsed.row(v) = collapsed.row(v % 9);
  meshes[2] = {"far", {}};
  meshes[2].file.mesh = tests::icosphere(3);
  meshes[2].file.mesh.positions.rowwise() += Eigen::RowVector3d(4e6, 5e6, 100);
  meshes[3] = {"coloured", {}};
  MeshFile& coloured = meshes[3].file;
  coloured.mesh = tests::icosphere(4);
  const auto count = static_cast<size_t>(coloured.mesh.vertex_count());
  for (const char* channel : {"red", "green", "blue"})
    coloured.set_vertex_property({channel, ScalarType::Uint8, std::vector<double>(count, 99)});
  coloured.corner_texcoords = CornerTexcoords::Random(coloured.mesh.triangles.size(), 2);
  coloured.corner_normals = CornerNormals::Random(coloured.mesh.triangles.size(), 3);
  return meshes;
}

void run_all(const Named& mesh, const fs::path& folder, const std::vector<AssetImage>& images) {
  const Topology topology(mesh.file.mesh);
  std::optional<SphereMap> map = read_sphere(mesh.file);
  if (!map) map = parameterize(mesh.file.mesh).map;
  for (const Trial& trial : trials())
    run(trial, mesh.file, *map, topology, mesh.name, folder, images);
}

/// Each of these meshes turning into each other, in its own coordinates and put to one place.
void run_morphs(const std::vector<Named>& meshes, const fs::path& folder) {
  std::vector<MappedMesh> mapped;
  for (const Named& mesh : meshes)
    mapped.push_back(MappedMesh(
        {.file = mesh.file, .map = parameterize(mesh.file.mesh).map, .name = mesh.name + ".obj"}));
  ExportOptions options;
  options.look.image_width = 64;
  for (const MappedMesh& from : mapped) {
    for (const MappedMesh& to : mapped) {
      const std::string stem = from.name() + "_" + to.name();
      for (const Placement placement : {Placement::AsItIs, Placement::Scaled}) {
        const std::string kind = placement == Placement::AsItIs ? "_there.glb" : "_here.glb";
        write(folder / (stem + kind), glb_bytes(make_morph({from, to}, placement, options)));
      }
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  fs::create_directories(argv[1]);
  const std::vector<AssetImage> images = make_images();
  if (argc == 2) {
    for (const Named& mesh : own_meshes()) run_all(mesh, argv[1], images);
    run_morphs(own_meshes(), argv[1]);
  }
  for (int i = 2; i < argc; ++i)
    run_all({fs::path(argv[i]).stem().string(), prepare_for_mapping(read_mesh(argv[i]))}, argv[1],
            images);
}
