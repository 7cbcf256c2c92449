#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <thread>

#include "reading.h"
#include "sphparam/errors.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/fillers.h"
#include "sphparam/chart/spherical_chart.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/safe_file.h"
#include "support/folder.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
namespace fs = std::filesystem;

namespace {

MeshFile egg_file() {
  MeshFile file;
  file.mesh = icosphere(2);
  file.mesh.positions.col(2) *= 1.5;
  return file;
}

SphereMap identity() { return {icosphere(2).positions}; }

MappedMesh egg() {
  return MappedMesh({.file = egg_file(), .map = identity(), .provenance = {{"method", "given"}}});
}

/// One vertex is thrown to the other side.
SphereMap folded() {
  SphereMap map = identity();
  map.points.row(7) *= -1;
  return map;
}

/// A closed box of six quads, as its polygons and their triangles.
struct Box {
  MeshFile file;
  Polygons polygons;
};

Box box() {
  Box result;
  Points& corners = result.file.mesh.positions;
  corners.resize(8, 3);
  for (int i = 0; i < 8; ++i)
    corners.row(i) << (i & 1 ? 1 : -1), (i & 2 ? 1 : -1), (i & 4 ? 1 : -1);
  const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& quad : quads) {
    for (const int v : quad) result.polygons.add_corner(v);
    REQUIRE(result.polygons.close_polygon({}).empty());
  }
  adopt_triangulation(result.file, triangulate(corners, result.polygons));
  return result;
}

}  // namespace

TEST_CASE("mapped_mesh: what it holds is proved") {
  const MappedMesh mapped = egg();
  CHECK(mapped.certificate().bijective());
  CHECK(mapped.map().points == identity().points);
  CHECK(mapped.topology().is_of(mapped.mesh().triangles));
  CHECK(mapped.provenance() == Provenance{{"method", "given"}});
  CHECK_FALSE(mapped.mapped_here());
  CHECK_FALSE(mapped.polygons());
}

TEST_CASE("mapped_mesh: a folded map is refused by the mesh's name and the faces at fault") {
  CHECK_THROWS_AS(MappedMesh({.file = egg_file(), .map = folded()}), NotCertifiedError);
  CHECK_THROWS_WITH(MappedMesh({.file = egg_file(), .map = folded(), .name = "egg.obj"}),
                    Catch::StartsWith("egg.obj") && Catch::Contains("folded"));
}

TEST_CASE("mapped_mesh: a map is refused that is of another mesh, and so is a topology") {
  CHECK_THROWS_AS(MappedMesh({.file = egg_file(), .map = {icosphere(1).positions}}),
                  std::invalid_argument);
  CHECK_THROWS_AS(egg().with_map({icosphere(3).positions}, {}), std::invalid_argument);
  CHECK_THROWS_AS(
      MappedMesh({.file = egg_file(), .map = identity(), .topology = Topology(icosphere(1))}),
      std::invalid_argument);
}

TEST_CASE("mapped_mesh: a mesh with a hole is refused before its map is looked at") {
  MeshFile file = egg_file();
  file.mesh.triangles.conservativeResize(file.mesh.face_count() - 1, 3);
  CHECK_THROWS_AS(MappedMesh({.file = file, .map = identity()}), MeshError);
}

