#include <catch2/catch.hpp>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "program.h"
#include "support/test_meshes.h"

// glibc chooses its elementary functions by what the processor can do; a variable of the
// environment makes it believe that the processor can do less. Elsewhere this compares runs that
// are alike.

namespace sphparam::tests {

namespace {

using Names = std::vector<std::string>;

/// For the programs that are started while it lives.
class PlainProcessor {
 public:
  PlainProcessor() {
    setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX,-AVX2,-AVX512F,-AVX512VL,-FMA,-FMA4", 1);
  }
  ~PlainProcessor() { unsetenv("GLIBC_TUNABLES"); }
};

void run(const Names& arguments) {
  const Ended ended = sphparam_program(arguments);
  INFO(arguments[0] << ": " << ended.err);
  REQUIRE((ended.code == 0 || ended.code == 5));  // 5: methods of others fold
}

/// Everything that makes numbers, on one small shape: names and bytes of all files.
std::map<std::string, std::string> made_files() {
  const Folder folder;
  const std::string shape = folder / "shape.obj", map = folder / "shape.sph.ply";
  write_bytes(shape, obj_text(random_sphere_mesh(300, 8)));
  run({"map", shape, "-o", map, "--plots", folder / "charts"});
  for (const char* method : {"curvilinear", "paper", "tangential", "hemispheres", "brechbuehler",
                             "stereographic", "conformal", "flow"}) {
    run({"map", shape, "--method", method, "--keep-folded", "-o",
         folder / (std::string(method) + ".sph.ply")});
  }
  run({"map", shape, "--balance", "equal-area", "--quality", "best", "-o",
       folder / "equal.sph.ply"});
  for (const char* grid : {"ico:3", "cube:8", "uv:24x12", "healpix:4"}) {
    run({"remesh", map, "--grid", grid, "-o", folder / (std::string(grid, 4) + ".ply")});
  }
  run({"remesh", map, "--grid", "cube:8", "--adaptive", "--subdiv-fit", "catmark", "--displace",
       folder / "detail.exr", "--displace-size", "64x32", "-o", folder / "fitted.obj"});
  run({"bake", map, "--map", "area,angle,stretch,position,normal-tangent,height,curvature,checker",
       "--size", "64", "-o", folder / "baked_{map}.exr"});
  run({"export", map, "--variants", "axes,area", "-o", folder / "shape.glb"});
  run({"spharm", map, "--degree", "6", "--json", folder / "shape.json", "--reconstruct",
       folder / "smooth.ply"});
  run({"render", map, "--size", "96", "-o", folder / "shape.png"});
  std::map<std::string, std::string> files;
  for (const std::string& name : folder.names()) {
    if (name == "charts") continue;
    std::string& bytes = files[name] = bytes_of(folder / name);
    const std::string here = folder / "";  // told in reports; every folder has a name of its own
    for (size_t at; (at = bytes.find(here)) != std::string::npos;) bytes.erase(at, here.size());
  }
  return files;
}

}  // namespace

TEST_CASE("processors: the same bytes in every file, whatever instructions the C library uses") {
  const auto here = made_files();
  CHECK(here.size() > 25);
  const PlainProcessor plain;
  const auto there = made_files();
  REQUIRE(there.size() == here.size());
  for (const auto& [name, bytes] : here) {
    INFO(name);
    CHECK(there.at(name) == bytes);
  }
}

}  // namespace sphparam::tests
