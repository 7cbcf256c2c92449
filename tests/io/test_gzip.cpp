#include <zlib.h>

#include <catch2/catch.hpp>

#include "io/files/gzip.h"
#include "reading.h"
#include "sphparam/io/mesh_writer.h"

using namespace sphparam;
using namespace sphparam::tests;
using sphparam::MeshFile;
using sphparam::ReadOptions;

namespace {

std::string gzipped(const std::string& bytes) {
  constexpr int gzip = 15 + 16;
  z_stream stream{};
  REQUIRE(deflateInit2(&stream, 9, Z_DEFLATED, gzip, 9, Z_DEFAULT_STRATEGY) == Z_OK);
  std::string packed(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  REQUIRE(deflate(&stream, Z_FINISH) == Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

}  // namespace

TEST_CASE("gzip: a mesh of any format is read through it, whatever its name") {
  const MeshFile plain = read(tetrahedron_obj, "a.obj");
  for (const std::string& bytes :
       {tetrahedron_obj, tetrahedron_off, tetrahedron_ply, sphparam::serialise_ply(plain)}) {
    for (const char* name : {"a.gz", "a.obj.gz", "a.ply", "standard input"}) {
      const MeshFile file = read(gzipped(bytes), name);
      CHECK(file.mesh.triangles == plain.mesh.triangles);
      CHECK(file.mesh.positions == plain.mesh.positions);
      CHECK(file.notes.empty());
      CHECK(contains(file.format, ", gzip"));
    }
  }
  // Where the content does not tell, the name within does.
  CHECK(contains(complaint(gzipped("hello"), "a.ply.gz"), "expected the magic word"));
  CHECK(contains(complaint(gzipped("hello"), "a.gz"), "not recognised"));
  CHECK(contains(complaint("hello", "a.off.gz"), "expected the keyword OFF"));
}

TEST_CASE(
    "gzip: of a long file the beginning, of a short one all, of a damaged one what comes out") {
  const std::string text(100000, 'x'), packed = gzipped("head" + text);
  CHECK(beginning_of_gzip(packed, 6) == "headxx");
  CHECK(beginning_of_gzip(gzipped("head"), 6) == "head");
  CHECK(beginning_of_gzip(packed.substr(0, 5), 6).empty());
}

TEST_CASE("gzip: members follow one another, zeros may end it, what else follows is noted") {
  const std::string first = tetrahedron_obj.substr(0, 20), second = tetrahedron_obj.substr(20);
  const MeshFile file = read(gzipped(first) + gzipped(second), "a.obj.gz");
  CHECK(file.mesh.triangles == read(tetrahedron_obj).mesh.triangles);
  CHECK(read(gzipped(tetrahedron_obj) + std::string(100, '\0')).notes.empty());
  CHECK(read(gzipped(tetrahedron_obj) + "more").notes ==
        std::vector<std::string>{"data after the end of the gzip data ignored"});
}

TEST_CASE("gzip: what is cut short or changed is refused, wherever") {
  const std::string packed = gzipped(tetrahedron_ply);
  for (std::size_t size = 2; size < packed.size(); ++size)
    CHECK(contains(complaint(packed.substr(0, size), "a.ply.gz"), "gzip data is cut short"));
  for (std::size_t at = 10; at < packed.size(); ++at) {
    std::string changed = packed;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    const std::string said = complaint(changed, "a.ply.gz");
    const bool is_padding = said.empty();  // bits that end the last byte of the data say nothing
    CHECK((is_padding ? at == packed.size() - 9 : contains(said, "gzip data is ")));
  }
  CHECK(contains(complaint(packed + packed.substr(0, 20), "a.ply.gz"), "cut short"));
  CHECK(contains(complaint(gzipped(packed), "a.ply.gz"), "gzip-compressed data within gzip"));
  CHECK(contains(complaint(gzipped(""), "a.ply.gz"), "the file is empty"));
}

TEST_CASE("gzip: the limit on bytes holds for what comes out") {
  const std::string packed = gzipped(tetrahedron_ply);
  const std::string bomb = gzipped(std::string(10 << 20, ' '));
  REQUIRE(bomb.size() < 20000);
  ReadOptions options;
  options.max_file_bytes = tetrahedron_ply.size();
  CHECK(complaint(packed, "a.ply.gz", options).empty());
  options.max_file_bytes -= 1;
  CHECK(contains(complaint(packed, "a.ply.gz", options), "unpacks to more than the limit of"));
  options.max_file_bytes = 1 << 20;
  CHECK(contains(complaint(bomb, "a.ply.gz", options),
                 "more than the limit of 1048576 bytes; `--limit file=N`"));
}