TEST_CASE("mapped_mesh: arrays that are not as long as the mesh has it are refused") {
  const auto refuses = [](const char* what, auto&& change) {
    INFO(what);
    MeshFile file = egg_file();
    file.materials = {"m"};
    change(file);
    CHECK_THROWS_AS(MappedMesh({.file = file, .map = identity()}), std::invalid_argument);
    CHECK_THROWS_WITH(MappedMesh({.file = file, .map = identity()}), Catch::Contains(what));
  };
  const auto v = static_cast<size_t>(egg_file().mesh.vertex_count()), f = 2 * v - 4;
  const auto row = static_cast<Eigen::Index>(f);
  const auto values = [](size_t count) { return std::vector<double>(count, 0); };
  refuses("'q' has 157", [&](MeshFile& file) {
    file.set_vertex_property({"q", ScalarType::Uint8, values(v - 5)});
  });
  refuses("'q' has 163", [&](MeshFile& file) {
    file.set_vertex_property({"q", ScalarType::Float64, values(v + 1)});
  });
  refuses("'nx'", [&](MeshFile& file) { file.set_vertex_property({"nx", {}, {}}); });
  refuses("'patch'", [&](MeshFile& file) { file.set_face_property({"patch", {}, values(f - 1)}); });
  refuses("corner_texcoords",
          [](MeshFile& file) { file.corner_texcoords = CornerTexcoords(4, 2); });
  refuses("corner_normals", [](MeshFile& file) { file.corner_normals = CornerNormals(4, 3); });
  refuses("second_texcoords",
          [](MeshFile& file) { file.second_texcoords = CornerTexcoords(0, 2); });
  refuses("corner_tangents",
          [&](MeshFile& file) { file.corner_tangents = CornerTangents(3 * row + 1, 4); });
  refuses("base_colours", [](MeshFile& file) { file.base_colours.resize(2); });
  refuses("channels", [](MeshFile& file) { file.channels.resize(2); });
  for (const double id : {1.0, -2.0, std::nan("")})
    refuses("'material'", [&](MeshFile& file) {
      file.channels.resize(1);
      file.set_face_property({"material", ScalarType::Float64, std::vector<double>(f, id)});
    });
}

TEST_CASE("mapped_mesh: arrays of the right length are taken, with faces of no material") {
  MeshFile file = egg_file();
  const Eigen::Index faces = file.mesh.face_count();
  file.materials = {"m"};
  file.base_colours.resize(1);
  file.channels.resize(1);
  file.corner_texcoords = CornerTexcoords::Zero(3 * faces, 2);
  Property material{"material", ScalarType::Int32, std::vector<double>(size_t(faces), -1)};
  material.values.front() = 0;
  file.set_face_property(std::move(material));
  CHECK(MappedMesh({.file = file, .map = identity()}).certificate().bijective());
}

TEST_CASE("mapped_mesh: positions that are no finite numbers are refused by the mesh's name") {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    MeshFile file = egg_file();
    file.mesh.positions(3, 1) = bad;
    CHECK_THROWS_AS(MappedMesh({.file = file, .map = identity()}), UnmeasurableMesh);
    CHECK_THROWS_WITH(MappedMesh({.file = file, .map = identity(), .name = "egg.obj"}),
                      Catch::StartsWith("egg.obj") && Catch::Contains("vertex 3"));
  }
}

TEST_CASE("mapped_mesh: polygons are those of its triangles") {
  const Box made = box();
  const SphereMap map{made.file.mesh.positions};
  const auto refuses = [&](auto&& change) {
    Polygons polygons = made.polygons;
    change(polygons);
    CHECK_THROWS_AS(MappedMesh({.file = made.file, .map = map, .polygons = polygons}),
                    std::invalid_argument);
  };
  refuses([](Polygons& polygons) { polygons.corners[5] = 8; });
  refuses([](Polygons& polygons) { polygons.corners[5] = -1; });
  refuses([](Polygons& polygons) { polygons.corners.pop_back(); });
  refuses([](Polygons& polygons) { polygons.starts.pop_back(); });
  refuses([](Polygons& polygons) { polygons = {}; });
  refuses([](Polygons& polygons) { polygons.starts[1] = 9; });
}

TEST_CASE("mapped_mesh: a source of a file alone is looked at, and mapped or refused") {
  MeshSource source;
  source.file = egg_file();
  CHECK(mapped_mesh(source).certificate().bijective());
  source.file.mesh.triangles.conservativeResize(source.file.mesh.face_count() - 1, 3);
  CHECK_THROWS_AS(mapped_mesh(source), MeshRefusal);
  CHECK_THROWS_AS(mapped_mesh(MeshSource{}), MeshRefusal);
  source.file = egg_file();
  for (const char* ray : {"sx", "sy", "sz"})
    source.file.set_vertex_property({ray, ScalarType::Float64, {1, 0, 0}});
  CHECK_THROWS_AS(mapped_mesh(source), std::invalid_argument);
}

