#include <meshoptimizer.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cstring>
#include <nlohmann/json.hpp>

#include "io/reading.h"
#include "sphparam/io/losses.h"
#include "support/draco_encoder.h"
#include "support/test_meshes.h"

// Compressed by the encoders of those who made the formats, read by ours.

using namespace sphparam;
using namespace sphparam::tests;
using nlohmann::json;

namespace {

/// A .glb of one mesh, whose JSON a test may change before it is written.
struct CompressedFile {
  json root;
  std::string binary;

  std::string bytes() const {
    const auto chunk = [](const char* kind, std::string content, char padding) {
      while (content.size() % 4 != 0) content.push_back(padding);
      const auto size = static_cast<std::uint32_t>(content.size());
      std::string words(4, '\0');
      std::memcpy(words.data(), &size, 4);
      return words + std::string(kind, 4) + content;
    };
    const std::string body = chunk("JSON", root.dump(), ' ') + chunk("BIN\0", binary, '\0');
    const std::uint32_t header[] = {2, static_cast<std::uint32_t>(12 + body.size())};
    std::string words(8, '\0');
    std::memcpy(words.data(), header, 8);
    return "glTF" + words + body;
  }
};

json scene(json primitive) {
  return {{"asset", {{"version", "2.0"}}},
          {"meshes", {{{"primitives", {std::move(primitive)}}}}},
          {"nodes", {{{"mesh", 0}}}},
          {"scenes", {{{"nodes", {0}}}}}};
}

json accessor(int type, Eigen::Index count, const char* shape) {
  return {{"componentType", type}, {"count", count}, {"type", shape}};
}

std::vector<float> float_positions(const TriangleMesh& mesh) {
  std::vector<float> numbers;
  for (const double x : mesh.positions.reshaped<Eigen::RowMajor>())
    numbers.push_back(static_cast<float>(x));
  return numbers;
}

std::vector<int> corners_of(const TriangleMesh& mesh) {
  return {mesh.triangles.data(), mesh.triangles.data() + mesh.triangles.size()};
}

CompressedFile draco_file(const TriangleMesh& mesh, bool edge_breaker = true) {
  CompressedFile file;
  file.binary = encode_by_draco(float_positions(mesh), corners_of(mesh), edge_breaker);
  file.root = scene(
      {{"attributes", {{"POSITION", 0}}},
       {"indices", 1},
       {"extensions",
        {{"KHR_draco_mesh_compression", {{"bufferView", 0}, {"attributes", {{"POSITION", 0}}}}}}}});
  file.root["accessors"] = {accessor(5126, mesh.vertex_count(), "VEC3"),
                            accessor(5125, 3 * mesh.face_count(), "SCALAR")};
  file.root["buffers"] = {{{"byteLength", file.binary.size()}}};
  file.root["bufferViews"] = {{{"buffer", 0}, {"byteLength", file.binary.size()}}};
  file.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return file;
}

std::string packed_vertices(const TriangleMesh& mesh) {
  const std::vector<float> numbers = float_positions(mesh);
  const auto count = static_cast<std::size_t>(mesh.vertex_count());
  std::string out(meshopt_encodeVertexBufferBound(count, 12), '\0');
  meshopt_encodeVertexVersion(0);
  out.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(),
                                        numbers.data(), count, 12));
  return out;
}

std::string packed_indices(const TriangleMesh& mesh, bool as_sequence) {
  const std::vector<unsigned> indices(mesh.triangles.data(),
                                      mesh.triangles.data() + mesh.triangles.size());
  const auto vertices = static_cast<std::size_t>(mesh.vertex_count());
  std::string out(meshopt_encodeIndexBufferBound(indices.size(), vertices) +
                      meshopt_encodeIndexSequenceBound(indices.size(), vertices),
                  '\0');
  auto* to = reinterpret_cast<unsigned char*>(out.data());
  out.resize(as_sequence
                 ? meshopt_encodeIndexSequence(to, out.size(), indices.data(), indices.size())
                 : meshopt_encodeIndexBuffer(to, out.size(), indices.data(), indices.size()));
  return out;
}

