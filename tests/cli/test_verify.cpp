#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "program.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;

TriangleMesh scaled(TriangleMesh mesh, double factor, const Vector3& shift) {
  mesh.positions *= factor;
  mesh.positions.rowwise() += shift.transpose();
  return mesh;
}

}  // namespace

TEST_CASE("verify: a sphere of any radius is certified, and its radius reported") {
  const Ended ended = sphparam_program({"verify", "-", "--json", "-"},
                                       obj_text(scaled(icosphere(2), 100, Vector3::Zero())));
  REQUIRE(ended.code == 0);
  const Json report = Json::parse(ended.out);
  CHECK(report["certificate"]["one_to_one"] == true);
  CHECK(report["mean_length"].get<double>() == Approx(100));
}

TEST_CASE("verify: a sphere beside the origin is certified as rays, with a warning") {
  const Ended ended =
      sphparam_program({"verify", "-"}, obj_text(scaled(icosphere(2), 1, Vector3(0.3, 0, 0))));
  CHECK(ended.code == 0);
  CHECK_THAT(ended.err, Contains("radius"));
}

TEST_CASE("verify: one vertex pulled across the sphere is found by its faces") {
  TriangleMesh folded = icosphere(2);
  folded.positions.row(7) *= -1;
  const Ended ended = sphparam_program({"verify", "-", "--json", "-"}, obj_text(folded));
  REQUIRE(ended.code == 5);
  const Json certificate = Json::parse(ended.out)["certificate"];
  CHECK(certificate["one_to_one"] == false);
  for (const Json& face : certificate["folded_faces"]) {
    CHECK((folded.triangles.row(face.get<int>()).array() == 7).any());
  }
  CHECK(certificate["folded_faces"].size() > 0);
}

TEST_CASE("verify: a sphere covered twice has no fold and is refused") {
  TriangleMesh wound = uv_sphere(12, 5);
  wound.positions = wound_rays(12, 5, 2);
  const Ended ended = sphparam_program({"verify", "-", "--json", "-"}, obj_text(wound));
  REQUIRE(ended.code == 5);
  const Json certificate = Json::parse(ended.out)["certificate"];
  CHECK(certificate["folds"] == 0);
  CHECK(certificate["degree"] == 2);
}

TEST_CASE("verify: a sphere seen from inside is one-to-one and said to be reversed") {
  TriangleMesh mirrored = icosphere(2);
  mirrored.positions.col(0) *= -1;
  const Ended ended = sphparam_program({"verify", "-", "--json", "-"}, obj_text(mirrored));
  REQUIRE(ended.code == 0);
  CHECK(Json::parse(ended.out)["certificate"]["reversed"] == true);
}

TEST_CASE("verify: --chart proves the chart of a map, from outside and from inside") {
  TriangleMesh sphere = icosphere(3);
  const Ended outside =
      sphparam_program({"verify", "-", "--chart", "--json", "-"}, obj_text(sphere));
  REQUIRE(outside.code == 0);
  const Json chart = Json::parse(outside.out)["chart"];
  CHECK(chart["certified"] == true);
  CHECK(chart["splits"]["total"].get<long>() >= chart["splits"]["folds"].get<long>());
  CHECK(chart["wedges"].get<long>() > chart["vertices"].get<long>());
  const Ended words = sphparam_program({"verify", "-", "--chart"}, obj_text(sphere));
  CHECK_THAT(words.out, Contains("chart: certified") && Contains("along the meridian"));
  CHECK_THAT(sphparam_program({"verify", "-"}, obj_text(sphere)).out, !Contains("chart"));

  sphere.positions.col(0) *= -1;
  CHECK(sphparam_program({"verify", "-", "--chart"}, obj_text(sphere)).code == 0);
}

