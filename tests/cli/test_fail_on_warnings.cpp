#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "image/image_codec.h"
#include "program.h"
#include "support/test_meshes.h"

/// `--fail-on-warnings`, which all subcommands have.
namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;

struct Ball {
  Folder folder;
  std::string mesh = folder / "ball.obj", square = folder / "square.png", out = folder / "x.glb";

  Ball() {
    write_bytes(mesh, obj_text(icosphere(2)));
    write_image(square, Image(16, 16, 3));  // which is warned of
  }
};

}  // namespace

TEST_CASE("fail on warnings: what is warned of ends with 6, outputs and the report are there") {
  const Ball ball;
  const std::string report = ball.folder / "r.json";
  const Ended ended = sphparam_program({"export", ball.mesh, "--image", ball.square, "-o", ball.out,
                                        "--json", report, "--fail-on-warnings", "-q"});
  CHECK(ended.code == 6);
  CHECK(ended.err ==
        "sphparam: error: --fail-on-warnings: 1 warning of what is odd or lost; all outputs are "
        "written\n");
  CHECK(std::filesystem::exists(ball.out));
  CHECK(Json::parse(bytes_of(report))["warnings"].size() == 1);
  CHECK(sphparam_program({"export", ball.mesh, "--image", ball.square, "-o", ball.out}).code == 0);
}

TEST_CASE("fail on warnings: what is lost is told likewise, and the option may stand first") {
  const Ball ball;
  const Ended ended = sphparam_program(
      {"--fail-on-warnings", "export", ball.mesh, "--variants", "axes", "-o", ball.out, "--unlit"});
  CHECK(ended.code == 0);
  const std::string ply = ball.folder / "numbers.ply";
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
      "property double z\nproperty double depth\nelement face 4\n"
      "property list uchar int vertex_indices\nend_header\n"
      "1 1 1 5\n-1 -1 1 6\n-1 1 -1 7\n1 -1 -1 8\n"
      "3 0 1 3\n3 0 2 1\n3 0 3 2\n3 1 2 3\n";
  write_bytes(ply, text);
  const Ended lost =
      sphparam_program({"--fail-on-warnings", "repair", ply, "-o", ball.folder / "lost.off"});
  INFO(lost.err);
  CHECK(lost.code == 6);
  CHECK(sphparam_program({"repair", ply, "-o", ball.folder / "kept.ply", "--fail-on-warnings"})
            .code == 0);
}

TEST_CASE("fail on warnings: other codes stay what they are") {
  const Ball ball;
  CHECK(sphparam_program({"info", ball.folder / "none.obj", "--fail-on-warnings"}).code == 3);
  CHECK(sphparam_program({"export", ball.mesh, "-o", ball.folder / "x.fbx", "--fail-on-warnings"})
            .code == 2);
  CHECK(sphparam_program({"info", ball.mesh, "--fail-on-warnings"}).code == 0);
  CHECK(sphparam_program({"verify", ball.mesh, "--fail-on-warnings"}).code == 0);
}

}  // namespace sphparam::tests
