#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "sphparam/correspondence/map_alignment.h"
#include "sphparam/correspondence/matched_files.h"
#include "sphparam/correspondence/surface_map.h"
#include "sphparam/errors.h"
#include "sphparam/group/group.h"
#include "sphparam/parameterize.h"
#include "sphparam/remesh/resample.h"
#include "sphparam/sphere/certificate.h"
#include "support/capped.h"
#include "support/coil.h"
#include "support/mapped.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

constexpr GridSpec small_grid{GridKind::Icosahedron, 3};
constexpr GridSpec middle_grid{GridKind::Icosahedron, 4};

Eigen::Matrix3d rotation(double angle, const Vector3& axis) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

/// The unit sphere as the grid has it: its vertices are found exactly.
TriangleMesh grid_sphere(const GridSpec& spec) {
  const SphereGrid grid = make_grid(spec);
  TriangleMesh mesh{grid.directions, Triangles(grid.faces.count(), 3)};
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) mesh.triangles(f, k) = grid.faces.polygon(f)[size_t(k)];
  return mesh;
}

/// An ellipsoid with a bump: no half turn leaves it as it is.
TriangleMesh bumpy(const GridSpec& grid, double length = 3) {
  TriangleMesh mesh = grid_sphere(grid);
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 x = mesh.position(v);
    const double radius =
        1 + 0.5 * std::exp(-4 * (x - Vector3(1, 1, 1).normalized()).squaredNorm());
    mesh.positions.row(v) = radius * x.cwiseProduct(Vector3(length, 2, 1.2));
  }
  return mesh;
}

Points displaced(const Points& points, double angle) {
  const Points turned = points * rotation(angle, Vector3(1, 2, -angle)).transpose();
  return turned.rowwise() + Eigen::RowVector3d(5 * angle, -3, 1);
}

/// Copies of a shape that are moved and turned, each with its vertices numbered anew and a map of
/// its own.
std::vector<MappedMesh> copies(const TriangleMesh& mesh) {
  std::vector<MappedMesh> result;
  for (const unsigned i : {1u, 2u, 3u}) {
    TriangleMesh copy = relabelled(mesh, i);
    copy.positions = displaced(copy.positions, i);
    SphereMap map = parameterize(copy).map;
    result.push_back(mapped(copy, std::move(map)));
  }
  return result;
}

/// RMS distance from the centroid by area, as integrals of the six products of corners.
double size_by_area(const TriangleMesh& mesh) {
  double area = 0;
  Vector3 first = Vector3::Zero();
  double second = 0;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const Vector3 a = mesh.position(mesh.triangles(f, 0)), b = mesh.position(mesh.triangles(f, 1)),
                  c = mesh.position(mesh.triangles(f, 2));
    const double here = (b - a).cross(c - a).norm() / 2;
    area += here;
    first += here * (a + b + c) / 3;
    second += here * (a.dot(a) + b.dot(b) + c.dot(c) + a.dot(b) + b.dot(c) + c.dot(a)) / 6;
  }
  return std::sqrt(second / area - (first / area).squaredNorm());
}

double rms(const MatrixX& a, const MatrixX& b) {
  return std::sqrt((a - b).squaredNorm() / static_cast<double>(a.rows()));
}

}  // namespace

TEST_CASE("group: registered copies of a shape, moved and turned, have it for their mean") {
  const TriangleMesh shape = bumpy(small_grid);
  const SphereMap sphere{grid_sphere(small_grid).positions};
  const MappedMesh pattern = mapped(shape, sphere);
  std::vector<MappedMesh> shapes;
  for (const double angle : {0.5, 1.0, 2.0})
    shapes.push_back(
        mapped(TriangleMesh{displaced(shape.positions, angle), shape.triangles}, sphere));
  const Group group =
      make_group(shapes, pattern, {.start = GroupStart::Maps, .hold = true, .grid = small_grid});
  // The grid has the very directions of the shape's vertices.
  CHECK((group.mean.mesh().positions - shape.positions).cwiseAbs().maxCoeff() < 1e-12);
  CHECK(group.distances.maxCoeff() < 1e-12);
  CHECK(group.deviation.maxCoeff() < 1e-12);
  CHECK(group.modes.modes.empty());
  for (size_t i = 0; i < shapes.size(); ++i) {
    CHECK(group.members[i].mapped.map().points == sphere.points);
    CHECK(group.members[i].start == "its map");
    CHECK(group.members[i].resampling_max < 1e-12);
    CHECK(rms(group.members[i].resampled.mesh().positions, shapes[i].mesh().positions) < 1e-12);
    CHECK(rms(aligned_shape(group, i).mesh().positions, shape.positions) < 1e-12);
  }
}