TEST_CASE("verify: two files of one connectivity are compared and the distortion measured") {
  const Folder folder;
  const TriangleMesh ball = icosphere(2);
  write_bytes(folder / "source.obj", obj_text(scaled(ball, 3, Vector3(1, 2, 3))));
  write_bytes(folder / "sphere.obj", obj_text(ball));
  const Ended ended =
      sphparam_program({"verify", folder / "source.obj", folder / "sphere.obj", "--json", "-"});
  REQUIRE(ended.code == 0);
  CHECK(Json::parse(ended.out)["distortion"]["mean_abs_ln_angle"].get<double>() ==
        Approx(0).margin(1e-9));

  // The radius of the sphere is not distortion.
  write_bytes(folder / "large.obj", obj_text(scaled(ball, 8, Vector3::Zero())));
  const Ended large =
      sphparam_program({"verify", folder / "source.obj", folder / "large.obj", "--json", "-"});
  REQUIRE(large.code == 0);
  CHECK(Json::parse(large.out)["distortion"]["symmetric_dirichlet"].get<double>() ==
        Approx(Json::parse(ended.out)["distortion"]["symmetric_dirichlet"].get<double>()));
}

TEST_CASE("verify: a mesh of quads and its sphere are one, however each would be cut alone") {
  // A cube with its top twisted against its bottom, and one twisted the other way.
  const std::string quads = "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  const auto corners = [](double bend) {
    std::string text;
    for (int i = 0; i < 8; ++i) {
      const double turn = (i % 4 + 0.5) * 1.5707963267948966 + (i < 4 ? bend : -bend);
      Vector3 x(std::cos(turn), std::sin(turn), i < 4 ? -0.7 : 0.7);
      x.normalize();
      text += "v " + std::to_string(x[0]) + " " + std::to_string(x[1]) + " " +
              std::to_string(x[2]) + "\n";
    }
    return text;
  };
  const Folder folder;
  write_bytes(folder / "shape.obj", corners(0.2) + quads);
  write_bytes(folder / "sphere.obj", corners(-0.2) + quads);
  const Ended ended = sphparam_program({"verify", folder / "shape.obj", folder / "sphere.obj"});
  INFO(ended.err);
  CHECK(ended.code == 0);
  CHECK_THAT(ended.out, Contains("of its polygons cut as in the mesh"));
  const Ended baked =
      sphparam_program({"bake", folder / "shape.obj", "--sphere", folder / "sphere.obj", "--map",
                        "area", "--size", "64", "-o", folder / "a.exr"});
  INFO(baked.err);
  CHECK(baked.code == 0);
}

TEST_CASE("verify: what --theta-phi wrote into glTF is the map that is judged") {
  const Folder folder;
  const std::string mesh = folder / "mesh.obj", with = folder / "with.glb",
                    without = folder / "without.glb";
  TriangleMesh egg = icosphere(3);
  egg.positions.col(0) *= 2;
  write_bytes(mesh, obj_text(egg));
  REQUIRE(sphparam_program({"export", mesh, "-o", with, "--theta-phi"}).code == 0);
  REQUIRE(sphparam_program({"export", mesh, "-o", without}).code == 0);
  const Ended ended = sphparam_program({"verify", with, "--json", "-"});
  INFO(ended.out << ended.err);
  CHECK(ended.code == 0);
  const Json report = Json::parse(ended.out);
  CHECK(report["rays"] == "attribute _THETA_PHI");
  CHECK(report["mean_length"].get<double>() == Approx(1));
  CHECK(report["distortion"].is_object());
  CHECK_THAT(sphparam_program({"verify", without}).err, Contains("--theta-phi"));
}

TEST_CASE("verify: a sphere is judged by its positions, whatever angles are noted beside them") {
  const TriangleMesh sphere = icosphere(1);
  std::string text = "ply\nformat ascii 1.0\nelement vertex " +
                     std::to_string(sphere.vertex_count()) +
                     "\nproperty double x\nproperty double y\nproperty double z\n"
                     "property double theta\nproperty double phi\nelement face " +
                     std::to_string(sphere.face_count()) +
                     "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& p : sphere.positions.rowwise()) {
    for (int k = 0; k < 3; ++k) text += std::to_string(7 * p[k]) + " ";
    text += "0 0\n";
  }
  for (const auto& corners : sphere.triangles.rowwise()) {
    text += "3";
    for (int k = 0; k < 3; ++k) text += " " + std::to_string(corners[k]);
    text += "\n";
  }
  const Ended ended = sphparam_program({"verify", "-", "--json", "-"}, text);
  INFO(ended.err);
  CHECK(ended.code == 0);
  CHECK(Json::parse(ended.out)["rays"] == "vertex positions");
}

