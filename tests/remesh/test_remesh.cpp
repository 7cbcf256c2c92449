#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <stdexcept>

#include "io/formats/ply/polygon_ply.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/planetocentric.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/parameterize.h"
#include "sphparam/remesh/remesh.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/sphere/radial_directions.h"
#include "sphparam/sphere/sphere_locator.h"
#include "support/mapped.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam;

namespace {

SphereGrid like(const TriangleMesh& mesh, const SphereMap& map) {
  SphereGrid grid;
  grid.directions = map.points;
  grid.faces.corners.assign(mesh.triangles.data(), mesh.triangles.data() + mesh.triangles.size());
  grid.faces.starts.clear();
  for (int i = 0; i <= mesh.triangles.size(); i += 3) grid.faces.starts.push_back(i);
  return grid;
}

SphereGrid grid_named(const std::string& name) { return make_grid(parse_grid(name)); }

/// A shape with one of everything: the map is not the positions.
MeshFile everything(const TriangleMesh& mesh) {
  MeshFile file;
  file.mesh = mesh;
  std::mt19937 random(3);
  const auto count = static_cast<size_t>(mesh.vertex_count());
  const auto property = [&](const char* name, ScalarType type, double from, double to) {
    Property made{name, type, {}};
    std::uniform_real_distribution<double> number(from, to);
    for (size_t v = 0; v < count; ++v) {
      const double x = number(random);
      made.values.push_back(type == ScalarType::Float64 ? x
                            : type == ScalarType::Float32
                                ? static_cast<double>(static_cast<float>(x))
                                : std::floor(x));
    }
    file.vertex_properties.push_back(std::move(made));
  };
  property("nx", ScalarType::Float64, -1, 1);
  property("ny", ScalarType::Float64, -1, 1);
  property("nz", ScalarType::Float64, -1, 1);
  for (size_t v = 0; v < count; ++v) {
    auto &x = file.vertex_properties[0].values[v], &y = file.vertex_properties[1].values[v],
         &z = file.vertex_properties[2].values[v];
    const Vector3 unit = Vector3(x, y, z).normalized();
    x = unit.x();
    y = unit.y();
    z = unit.z();
  }
  property("red", ScalarType::Uint8, 0, 256);
  property("green", ScalarType::Uint8, 0, 256);
  property("blue", ScalarType::Uint8, 0, 256);
  property("thickness", ScalarType::Float32, 1, 4);
  property("parcel", ScalarType::Int32, 1, 30);
  Property material{"material", ScalarType::Int32, {}};
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f)
    material.values.push_back(static_cast<double>(f % 2));
  file.face_properties.push_back(material);
  file.materials = {"wood", "stone"};
  CornerTexcoords texcoords(3 * mesh.face_count(), 2);
  CornerNormals normals(3 * mesh.face_count(), 3);
  for (Eigen::Index i = 0; i < 3 * mesh.face_count(); ++i) {  // every face is a chart of its own
    const auto x = static_cast<double>(i);
    texcoords.row(i) << std::cos(x), std::sin(x);
    normals.row(i) << std::cos(x), std::sin(x), 0.5;
  }
  file.corner_texcoords = std::move(texcoords);
  file.corner_normals = std::move(normals);
  return file;
}

struct Mapped {
  MeshFile file;
  SphereMap map;
  explicit Mapped(const TriangleMesh& mesh)
      : file(everything(mesh)), map(parameterize(mesh, {.threads = 1}).map) {}
  MappedMesh mapped() const { return tests::mapped(file, map); }
};

TriangleMesh stretched_sphere(int level) {
  TriangleMesh mesh = icosphere(level);
  mesh.positions.col(0) *= 2;
  mesh.positions.col(2) *= 0.5;
  return mesh;
}