/// As gltfpack writes it: the views lie in a buffer that is not in the file.
CompressedFile meshopt_file(const TriangleMesh& mesh, const char* mode = "TRIANGLES") {
  CompressedFile file;
  file.root = scene({{"attributes", {{"POSITION", 0}}}, {"indices", 1}});
  const auto add = [&](const std::string& packed, std::size_t stride, Eigen::Index count,
                       const char* in_mode) {
    while (file.binary.size() % 4 != 0) file.binary.push_back('\0');
    file.root["bufferViews"].push_back({{"buffer", 1},
                                        {"byteLength", stride * static_cast<std::size_t>(count)},
                                        {"extensions",
                                         {{"EXT_meshopt_compression",
                                           {{"buffer", 0},
                                            {"byteOffset", file.binary.size()},
                                            {"byteLength", packed.size()},
                                            {"byteStride", stride},
                                            {"count", count},
                                            {"mode", in_mode}}}}}});
    file.binary += packed;
  };
  add(packed_vertices(mesh), 12, mesh.vertex_count(), "ATTRIBUTES");
  add(packed_indices(mesh, mode == std::string("INDICES")), 4, 3 * mesh.face_count(), mode);
  file.root["accessors"] = {accessor(5126, mesh.vertex_count(), "VEC3"),
                            accessor(5125, 3 * mesh.face_count(), "SCALAR")};
  file.root["accessors"][0]["bufferView"] = 0;
  file.root["accessors"][1]["bufferView"] = 1;
  file.root["buffers"] = {{{"byteLength", file.binary.size()}},
                          {{"byteLength", 100000},
                           {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
  file.root["extensionsRequired"] = {"EXT_meshopt_compression"};
  return file;
}

/// Each triangle as the places of its corners, the least first; sorted.
std::vector<std::vector<double>> places(const TriangleMesh& mesh) {
  std::vector<std::vector<double>> all;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    std::vector<std::vector<double>> corners;
    for (int k = 0; k < 3; ++k) {
      const Vector3 x = mesh.position(mesh.triangles(f, k)).cast<float>().cast<double>();
      corners.push_back({x[0], x[1], x[2]});
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    all.emplace_back();
    for (const auto& corner : corners)
      all.back().insert(all.back().end(), corner.begin(), corner.end());
  }
  std::sort(all.begin(), all.end());
  return all;
}

json& packed_view(CompressedFile& file, int view) {
  return file
      .root["bufferViews"][static_cast<std::size_t>(view)]["extensions"]["EXT_meshopt_compression"];
}

}  // namespace

TEST_CASE("gltf_compression: what Draco has packed is the mesh that it was") {
  const TriangleMesh mesh = icosphere(3);
  for (const bool edge_breaker : {false, true}) {
    const MeshFile file = read(draco_file(mesh, edge_breaker).bytes(), "a.glb");
    CHECK(places(file.mesh) == places(mesh));
    CHECK(file.mesh.vertex_count() == mesh.vertex_count());
    CHECK(file.position_type == ScalarType::Float32);
  }
}

TEST_CASE("gltf_compression: attributes that Draco has not packed are where they say") {
  const TriangleMesh mesh = octahedron();
  CompressedFile file = draco_file(mesh, false);
  while (file.binary.size() % 4 != 0) file.binary.push_back('\0');
  const std::size_t packed = file.binary.size();
  file.binary += "abcdef";
  file.root["buffers"][0]["byteLength"] = file.binary.size();
  file.root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", packed}, {"byteLength", 6}});
  file.root["accessors"].push_back(accessor(5121, 6, "SCALAR"));
  file.root["meshes"][0]["primitives"][0]["attributes"]["_RANK"] = 2;
  CHECK(complaint(file.bytes(), "a.glb") == "a.glb: accessor 2: has no data");
  file.root["accessors"][2]["bufferView"] = 1;
  CHECK(values_of(read(file.bytes(), "a.glb").find_vertex_property("_RANK")) ==
        std::vector<double>{'a', 'b', 'c', 'd', 'e', 'f'});
  // A primitive that is not packed shares an accessor with one that is.
  const std::vector<float> numbers = float_positions(mesh);
  const std::size_t bytes = numbers.size() * sizeof(float), start = packed + 8;
  file.binary.resize(start + bytes);
  std::memcpy(file.binary.data() + start, numbers.data(), bytes);
  file.root["buffers"][0]["byteLength"] = file.binary.size();
  file.root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", start}, {"byteLength", bytes}});
  file.root["accessors"][0]["bufferView"] = 2;
  file.root["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}});
  CHECK(read(file.bytes(), "a.glb").mesh.positions.bottomRows(6) == mesh.positions);
}

namespace {

/// One of Draco with metadata after its header, whose flag says so.
CompressedFile with_metadata(CompressedFile file, const std::string& metadata) {
  file.binary[10] = static_cast<char>(file.binary[10] | 0x80);
  file.binary.insert(11, metadata);
  file.root["buffers"][0]["byteLength"] = file.binary.size();
  file.root["bufferViews"][0]["byteLength"] = file.binary.size();
  return file;
}

}  // namespace

TEST_CASE("gltf_compression: metadata of Draco are passed over, up to a depth") {
  const TriangleMesh mesh = icosphere(2);
  // Of one attribute, with entries within entries, and of all.
  const std::string entry = "\1\4name\2me", none(1, '\0');
  const std::string nested = entry + "\1\5inner" + entry + none;
  const std::string one_attribute = "\1" + none;
  for (const bool edge_breaker : {false, true}) {
    const CompressedFile file =
        with_metadata(draco_file(mesh, edge_breaker), one_attribute + nested + entry + none);
    CHECK(places(read(file.bytes(), "a.glb").mesh) == places(mesh));
  }
  // Within each other: no entries, and one more with a name of no letters. Then far too many faces.
  const auto deep = [&](int depth) {
    std::string metadata = none;
    for (int i = 0; i < depth; ++i) metadata += none + "\1" + none;
    CompressedFile file = with_metadata(draco_file(mesh, false), metadata + none + none);
    file.binary.replace(11 + metadata.size() + 2, 5, "\xff\xff\xff\xff\x0f");
    return complaint(file.bytes(), "a.glb");
  };
  CHECK(contains(deep(64), "more triangles than its bytes can hold"));
  CHECK(contains(deep(65), "its metadata are nested too deep"));
}

TEST_CASE("gltf_compression: what meshoptimizer has packed is the mesh that it was") {
  const TriangleMesh mesh = icosphere(3);
  for (const char* mode : {"TRIANGLES", "INDICES"}) {
    const MeshFile file = read(meshopt_file(mesh, mode).bytes(), "a.glb");
    CHECK(file.mesh.positions == mesh.positions.cast<float>().cast<double>());
    CHECK(places(file.mesh) == places(mesh));
  }
}

TEST_CASE("gltf_compression: filtered numbers are what they stand for") {
  const TriangleMesh mesh = octahedron();
  CompressedFile file = meshopt_file(mesh);
  // Exponent 0, mantissa x: all of the octahedron's coordinates are whole numbers.
  std::vector<std::int32_t> numbers;
  for (const float x : float_positions(mesh))
    numbers.push_back(static_cast<std::int32_t>(x) & 0xFFFFFF);
  const auto count = static_cast<std::size_t>(mesh.vertex_count());
  std::string packed(meshopt_encodeVertexBufferBound(count, 12), '\0');
  packed.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(packed.data()),
                                           packed.size(), numbers.data(), count, 12));
  packed_view(file, 0)["byteOffset"] = file.binary.size();
  packed_view(file, 0)["byteLength"] = packed.size();
  packed_view(file, 0)["filter"] = "EXPONENTIAL";
  file.binary += packed;
  file.root["buffers"][0]["byteLength"] = file.binary.size();
  CHECK(places(read(file.bytes(), "a.glb").mesh) == places(mesh));
}

TEST_CASE("gltf_compression: damage is refused with its place") {
  const TriangleMesh mesh = icosphere(2);
  const auto refused = [](const CompressedFile& file, const std::string& expected) {
    const std::string message = complaint(file.bytes(), "a.glb");
    INFO(message);
    CHECK(contains(message, expected));
  };
  const auto meshopt = [&](const char* key, const json& value, const std::string& expected) {
    CompressedFile file = meshopt_file(mesh);
    packed_view(file, 0)[key] = value;
    refused(file, expected);
  };
  meshopt("count", 1 << 30, "buffer view 0: EXT_meshopt_compression: it claims more rows");
  CompressedFile few = meshopt_file(octahedron());
  REQUIRE(packed_view(few, 0)["byteLength"] < 256);
  packed_view(few, 0)["count"] = 10000;  // 120 kB of at most 256 times as many bytes, and 64 kB
  refused(few, "it claims more rows");
  meshopt("count", -1, "buffer view 0: its compression has no count");
  meshopt("count", 2.5, "no whole number");
  meshopt("count", 161, "do not fit");
  meshopt("byteStride", 10, "rows of 10 bytes");
  meshopt("byteOffset", 1 << 30, "past the end");
  meshopt("byteOffset", 1, "damaged");
  meshopt("buffer", 7, "a buffer that is not there");
  meshopt("mode", "POINTS", "mode 'POINTS'");
  meshopt("filter", "SHARP", "filter 'SHARP'");
  meshopt("filter", "QUATERNION", "does not go with rows of 12");

  const auto draco = [&](const char* key, const json& value, const std::string& expected) {
    CompressedFile file = draco_file(mesh);
    file.root["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"][key] =
        value;
    refused(file, expected);
  };
  draco("bufferView", 5,
        "mesh 0 primitive 0: its compressed bytes are in a view that is not there");
  draco("bufferView", "x", "no whole number");
  draco("attributes", 1, "has no attributes");
  draco("attributes", {{"POSITION", 9}}, "there is no attribute 9");
  draco("attributes", {{"NORMAL", 0}}, "NORMAL has no accessor");
  CompressedFile file = draco_file(mesh);
  file.root["accessors"][0]["type"] = "VEC2";
  refused(file, "attribute 0 has 3 components");
  file.root["accessors"][0] = 7;
  refused(file, "cannot be read as glTF");
}

TEST_CASE("gltf_compression: bytes changed anywhere are read or refused, and end") {
  const TriangleMesh mesh = icosphere(1);
  for (const CompressedFile& whole :
       {draco_file(mesh, false), draco_file(mesh, true), meshopt_file(mesh)}) {
    for (std::size_t at = 0; at < whole.binary.size(); ++at) {
      CompressedFile file = whole;
      file.binary[at] = static_cast<char>(file.binary[at] ^ 0x55);
      complaint(file.bytes(), "a.glb");  // throws what is no ReadError
    }
    for (std::size_t size = 4; size < whole.binary.size(); size += 7) {
      CompressedFile file = whole;
      file.binary.resize(size);
      CHECK_FALSE(complaint(file.bytes(), "a.glb").empty());
    }
  }
}