TEST_CASE("group: copies with maps of their own come into correspondence, and have it for a mean") {
  const TriangleMesh shape = bumpy(middle_grid);
  const std::vector<MappedMesh> shapes = copies(shape);
  for (const int rounds : {0, 1}) {
    const GroupStart start = rounds == 0 ? GroupStart::Ellipsoid : GroupStart::Rotation;
    const Group group = make_group(
        shapes, shapes[0], {.start = start, .rounds = rounds, .grid = middle_grid, .threads = 2});
    CHECK(group.members[0].start == "template");
    CHECK(group.members[1].start == (rounds == 0 ? "ellipsoid" : "rotation"));
    CHECK(group.distances.maxCoeff() < 5e-3);  // of a length of 6
    for (const GroupMember& member : group.members) {
      CHECK(certify(member.mapped.topology(), member.mapped.map()).bijective());
      CHECK(certify(member.resampled.topology(), member.resampled.map()).bijective());
      CHECK(member.resampling_rms < 0.02);
      CHECK(member.warnings.empty());
    }
    CHECK(rms(group.mean.mesh().positions, group.members[0].resampled.mesh().positions) < 5e-3);
  }
}

TEST_CASE("group: half turns that a symmetric template leaves open are the shapes' own, and told") {
  TriangleMesh plain = grid_sphere(middle_grid);
  plain.positions = plain.positions * Vector3(3, 2, 1.2).asDiagonal();
  std::vector<MappedMesh> shapes = copies(bumpy(middle_grid));
  const MappedMesh reference = mapped(plain, parameterize(plain).map);
  const Group group =
      make_group(shapes, reference,
                 {.start = GroupStart::Ellipsoid, .hold = true, .grid = middle_grid, .threads = 2});
  CHECK(group.distances.maxCoeff() < 0.01);  // of a length of 6
  for (const GroupMember& member : group.members) {
    CHECK(member.confidence < 0.01);
    REQUIRE(member.warnings.size() == 1);
    CHECK_THAT(member.warnings[0], Catch::StartsWith("the template hardly tells half turns apart"));
  }
  const Group told = make_group(shapes, shapes[0],
                                {.start = GroupStart::Ellipsoid, .hold = true, .grid = small_grid});
  CHECK(told.members[0].confidence == 1);
  CHECK(told.members[1].confidence > 0.95);
}

TEST_CASE("group: a shape that fits in several positions is brought without confidence") {
  TriangleMesh plain = grid_sphere(middle_grid);
  plain.positions = plain.positions * Vector3(3, 2, 1.2).asDiagonal();
  std::vector<MappedMesh> shapes = copies(bumpy(middle_grid));
  shapes.push_back(mapped(plain, parameterize(plain).map));
  for (const bool hold : {true, false}) {
    const Group group = make_group(shapes, shapes[0],
                                   {.start = GroupStart::Rotation,
                                    .hold = hold,
                                    .rounds = 0,
                                    .grid = small_grid,
                                    .threads = 2});
    CHECK(group.members[0].confidence == 1);
    CHECK(group.members[1].confidence > 0.98);
    CHECK(group.members[3].confidence < 0.01);
    REQUIRE_FALSE(group.members[3].warnings.empty());
    CHECK_THAT(group.members[3].warnings[0],
               Catch::Contains("in two positions") && Catch::EndsWith("by match, bring it right"));
  }
}

