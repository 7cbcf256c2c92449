#include <algorithm>
#include <catch2/catch.hpp>
#include <cstring>
#include <nlohmann/json.hpp>

#include "sphparam/gltf/morph.h"
#include "sphparam/io/losses.h"
#include "sphparam/parameterize.h"
#include "support/glb_json.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

using nlohmann::json;

MappedMesh mapped(TriangleMesh mesh, const std::string& name) {
  MeshFile file;
  file.mesh = std::move(mesh);
  SphereMap map = parameterize(file.mesh).map;
  return MappedMesh({.file = std::move(file), .map = std::move(map), .name = name});
}

MappedMesh coloured(const MappedMesh& mapped, double red) {
  MeshFile file = mapped.file();
  const auto count = static_cast<size_t>(file.mesh.vertex_count());
  for (const char* channel : {"red", "green", "blue"}) {
    file.set_vertex_property(
        {channel, ScalarType::Uint8, std::vector<double>(count, *channel == 'r' ? red : 40)});
  }
  return MappedMesh({.file = std::move(file), .map = mapped.map(), .name = mapped.name()});
}

/// An egg with a bump on its side: no turn makes it fit itself.
TriangleMesh pear(int level, double bump) {
  TriangleMesh mesh = icosphere(level);
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 x = mesh.position(v);
    const double near = std::exp(-6 * (x - Vector3(0.6, 0.8, 0)).squaredNorm());
    mesh.positions.row(v) = (1 + bump * near) * x.cwiseProduct(Vector3(1, 1.2, 1.6));
  }
  return mesh;
}

/// One matched with another of the same sphere: their maps as they are.
SurfaceMap two_pears() {
  const MappedMesh from = mapped(pear(3, 0.5), "one.obj");
  MeshFile file;
  file.mesh = pear(3, 0.9);
  return {from, MappedMesh({.file = std::move(file), .map = from.map(), .name = "other.obj"})};
}

const ExportOptions small{.look = {.image_width = 64}, .up = {.direction = Vector3::UnitY()}};

/// #N×3 float32 of an accessor of a .glb.
FloatRows rows_of(const std::string& glb, const json& gltf, int accessor) {
  const json& entry = gltf["accessors"][accessor];
  const json& view = gltf["bufferViews"][entry["bufferView"].get<int>()];
  std::uint32_t json_length = 0;
  std::memcpy(&json_length, glb.data() + 12, 4);
  FloatRows rows(entry["count"].get<Eigen::Index>(), 3);
  std::memcpy(rows.data(), glb.data() + 20 + json_length + 8 + view["byteOffset"].get<size_t>(),
              static_cast<size_t>(rows.size()) * 4);
  return rows;
}

}  // namespace

TEST_CASE(
    "morph: as written, base and target are the two shapes, and its normals are the other's") {
  const SurfaceMap map = two_pears();
  const Asset asset = make_morph(map, Placement::AsItIs, small);
  const std::string glb = glb_bytes(asset);
  const json gltf = json_of(glb);
  const json& primitive = gltf["meshes"][0]["primitives"][0];
  REQUIRE(primitive["targets"].size() == 1);
  const json &base = primitive["attributes"], &target = primitive["targets"][0];
  const FloatRows before = rows_of(glb, gltf, base["POSITION"]),
                  change = rows_of(glb, gltf, target["POSITION"]);
  const FloatRows normals =
      rows_of(glb, gltf, base["NORMAL"]) + rows_of(glb, gltf, target["NORMAL"]);
  const CarriedShape carried = carried_shape(map);
  const TriangleMesh &one = map.from().mesh(), &other = map.to().mesh();
  for (Vertex v = 0; v < one.vertex_count(); ++v) {  // the first vertices of the chart
    CHECK((before.row(v).cast<double>() - one.positions.row(v)).norm() < 1e-6);
    CHECK((before.row(v).cast<double>() + change.row(v).cast<double>() - other.positions.row(v))
              .norm() < 1e-6);
    CHECK((normals.row(v).cast<double>() - carried.normals.row(v)).norm() < 1e-6);
  }
  CHECK(gltf["meshes"][0]["extras"]["targetNames"] == json::array({"other"}));
}

TEST_CASE("morph: the animation goes to the other shape and back") {
  const Asset asset = make_morph(two_pears(), Placement::Scaled, small);
  const json gltf = json_of(glb_bytes(asset));
  REQUIRE(gltf["animations"].size() == 1);
  const json& sampler = gltf["animations"][0]["samplers"][0];
  const json& weights = gltf["accessors"][sampler["output"].get<int>()];
  CHECK(weights["count"] == 5);  // A, A, B, B, A
  CHECK(gltf["animations"][0]["channels"][0]["target"]["path"] == "weights");
}

TEST_CASE("morph: a turned, scaled and shifted copy comes to lie on the shape itself") {
  const MappedMesh from = mapped(pear(3, 0.5), "one.obj");
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(2, Vector3(1, 2, -1).normalized()).toRotationMatrix();
  MeshFile file;
  file.mesh = {
      (from.mesh().positions * turn.transpose() * 40).rowwise() + Eigen::RowVector3d(100, -50, 7),
      from.mesh().triangles};
  const SurfaceMap map(from, MappedMesh({.file = file, .map = from.map(), .name = "copy"}));
  const Similarity scaled = placement_on(map, Placement::Scaled);
  CHECK(scaled.scale == Approx(1 / 40.0));
  CHECK((scaled.rotation * turn - Eigen::Matrix3d::Identity()).norm() < 1e-9);
  const Asset asset = make_morph(map, Placement::Scaled, small);
  CHECK(asset.levels[0].targets[0].positions.cwiseAbs().maxCoeff() < 1e-5F);
  const Similarity moved = placement_on(map, Placement::Moved);
  CHECK(moved.scale == 1);
  CHECK((moved.rotation - scaled.rotation).norm() < 1e-12);
  CHECK(placement_on(map, Placement::AsItIs).shift == Vector3::Zero());
}