/// A sphere in two charts, east and west, far apart in the image.
MeshFile two_charts(const TriangleMesh& mesh) {
  CornerTexcoords texcoords(3 * mesh.face_count(), 2);
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    double middle = 0;
    for (int k = 0; k < 3; ++k) middle += mesh.positions(mesh.triangles(f, k), 0);
    for (int k = 0; k < 3; ++k) {
      const Vector3 q = mesh.position(mesh.triangles(f, k));
      texcoords.row(3 * f + k) << (middle > 0 ? 10 : 0) + q.y(), q.z();
    }
  }
  MeshFile file;
  file.mesh = mesh;
  file.corner_texcoords.emplace(texcoords);
  return file;
}

const Property& vertex_property(const MeshFile& file, const std::string& name) {
  const Property* found = file.find_vertex_property(name);
  REQUIRE(found);
  return *found;
}

}  // namespace

TEST_CASE("remesh: points of a sphere are on it where its file says that it is one") {
  const auto off_sphere = [](const MeshFile& file) {
    const MappedMesh ball(
        {.file = file, .map = SphereMap{file.mesh.positions.rowwise().normalized()}});
    const Points points = remesh(ball, grid_named("healpix:4")).mesh().positions;
    return (points.rowwise().norm().array() - 100).abs().maxCoeff();
  };
  MeshFile file;
  file.mesh = icosphere(2);
  file.mesh.positions *= 100;
  CHECK(off_sphere(file) > 1);  // on its triangles
  file.comments = {"gifti GeometricType Spherical"};
  CHECK(off_sphere(file) < 1e-12 * 100);
  file.mesh.positions.row(0) *= 1.001;  // no sphere
  CHECK(off_sphere(file) > 1);
}

TEST_CASE("remesh: points of another surface that a match has for vertices have no mean") {
  const auto carried = [](std::vector<std::string> names) {
    MeshFile file;
    file.mesh = icosphere(2);
    for (const std::string& name : names)
      file.set_vertex_property({name, ScalarType::Float64, std::vector<double>(162, 1)});
    SphereMap map{file.mesh.positions};
    const MappedMesh mapped({.file = std::move(file), .map = std::move(map)});
    const Remeshed made = remesh(mapped, grid_named("ico:2"), {.transfer = {"all"}});
    std::vector<std::string> result;
    for (const Property& property : made.file().vertex_properties) result.push_back(property.name);
    return result;
  };
  using Names = std::vector<std::string>;
  CHECK(carried({"heat", "target_face", "target_0", "target_1", "target_2"}) == Names{"heat"});
  CHECK(carried({"heat", "target_0"}) == Names{"heat", "target_0"});  // somebody's own
}

TEST_CASE("remesh: a mesh on its own sphere is itself, bit for bit, with all it carries") {
  for (const TriangleMesh& mesh : {stretched_sphere(2), random_sphere_mesh(300, 4)}) {
    const Mapped source(mesh);
    const Remeshed result = remesh(source.mapped(), like(mesh, source.map));
    CHECK(result.file().mesh.positions == mesh.positions);
    CHECK(result.file().mesh.triangles == mesh.triangles);
    REQUIRE(result.file().vertex_properties.size() == source.file.vertex_properties.size());
    for (size_t i = 0; i < result.file().vertex_properties.size(); ++i) {
      INFO(source.file.vertex_properties[i].name);
      CHECK(result.file().vertex_properties[i].values == source.file.vertex_properties[i].values);
      CHECK(result.file().vertex_properties[i].type == source.file.vertex_properties[i].type);
    }
    CHECK(result.file().find_face_property("material")->values ==
          source.file.find_face_property("material")->values);
    CHECK(result.file().materials == source.file.materials);
    CHECK(*result.file().corner_texcoords == *source.file.corner_texcoords);
    CHECK(*result.file().corner_normals == *source.file.corner_normals);
  }
}