TEST_CASE("mapped_mesh: a map that is made says how it came about, as `map` does") {
  MeshSource source;
  source.file = egg_file();
  LoadOptions options;
  options.map.poles = Poles{5, 9};
  options.map.meridian = 20;
  const Provenance lines = mapped_mesh(source, options).provenance();
  const auto has = [&](const char* key, const char* value) {
    return std::ranges::count(lines, std::pair<std::string, std::string>(key, value)) == 1;
  };
  CHECK(has("poles", "5 9"));
  CHECK(has("meridian", "20"));
  CHECK(lines.back() == std::pair<std::string, std::string>("verdict", "one-to-one"));
}

TEST_CASE("mapped_mesh: two spheres are no sphere") {
  const MeshFile one = egg_file();
  const int v = static_cast<int>(one.mesh.vertex_count());
  MeshFile two;
  two.mesh.positions.resize(2 * v, 3);
  two.mesh.positions << one.mesh.positions, one.mesh.positions;
  two.mesh.triangles.resize(2 * one.mesh.face_count(), 3);
  two.mesh.triangles << one.mesh.triangles, (one.mesh.triangles.array() + v).matrix();
  CHECK_THROWS_AS(MappedMesh({.file = two, .map = {two.mesh.positions}}), NotCertifiedError);
}

TEST_CASE("mapped_mesh: rays become unit, those that are stay as they are") {
  SphereMap stretched = identity();
  for (Eigen::Index v = 0; v < stretched.points.rows(); ++v)
    stretched.points.row(v) *= 1 + static_cast<double>(v);
  const MappedMesh mapped({.file = egg_file(), .map = stretched});
  CHECK((mapped.map().points.rowwise().norm().array() - 1).abs().maxCoeff() < 1e-15);
  CHECK(mapped.certificate().max_length_error < 1e-15);
  CHECK((mapped.map().points - identity().points).cwiseAbs().maxCoeff() < 1e-15);
  CHECK(unit_rays(identity()).points == identity().points);
}

TEST_CASE("mapped_mesh: rays of any finite length are those of a map") {
  for (const double length : {1e20, 1e100, 1e300, 1e-170}) {
    INFO(length);
    SphereMap map = identity();
    map.points *= length;
    const MappedMesh mapped({.file = egg_file(), .map = map});
    CHECK((mapped.map().points - identity().points).cwiseAbs().maxCoeff() < 1e-15);
    CHECK(mapped.with_map(map, {}).map().points == mapped.map().points);
  }
}

TEST_CASE("mapped_mesh: copies share everything") {
  const MappedMesh mapped = egg();
  const MappedMesh copy = mapped;
  CHECK(&copy.mesh() == &mapped.mesh());
  CHECK(&copy.map() == &mapped.map());
  CHECK(&copy.locator() == &mapped.locator());
}

TEST_CASE("mapped_mesh: with another map the mesh is the same one") {
  const MappedMesh mapped = egg();
  SphereMap turned = identity();
  turned.points.col(0).swap(turned.points.col(1));
  turned.points.col(0) *= -1;
  const MappedMesh other = mapped.with_map(turned, {{"method", "turned"}});
  CHECK(&other.mesh() == &mapped.mesh());
  CHECK(&other.topology() == &mapped.topology());
  CHECK(other.map().points == turned.points);
  CHECK(other.provenance() == Provenance{{"method", "turned"}});
  CHECK(other.mapped_here());
  CHECK(&other.locator() != &mapped.locator());
  CHECK(mapped.map().points == identity().points);
  CHECK_THROWS_AS(mapped.with_map(folded(), {}), NotCertifiedError);
}

TEST_CASE("mapped_mesh: a chart at hand is shared, and is that of the map") {
  const MappedMesh bare = egg();
  CHECK(bare.chart() == nullptr);
  const MappedMesh charted = bare.with_chart();
  REQUIRE(charted.chart() != nullptr);
  const SphericalChart made = spherical_chart(bare.mesh(), bare.topology(), bare.map());
  CHECK(charted.chart()->uv == made.uv);
  CHECK(chart_of(charted).uv == made.uv);
  CHECK(chart_of(bare).uv == made.uv);
  CHECK(MappedMesh(charted).chart() == charted.chart());
  SphereMap turned = identity();
  turned.points.col(0).swap(turned.points.col(1));
  turned.points.col(0) *= -1;
  CHECK(charted.with_map(turned, {}).chart() == nullptr);
}