TEST_CASE(
    "verify: theta and phi that are not those of sx sy sz end with 5, a header is warned of") {
  const Folder folder;
  const std::string map = folder / "ball.sph.ply", hurt = folder / "hurt.sph.ply";
  REQUIRE(sphparam_program({"map", "-", "-o", map}, obj_text(icosphere(2))).code == 0);
  const std::string bytes = bytes_of(map);
  const Ended sound = sphparam_program({"verify", map, "--json", "-"});
  CHECK(sound.code == 0);
  CHECK(Json::parse(sound.out)["angles"]["off"] == 0);
  CHECK(Json::parse(sound.out)["warnings"].empty());

  // The first vertex: x, y, z, theta, phi are eight bytes each.
  const std::size_t body = bytes.find("end_header\n") + 11;
  std::string wrong = bytes;
  const double theta = 1.25, phi = 0.75;
  std::memcpy(&wrong[body + 24], &theta, 8);
  std::memcpy(&wrong[body + 32], &phi, 8);
  write_bytes(hurt, wrong);
  for (const bool quiet : {false, true}) {
    std::vector<std::string> arguments = {"verify", hurt, "--json", "-"};
    if (quiet) arguments.push_back("-q");
    const Ended ended = sphparam_program(arguments);
    CHECK(ended.code == 5);
    CHECK_THAT(ended.err, Contains("theta and phi of 1 vertex is not that of sx sy sz"));
    CHECK(Json::parse(ended.out)["angles"]["off"] == 1);
    CHECK(Json::parse(ended.out)["certificate"]["one_to_one"] == true);
  }

  std::string claims = bytes;
  claims.replace(claims.find("verdict one-to-one"), 18, "verdict folded 999");
  write_bytes(hurt, claims + "more");
  const Ended ended = sphparam_program({"verify", hurt});
  CHECK(ended.code == 0);
  CHECK_THAT(ended.err, Contains("the header says: folded 999; it is one-to-one") &&
                            Contains("data after the last element ignored"));
}

TEST_CASE("verify: the report names both files") {
  const Folder folder;
  write_bytes(folder / "a.obj", obj_text(icosphere(1)));
  write_bytes(folder / "s.obj", obj_text(icosphere(1)));
  const Ended ended =
      sphparam_program({"verify", folder / "a.obj", folder / "s.obj", "--json", "-"});
  const Json report = Json::parse(ended.out);
  CHECK(report["input"]["file"] == folder / "a.obj");
  CHECK(report["sphere"] == folder / "s.obj");
}

TEST_CASE("verify: files of different connectivity end with 3 and the place is named") {
  const Folder folder;
  TriangleMesh other = icosphere(2);
  std::swap(other.triangles(9, 0), other.triangles(9, 1));
  write_bytes(folder / "source.obj", obj_text(other));
  write_bytes(folder / "sphere.obj", obj_text(icosphere(2)));
  write_bytes(folder / "small.obj", obj_text(icosphere(1)));
  const Ended face = sphparam_program({"verify", folder / "source.obj", folder / "sphere.obj"});
  CHECK(face.code == 3);
  CHECK_THAT(face.err, Contains("triangle 9"));
  const Ended count = sphparam_program({"verify", folder / "small.obj", folder / "sphere.obj"});
  CHECK(count.code == 3);
  CHECK_THAT(count.err, Contains("sphere.obj: not a sphere of small.obj") && Contains("42") &&
                            Contains("162"));
}

TEST_CASE("verify: a file without faces is refused, not proved") {
  const Ended ended = sphparam_program({"verify", "-"}, "v 0 0 1\nv 1 0 0\n");
  CHECK(ended.code == 4);
  CHECK(sphparam_program({"verify", "-", "--json", "-", "--chart"}, "v 0 0 1\n").code == 4);
}

}  // namespace sphparam::tests
