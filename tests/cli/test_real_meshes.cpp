#include <catch2/catch.hpp>

#include "program.h"
#include "support/real_meshes.h"

namespace sphparam::tests {

namespace {

void check_mapped(const fs::path& mesh, const std::string& method = "progressive") {
  const Folder folder;
  const std::string map = folder / "map.sph.ply";
  INFO(mesh << " by the method " << method);
  const Ended mapped = sphparam_program({"map", mesh, "-o", map, "--method", method});
  INFO(mapped.err);
  CHECK(mapped.code == 0);
  CHECK(sphparam_program({"verify", map, "-q"}).code == 0);
}

}  // namespace

TEST_CASE("real meshes: every closed genus-0 mesh is certified") {
  for (const fs::path& file : real_meshes()) check_mapped(file);
}

TEST_CASE("real meshes: the paper's method made sound certifies every one too") {
  for (const fs::path& file : real_meshes()) check_mapped(file, "curvilinear");
}

}  // namespace sphparam::tests