TEST_CASE("mapped_mesh: it outlives what it was made of") {
  const MappedMesh other = [] {
    const MappedMesh mapped = egg();
    return mapped.with_map(identity(), {});
  }();
  CHECK(other.mesh().vertex_count() == 162);
  CHECK(other.locator().locate(Vector3::UnitZ()).face >= 0);
}

TEST_CASE("mapped_mesh: threads that ask at once get one locator") {
  const MappedMesh mapped = egg();
  std::array<const SphereLocator*, 8> seen{};
  {
    std::vector<std::jthread> threads;
    for (auto& slot : seen) threads.emplace_back([&] { slot = &mapped.locator(); });
  }
  for (const SphereLocator* locator : seen) CHECK(locator == seen[0]);
  CHECK(seen[0] == &mapped.locator());
}

TEST_CASE("mapped_mesh: saved and loaded it is the same, bit for bit") {
  const Folder folder;
  save_mapped(folder / "egg.sph.ply", egg());
  const MappedMesh back = load_mapped(folder / "egg.sph.ply");
  CHECK(back.map().points == egg().map().points);
  CHECK(back.mesh().positions == egg().mesh().positions);
  CHECK(back.provenance() == egg().provenance());
  CHECK_FALSE(back.mapped_here());
  CHECK(back.name() == "egg.sph.ply");
}

TEST_CASE("mapped_mesh: formats without a place for the map hold the mesh alone") {
  const Folder folder;
  for (const char* name : {"egg.obj", "egg.off", "egg.gii"}) {
    save_mapped(folder / name, egg());
    const MeshFile back = read_mesh(folder / name);
    const Points positions = egg().mesh().positions;
    const bool rounds = fs::path(name).extension() == ".gii";
    CHECK(back.mesh.positions ==
          (rounds ? Points(positions.cast<float>().cast<double>()) : positions));
    CHECK_FALSE(read_sphere(back));
  }
  CHECK_THROWS_AS(save_mapped(folder / "egg.dae", egg()), WriteError);
  CHECK_FALSE(fs::exists(folder / "egg.dae"));
}

TEST_CASE("mapped_mesh: a mesh without a map is mapped, and says how") {
  const Folder folder;
  write_mesh(folder / "egg.obj", egg_file());
  const MappedMesh mapped = load_mapped(folder / "egg.obj");
  CHECK(mapped.certificate().bijective());
  CHECK(mapped.mapped_here());
  CHECK(mapped.provenance().back() == std::pair<std::string, std::string>{"verdict", "one-to-one"});
}

TEST_CASE("mapped_mesh: the sphere may be a file of its own, of any radius") {
  const Folder folder;
  write_mesh(folder / "egg.obj", egg_file());
  SphereMap large = identity();
  large.points *= 100;
  write_mesh(folder / "sphere.off", sphere_mesh(egg_file(), large, {}), {.is_sphere = true});
  const MappedMesh mapped = load_mapped(folder / "egg.obj", {.sphere = folder / "sphere.off"});
  CHECK((mapped.map().points - identity().points).cwiseAbs().maxCoeff() < 1e-15);
  CHECK_FALSE(mapped.mapped_here());
  CHECK(mapped.notes().empty());

  MeshFile other;
  other.mesh = icosphere(1);
  write_mesh(folder / "other.off", other);
  CHECK_THROWS_AS(load_mapped(folder / "egg.obj", {.sphere = folder / "other.off"}), ReadError);
  write_mesh(folder / "folded.off", sphere_mesh(egg_file(), folded(), {}));
  CHECK_THROWS_WITH(load_mapped(folder / "egg.obj", {.sphere = folder / "folded.off"}),
                    Catch::StartsWith("folded.off"));
}

TEST_CASE("mapped_mesh: a sphere that was moved off the origin is taken by its rays, and told") {
  const Folder folder;
  write_mesh(folder / "egg.obj", egg_file());
  SphereMap moved = identity();
  moved.points.col(1).array() += 0.5;
  write_mesh(folder / "off.off", sphere_mesh(egg_file(), moved, {}), {.is_sphere = true});
  const MappedMesh mapped = load_mapped(folder / "egg.obj", {.sphere = folder / "off.off"});
  CHECK(mapped.notes() ==
        std::vector<std::string>{"off.off: these points are not on a sphere about the origin: "
                                 "their radius is 1.08 in the mean, and up to 53.8 % more or less; "
                                 "their directions are judged"});
}