TEST_CASE("group: shapes that lie alike say that they began where they are nearest in space") {
  TriangleMesh beside = coil(1);
  beside.positions.col(0).array() += 0.001;
  const std::vector<MappedMesh> shapes = {
      mapped(coil(1), parameterize(coil(1)).map),
      mapped(beside, parameterize(beside, {.energy = {.lambda = 20}}).map)};
  const Group group =
      make_group(shapes, shapes[0], {.alike = true, .rounds = 0, .grid = small_grid});
  CHECK(group.members[1].start == "places");
}

TEST_CASE("group: a coil that a turn alone brings is told as such, and little trusted") {
  std::vector<MappedMesh> shapes;
  for (const int turns : {1, 2}) {
    const TriangleMesh mesh = coil(turns);
    shapes.push_back(mapped(mesh, parameterize(mesh).map));
  }
  const Group group = make_group(shapes, shapes[0], {.rounds = 0, .grid = small_grid});
  CHECK(group.members[0].start == "template");
  CHECK(group.members[1].start == "turn");
  CHECK(group.members[1].confidence < 0.1);
  REQUIRE(group.members[1].warnings.size() >= 2);  // the first: after another turn about as well
  CHECK_THAT(group.members[1].warnings[1],
             Catch::StartsWith("nothing but a turn of the maps was found") &&
                 Catch::EndsWith("--start rotation may find more"));
}

TEST_CASE("group: a start or an energy that there is not is refused by its name") {
  const TriangleMesh mesh = icosphere(1);
  const MappedMesh ball = mapped(mesh, {mesh.positions});
  CHECK_THROWS_WITH(make_group({ball}, ball, {.start = GroupStart(9)}),
                    Catch::StartsWith("start is 9"));
  CHECK_THROWS_WITH(make_group({ball}, ball, {.energy = {.lambda = std::nan("")}}),
                    Catch::Contains("lambda is nan"));
}

TEST_CASE("group: what is asked of a member, a mode or a vertex that there is not is refused") {
  const TriangleMesh mesh = icosphere(1);
  const MappedMesh ball = mapped(mesh, {mesh.positions});
  const Group group = make_group({ball}, ball, {.hold = true, .grid = std::nullopt});
  CHECK_THROWS_AS(aligned_shape(group, 1), std::out_of_range);
  CHECK_THROWS_AS(group_shape(group, 0, 1), std::out_of_range);
  CHECK_THROWS_AS(carried_to(group, 1, {0}), std::out_of_range);
  CHECK_THROWS_AS(carried_to(group, 0, {static_cast<Vertex>(mesh.vertex_count())}),
                  std::invalid_argument);
}

TEST_CASE("group: positions that a symmetry makes alike are no doubt") {
  std::vector<MappedMesh> shapes;
  for (const double length : {3.0, 3.3}) {
    TriangleMesh mesh = grid_sphere(small_grid);
    mesh.positions = (mesh.positions * Eigen::Vector3d(length, 2, 1.2).asDiagonal()).eval();
    SphereMap map = parameterize(mesh).map;
    shapes.push_back(mapped(mesh, std::move(map)));
  }
  const Group group =
      make_group(shapes, shapes[0], {.start = GroupStart::Rotation, .grid = small_grid});
  CHECK(group.members[1].start == "rotation");
  CHECK(group.members[1].warnings.empty());
}

TEST_CASE("group: shapes that lie alike in space come together as they lie, whatever symmetry") {
  TriangleMesh mesh = icosphere(4);
  mesh.positions = mesh.positions * Vector3(3, 2, 1.2).asDiagonal();
  const MappedMesh shape = mapped(mesh, parameterize(mesh).map);
  for (const Vector3& axis : {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(1, 2, 3)}) {
    const MappedMesh other = turned_map(shape, rotation(M_PI, axis));
    const Group group = make_group(
        {shape, other}, shape,
        {.start = GroupStart::Rotation, .alike = true, .hold = true, .grid = small_grid});
    CHECK(rms(group.members[1].mapped.map().points, shape.map().points) < 1e-6);
  }
}

