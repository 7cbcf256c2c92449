#include <catch2/catch.hpp>

#include "sphparam/io/file_numbers.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// Vertex v has the number v + 100 in its file; the last two were one.
MeshFile renumbered() {
  MeshFile file;
  file.mesh = icosphere(0);
  Property source{"source_vertex", ScalarType::Int32, {}};
  for (Vertex v = 0; v < file.mesh.vertex_count(); ++v) source.values.push_back(v + 100);
  source.values.back() = source.values[source.values.size() - 2];
  file.set_vertex_property(source);
  return file;
}

}  // namespace

TEST_CASE("file numbers: poles and meridian are found by their numbers in the file") {
  const MeshFile file = renumbered();
  const FileNumbers numbers(file);
  ParameterizeOptions options;
  options.poles = Poles{103, 100};
  options.meridian = 105;
  const ParameterizeOptions settled = with_vertices_of_mesh(options, numbers);
  CHECK(settled.poles->north == 3);
  CHECK(settled.poles->south == 0);
  CHECK(settled.meridian == 5);
}

TEST_CASE("file numbers: a number of no vertex says whose it was") {
  const MeshFile file = renumbered();
  const FileNumbers numbers(file);
  ParameterizeOptions options;
  options.meridian = 3;
  try {
    with_vertices_of_mesh(options, numbers);
    FAIL("3 is no number in the file");
  } catch (const NoSuchVertex& error) {
    CHECK(error.whose() == "meridian");
    CHECK(error.what() == numbers.absence(3));
  }
  options.meridian = {};
  options.poles = Poles{104, 104};
  CHECK_THROWS_WITH(with_vertices_of_mesh(options, numbers), Catch::Contains("one vertex"));
}
