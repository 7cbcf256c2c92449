#include <catch2/catch.hpp>

#include "io/uri.h"
#include "sphparam/io/paths.h"

using namespace sphparam;

TEST_CASE("paths: the finest level has the name as it is, coarser ones their number in it") {
  CHECK(level_path("folder/a.ply", 0) == "folder/a.ply");
  CHECK(level_path("folder/a.ply", 2) == "folder/a_lod2.ply");
  CHECK(level_path("a.sph.ply", 1) == "a_lod1.sph.ply");
  CHECK(level_path("b.c.ply", 1) == "b.c_lod1.ply");
  CHECK(level_path("a{n}.glb", 0) == "a0.glb");
  CHECK(level_path("a{n}.glb", 3) == "a3.glb");
}

TEST_CASE("paths: a stem is without what says that there is a map, or that it is packed") {
  CHECK(stem_of("folder/statue.ply") == "statue");
  CHECK(stem_of("statue.sph.ply") == "statue");
  CHECK(stem_of("statue.v2.obj.gz") == "statue.v2");
}

TEST_CASE("uri: of a name letters, digits and four marks stay, all else is told byte by byte") {
  CHECK(uri_of_file("aZ09-._~") == "aZ09-._~");
  CHECK(uri_of_file("ä b/c%d") == "%C3%A4%20b%2Fc%25d");
}