TEST_CASE("mapped_mesh: a mesh that needs it is mended where that is asked for") {
  const Folder folder;
  MeshFile open = egg_file();
  open.mesh.triangles.conservativeResize(open.mesh.face_count() - 1, 3);
  write_mesh(folder / "open.obj", open);
  CHECK_THROWS_AS(load_mapped(folder / "open.obj"), MeshRefusal);
  const MappedMesh mended = load_mapped(folder / "open.obj", {.repair = RepairOptions{}});
  CHECK(mended.mesh().face_count() == egg_file().mesh.face_count());
  CHECK(mended.certificate().bijective());
}

TEST_CASE("mapped_mesh: the polygons that the triangles are cut of are kept and written") {
  const Folder folder;
  const auto [file, polygons] = box();
  const MappedMesh mapped(
      {.file = file, .map = {file.mesh.positions}, .polygons = polygons, .name = "box"});
  REQUIRE(mapped.polygons());
  CHECK(mapped.polygons()->corners == polygons.corners);
  for (const char* name : {"box.sph.ply", "box.obj"}) {
    save_mapped(folder / name, mapped);
    const MeshFile back = read_mesh(folder / name);
    CHECK(back.polygons == 6);
    CHECK(back.mesh.triangles == file.mesh.triangles);
  }
}

TEST_CASE("mapped_mesh: a surface without its fillers is written in the polygons that are left") {
  const Folder folder;
  auto [file, polygons] = box();
  // The quads about vertex 0, two triangles each, close a hole: no other quad has that vertex.
  mark_fillers(file, {1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0});
  const MappedMesh mapped({.file = file, .map = {file.mesh.positions}, .polygons = polygons});
  PendingFiles files;
  add_mapped(files, folder / "box.obj", mapped, 1, {}, FillersInFile::Left);
  files.publish();
  const MeshFile back = read_mesh(folder / "box.obj");
  CHECK(back.polygons == 3);
  CHECK(back.mesh.positions == file.mesh.positions.bottomRows(7));
  Triangles left(6, 3);
  for (const int t : {2, 3, 6, 7, 10, 11})
    left.row(t / 4 * 2 + t % 2) = file.mesh.triangles.row(t).array() - 1;
  CHECK(back.mesh.triangles == left);
}

TEST_CASE("mapped_mesh: progress may cancel the map that is made") {
  const Folder folder;
  write_mesh(folder / "egg.obj", egg_file());
  LoadOptions options;
  options.map.progress = [](std::string_view, double) { return false; };
  CHECK_THROWS_AS(load_mapped(folder / "egg.obj", options), Cancelled);
}

// The lines of docs/components/io.md, which a test of documents looks for here.
TEST_CASE("mapped_mesh: vectors of a program become a mapped mesh with what its vertices carry") {
  const sphparam::TriangleMesh ball = icosphere(1);
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<int, 3>> faces;
  for (const auto& p : ball.positions.rowwise()) points.push_back({p[0], p[1], 2 * p[2]});
  for (const auto& f : ball.triangles.rowwise()) faces.push_back({f[0], f[1], f[2]});
  const std::vector<double> thickness(points.size(), 2.5);

  sphparam::MeshSource own;
  auto& mesh = own.file.mesh;
  mesh.positions.resize(std::ssize(points), 3);
  for (int v = 0; v < std::ssize(points); ++v)
    mesh.positions.row(v) << points[v][0], points[v][1], points[v][2];
  mesh.triangles.resize(std::ssize(faces), 3);
  for (int f = 0; f < std::ssize(faces); ++f)
    mesh.triangles.row(f) << faces[f][0], faces[f][1], faces[f][2];
  own.file.set_vertex_property({"thickness", sphparam::ScalarType::Float32, thickness});
  const auto mapped = sphparam::mapped_mesh(std::move(own));

  CHECK(mapped.certificate().bijective());
  CHECK(mapped.mapped_here());
  CHECK(mapped.mesh().positions.col(2) == 2 * ball.positions.col(2));
  CHECK(mapped.mesh().triangles == ball.triangles);
  REQUIRE(mapped.file().find_vertex_property("thickness"));
  CHECK(mapped.file().find_vertex_property("thickness")->values == thickness);
}
