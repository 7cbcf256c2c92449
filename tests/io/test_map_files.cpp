#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <numbers>

#include "reading.h"
#include "sphparam/errors.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/harmonic_expansion.h"
#include "sphparam/io/map_files.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/verify_map.h"
#include "support/folder.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
namespace fs = std::filesystem;

namespace {

MappedMesh egg() {
  MeshFile file;
  file.mesh = icosphere(2);
  file.mesh.positions.col(2) *= 1.5;
  file.vertex_properties.push_back({"height", ScalarType::Float64, std::vector<double>(162)});
  for (Vertex v = 0; v < 162; ++v)
    file.vertex_properties[0].values[static_cast<size_t>(v)] = file.mesh.position(v).z();
  return MappedMesh({.file = file,
                     .map = {icosphere(2).positions},
                     .provenance = {{"method", "given"}, {"verdict", "one-to-one"}}});
}

/// A map of the egg whose points lie closer together than floats do there, all but the first.
SphereMap gathered_map() {
  constexpr double scale = 1e-8;
  SphereMap map{icosphere(2).positions};
  const Vector3 pole = -map.point(0);
  for (Vertex v = 1; v < 162; ++v) {
    const Vector3 p = map.point(v);
    const Vector3 plane = scale / (1 + p.dot(pole)) * (p - p.dot(pole) * pole);
    map.points.row(v) = (2 * plane + (1 - plane.squaredNorm()) * pole).normalized();
  }
  return map;
}

}  // namespace

TEST_CASE("map_files: the sphere is written in every format, exactly but for GIFTI's floats") {
  const Folder folder;
  for (const char* name : {"s.ply", "s.obj", "s.off", "s.gii"}) {
    CHECK(save_sphere(folder / name, egg()) == 0);
    const VerifiedMap read = verify_map(folder / name);
    CHECK(read.certificate.bijective());
    const bool exact = std::string(name) != "s.gii";
    CHECK(read.mean_length == Approx(exact ? 1 : 100));
    if (exact) CHECK(read.map.points == egg().map().points);
    CHECK(read_provenance(read_mesh(folder / name)) == egg().provenance());
  }
  CHECK_THROWS_AS(save_sphere(folder / "s.stl", egg()), WriteError);
}

TEST_CASE("map_files: what floats cannot hold is mapped anew, where nothing holds it in place") {
  const Folder folder;
  const Provenance held = {{"method", "given"},
                           {"poles", "1 2"},
                           {"meridian", "3"},
                           {"upright", "as the mesh"},
                           {"verdict", "one-to-one"}};
  const MappedMesh mapped({.file = egg().file(), .map = gathered_map(), .provenance = held});
  CHECK_THROWS_WITH(
      save_sphere(folder / "a.gii", mapped, {.may_remap = false}),
      Catch::Contains("a.gii: numbers of 32 bits cannot hold this map with its pins"));
  CHECK(save_sphere(folder / "a.ply", mapped, {.may_remap = false}) == 0);
  CHECK(read_provenance(read_mesh(folder / "a.ply")) == held);
  CHECK(save_sphere(folder / "b.gii", egg(), {.may_remap = false}) == 0);
  CHECK(save_sphere(folder / "c.gii", mapped) > 0);
  CHECK(verify_map(folder / "c.gii").certificate.bijective());
  CHECK(read_provenance(read_mesh(folder / "c.gii")) ==
        Provenance{{"method", "given"}, {"verdict", "one-to-one"}});
}

