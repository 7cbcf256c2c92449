#include <catch2/catch.hpp>

#include "sphparam/io/fillers.h"
#include "sphparam/remesh/remesh.h"
#include "support/mapped.h"

using namespace sphparam;

namespace {

MappedMesh octahedron() {
  MeshFile file;
  file.mesh.positions =
      (Points(6, 3) << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1).finished();
  file.mesh.triangles =
      (Triangles(8, 3) << 0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5)
          .finished();
  SphereMap map{file.mesh.positions};
  file.mesh.positions *= 0.5;
  file.set_vertex_property({"thick, \"mm\"", ScalarType::Float64, {0.1, 1, 2, 3, 4, 5}});
  file.set_vertex_property({"parcel", ScalarType::Int32, {7, 8, 9, 10, 11, 12}});
  return tests::mapped(std::move(file), std::move(map));
}

}  // namespace

TEST_CASE("sample table: a row a vertex, of its number, place, position and properties") {
  CHECK(sample_table(octahedron()) ==
        "vertex,theta,phi,x,y,z,\"thick, \"\"mm\"\"\",parcel\n"
        "0,0,1.5707963267948966,0.5,0,0,0.1,7\n"
        "1,3.141592653589793,1.5707963267948966,-0.5,0,0,1,8\n"
        "2,1.5707963267948966,1.5707963267948966,0,0.5,0,2,9\n"
        "3,4.71238898038469,1.5707963267948966,0,-0.5,0,3,10\n"
        "4,0,0,0,0,0.5,4,11\n"
        "5,0,3.141592653589793,0,0,-0.5,5,12\n");
}

TEST_CASE("sample table: with tabs between, commas in names need no quotes but have them") {
  const std::string text =
      sample_table(octahedron(), TableAngles::Radians, {{0, 1, 0, 0, 0, 0}}, '\t');
  CHECK_THAT(
      text, Catch::StartsWith("vertex\ttheta\tphi\tx\ty\tz\t\"thick, \"\"mm\"\"\"\tparcel\tfiller\n"
                              "0\t0\t1.5707963267948966\t0.5\t0\t0\t0.1\t7\t0\n"
                              "1\t3.141592653589793\t1.5707963267948966\t-0.5\t0\t0\t1\t8\t1\n"));
}

TEST_CASE("sample table: in degrees longitude goes from -180 to 180 and latitude north") {
  const std::string text = sample_table(octahedron(), TableAngles::Degrees);
  CHECK_THAT(text, Catch::StartsWith("vertex,lon,lat,x,y,z,"));
  for (const char* row :
       {"\n0,0,0,0.5,", "\n1,180,0,-0.5,", "\n2,90,0,", "\n3,-90,0,", "\n4,0,90,", "\n5,0,-90,"})
    CHECK_THAT(text, Catch::Contains(row));
}

TEST_CASE("sample table: vertices in holes have a mark, or no row") {
  const FillerMarks in_hole = {0, 1, 0, 0, 0, 0};
  const std::string marked = sample_table(octahedron(), TableAngles::Degrees, {in_hole});
  CHECK_THAT(marked, Catch::StartsWith("vertex,lon,lat,x,y,z,\"thick, \"\"mm\"\"\",parcel,filler\n"
                                       "0,0,0,0.5,0,0,0.1,7,0\n"
                                       "1,180,0,-0.5,0,0,1,8,1\n"
                                       "2,90,0,"));
  const std::string left = sample_table(octahedron(), TableAngles::Degrees, {in_hole, true});
  CHECK_THAT(left, Catch::StartsWith("vertex,lon,lat,x,y,z,\"thick, \"\"mm\"\"\",parcel\n"
                                     "0,0,0,0.5,0,0,0.1,7\n"
                                     "2,90,0,"));
}

TEST_CASE(
    "sample table: a direction is in a hole where no surface is, of which its rim is a part") {
  MeshFile file = octahedron().file();
  const SphereMap map{file.mesh.positions * 2};
  const Points directions =
      (Points(5, 3) << 1, 1, 1, 1, 0, 0, 1, 1, 0, -1, 1, 1, 2, 1, 1).finished();
  CHECK(in_holes(tests::mapped(file, map), directions).empty());
  mark_fillers(file, {1, 0, 0, 0, 0, 0, 0, 0});
  CHECK(in_holes(tests::mapped(file, map), directions) == FillerMarks{1, 0, 0, 0, 1});
}
