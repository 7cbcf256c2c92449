#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "program.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

using Catch::Contains;
namespace fs = std::filesystem;

TEST_CASE("asset: `sphparam FILE` fills a folder beside, all files together") {
  const Folder folder;
  const std::string mesh = folder / "ball.obj", out = folder / "made", json = folder / "r.json";
  write_bytes(mesh, obj_text(icosphere(3)));
  const Ended ended = sphparam_program({mesh, "-o", out, "--size", "64", "--json", json});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("One closed surface as it is, certified one-to-one"));
  for (const char* name : {"ball.glb", "ball.sph.ply", "ball_ao.png", "ball.html"})
    CHECK(fs::exists(fs::path(out) / name));
  CHECK(nlohmann::json::parse(bytes_of(json))["surface"] == "itself");
  CHECK(sphparam_program({"verify", out + "/ball.sph.ply"}).code == 0);
  CHECK(sphparam_program({mesh, "-o", out, "--size", "64", "--no-page"}).code == 0);  // once more
}

TEST_CASE("asset: a stream, a folder with a slash at its end, a report in it") {
  const Folder folder;
  const std::string out = folder / "made";
  const Ended ended = sphparam_program(
      {"-", "-o", out + "/", "--size", "64", "--no-page", "--json", out + "/r.json"},
      obj_text(icosphere(2)));
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK(fs::exists(out + "/mesh.glb"));
  CHECK(fs::exists(out + "/r.json"));
  CHECK_THAT(ended.err, Contains("--up y where it lies on its side"));
}

TEST_CASE("asset: what cannot be done is said, and leaves no folder") {
  const Folder folder;
  const std::string mesh = folder / "a.obj", out = folder / "made";
  write_bytes(mesh, "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  const auto asset = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"asset", mesh, "-o", out};
    words.insert(words.end(), more.begin(), more.end());
    return sphparam_program(words);
  };
  const Ended empty = asset({});
  INFO(empty.err);
  CHECK(empty.code == 3);
  CHECK_FALSE(fs::exists(out));
  CHECK(asset({"--resolution", "2"}).code == 2);
  CHECK(sphparam_program({folder / "missing.glb"}).code == 3);
  write_bytes(out, "a file");
  write_bytes(mesh, obj_text(icosphere(1)));
  fs::remove(out);
  CHECK(asset({"--size", "63"}).code == 2);
  CHECK_FALSE(fs::exists(out));
  write_bytes(out, "a file");
  const Ended file = asset({});
  CHECK(file.code == 3);
  CHECK(bytes_of(out) == "a file");
  CHECK(sphparam_program({"nonsense"}).code == 2);
  CHECK(sphparam_program({"asset", mesh, "-o", folder / "x.glb"}).code == 2);
}

}  // namespace sphparam::tests
