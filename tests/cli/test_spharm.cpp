#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>

#include "number_text.h"
#include "program.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/mesh/triangle_mesh.h"
#include "support/test_meshes.h"

/// `sphparam spharm`.
namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;

TriangleMesh ellipsoid(const TriangleMesh& sphere) {
  TriangleMesh mesh = sphere;
  mesh.positions *= Eigen::Vector3d(2, 1, 0.5).asDiagonal();
  return mesh;
}

}  // namespace

TEST_CASE("spharm: an ellipsoid on its affine sphere has its semi-axes and nothing else") {
  const Folder folder;
  write_bytes(folder / "ball.obj", obj_text(icosphere(3)));
  write_bytes(folder / "body.obj", obj_text(ellipsoid(icosphere(3))));
  const Ended ended = sphparam_program({"spharm", folder / "body.obj", "--sphere",
                                        folder / "ball.obj", "--degree", "8", "--json", "-"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  const Json report = Json::parse(ended.out);
  CHECK(report["degree"] == 8);
  const double axes[] = {2, 1, 0.5};
  for (size_t i = 0; i < 3; ++i) {
    CHECK(std::abs(report["first_order_ellipsoid"][i].get<double>() - axes[i]) < 1e-6);
  }
  CHECK(report["position_rms"] < 1e-9);
  REQUIRE(report["functions"].size() == 3);
  REQUIRE(report["functions"][0]["coefficients"].size() == 81);
  for (const Json& function : report["functions"]) {
    for (size_t l = 0; l <= 8; ++l) {
      if (l != 1) CHECK(function["power_per_degree"][l] < 1e-12);
    }
  }
  // The default fit finds it at the vertices; the integral sees the flat triangles too.
  const Ended integral =
      sphparam_program({"spharm", folder / "body.obj", "--sphere", folder / "ball.obj", "--degree",
                        "8", "--fit", "quadrature", "--json", "-"});
  const Json by_integral = Json::parse(integral.out);
  CHECK(by_integral["position_rms"] > 1e-6);
  CHECK(by_integral["quadrature"]["change"] <= 1e-4);
  CHECK(by_integral["quadrature"]["rows"].get<int>() * 2 == by_integral["quadrature"]["columns"]);
  CHECK_FALSE(report.contains("quadrature"));
  const Ended told =
      sphparam_program({"spharm", folder / "body.obj", "--sphere", folder / "ball.obj", "--degree",
                        "1", "--fit", "quadrature"});
  CHECK_THAT(told.err, Contains("integral by ") && Contains("the last doubling changed"));
}

TEST_CASE("spharm: what a turned reconstruction has as it was, or not at all, is told") {
  const Folder folder;
  std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 42\nproperty double x\nproperty double y\nproperty "
      "double z\n";
  for (const char* name : {"nx", "ny", "nz", "U_X", "U_Y", "U_Z", "pair_0", "pair_1"})
    ply += "property float " + std::string(name) + "\n";
  ply +=
      "element face 80\nproperty list uchar int vertex_indices\nproperty uchar part\nend_header\n";
  const TriangleMesh mesh = ellipsoid(icosphere(1));
  REQUIRE(mesh.vertex_count() == 42);
  for (Vertex v = 0; v < 42; ++v) {
    for (const double x : mesh.positions.row(v)) ply += std::to_string(x) + " ";
    ply += "1 0 0 0 1 0 5 6\n";
  }
  for (Face f = 0; f < 80; ++f)
    ply += "3 " + std::to_string(mesh.triangles(f, 0)) + " " +
           std::to_string(mesh.triangles(f, 1)) + " " + std::to_string(mesh.triangles(f, 2)) +
           " 7\n";
  write_bytes(folder / "egg.ply", ply);
  const auto told = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"spharm", folder / "egg.ply", "--degree",
                                   "2",      "--reconstruct",    folder / "out.ply"};
    words.insert(words.end(), more.begin(), more.end());
    return sphparam_program(words).err;
  };
  const std::string turned =
      "out.ply: the surface is turned, not what its vertices have: components of U are along the "
      "axes of before\n";
  CHECK_THAT(told({}), Contains("out.ply: not carried: normals, which are those of the surface "
                                "before\n") &&
                           !Contains("is turned, not"));
  CHECK_THAT(told({"--align"}), Contains(turned));
  CHECK_THAT(told({"--align=sphere"}), !Contains("is turned, not"));
  CHECK_THAT(told({"--scalar", "part"}),
             Contains("--scalar: part is a property of faces; harmonics are of what vertices have: "
                      "ParaView's Cell Data to Point Data averages it onto them"));
  CHECK_THAT(told({"--scalar", "U_X,U_Y"}),
             Contains("the vertices have no property U_X,U_Y") &&
                 Contains("; the option is given once for each: --scalar A --scalar B"));
}