TEST_CASE("group: ellipsoids of many lengths vary in one mode, whose scores are the length") {
  std::vector<MappedMesh> shapes;
  const std::vector<double> lengths{3, 3.4, 3.8, 4.2, 4.6};
  for (const double length : lengths) {
    TriangleMesh mesh = bumpy(middle_grid, length);
    mesh.positions = displaced(mesh.positions, length);
    SphereMap map = parameterize(mesh).map;
    shapes.push_back(mapped(mesh, std::move(map)));
  }
  const Group group = make_group(shapes, shapes[2], {.grid = middle_grid, .threads = 2});
  REQUIRE(group.modes.modes.size() == 3);
  CHECK(group.modes.shares[0] > 0.99);
  const double sign = group.modes.scores(4, 0) > 0 ? 1 : -1;
  for (int i = 0; i < 5; ++i)
    CHECK(sign * group.modes.scores(i, 0) ==
          Approx((lengths[size_t(i)] - 3.8) / (0.4 * std::sqrt(2.5))).margin(0.06));
  // Two deviations along it are an ellipsoid of another length.
  const Points longer = group_shape(group, 0, 2 * sign).mesh().positions;
  const Vector3 centre = longer.transpose() * group.weights;
  const Points about = longer.rowwise() - centre.transpose();
  CHECK(about.rowwise().norm().maxCoeff() > 4.8);
}

TEST_CASE("group: vertices of the template are carried to the same vertices of its copies") {
  const TriangleMesh shape = bumpy(small_grid);
  const SphereMap sphere{grid_sphere(small_grid).positions};
  const std::vector<MappedMesh> shapes{
      mapped(TriangleMesh{displaced(shape.positions, 1), shape.triangles}, sphere)};
  const Group group = make_group(shapes, mapped(shape, sphere),
                                 {.start = GroupStart::Maps, .rounds = 1, .grid = small_grid});
  const std::vector<Vertex> vertices{0, 17, 300};
  const std::vector<SurfacePoint> points = carried_to(group, 0, vertices);
  for (size_t i = 0; i < vertices.size(); ++i)
    CHECK((position(shapes[0].mesh(), points[i]) - shapes[0].mesh().position(vertices[i])).norm() <
          1e-6);
}

TEST_CASE("group: without a grid the mean has the triangles of the template") {
  const std::vector<MappedMesh> shapes = copies(bumpy(small_grid));
  const Group group = make_group(shapes, shapes[1], {.grid = std::nullopt});
  CHECK(group.mean.mesh().triangles == shapes[1].mesh().triangles);
  CHECK(rms(group.mean.mesh().positions, shapes[1].mesh().positions) < 2e-2);
}

TEST_CASE("group: deviations are those of the aligned shapes") {
  TriangleMesh shape = bumpy(small_grid);
  const SphereMap sphere{grid_sphere(small_grid).positions};
  const MappedMesh one = mapped(shape, sphere);
  shape.positions *= 1.1;
  const MappedMesh other = mapped(shape, sphere);
  const GroupOptions options{.start = GroupStart::Maps, .hold = true, .grid = small_grid};
  const Group group = make_group({one, other}, one, options);
  const Points apart = group.members[1].aligned - group.members[0].aligned;
  CHECK((group.deviation - apart.rowwise().norm() / std::sqrt(2)).cwiseAbs().maxCoeff() < 1e-12);
  CHECK((group.deviation - group.normal_deviation).minCoeff() > -1e-12);
  CHECK(group.modes.modes.size() == 1);
  GroupOptions scaled = options;
  scaled.scale = true;
  const Group of_one_size = make_group({one, other}, one, scaled);
  CHECK(of_one_size.deviation.maxCoeff() < 1e-12);
  CHECK(of_one_size.distances.maxCoeff() < 1e-12);
  CHECK(group.distances(0, 1) > 0.1);
}