TEST_CASE("morph: extras tell where the other shape was put") {
  const SurfaceMap map = two_pears();
  const Asset asset = make_morph(map, Placement::Scaled, small);
  const auto value = [&](const std::string& key) {
    for (const auto& [name, text] : asset.extras)
      if (name == key) return text;
    return std::string("absent");
  };
  CHECK(value("target") == "other.obj");
  CHECK(std::stod(value("target_scale")) == placement_on(map, Placement::Scaled).scale);
}

TEST_CASE("morph: numbers of both surfaces are told, which .glb has no place for") {
  const SurfaceMap bare = two_pears();
  const auto with_number = [](const MappedMesh& mapped, const char* name) {
    MeshFile file = mapped.file();
    file.set_vertex_property(
        {name, ScalarType::Float64, std::vector<double>(size_t(file.mesh.vertex_count()), 1)});
    return MappedMesh({.file = std::move(file), .map = mapped.map(), .name = mapped.name()});
  };
  const Asset asset = make_morph({with_number(bare.from(), "int0"), with_number(bare.to(), "int1")},
                                 Placement::Scaled, small);
  CHECK(losses_among(asset.warnings) ==
        std::vector<std::string>{
            "not carried: int0 of vertices: .ply has room for that",
            "not carried: int1 of vertices of other.obj: .ply has room for that"});
}

TEST_CASE("morph: the looks of both surfaces are there, that of a bare one only beside none") {
  const SurfaceMap bare = two_pears();
  const MappedMesh red = coloured(bare.from(), 200), blue = coloured(bare.to(), 10);
  const auto names = [](const Asset& asset) {
    std::vector<std::string> all;
    for (const Material& material : asset.materials) all.push_back(material.name);
    return all;
  };
  using Names = std::vector<std::string>;
  CHECK(names(make_morph(bare, Placement::Scaled, small)) == Names{"checker"});
  const Asset one = make_morph({red, bare.to()}, Placement::Scaled, small);
  CHECK(names(one) == Names{"one"});
  CHECK(one.levels[0].colours.size() == one.levels[0].vertex_count());
  const Asset both = make_morph({red, blue}, Placement::Scaled, small);
  CHECK(names(both) == Names{"one", "other"});
  CHECK(both.levels[0].colours.empty());  // they would tint the other's
  CHECK(both.images[0].bytes != both.images[1].bytes);
  const Asset other = make_morph({bare.from(), blue}, Placement::Scaled, small);
  CHECK(names(other) == Names{"other", "checker"});
  CHECK(other.levels[0].colours.empty());
  CHECK(other.materials[1].base_colour == 1);
}

TEST_CASE("morph: what is told of either look is told, and of both once") {
  const auto dressed = [](const MappedMesh& mapped, double roughness) {
    MeshFile file = mapped.file();
    file.materials = {"m"};
    file.base_colours.resize(1);
    file.channels.resize(1);
    file.channels[0].metallic.factor = {0, 0, 0, 1};
    file.channels[0].roughness.factor[0] = roughness;
    file.set_face_property(
        {"material", ScalarType::Int32, std::vector<double>(file.mesh.face_count(), 0)});
    file.corner_texcoords = CornerTexcoords::Zero(file.mesh.triangles.size(), 2);
    return MappedMesh({.file = std::move(file), .map = mapped.map(), .name = mapped.name()});
  };
  const SurfaceMap bare = two_pears();
  const std::string told =
      "not carried: roughness of its materials: `bake --map channels` makes images of all";
  const MappedMesh plain_from = dressed(bare.from(), 1), plain_to = dressed(bare.to(), 1);
  const MappedMesh rough_from = dressed(bare.from(), 0.5), rough_to = dressed(bare.to(), 0.5);
  const auto times = [&](const MappedMesh& from, const MappedMesh& to) {
    const Asset asset = make_morph({from, to}, Placement::Scaled, small);
    return std::ranges::count(asset.warnings, told);
  };
  CHECK(times(plain_from, plain_to) == 0);
  CHECK(times(rough_from, plain_to) == 1);
  CHECK(times(plain_from, rough_to) == 1);
  CHECK(times(rough_from, rough_to) == 1);
}

TEST_CASE("morph: the same bytes for one thread and three") {
  const SurfaceMap map = two_pears();
  ExportOptions one = small, three = small;
  one.threads = 1;
  three.threads = 3;
  CHECK(glb_bytes(make_morph(map, Placement::Scaled, one)) ==
        glb_bytes(make_morph(map, Placement::Scaled, three)));
}

TEST_CASE("morph: a shape that is no number in float32 is refused") {
  const SurfaceMap map = two_pears();
  MeshFile file = map.to().file();
  file.mesh.positions *= 1e60;
  const SurfaceMap large(map.from(), MappedMesh({.file = file, .map = map.to().map()}));
  CHECK_THROWS_AS(make_morph(large, Placement::AsItIs, small), std::range_error);
  CHECK_NOTHROW(make_morph(large, Placement::Scaled, small));
}

TEST_CASE("export: another shape without a row a vertex is refused") {
  const SurfaceMap map = two_pears();
  ExportOptions options = small;
  options.others = {{"few", Points::Zero(3, 3), Points::Zero(3, 3)}};
  CHECK_THROWS_AS(make_asset(map.from(), options), std::invalid_argument);
}

}  // namespace sphparam::tests