TEST_CASE("spharm, bake: whose directions numbers of a sphere get is told, where they are others") {
  const Folder folder;
  const TriangleMesh ball = icosphere(3);
  std::string ply = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(ball.vertex_count()) +
                    "\nproperty double x\nproperty double y\nproperty double z\nproperty double p\n"
                    "element face " +
                    std::to_string(ball.face_count()) +
                    "\nproperty list uchar int vertex_indices\nend_header\n";
  for (Vertex v = 0; v < ball.vertex_count(); ++v) {
    const Vector3 x = ball.position(v);
    ply += shortest(x.x()) + " " + shortest(x.y()) + " " + shortest(x.z()) + " " + shortest(x.z()) +
           "\n";
  }
  for (Face f = 0; f < ball.face_count(); ++f)
    ply += "3 " + std::to_string(ball.triangles(f, 0)) + " " +
           std::to_string(ball.triangles(f, 1)) + " " + std::to_string(ball.triangles(f, 2)) + "\n";
  const std::string mesh = folder / "ball.ply", turned = folder / "turned.sph.ply",
                    radial = folder / "radial.sph.ply";
  write_bytes(mesh, ply);
  REQUIRE(sphparam_program({"map", mesh, "-o", radial, "--method", "radial"}).code == 0);
  REQUIRE(sphparam_program({"map", mesh, "-o", turned, "--poles", "0,3"}).code == 0);
  const auto expanded = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"spharm", "--degree", "2", "--scalar", "p"};
    words.insert(words.end(), more.begin(), more.end());
    const Ended ended = sphparam_program(words);
    CHECK(ended.code == 0);
    return ended.err;
  };
  const std::string warning =
      "the directions of these harmonics are the map's, not the body's: the map's longitudes and ";
  CHECK_THAT(expanded({turned}), Contains(warning));
  CHECK_THAT(expanded({turned, "--align"}), !Contains(warning));
  CHECK_THAT(expanded({radial}), !Contains(warning));
  CHECK_THAT(expanded({mesh, "--sphere", mesh}), !Contains(warning));
  const auto baked = [&](const std::string& of, const std::string& field) {
    return sphparam_program({"bake", of, "--map", field, "-o", folder / "p.png", "--size", "32"})
        .err;
  };
  const std::string image = "the directions of these images are the map's, not the body's: ";
  const bool is_turned = expanded({mesh}).find(warning) != std::string::npos;
  CHECK((baked(mesh, "scalar:p").find(image) != std::string::npos) == is_turned);
  CHECK_THAT(baked(mesh, "ao"), !Contains(image));
  CHECK_THAT(baked(turned, "scalar:p"), !Contains(image));  // the map is there to show it
}

TEST_CASE("spharm: a vertex that stands for a gap without vertices is told") {
  const Folder folder;
  TriangleMesh ball = icosphere(3);
  const auto told = [&] {
    write_bytes(folder / "ball.obj", obj_text(ball));
    const Ended ended = sphparam_program(
        {"spharm", folder / "ball.obj", "--sphere", folder / "ball.obj", "--degree", "2"});
    CHECK(ended.code == 0);
    return ended.err;
  };
  CHECK_THAT(told(), !Contains("warning"));
  const Vector3 middle = ball.position(0);
  for (Vertex v = 1; v < ball.vertex_count(); ++v) {  // all others away from it
    const Vector3 x = ball.position(v), side = x - x.dot(middle) * middle;
    if (side.norm() < 1e-9) continue;
    const double angle = std::numbers::pi - 0.75 * (std::numbers::pi - std::acos(x.dot(middle)));
    ball.positions.row(v) = std::cos(angle) * middle + std::sin(angle) * side.normalized();
  }
  CHECK_THAT(told(),
             Contains("warning: 6 vertices stand for 18.7 % of the sphere, as on the rim of a gap "
                      "without vertices: what these carry decides the coefficients, and so does "
                      "its noise; vertex 0 for 5.28 %, 47.1 times the median\n"));
}