TEST_CASE("group: a size is the shape's own, whoever else is there, and scaling brings all to it") {
  const SphereMap sphere{grid_sphere(small_grid).positions};
  std::vector<MappedMesh> shapes;  // the longer, the more of its area lies far out
  for (const double length : {1.5, 3.0, 6.0})
    shapes.push_back(mapped(bumpy(small_grid, length), sphere));
  GroupOptions options{.start = GroupStart::Maps, .hold = true, .grid = small_grid};
  const Group group = make_group(shapes, shapes[0], options);
  double sum = 0;
  for (size_t i = 0; i < shapes.size(); ++i) {
    const double size = group.members[i].size;
    CHECK(size == Approx(size_by_area(shapes[i].mesh())).epsilon(1e-12));
    CHECK(make_group({shapes[i]}, shapes[i], options).members[0].size == size);
    sum += size;
  }
  options.scale = true;
  const Group scaled = make_group(shapes, shapes[0], options);
  for (size_t i = 0; i < shapes.size(); ++i) {
    const GroupMember& member = scaled.members[i];
    CHECK(member.size == group.members[i].size);
    CHECK(member.motion.scale * member.size == Approx(sum / 3).epsilon(1e-12));
    CHECK(size_by_area(aligned_shape(scaled, i).mesh()) == Approx(sum / 3).epsilon(1e-12));
  }
}

TEST_CASE("group: shapes on the grid have what their vertices have, but normals") {
  MeshFile file;
  file.mesh = bumpy(small_grid);
  const SphereMap sphere{grid_sphere(small_grid).positions};
  std::vector<double> height, label;
  for (Vertex v = 0; v < file.mesh.vertex_count(); ++v) {
    height.push_back(file.mesh.positions(v, 2));
    label.push_back(v % 5);
  }
  for (const char* name : {"nx", "ny", "nz", "height"})
    file.set_vertex_property({name, ScalarType::Float64, height});
  file.set_vertex_property({"label", ScalarType::Int32, label});
  const MappedMesh shape = mapped(file, sphere);
  const Group group = make_group({shape, shape}, shape,
                                 {.start = GroupStart::Maps, .hold = true, .grid = small_grid});
  for (const MappedMesh& on_grid : {group.members[1].resampled, aligned_shape(group, 1)}) {
    const Property* const found = on_grid.file().find_vertex_property("height");
    REQUIRE(found != nullptr);
    CHECK(found->values == height);
    const Property* const labels = on_grid.file().find_vertex_property("label");
    REQUIRE(labels != nullptr);
    CHECK(labels->type == ScalarType::Int32);
    CHECK(labels->values == label);
    CHECK(on_grid.file().find_vertex_property("nx") == nullptr);
  }
  CHECK(group.mean.file().vertex_properties.empty());
}

TEST_CASE("group: numbers that shapes have under one name have a mean and a deviation") {
  const SphereMap sphere{grid_sphere(small_grid).positions};
  std::vector<MappedMesh> shapes;
  for (const double factor : {1.0, 2.0, 6.0}) {
    MeshFile file;
    file.mesh = bumpy(small_grid);
    std::vector<double> values;
    for (Vertex v = 0; v < file.mesh.vertex_count(); ++v) values.push_back(factor * v);
    if (factor != 2) file.set_vertex_property({"depth", ScalarType::Float32, values});
    for (const char* name : {"sulc", "red", "s"})
      file.set_vertex_property({name, ScalarType::Float64, values});
    file.set_vertex_property({"label", ScalarType::Int32, values});
    if (factor == 6) file.set_vertex_property({"alone", ScalarType::Float64, values});
    shapes.push_back(mapped(file, sphere));
  }
  const GroupOptions options{.start = GroupStart::Maps, .hold = true, .grid = small_grid};
  const Group group = make_group(shapes, shapes[0], options);
  REQUIRE(group.scalars.size() == 2);
  const GroupScalar &depth = group.scalars[0], &sulc = group.scalars[1];
  CHECK(depth.name == "depth");
  CHECK(depth.shapes == std::vector<size_t>{0, 2});
  CHECK(sulc.name == "sulc");
  CHECK(sulc.shapes == std::vector<size_t>{0, 1, 2});
  for (Vertex v = 0; v < group.mean.mesh().vertex_count(); ++v) {
    CHECK(depth.mean[v] == 3.5 * v);
    CHECK(depth.deviation[v] == Approx(std::sqrt(12.5) * v));
    CHECK(sulc.mean[v] == 3 * v);
    CHECK(sulc.deviation[v] == Approx(std::sqrt(7.0) * v));
  }
  CHECK(make_group({shapes[0]}, shapes[0], options).scalars.empty());
}