TEST_CASE("remesh: what is constant stays so, at points and over cells") {
  Mapped source(random_sphere_mesh(2000, 7));
  for (Property& property : source.file.vertex_properties) {
    std::fill(property.values.begin(), property.values.end(),
              property.type == ScalarType::Float32 ? static_cast<double>(0.3F) : 77.0);
  }
  source.file.mesh.positions.col(1).setConstant(0.1);
  for (const SampleMode mode : {SampleMode::Point, SampleMode::Cell}) {
    const Remeshed result = remesh(source.mapped(), grid_named("ico:2"), {.sample = mode});
    for (const char* name : {"red", "thickness", "parcel"}) {
      const Property& property = vertex_property(result.file(), name);
      for (const double value : property.values) {
        CHECK(value == source.file.find_vertex_property(name)->values[0]);
      }
    }
    CHECK((result.file().mesh.positions.col(1).array() == 0.1).all());
  }
}

TEST_CASE("remesh: values lie between those around, labels are labels of the source") {
  const Mapped source(random_sphere_mesh(500, 2));
  const Remeshed result = remesh(source.mapped(), grid_named("octa:33"));
  for (const double label : vertex_property(result.file(), "parcel").values) {
    CHECK(label == std::floor(label));
    CHECK((label >= 1 && label < 30));
  }
  for (const double value : vertex_property(result.file(), "thickness").values) {
    CHECK((value >= 1 && value <= 4));
    CHECK(value == static_cast<double>(static_cast<float>(value)));
  }
  for (size_t v = 0; v < 1000; ++v) {
    const Vector3 normal(vertex_property(result.file(), "nx").values[v],
                         vertex_property(result.file(), "ny").values[v],
                         vertex_property(result.file(), "nz").values[v]);
    CHECK(normal.norm() == Approx(1));
  }
}

TEST_CASE("remesh: finer grids come nearer to the surface, four times a level") {
  // A smooth bumpy sphere, sampled far more finely than the grids.
  const auto bumpy = [](const Vector3& q) {
    return Vector3(q * (1 + 0.2 * std::sin(3 * q.x()) * std::cos(2 * q.y() + q.z())));
  };
  const TriangleMesh fine = icosphere(6);
  MeshFile source;
  source.mesh = fine;
  for (Vertex v = 0; v < fine.vertex_count(); ++v) {
    source.mesh.positions.row(v) = bumpy(fine.position(v));
  }
  double before = 0;
  for (const char* name : {"ico:2", "ico:3", "ico:4"}) {
    const Remeshed result = remesh(mapped(source, {fine.positions}), grid_named(name));
    double square = 0;  // from the middles of faces to the surface in their directions
    const TriangleMesh& mesh = result.file().mesh;
    for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
      const Vector3 middle =
          (mesh.position(mesh.triangles(f, 0)) + mesh.position(mesh.triangles(f, 1)) +
           mesh.position(mesh.triangles(f, 2))) /
          3;
      square += (middle - bumpy(middle.normalized())).squaredNorm();
    }
    const double rms = std::sqrt(square / static_cast<double>(mesh.face_count()));
    if (before > 0) CHECK(before / rms == Approx(4).margin(0.7));
    before = rms;
  }
}

TEST_CASE("remesh: over cells nothing is left out, at points most is") {
  // A thin label and a spike of one vertex in a fine mesh, seen by a coarse grid.
  const TriangleMesh fine = icosphere(5);
  MeshFile source;
  source.mesh = fine;
  Property spike{"spike", ScalarType::Float64, std::vector<double>(10242, 0.0)};
  for (size_t v = 5; v < spike.values.size(); v += 10) spike.values[v] = 10;
  source.vertex_properties.push_back(spike);
  const auto spread = [&](SampleMode mode) {
    const Remeshed result =
        remesh(mapped(source, {fine.positions}), grid_named("ico:2"), {.sample = mode});
    double square = 0;
    const auto& values = vertex_property(result.file(), "spike").values;
    for (const double value : values) square += (value - 1) * (value - 1);
    return std::sqrt(square / static_cast<double>(values.size()));
  };
  const auto averaged = [&](SampleMode mode, const char* grid) {
    return remesh(mapped(source, {fine.positions}), grid_named(grid), {.sample = mode})
        .figures()
        .averaged;
  };
  CHECK(averaged(SampleMode::Cell, "ico:2") == 162);
  CHECK(averaged(SampleMode::Cell, "ico:7") == 0);  // finer than the mesh
  CHECK(averaged(SampleMode::Point, "ico:2") == 0);
  CHECK(spread(SampleMode::Cell) < 0.4);
  CHECK(spread(SampleMode::Point) > 1.5);
}