TEST_CASE("spharm: a name in Latin-1 does not spoil the report") {
  const Folder folder;
  const std::string mesh = folder / "caf\xE9.obj";
  write_bytes(mesh, obj_text(icosphere(2)));
  const Ended ended = sphparam_program({"spharm", mesh, "--degree", "2", "--json", "-"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK(Json::parse(ended.out)["degree"] == 2);
}

TEST_CASE("spharm: the CSV has a line a coefficient, with the scalars that were asked for") {
  const Folder folder;
  REQUIRE(
      sphparam_program({"map", "-", "-o", folder / "ball.sph.ply"}, obj_text(icosphere(3))).code ==
      0);
  const Ended ended = sphparam_program(
      {"spharm", folder / "ball.sph.ply", "--degree", "3", "--scalar", "sz", "--csv", "-"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.out, Catch::StartsWith("l,m,x,y,z,sz\n0,0,"));
  CHECK(std::count(ended.out.begin(), ended.out.end(), '\n') == 17);
}

TEST_CASE("spharm: the reconstruction is a certified map nearer to the mesh with each degree") {
  const Folder folder;
  write_bytes(folder / "egg.obj", obj_text(ellipsoid(icosphere(3))));
  double last = 1e300;
  for (const char* degree : {"1", "4", "9"}) {
    const Ended ended = sphparam_program({"spharm", folder / "egg.obj", "--degree", degree,
                                          "--reconstruct", folder / "smooth.ply", "--json", "-"});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    const double rms = Json::parse(ended.out)["position_rms"];
    CHECK(rms < last);
    last = rms;
    CHECK(sphparam_program({"verify", folder / "smooth.ply"}).code == 0);
  }
}

TEST_CASE("spharm: a reconstruction without rays has no verdict on them") {
  const Folder folder;
  write_bytes(folder / "egg.obj", obj_text(ellipsoid(icosphere(2))));
  for (const auto& [file, rays] : {std::pair("s.ply", true), {"s.obj", false}, {"s.off", false}}) {
    INFO(file);
    REQUIRE(sphparam_program(
                {"spharm", folder / "egg.obj", "--degree", "2", "--reconstruct", folder / file})
                .code == 0);
    const std::string bytes = bytes_of(folder / file);
    CHECK_THAT(bytes, Contains("sphparam harmonics 2"));
    CHECK((bytes.find("sphparam verdict") != std::string::npos) == rays);
  }
}

TEST_CASE("spharm: residuals are told weighted by solid angle, and plain") {
  const Folder folder;
  TriangleMesh egg = icosphere(3);
  for (Eigen::Index v = 0; v < egg.vertex_count(); ++v) {
    if (egg.positions(v, 2) > 0) egg.positions(v, 2) *= 4;
  }
  write_bytes(folder / "egg.obj", obj_text(egg));
  const Ended ended =
      sphparam_program({"spharm", folder / "egg.obj", "--degree", "3", "--reconstruct",
                        folder / "smooth.ply", "--json", folder / "egg.json"});
  REQUIRE(ended.code == 0);
  const std::filesystem::path smooth = folder / "smooth.ply";
  const Points left = sphparam::read_mesh(smooth).mesh.positions - egg.positions;
  const Json report = Json::parse(bytes_of(folder / "egg.json"));
  const double plain = report["position_rms_unweighted"];
  CHECK(plain == Approx(std::sqrt(left.rowwise().squaredNorm().mean())));
  CHECK(std::abs(plain / report["position_rms"].get<double>() - 1) > 0.01);
  CHECK(report["functions"][2]["rms_residual_unweighted"].get<double>() ==
        Approx(std::sqrt(left.col(2).squaredNorm() / double(left.rows()))));
  CHECK_THAT(report["rms"].get<std::string>(), Contains("solid angle"));
  CHECK_THAT(ended.err, Contains("weighted by solid angle") && Contains(", unweighted "));
}

TEST_CASE("spharm: the same bytes for 1, 2 and 4 threads") {
  const std::string egg = obj_text(ellipsoid(icosphere(4)));
  const std::string one =
      sphparam_program({"spharm", "-", "--csv", "-", "--threads", "1"}, egg).out;
  CHECK_FALSE(one.empty());
  for (const char* threads : {"2", "4"}) {
    CHECK(sphparam_program({"spharm", "-", "--csv", "-", "--threads", threads}, egg).out == one);
  }
}

TEST_CASE("spharm: the radius of a radial map, in geodesy's normalisation, and as SHADR") {
  const Folder folder;
  const std::string map = folder / "egg.sph.ply", table = folder / "egg.sha";
  REQUIRE(sphparam_program({"map", "-", "-o", map, "--method", "radial"},
                           obj_text(ellipsoid(icosphere(4))))
              .code == 0);
  const Ended ended = sphparam_program({"spharm", map, "--degree", "6", "--radius",
                                        "--normalisation", "4pi", "--shadr", table, "--json", "-"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, !Contains("warning"));
  const Json report = Json::parse(ended.out);
  CHECK_THAT(report["basis"].get<std::string>(), Contains("4pi-normalised"));
  CHECK(report["functions"][3]["name"] == "radius");
  const std::string text = bytes_of(table);
  CHECK(std::count(text.begin(), text.end(), '\n') == 1 + 28);
  const double mean = report["functions"][3]["coefficients"][0];
  CHECK(std::stod(text.substr(0, text.find(','))) == Approx(mean).epsilon(1e-15));
  const Ended other =
      sphparam_program({"spharm", "-", "--degree", "4", "--radius", "--csv", folder / "x.csv"},
                       obj_text(ellipsoid(icosphere(3))));
  CHECK(other.code == 0);
  CHECK_THAT(other.err, Contains("are the map's, not the body's"));
  CHECK(sphparam_program({"spharm", map, "--centre", "0,0,0", "--json", "-"}).code == 2);
  const Ended far =
      sphparam_program({"spharm", map, "--radius", "--centre", "1e300,0,0", "--json", "-"});
  CHECK(far.code == 2);
  CHECK_THAT(far.err, Contains("--centre: it is so far from the mesh"));
}

TEST_CASE("spharm: a centre outside of the body is told, centroid is that of what it encloses") {
  const Folder folder;
  TriangleMesh ball = icosphere(3);
  ball.positions.rowwise() += Vector3(5, 6, 7).transpose();
  const std::string map = folder / "ball.sph.ply";
  REQUIRE(sphparam_program({"map", "-", "-o", map, "--method", "radial", "--centre", "centroid"},
                           obj_text(ball))
              .code == 0);
  const auto radius_about = [&](const char* centre, bool is_outside) {
    const Ended ended = sphparam_program(
        {"spharm", map, "--radius", "--centre", centre, "--degree", "2", "--json", "-"});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    CHECK((ended.err.find("the centre 0,0,0 lies outside of the surface: --centre centroid is "
                          "5,6,7") != std::string::npos) == is_outside);
    return Json::parse(ended.out);
  };
  const Json inside = radius_about("centroid", false);
  for (int k = 0; k < 3; ++k) CHECK(inside["centre"][k].get<double>() == Approx(5 + k));
  const auto& mean = inside["functions"][3]["coefficients"][0];
  CHECK(mean.get<double>() == Approx(std::sqrt(4 * std::numbers::pi)).epsilon(0.01));
  radius_about("0,0,0", true);
}

TEST_CASE("spharm: what the vertices leave open is told, with the degree that leaves it out") {
  const Folder folder;
  // Longitudes and latitudes 15° apart, in float32, and a body that is rough beyond all degrees.
  TriangleMesh body = uv_sphere(24, 11);
  for (Eigen::Index v = 0; v < body.vertex_count(); ++v)
    body.positions.row(v) *= 10 + 0.1 * std::sin(double(7 * v * v % 101));
  body.positions = body.positions.cast<float>().cast<double>();
  const std::string map = folder / "body.sph.ply";
  REQUIRE(sphparam_program({"map", "-", "-o", map, "--method", "radial"}, obj_text(body)).code ==
          0);
  const auto power = [&](const char* degree, bool is_told) {
    const Ended ended =
        sphparam_program({"spharm", map, "--radius", "--degree", degree, "--json", "-"});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    CHECK((ended.err.find("warning: the vertices decide harmonics up to degree 11, and what they "
                          "leave open beyond is near the integral's; --degree 11 leaves it out, "
                          "--fit quadrature is the integral\n") != std::string::npos) == is_told);
    const Json report = Json::parse(ended.out);
    CHECK(report["converged"] == !is_told);
    CHECK(report["decided_degree"] == 11);
    CHECK(report["centre"] == Json::array({0.0, 0.0, 0.0}));
    return report["functions"][3]["power_per_degree"].back().get<double>();
  };
  const double decided = power("11", false);
  CHECK(power("12", true) < 10 * decided);
  CHECK(power("13", true) < 10 * decided);
}

TEST_CASE("spharm: --align gives a turned mesh the same coefficients, and writes the turned map") {
  const Folder folder;
  TriangleMesh body = icosphere(3);
  for (Eigen::Index v = 0; v < body.vertex_count(); ++v) {
    Eigen::RowVector3d p = body.positions.row(v);
    const double bump = 0.3 * p.x() * p.x() + 0.2 * p.x() * p.y() * p.y();
    body.positions.row(v) << 3 * p.x() + bump, 2 * p.y() + 0.4 * p.y() * p.y(), p.z() + bump;
  }
  const TriangleMesh ball = icosphere(3);
  TriangleMesh turned = body;
  turned.positions.col(0) = -body.positions.col(1);
  turned.positions.col(1) = body.positions.col(0);
  turned.positions.array() += 5;
  write_bytes(folder / "body.obj", obj_text(body));
  write_bytes(folder / "turned.obj", obj_text(turned));
  write_bytes(folder / "ball.obj", obj_text(ball));
  const auto coefficients = [&](const std::string& mesh, std::vector<std::string> more) {
    more.insert(more.begin(),
                {"spharm", folder / mesh, "--sphere", folder / "ball.obj", "--degree", "4"});
    const Ended ended = sphparam_program(more);
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    return ended;
  };
  const Json one = Json::parse(coefficients("body.obj", {"--align", "--json", "-"}).out);
  const Json two =
      Json::parse(coefficients("turned.obj", {"--align", "--coef", folder / "t.coef",
                                              "--reconstruct", folder / "t.ply", "--json", "-"})
                      .out);
  CHECK(one["alignment"]["turned"] == "sphere and surface");
  for (size_t k = 0; k < 3; ++k)
    for (size_t i = 0; i < 25; ++i)
      CHECK(std::abs(one["functions"][k]["coefficients"][i].get<double>() -
                     two["functions"][k]["coefficients"][i].get<double>()) < 1e-9);
  CHECK(sphparam_program({"verify", folder / "t.ply"}).code == 0);
  const Json again = Json::parse(
      sphparam_program({"spharm", folder / "t.ply", "--degree", "4", "--json", "-"}).out);
  for (size_t i = 0; i < 25; ++i)
    CHECK(std::abs(one["functions"][0]["coefficients"][i].get<double>() -
                   again["functions"][0]["coefficients"][i].get<double>()) < 1e-9);
  CHECK_THAT(bytes_of(folder / "t.coef"), Catch::StartsWith("{ 25,{"));
  coefficients("body.obj", {"--align", "--flip-template", folder / "t.coef"});
  coefficients("body.obj", {"--align=sphere", "--coef", folder / "p.coef"});
  const std::string path = folder / "body.obj";
  coefficients("body.obj", {"--coef", folder / "raw.coef"});
  const Ended crooked =
      sphparam_program({"spharm", path, "--align", "--flip-template", folder / "ball.obj"});
  CHECK(crooked.code == 3);
  CHECK_THAT(crooked.err, Contains("ball.obj"));
  CHECK(sphparam_program({"spharm", path, "--align=surface"}).code == 2);
  CHECK(sphparam_program({"spharm", path, "--align", "--degree", "0"}).code == 2);
  CHECK(sphparam_program({"spharm", path, "--align", "--shadr", folder / "x.sha"}).code == 2);
  CHECK(sphparam_program({"spharm", path, "--flip-template", folder / "t.coef"}).code == 2);
}

TEST_CASE("spharm: a surface on a grid, of a mesh and of its coefficients in a file") {
  const Folder folder;
  MeshFile file;
  file.mesh = ellipsoid(icosphere(3));
  const auto count = size_t(file.mesh.vertex_count());
  file.set_vertex_property({"height", ScalarType::Float64, std::vector<double>(count, 5)});
  file.set_vertex_property({"label", ScalarType::Int32, std::vector<double>(count, 1)});
  const std::string mesh = folder / "egg.ply", ball = folder / "ball.obj";
  write_mesh(mesh, file);
  write_bytes(ball, obj_text(icosphere(3)));
  const auto run = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "spharm");
    return sphparam_program(words);
  };
  const Ended first = run({mesh, "--sphere", ball, "--degree", "4", "--scalar", "height", "--json",
                           folder / "egg.json", "--coef", folder / "egg.coef", "--grid", "cube:6",
                           "--reconstruct", folder / "one.sph.ply"});
  INFO(first.err);
  REQUIRE(first.code == 0);
  CHECK_THAT(first.err,
             Contains("one.sph.ply: not carried: label: on a grid is what was expanded"));
  const std::vector<std::string> onto{"--grid", "cube:6", "--reconstruct"};
  const auto made = [&](const std::string& from, std::vector<std::string> more,
                        const std::string& to) {
    more.insert(more.begin(), folder / from);
    more.insert(more.end(), onto.begin(), onto.end());
    more.push_back(folder / to);
    const Ended ended = run(more);
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    CHECK_THAT(ended.err, Contains(" on cube:6, certified one-to-one"));
    CHECK(sphparam_program({"verify", folder / to}).code == 0);
    return read_mesh(std::string(folder / to));
  };
  const MeshFile one = read_mesh(std::string(folder / "one.sph.ply")),
                 two = made("egg.json", {}, "two.sph.ply"),
                 three = made("egg.coef", {"--degree", "1"}, "three.sph.ply");
  CHECK(one.mesh.vertex_count() == 218);
  CHECK(bytes_of(folder / "one.sph.ply") == bytes_of(folder / "two.sph.ply"));
  CHECK(two.polygons == 216);
  CHECK((one.mesh.positions - three.mesh.positions).cwiseAbs().maxCoeff() < 1e-8);
  CHECK_FALSE(three.find_vertex_property("height"));
  for (Vertex v = 0; v < 218; ++v) {
    CHECK(std::abs(two.find_vertex_property("height")->values[size_t(v)] - 5) < 1e-9);
    for (int k = 0; k < 3; ++k) {
      const double ray = two.find_vertex_property(std::string("s") + "xyz"[k])->values[size_t(v)];
      CHECK(std::abs(three.mesh.positions(v, k) - Vector3(2, 1, 0.5)[k] * ray) < 1e-8);
    }
  }
  const Ended bare = run({folder / "two.sph.ply", "--degree", "1", "--scalar", "height", "--grid",
                          "ico:1", "--reconstruct", folder / "bare.ply"});
  CHECK(bare.code == 0);
  CHECK_THAT(bare.err, !Contains("not carried"));
  // Other vertices, without a mesh of ours.
  REQUIRE(run({folder / "egg.json", "--grid", "like:" + ball, "--reconstruct", folder / "l.ply"})
              .code == 0);
  CHECK((read_mesh(std::string(folder / "l.ply")).mesh.positions - file.mesh.positions)
            .cwiseAbs()
            .maxCoeff() < 1e-8);
  const auto refused = [&](std::vector<std::string> words, int code, const std::string& why) {
    const Ended ended = run(words);
    INFO(ended.err);
    CHECK(ended.code == code);
    CHECK_THAT(ended.err, Contains(why));
  };
  const std::string json = folder / "egg.json", out = folder / "out.ply";
  refused({json}, 2, "egg.json has coefficients: --grid GRID --reconstruct FILE makes a surface");
  refused({json, "--grid", "ico:2"}, 2, "--grid is of the surface that --reconstruct writes");
  refused({json, "--reconstruct", out, "--grid", "like:"}, 2, "--grid like: names no mesh");
  refused({json, "--reconstruct", out, "--grid", "ball:2"}, 2, "--grid ball:2: expected ico:L");
  refused({json, "--reconstruct", out, "--grid", "like:" + (folder / "nowhere.ply")}, 3, "nowhere");
  refused({json, "--reconstruct", out, "--grid", "ico:2", "--degree", "5"}, 2,
          "--degree: egg.json has coefficients up to degree 4");
  refused({json, "--reconstruct", out, "--grid", "ico:2", "--sphere", ball}, 2,
          "--sphere is of a mesh: egg.json has its coefficients");
  refused({json, "--reconstruct", out, "--grid", "ico:2", "--json", "-"}, 2, "--json is of a mesh");
  refused({json, "--reconstruct", out, "--grid", "ico:2", "--max-hole", "3"}, 2,
          "repairs are of a mesh");
  write_bytes(folder / "bad.json", "{}");
  refused({folder / "bad.json", "--reconstruct", out, "--grid", "ico:2"}, 3,
          "bad.json: these are no coefficients");
  CHECK_FALSE(std::filesystem::exists(out));
}

TEST_CASE("spharm: what makes no sense is refused, and nothing is written") {
  const Folder folder;
  write_bytes(folder / "ball.obj", obj_text(icosphere(2)));
  const std::string ball = folder / "ball.obj";
  const auto run = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"spharm", ball});
    return sphparam_program(arguments);
  };
  CHECK(run({"--degree", "-1"}).code == 2);
  CHECK(run({"--degree", "1001"}).code == 2);
  CHECK_THAT(run({"--degree", "20"}).err, Contains("441 coefficients for 162 vertices"));
  CHECK_FALSE(run({"--degree", "11"}).err.find("coefficients for") != std::string::npos);
  const Ended unknown = run({"--scalar", "gravty", "--csv", folder / "out.csv"});
  CHECK(unknown.code == 2);
  CHECK_THAT(unknown.err, Contains("no property gravty; they have none"));
  TriangleMesh mesh = icosphere(1);
  MeshFile file;
  file.mesh = mesh;
  for (const char* name : {"gravity", "flow_0", "flow_1", "flow_speed"})
    file.set_vertex_property(
        {name, ScalarType::Float64, std::vector<double>(size_t(mesh.vertex_count()), 1)});
  const Folder other;
  write_mesh(other / "ball.ply", file);
  const auto told = [&](const char* scalar) {
    return sphparam_program({"spharm", other / "ball.ply", "--scalar", scalar}).err;
  };
  CHECK_THAT(told("gravty"), Contains("no property gravty; they have gravity, flow_0, flow_1, "
                                      "flow_speed; did you mean gravity?"));
  CHECK_THAT(told("flow"),
             Contains("no property flow, but its columns, each a scalar: flow_0, flow_1\n"));
  const Ended twice = sphparam_program(
      {"spharm", other / "ball.ply", "--scalar", "gravity", "--scalar", "gravity"});
  CHECK(twice.code == 2);
  CHECK_THAT(twice.err, Contains("--scalar: gravity is named twice"));
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--radius"}, {"--shadr", folder / "out.sha"}}) {
    std::vector<std::string> both = words;
    both.insert(both.end(), {"--scalar", "radius"});
    CHECK(run(both).code == 2);
    CHECK_THAT(run(both).err,
               Contains("--scalar: radius is what --radius and --shadr expand under that name"));
  }
  CHECK(run({"--reconstruct", folder / "out.dae"}).code == 2);
  CHECK(run({"--json", ball}).code == 2);
  CHECK(run({"--json", folder / "out", "--csv", folder / "out"}).code == 2);
  write_bytes(folder / "other.obj", obj_text(icosphere(1)));
  CHECK(run({"--sphere", folder / "other.obj", "--csv", folder / "out.csv"}).code == 3);
  CHECK(folder.names() == std::vector<std::string>{"ball.obj", "other.obj"});
}

}  // namespace sphparam::tests
