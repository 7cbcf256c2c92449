#include <algorithm>
#include <catch2/catch.hpp>

#include "io/formats/gifti/gifti_writer.h"
#include "io/reading.h"
#include "sphparam/errors.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/sphere/float_rounding.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using sphparam::MeshFile;
using sphparam::ScalarType;
using sphparam::serialise_gifti;

TEST_CASE("gifti_writer: what is written is read back bit for bit, and written again the same") {
  MeshFile file;
  file.mesh = icosphere(3);
  file.mesh.positions = file.mesh.positions.cast<float>().cast<double>().eval();
  file.comments = {"gifti AnatomicalStructurePrimary CortexRight", "sphparam verdict certified",
                   "made by hand"};
  const std::string bytes = serialise_gifti(file);
  const MeshFile again = read(bytes, "a.gii");
  CHECK(again.mesh.positions == file.mesh.positions);
  CHECK(again.position_type == ScalarType::Float32);
  CHECK(again.mesh.triangles == file.mesh.triangles);
  CHECK(again.notes.empty());
  CHECK(again.comments == std::vector<std::string>{"sphparam verdict certified",
                                                   "gifti AnatomicalStructurePrimary CortexRight"});
  CHECK(serialise_gifti(again) == bytes);
}

TEST_CASE("gifti_writer: coordinates that no float holds are rounded to the nearest one") {
  MeshFile file;
  file.mesh = icosphere(3);
  const MeshFile again = read(serialise_gifti(file));
  CHECK(again.position_type == ScalarType::Float32);
  CHECK(again.mesh.positions == file.mesh.positions.cast<float>().cast<double>());
}

TEST_CASE("gifti_writer: triangles that rounding leaves without area are counted") {
  MeshFile file;
  file.mesh = icosphere(1);
  const Triangles& triangles = file.mesh.triangles;
  file.mesh.positions.row(triangles(0, 1)) = file.mesh.positions.row(triangles(0, 0));
  file.mesh.positions.row(triangles(0, 1)) *= 1 + 1e-9;  // both of its edge
  const auto losses = losses_of_writing(file, read(serialise_gifti(file)));
  REQUIRE(losses.size() == 2);
  CHECK(contains(losses[0], "not carried: the last digits of "));
  CHECK(losses[1] ==
        "not carried: the area of 2 of 80 triangles: with coordinates of 32 bits they have none");
}

TEST_CASE("gifti_writer: coordinates beyond floats are refused, and a mesh too small for them") {
  MeshFile file;
  file.mesh = tetrahedron();
  file.mesh.positions *= 1e39;
  try {
    serialise_gifti(file);
    FAIL("not refused");
  } catch (const sphparam::WriteError& error) {
    CHECK(contains(error.what(), "a coordinate of vertex 0 is beyond numbers of 32 bits"));
  }
  file.mesh.positions *= 1e-78;
  CHECK_THROWS_AS(serialise_gifti(file), sphparam::UnmeasurableMesh);
}

TEST_CASE("gifti_writer: a map rounded to floats keeps its certificate in the file") {
  MeshFile file;
  file.mesh = icosphere(4);
  file.comments = {"gifti AnatomicalStructurePrimary CortexLeft", "gifti GeometricType Anatomical"};
  const FloatRounding rounding = round_to_float(Topology(file.mesh), {file.mesh.positions});
  REQUIRE(rounding.certificate.bijective());
  MeshFile sphere = sphparam::sphere_mesh(file, rounding.map, {{"verdict", "certified"}});
  const std::string bytes = serialise_gifti(
      sphere, {.geometric_type = "Spherical", .anatomical_structure = "CortexLeft"});
  const MeshFile again = read(bytes, "a.gii");
  CHECK(again.position_type == ScalarType::Float32);
  CHECK(certify(Topology(again.mesh), {again.mesh.positions}).bijective());
  CHECK(contains(bytes, "Spherical"));
  CHECK_FALSE(contains(bytes, "Anatomical]]"));
  CHECK(contains(bytes, "CortexLeft"));
  CHECK(sphparam::read_provenance(again) == sphparam::Provenance{{"verdict", "certified"}});
}

TEST_CASE("gifti_writer: labels come back with their keys, colours and names") {
  MeshFile file;
  file.mesh = tetrahedron();
  file.comments = {"gifti label 0 1 1 1 0 ???", "gifti label 35 0.25 0.5 0.1 1 G_front inf-Orbital",
                   "gifti label -2 0 0 0 1 "};
  const MeshFile again = read(serialise_gifti(file));
  CHECK(std::vector<std::string>(again.comments.begin() + 1, again.comments.end()) ==
        file.comments);
  file.comments = {"gifti label 7 - no colour", "gifti label seven - no label"};
  const MeshFile plain = read(serialise_gifti(file));
  CHECK(std::count(plain.comments.begin(), plain.comments.end(), "gifti label 7 - no colour") == 1);
}

TEST_CASE("gifti_writer: a sphere is in no space but its own, whatever the surface is in") {
  MeshFile file;
  file.mesh = tetrahedron();
  const std::string bytes = serialise_gifti(file, {.geometric_type = "Spherical"});
  CHECK(contains(bytes, "<CoordinateSystemTransformMatrix>"));
  CHECK(read(bytes).notes.empty());  // an identity
  CHECK_FALSE(contains(serialise_gifti(file), "<CoordinateSystemTransformMatrix>"));
}

TEST_CASE("gifti_writer: what a stranger wrote into comments cannot break the XML") {
  MeshFile file;
  file.mesh = tetrahedron();
  file.comments = {"gifti GeometricType a]]><b>&\x01\xff c", "sphparam \"k\" v", "gifti",
                   "gifti x"};
  const MeshFile again = read(serialise_gifti(file));
  CHECK(again.mesh.triangles == file.mesh.triangles);
  CHECK(contains(again.comments.at(2), "<b>&?? c"));
}

TEST_CASE("gifti_writer: a mesh without faces is written and read") {
  const MeshFile again = read(serialise_gifti(MeshFile{}));
  CHECK(again.mesh.vertex_count() == 0);
  CHECK(again.mesh.face_count() == 0);
}