TEST_CASE("remesh: means over cells and by areas are the same however large the mesh is") {
  MeshFile file;
  file.mesh = icosphere(4);
  const SphereMap map{file.mesh.positions};
  for (auto row : file.mesh.positions.rowwise()) row *= 1 + 0.3 * std::sin(4 * row[0] + row[1]);
  Property height{"height", ScalarType::Float64, {}};
  for (const double z : map.points.col(2)) height.values.push_back(std::sin(9 * z));
  file.vertex_properties.push_back(height);
  const auto heights = [&](double size, SampleMode mode) {
    MeshFile scaled = file;
    scaled.mesh.positions *= size;
    const Remeshed made = remesh(mapped(scaled, map), grid_named("ico:2"), {.sample = mode});
    return vertex_property(made.file(), "height").values;
  };
  for (const SampleMode mode : {SampleMode::Cell, SampleMode::AdapBaryArea})
    for (const int exponent : {-533, -200, 200, 533})
      CHECK(heights(std::ldexp(1.0, exponent), mode) == heights(1, mode));
}

TEST_CASE("remesh: two corners of one label outweigh a heavier one") {
  MeshFile source;
  source.mesh = icosphere(0);
  source.vertex_properties.push_back({"label", ScalarType::Int32, std::vector<double>(12, 7.0)});
  source.vertex_properties.front().values[0] = 2;
  const SphereGrid grid = grid_named("ico:4");
  const Remeshed result = remesh(mapped(source, {source.mesh.positions}), grid);
  const auto& labels = vertex_property(result.file(), "label").values;
  int heaviest_and_outvoted = 0;
  for (Face f = 0; f < source.mesh.face_count(); ++f) {
    const Eigen::RowVector3i triangle = source.mesh.triangles.row(f);
    const auto k = std::find(triangle.begin(), triangle.end(), 0) - triangle.begin();
    if (k == 3) continue;
    Eigen::Matrix3d corners;
    for (int i = 0; i < 3; ++i) corners.col(i) = source.mesh.position(source.mesh.triangles(f, i));
    for (Eigen::Index v = 0; v < grid.directions.rows(); ++v) {
      Vector3 weights = corners.inverse() * grid.directions.row(v).transpose();
      if (weights.minCoeff() < 1e-9) continue;  // not inside this face
      weights /= weights.sum();
      if (std::abs(weights[k] - 0.5) < 1e-9) continue;
      CHECK(labels[static_cast<size_t>(v)] == (weights[k] > 0.5 ? 2 : 7));
      heaviest_and_outvoted += weights[k] < 0.5 && weights[k] == weights.maxCoeff();
    }
  }
  CHECK(heaviest_and_outvoted > 20);
}

TEST_CASE("remesh: texture coordinates never run across a seam") {
  const TriangleMesh mesh = icosphere(3);
  const MeshFile source = two_charts(mesh);
  for (const char* name : {"ico:2", "ico:5", "cube:9"}) {
    INFO(name);
    const Remeshed result = remesh(mapped(source, {mesh.positions}), grid_named(name));
    const auto& uv = *result.file().corner_texcoords;
    for (Eigen::Index f = 0; f < result.file().mesh.face_count(); ++f) {
      const auto u = uv.block(3 * f, 0, 3, 1);
      CHECK(u.maxCoeff() - u.minCoeff() < 1.5);
      for (int k = 0; k < 3; ++k) {  // the place itself, where the chart reaches it
        const Vector3 q = result.map().point(result.file().mesh.triangles(f, k));
        const double v = uv(3 * f + k, 1);
        if (std::abs(q.x()) > 0.3) CHECK(v == Approx(q.z()).margin(0.02));
      }
    }
  }
}

