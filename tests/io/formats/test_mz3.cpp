#include <catch2/catch.hpp>
#include <limits>

#include "io/files/gzip.h"
#include "io/formats/mz3_reader.h"
#include "io/formats/mz3_writer.h"
#include "io/reading.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/mesh_writer.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

MeshFile coloured_tetrahedron() {
  MeshFile file;
  file.mesh = tetrahedron();
  file.position_type = ScalarType::Float32;
  file.vertex_properties = {{"red", ScalarType::Uint8, {255, 0, 7, 9}},
                            {"green", ScalarType::Uint8, {1, 2, 3, 4}},
                            {"blue", ScalarType::Uint8, {0, 0, 0, 255}},
                            {"alpha", ScalarType::Uint8, {255, 254, 253, 0}},
                            {"scalar", ScalarType::Float32, {0.5, -1, 2, 3}},
                            {"scalar_2", ScalarType::Float32, {1, 1, 1, 0.25}}};
  return file;
}

}  // namespace

TEST_CASE("mz3: a mesh with colours and layers comes back as it was, packed or not") {
  const MeshFile file = coloured_tetrahedron();
  const std::string bytes = serialise_mz3(file);
  CHECK(bytes.size() == 16 + 4 * (12 + 12 + 4 + 2 * 4));
  CHECK(bytes.starts_with(std::string("MZ\x0f\0\4\0\0\0\4\0\0\0\0\0\0\0", 16)));
  for (const std::string& written : {bytes, zip(bytes)}) {
    for (const char* name : {"a.mz3", "a.mz3.gz", "nameless"}) {
      const MeshFile back = read(written, name);
      CHECK(back.mesh.positions == file.mesh.positions);
      CHECK(back.mesh.triangles == file.mesh.triangles);
      CHECK(back.notes.empty());
      CHECK(serialise_mz3(back) == bytes);
      CHECK(losses_of_writing(file, back).empty());
    }
  }
}

TEST_CASE("mz3: colours without alpha are opaque, and a byte after them is told") {
  MeshFile file = coloured_tetrahedron();
  file.vertex_properties.resize(3);
  const std::string bytes = serialise_mz3(file);
  const MeshFile back = read(bytes);
  CHECK(values_of(back.find_vertex_property("blue")) == std::vector<double>{0, 0, 0, 255});
  CHECK(values_of(back.find_vertex_property("alpha")) == std::vector<double>(4, 255));
  CHECK(back.notes.empty());
  CHECK(read(bytes + "x").notes ==
        std::vector<std::string>{"data after the end of the mesh ignored"});
}

TEST_CASE("mz3: colours of any type are bytes, the brightest of the type 255") {
  using enum ScalarType;
  for (const auto& [type, value] :
       {std::pair{Uint8, 51.0}, {Int32, 51.0}, {Uint16, 13107.0}, {Float32, 0.2}, {Float64, 0.2}}) {
    MeshFile file = coloured_tetrahedron();
    for (const char* const name : {"red", "green", "blue", "alpha"})
      file.set_vertex_property({name, type, std::vector<double>(4, value)});
    const MeshFile back = read(serialise_mz3(file));
    for (const char* const name : {"red", "alpha"})
      CHECK(values_of(back.find_vertex_property(name)) == std::vector<double>(4, 51));
  }
}

TEST_CASE("mz3: layers that need it have 64 bits, and names are told to be lost") {
  MeshFile file = coloured_tetrahedron();
  file.set_vertex_property({"thickness", ScalarType::Float64, {0.1, 0.2, 0.3, 1e300}});
  const MeshFile back = read(serialise_mz3(file));
  CHECK(values_of(back.find_vertex_property("scalar_3")) ==
        file.find_vertex_property("thickness")->values);
  CHECK(contains(losses_of_writing(file, back).at(0), "thickness"));
}

TEST_CASE("mz3: comments are told to be lost, but for what says of a map and of vertices") {
  MeshFile file = coloured_tetrahedron();
  const MeshFile back = read(serialise_mz3(file));
  file.comments = {"sphparam method progressive", "source_vertices 9"};
  CHECK(losses_of_writing(file, back).empty());
  file.comments.push_back("made by hand");
  CHECK(losses_of_writing(file, back) == std::vector<std::string>{"not carried: 1 comment"});
}

TEST_CASE("mz3: a layer that leaves vertices out, and private data, are told") {
  MeshFile file = coloured_tetrahedron();
  file.vertex_properties[4].values[2] = std::numeric_limits<double>::quiet_NaN();
  const MeshFile back = read(serialise_mz3(file));
  CHECK(contains(losses_among(back.notes).at(0), "layer 1"));
  CHECK(back.find_vertex_property("scalar_2"));
  std::string bytes = serialise_mz3(coloured_tetrahedron());
  bytes[12] = 3;
  bytes.insert(16, "abc");
  CHECK(contains(losses_among(read(bytes).notes).at(0), "3 bytes of private data"));
}

TEST_CASE("mz3: files of values, wrong headers and cut files are refused") {
  const std::string bytes = serialise_mz3(coloured_tetrahedron());
  std::string values = bytes;
  values[2] = 8;
  CHECK(contains(complaint(values, "a.mz3"), "no mesh"));
  const std::size_t one_layer_less = bytes.size() - 16;  // how many there are follows from the size
  for (std::size_t size = 2; size < bytes.size(); ++size) {
    if (size == one_layer_less) continue;
    INFO(size);
    CHECK(contains(complaint(bytes.substr(0, size), "a.mz3"), "a.mz3"));
  }
  std::string future = bytes;
  future[3] = 1;
  CHECK(contains(complaint(future, "a.mz3"), "attributes 271"));
  std::string counts = bytes;
  counts[11] = '\x7f';
  CHECK(contains(complaint(counts, "a.mz3"), "over the limit"));
}