TEST_CASE("map_files: a folded map has the verdict of what floats made of it") {
  const Folder folder;
  const MappedMesh mapped = egg();
  SphereMap map = gathered_map();
  map.points.row(0) = map.points.row(1);
  const Certificate certificate = certify(mapped.topology(), map);
  const Provenance provenance = {{"verdict", verdict(certificate)}};
  PendingFiles files;
  for (const char* name : {"a.ply", "a.gii"}) {
    CHECK(add_sphere(files, folder / name,
                     {mapped.file(), mapped.topology(), map, certificate, provenance}) == 0);
  }
  files.publish();
  CHECK(read_provenance(read_mesh(folder / "a.ply")) == provenance);
  const std::string found = verdict(verify_map(folder / "a.gii").certificate);
  REQUIRE(found != verdict(certificate));
  CHECK(read_provenance(read_mesh(folder / "a.gii")) == Provenance{{"verdict", found}});
}

TEST_CASE("map_files: what is written must have the verdict that was found") {
  const Folder folder;
  const MappedMesh mapped = egg();
  PendingFiles files;
  const MeshFile with_map = attach_map(mapped.file(), mapped.map(), {});
  CHECK_THROWS_AS(add_map(files, folder / "egg.sph.ply", with_map, mapped.topology(), "folded 3"),
                  NotCertifiedError);
  add_map(files, folder / "egg.sph.ply", with_map, mapped.topology(), "one-to-one");
  files.publish();
  CHECK(fs::exists(folder / "egg.sph.ply"));
}

TEST_CASE("map_files: a map is proved on the faces and the vertices that the file has") {
  const Folder folder;
  const MappedMesh mapped = egg();
  const MeshFile with_map = attach_map(mapped.file(), mapped.map(), {});
  PendingFiles files;
  const auto add = [&](const MeshFile& file) {
    add_certified(files, folder / "egg.sph.ply", serialise_ply(file), mapped.topology(), 1);
  };
  MeshFile other_faces = with_map;
  for (int& v : other_faces.mesh.triangles.reshaped()) v = v == 3 ? 100 : v == 100 ? 3 : v;
  CHECK_THROWS_AS(add(other_faces), NotCertifiedError);
  MeshFile one_more = with_map;
  one_more.mesh.positions.conservativeResize(163, 3);
  one_more.mesh.positions.row(162).setZero();
  for (Property& property : one_more.vertex_properties) property.values.push_back(1);
  CHECK_THROWS_AS(add(one_more), MeshError);
  CHECK_NOTHROW(add(with_map));
}

TEST_CASE("map_files: provenance says how a map came about, by the numbers of the file") {
  MeshFile file;
  file.mesh = octahedron();
  file.set_vertex_property({"source_vertex", ScalarType::Int32, {10, 11, 12, 13, 14, 15}});
  Parameterization result;
  result.made_by = "relaxation";
  result.poles = Poles{4, 5};
  result.meridian = 0;
  const Provenance lines = provenance_of(
      result,
      {.method = "progressive", .options = "--lambda 1", .pins = 2, .verdict = "one-to-one"},
      FileNumbers(file));
  const Provenance expected = {{"version", lines.front().second},
                               {"method", "progressive"},
                               {"stage", "relaxation"},
                               {"options", "--lambda 1"},
                               {"poles", "14 15"},
                               {"meridian", "10"},
                               {"pins", "2"},
                               {"verdict", "one-to-one"}};
  CHECK(lines == expected);
}

TEST_CASE("harmonic_expansion: an ellipsoid is of degree 1, and comes back") {
  const MappedMesh mapped = egg();
  const HarmonicExpansion expansion = expand_in_harmonics(mapped, {"height"}, {.degree = 3});
  CHECK(expansion.degree() == 3);
  CHECK(expansion.functions == std::vector<std::string>{"x", "y", "z", "height"});
  CHECK(expansion.plain_position_rms() < 1e-9);
  const MeshFile back = reconstruction(mapped, expansion);
  CHECK((back.mesh.positions - mapped.mesh().positions).cwiseAbs().maxCoeff() < 1e-9);
  CHECK(read_sphere(back)->points == mapped.map().points);
  CHECK(values_of(back.find_vertex_property("height"))[3] ==
        Approx(mapped.mesh().position(3).z()).margin(1e-9));
  CHECK(read_provenance(back).back() == std::pair<std::string, std::string>{"harmonics", "3"});
}