TEST_CASE("remesh: quads are written as quads, and what is read back is the same mesh") {
  const Mapped source(stretched_sphere(3));
  for (const char* name : {"cube:6", "uv:9x5", "healpix:3"}) {
    INFO(name);
    const Remeshed result = remesh(source.mapped(), grid_named(name));
    const MeshFile file = attach_map(result.file(), result.map(), {{"verdict", "one-to-one"}});
    const MeshFile read = read_mesh(serialise_polygon_ply(file, result.faces()), "x.ply", {});
    CHECK(read.mesh.positions == file.mesh.positions);
    CHECK(read.mesh.triangles == file.mesh.triangles);
    CHECK(read.polygons == file.polygons);
    CHECK(*read.corner_texcoords == *file.corner_texcoords);
    CHECK(*read.corner_normals == *file.corner_normals);
    CHECK(read.find_face_property("material")->values ==
          file.find_face_property("material")->values);
    CHECK(certify(Topology(read.mesh), *read_sphere(read)).bijective());
  }
}

TEST_CASE("remesh: the same bytes for any number of threads, at points and over cells") {
  const Mapped source(random_sphere_mesh(3000, 11));
  for (const SampleMode mode : {SampleMode::Point, SampleMode::Cell}) {
    const auto run = [&](int threads) {
      return remesh(source.mapped(), grid_named("ico:5"), {.sample = mode, .threads = threads});
    };
    const Remeshed one = run(1), three = run(3);
    CHECK(one.file().mesh.positions == three.file().mesh.positions);
    CHECK(*one.file().corner_texcoords == *three.file().corner_texcoords);
    for (size_t i = 0; i < one.file().vertex_properties.size(); ++i) {
      CHECK(one.file().vertex_properties[i].values == three.file().vertex_properties[i].values);
    }
  }
}