TEST_CASE("group: points of another surface that a match has for vertices stay with these") {
  MeshFile file;
  file.mesh = bumpy(small_grid);
  for (const char* name : {"heat", "target_face", "target_0", "target_1", "target_2"})
    file.set_vertex_property(
        {name, ScalarType::Float64, std::vector<double>(size_t(file.mesh.vertex_count()), 1)});
  const MappedMesh shape(
      {.file = std::move(file), .map = SphereMap{grid_sphere(small_grid).positions}});
  const Group group = make_group({shape}, shape, {.hold = true, .grid = small_grid});
  const GroupMember& member = group.members[0];
  CHECK(member.mapped.file().find_vertex_property("target_face"));
  CHECK(member.resampled.file().find_vertex_property("heat"));
  for (const char* name : {"target_face", "target_0", "target_1", "target_2"})
    CHECK_FALSE(member.resampled.file().find_vertex_property(name));
  REQUIRE(member.warnings.size() == 1);
  CHECK_THAT(member.warnings[0], Catch::StartsWith("not carried: target_face and target_0"));
}

TEST_CASE("group: fillers of kept holes have no weight, wherever they lie") {
  const Points sphere = grid_sphere(small_grid).positions;
  const auto made = [&](double cap) {
    std::vector<MappedMesh> shapes;
    for (const double length : {2.0, 3.0, 4.0})
      shapes.push_back(capped(bumpy(small_grid, length), sphere, cap));
    return make_group(shapes, shapes[1],
                      {.start = GroupStart::Maps, .hold = true, .grid = small_grid});
  };
  const Group flat = made(1), high = made(3);
  CHECK((flat.weights - high.weights).cwiseAbs().maxCoeff() < 1e-12);
  CHECK(rms(flat.distances, high.distances) < 1e-9);
  const VectorX areas = vertex_areas(high.members[0].resampled.surface());
  for (Vertex v = 0; v < areas.size(); ++v)
    if (areas[v] == 0) CHECK(high.weights[v] == 0);
  CHECK(high.weights.sum() == Approx(1));
  for (size_t i = 0; i < 3; ++i) CHECK(high.members[i].resampling_max < 1e-12);
}

TEST_CASE("group: a shape that is inside out beside the template is told, and once") {
  const TriangleMesh shape = bumpy(small_grid);
  TriangleMesh turned = shape;
  turned.triangles.col(1).swap(turned.triangles.col(2));
  std::vector<MappedMesh> shapes;
  for (const TriangleMesh& mesh : {shape, turned, shape}) {
    MeshFile file;
    file.mesh = mesh;
    shapes.push_back(MappedMesh({.file = std::move(file),
                                 .map = parameterize(mesh).map,
                                 .name = std::to_string(shapes.size()) + ".vtp"}));
  }
  for (const GroupStart start : {GroupStart::Ends, GroupStart::Rotation, GroupStart::Ellipsoid}) {
    const Group group = make_group(shapes, shapes[0], {.start = start, .grid = small_grid});
    const auto count = [&](size_t i) {
      return std::ranges::count(group.members[i].warnings,
                                "1.vtp is inside out and 0.vtp is not, so that the map between "
                                "them mirrors: --repair=orientation turns it over");
    };
    CHECK(count(0) == 0);
    CHECK(count(1) == 1);
    CHECK(count(2) == 0);
    for (const GroupMember& member : group.members)
      for (const std::string& warning : member.warnings)
        CHECK((&member == &group.members[1] || warning.find("inside out") == std::string::npos));
  }
}