TEST_CASE("harmonic_expansion: the integral is of the flat triangles, of a radial map along rays") {
  // With corners 3 along x and 1 along y and z: r = 1 / (|x|/3 + |y| + |z|), of this mean.
  constexpr double mean = 0.902772733935;
  MeshFile file;
  file.mesh = octahedron();
  const SphereMap map{file.mesh.positions};
  file.mesh.positions.col(0) *= 3;
  const Provenance lines = {
      {"method", "radial"}, {"radial-centre", "0 0 0"}, {"radial-movement", "0"}};
  const auto mean_radius = [&](const Provenance& provenance) {
    const MappedMesh mapped({.file = file, .map = map, .provenance = provenance});
    const HarmonicExpansion found =
        expand_in_harmonics(mapped, {}, {.degree = 0, .least_squares = false}, Vector3(0, 0, 0));
    CHECK(found.radius_about == Vector3(0, 0, 0));
    return found.fit.coefficients(0, 3) / std::sqrt(4 * std::numbers::pi);
  };
  CHECK(mean_radius(lines) == Approx(mean).epsilon(1e-4));
  // Elsewhere a map says which point lies where, and the radius is that of the point.
  CHECK(mean_radius({}) > 1.05 * mean);
}

TEST_CASE("harmonic_expansion: what was turned says so, and no longer that it lies as a body") {
  MeshFile file = egg().file();
  file.mesh.positions.col(1) *= 1.2;
  file.corner_tangents = CornerTangents::Zero(file.mesh.triangles.size(), 4);
  file.comments = {"up axis y", "front axis z", "freesurfer geometry cras = 1 2 3"};
  const MappedMesh mapped({.file = file,
                           .map = {icosphere(2).positions},
                           .provenance = {{"method", "radial"},
                                          {"poles", "1 2"},
                                          {"meridian", "3"},
                                          {"upright", "z, front -y"},
                                          {"radial-centre", "0 0 0"},
                                          {"radial-movement", "0"}}});
  const HarmonicExpansion as_it_was = expand_in_harmonics(mapped, {}, {.degree = 3});
  Provenance lines = mapped.provenance();
  lines.emplace_back("harmonics", "3");
  const MeshFile there = reconstruction(mapped, as_it_was);
  CHECK(read_provenance(there) == lines);
  for (const std::string& comment : file.comments)
    CHECK(std::ranges::count(there.comments, comment) == 1);
  CHECK_FALSE(there.corner_tangents);

  HarmonicExpansion turned = as_it_was;
  align(turned, mapped, HarmonicAlignment::SphereAndSurface);
  const MeshFile back = reconstruction(mapped, turned);
  CHECK(read_provenance(back) ==
        Provenance{{"method", "radial"}, {"harmonics", "3"}, {"aligned", "first-order ellipsoid"}});
  for (const std::string& comment : file.comments)
    CHECK(std::ranges::count(back.comments, comment) == 0);
  const Points along = read_sphere(back)->points * Vector3(-1.5, -1.2, 1).asDiagonal();
  CHECK((back.mesh.positions - along).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("harmonic_expansion: what it makes is written with its map, or as the mesh alone") {
  const Folder folder;
  const MappedMesh mapped = egg();
  const HarmonicExpansion expansion = expand_in_harmonics(mapped, {}, {.degree = 3});
  PendingFiles files;
  add_reconstruction(files, folder / "a.sph.ply", mapped, expansion);
  add_reconstruction(files, folder / "a.off", mapped, expansion);
  files.publish();
  CHECK(load_mapped(folder / "a.sph.ply").map().points == mapped.map().points);
  CHECK_FALSE(has_map(read_mesh(folder / "a.off")));
}

TEST_CASE("harmonic_expansion: a scalar that vertices lack is named") {
  CHECK_THROWS_WITH(expand_in_harmonics(egg(), {"weight"}), Catch::Contains("weight"));
}