TEST_CASE("remesh: what faces measure is averaged with cells, labels and finer grids are not") {
  // Every face of ico:1 is cut into 16 of ico:3, in any order; of each value i that of ico:1 is to
  // be the mean of those that lie in it, by area.
  const TriangleMesh fine = icosphere(3);
  MeshFile file;
  file.mesh = fine;
  file.mesh.positions.col(2) *= 2;  // so that areas differ
  Property heat{"heat", ScalarType::Float64, {}}, part{"part", ScalarType::Int32, {}};
  for (Face f = 0; f < fine.face_count(); ++f) {
    heat.values.push_back(f * 37 % 101);
    part.values.push_back(f * 37 % 101);
  }
  file.set_face_property(heat);
  file.set_face_property(part);
  const MappedMesh source({.file = file, .map = SphereMap{fine.positions}, .name = "egg"});
  const TriangleMesh coarse = icosphere(1);
  const auto run = [&](const TriangleMesh& grid, SampleMode sample) {
    return remesh(source, like(grid, SphereMap{grid.positions}), {.sample = sample, .threads = 3})
        .file();
  };
  std::vector<double> sums(80), areas(80);
  const Topology topology(coarse);
  const SphereMap coarse_map{coarse.positions};
  const SphereLocator locator(topology, coarse_map);
  for (Face f = 0; f < fine.face_count(); ++f) {
    Vector3 middle = Vector3::Zero();
    for (const Vertex v : fine.triangles.row(f)) middle += fine.position(v);
    const auto corner = [&](int k) { return file.mesh.position(fine.triangles(f, k)); };
    const double area = (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
    const auto in = static_cast<size_t>(locator.locate(middle).face);
    sums[in] += area * heat.values[static_cast<size_t>(f)];
    areas[in] += area;
  }
  const std::vector<double> at_middles =
      run(coarse, SampleMode::Point).find_face_property("heat")->values;
  for (const SampleMode sample : {SampleMode::Cell, SampleMode::AdapBaryArea}) {
    const MeshFile made = run(coarse, sample);
    for (size_t g = 0; g < 80; ++g)
      CHECK(made.find_face_property("heat")->values[g] == Approx(sums[g] / areas[g]));
    CHECK(made.find_face_property("part")->values == at_middles);
  }
  CHECK(run(coarse, SampleMode::Barycentric).find_face_property("heat")->values == at_middles);
  CHECK(run(fine, SampleMode::Cell).find_face_property("heat")->values == heat.values);
}

TEST_CASE("remesh: means of faces leave out what closes holes") {
  MeshFile file;
  file.mesh = icosphere(3);
  SphereMap map{file.mesh.positions};
  FillerMarks fillers(static_cast<size_t>(file.mesh.face_count()), 0);
  Property heat{"heat", ScalarType::Float32, {}};
  for (Face f = 0; f < file.mesh.face_count(); ++f) {
    fillers[static_cast<size_t>(f)] = f == 0 ? 1 : 0;
    heat.values.push_back(f == 0 ? 0 : 7);
  }
  file.set_face_property(heat);
  mark_fillers(file, fillers);
  const MappedMesh source({.file = std::move(file), .map = std::move(map), .name = "ball"});
  const MeshFile made = remesh(source, grid_named("ico:1"), {.sample = SampleMode::Cell}).file();
  CHECK(made.find_face_property("heat")->values == std::vector<double>(80, 7.0));
}

TEST_CASE("remesh: only what is wanted is carried, and unknown names are refused") {
  Mapped source(icosphere(1));
  source.file.set_face_property({"part", ScalarType::Int32, std::vector<double>(80, 3.0)});
  const auto run = [&](std::vector<std::string> names) {
    return remesh(source.mapped(), grid_named("ico:2"), {.transfer = std::move(names)}).file();
  };
  CHECK(run({"none"}).vertex_properties.empty());
  CHECK(run({"none"}).face_properties.empty());
  CHECK(run({"material"}).find_face_property("material"));
  CHECK_FALSE(run({"material"}).find_face_property("part"));
  CHECK(run({"part"}).find_face_property("part"));
  CHECK(run({"material"}).materials == source.file.materials);
  CHECK(run({"color"}).vertex_properties.size() == 3);
  CHECK_FALSE(run({"color"}).corner_texcoords);
  CHECK(run({"uv", "thickness"}).corner_texcoords);
  CHECK(run({"uv", "thickness"}).vertex_properties.size() == 1);
  CHECK(run({"all"}).vertex_properties.size() == 8);
  CHECK_THROWS_WITH(run({"thicknes"}),
                    "no property thicknes to transfer; there are position, nx, ny, nz, red, green, "
                    "blue, thickness, parcel, material, part, uv, normal");
}

TEST_CASE("remesh: a callback that says no ends it") {
  const Mapped source(icosphere(1));
  RemeshOptions options;
  options.progress = [](std::string_view, double) { return false; };
  CHECK_THROWS_AS(remesh(source.mapped(), grid_named("ico:2"), options), Cancelled);
}

TEST_CASE("remesh: grids of one's own that are none are refused, saying what is wrong") {
  const TriangleMesh ball = icosphere(1);
  const MappedMesh source = mapped(ball, {ball.positions});
  const SphereGrid sound = grid_named("ico:1");
  for (const double bad : {0.0, std::nan("")}) {
    SphereGrid grid = sound;
    grid.directions.row(5) *= bad;
    CHECK_THROWS_WITH(remesh(source, grid), "grid ico:1: direction 5 is zero or not finite");
  }
  SphereGrid torn = sound;
  torn.faces.corners[7] = 42;
  CHECK_THROWS_WITH(remesh(source, torn), Catch::Contains("names a vertex that does not exist"));
  CHECK_THROWS_AS(remesh(source, torn), MeshError);
  CHECK_THROWS_WITH(remesh(source, SphereGrid{}), Catch::Contains("the mesh has no faces"));
  SphereGrid folded = sound;
  folded.directions.row(0).swap(folded.directions.row(40));
  CHECK_THROWS_AS(remesh(source, folded), NotCertifiedError);
}

TEST_CASE("remesh: areas below 0 or not numbers, and unknown ways of sampling, are refused") {
  const TriangleMesh ball = icosphere(1);
  const MappedMesh source = mapped(ball, {ball.positions});
  const SphereGrid grid = grid_named("ico:1");
  for (const double bad : {-1.0, std::nan("")}) {
    const VectorX areas = VectorX::Constant(42, bad);
    CHECK_THROWS_AS(
        remesh(source, grid, {.sample = SampleMode::AdapBaryArea, .source_areas = areas}),
        std::invalid_argument);
    CHECK_THROWS_AS(remesh(source, grid, {.sample = SampleMode::AdapBaryArea, .grid_areas = areas}),
                    std::invalid_argument);
  }
  CHECK_THROWS_AS(remesh(source, grid, {.sample = static_cast<SampleMode>(9)}),
                  std::invalid_argument);
}

TEST_CASE("remesh: of a radial map, vertices are in their directions from its centre") {
  const Vector3 centre(5, 6, 7);
  TriangleMesh mesh = icosphere(2);
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 p = mesh.position(v);
    mesh.positions.row(v) =
        centre + (1 + 0.3 * p.x() * p.y()) * Vector3(9 * p.x(), 3 * p.y(), p.z());
  }
  MeshFile file;
  file.mesh = mesh;
  Property x{"x_again", ScalarType::Float64, {}};
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) x.values.push_back(mesh.positions(v, 0));
  file.vertex_properties.push_back(x);
  const MappedMesh body({.file = file,
                         .map = radial_directions(mesh, centre),
                         .provenance = {{"radial-centre", "5 6 7"}, {"radial-movement", "0"}}});
  const auto off = [&](const Remeshed& made) {
    const Points from_centre = made.mesh().positions.rowwise() - centre.transpose();
    return (from_centre.rowwise().normalized() - made.map().points.rowwise().normalized())
        .rowwise()
        .norm()
        .maxCoeff();
  };
  for (const char* grid : {"healpix:8", "cube:5"}) {
    INFO(grid);
    const Remeshed made = remesh(body, grid_named(grid));
    CHECK(off(made) < 1e-12);
    REQUIRE(planetocentric(made.provenance()));
    CHECK(planetocentric(made.provenance())->centre == centre);
    CHECK(planetocentric(made.provenance())->largest_movement == 0);
    CHECK(made.provenance().back().first == "verdict");
    const auto& again = made.file().vertex_properties.at(0).values;
    for (Vertex v = 0; v < made.mesh().vertex_count(); ++v)
      CHECK(again[static_cast<size_t>(v)] == Approx(made.mesh().positions(v, 0)).margin(1e-12));
  }
  CHECK(remesh(body, like(mesh, body.map())).mesh().positions == mesh.positions);
  const Remeshed means = remesh(body, grid_named("healpix:8"), {.sample = SampleMode::Cell});
  CHECK_FALSE(planetocentric(means.provenance()));
  const MappedMesh unsaid = mapped(file, body.map());  // along the sphere's flat triangles
  CHECK(off(remesh(unsaid, grid_named("healpix:8"))) > 0.01);
}

TEST_CASE("remesh: what only says that it is radial is no radial map") {
  MeshFile file;
  file.mesh = icosphere(2);
  const SphereMap map{file.mesh.positions};
  file.mesh.positions *= Vector3(9, 3, 1).asDiagonal();
  const auto positions = [&](const SphereMap& of_map, const Provenance& lines) {
    return remesh(MappedMesh({.file = file, .map = of_map, .provenance = lines}),
                  grid_named("ico:3"))
        .mesh()
        .positions;
  };
  const Provenance radial = {{"radial-centre", "0 0 0"}, {"radial-movement", "0"}};
  CHECK(positions(map, radial) == positions(map, {}));  // other directions than the mesh has
  const SphereMap directions = radial_directions(file.mesh);
  Provenance anew = radial;
  anew.emplace_back("anew", "nothing of the method's own map is left");
  CHECK(positions(directions, anew) == positions(directions, {}));
  CHECK_FALSE(positions(directions, radial) == positions(directions, {}));
}