TEST_CASE("group: a shape whose area is beyond doubles is refused by its name") {
  TriangleMesh mesh = grid_sphere(small_grid);
  const SphereMap sphere{mesh.positions};
  const MappedMesh ball = mapped(mesh, sphere);
  mesh.positions *= 1e110;
  const GroupOptions options{.start = GroupStart::Maps, .hold = true, .grid = small_grid};
  for (const auto& [shape, reference] :
       {std::pair(mapped(mesh, sphere), ball), {ball, mapped(mesh, sphere)}})
    CHECK_THROWS_AS(make_group({shape, ball}, reference, options), UnmeasurableMesh);
}

TEST_CASE("group: shapes on the mean lie in the volume of the template") {
  const TriangleMesh mesh = grid_sphere(small_grid);
  const auto at = [&](const std::string& centre) {
    MeshFile file;
    file.mesh = mesh;
    file.comments = {"freesurfer geometry cras = " + centre};
    return MappedMesh({.file = std::move(file), .map = {mesh.positions}});
  };
  const std::vector<MappedMesh> shapes = {at("1 2 3"), at("4 5 6")};
  const Group group = make_group(shapes, at("7 8 9"),
                                 {.start = GroupStart::Maps, .hold = true, .grid = small_grid});
  const std::vector<std::string> of_template = {"freesurfer geometry cras = 7 8 9"};
  CHECK(group.mean.file().comments == of_template);
  CHECK(aligned_shape(group, 0).file().comments == of_template);
  CHECK(group.members[0].resampled.file().comments == shapes[0].file().comments);
}

TEST_CASE("group: the same bits for any number of threads") {
  const std::vector<MappedMesh> shapes = copies(bumpy(small_grid));
  const auto made = [&](int threads) {
    return make_group(shapes, shapes[1], {.grid = small_grid, .threads = threads});
  };
  const Group one = made(1), three = made(3);
  CHECK(one.mean.mesh().positions == three.mean.mesh().positions);
  CHECK(one.distances == three.distances);
  for (size_t i = 0; i < shapes.size(); ++i)
    CHECK(one.members[i].mapped.map().points == three.members[i].mapped.map().points);
}

TEST_CASE("group: what makes no sense is refused, and work can be cancelled") {
  const MappedMesh shape = mapped(bumpy({GridKind::Icosahedron, 2}),
                                  SphereMap{grid_sphere({GridKind::Icosahedron, 2}).positions});
  CHECK_THROWS_AS(make_group({}, shape), std::invalid_argument);
  CHECK_THROWS_AS(make_group({shape}, shape, {.rounds = -1}), std::invalid_argument);
  CHECK_THROWS_WITH(make_group({shape}, shape, {.grid = GridSpec{GridKind::Cube, 8}}),
                    Catch::Contains("triangles"));
  CHECK_THROWS_AS(
      make_group({shape, shape}, shape,
                 {.grid = small_grid, .progress = [](std::string_view, double) { return false; }}),
      Cancelled);
}

TEST_CASE("group: mirror images are taken as such where that is asked for, and told") {
  const TriangleMesh shape = bumpy(middle_grid);
  std::vector<MappedMesh> shapes = copies(shape);
  const Group without = make_group(shapes, shapes[0], {.mirror = true, .grid = middle_grid});
  for (const GroupMember& member : without.members) CHECK_FALSE(member.mirrored);
  shapes[1] = mirror_image(shapes[1]);
  for (const GroupStart start : {GroupStart::Ends, GroupStart::Rotation, GroupStart::Ellipsoid}) {
    for (const bool hold : {false, true}) {
      const Group group = make_group(
          shapes, shapes[0],
          {.start = start, .mirror = true, .hold = hold, .rounds = 0, .grid = middle_grid});
      CHECK(group.members[1].mirrored);
      CHECK_FALSE(group.members[0].mirrored);
      CHECK_FALSE(group.members[2].mirrored);
      CHECK(group.distances.maxCoeff() < 0.02);
      CHECK(group.members[1].mapped.mesh().positions == mirror_image(shapes[1]).mesh().positions);
      CHECK(group.members[1].mapped.certificate().bijective());
    }
  }
  const Group apart = make_group(shapes, shapes[0], {.rounds = 0, .grid = middle_grid});
  CHECK_FALSE(apart.members[1].mirrored);
  CHECK(apart.distances(0, 1) > 0.1);
}
