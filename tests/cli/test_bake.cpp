#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "image/image_codec.h"
#include "mapped.h"
#include "program.h"
#include "support/image_headers.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

using Catch::Contains;
using Json = nlohmann::json;
using namespace sphparam;

/// A ball whose texture coordinates are x and y: a picture laid on it from above.
std::string textured_ball() {
  const TriangleMesh mesh = icosphere(3);
  std::string text = obj_text(mesh);
  text.erase(text.find("\nf ") + 1);
  for (const auto& x : mesh.positions.rowwise()) {
    text.append("vt ").append(std::to_string(0.5 + 0.45 * x[0]));
    text.append(" ").append(std::to_string(0.5 + 0.45 * x[1])).append("\n");
  }
  for (const auto& f : mesh.triangles.rowwise()) {
    text += "f";
    for (const int v : f) {
      const std::string number = std::to_string(v + 1);
      text.append(" ").append(number).append("/").append(number);
    }
    text += "\n";
  }
  return text;
}

/// Left half red, right half green.
Image two_colours() {
  Image image(64, 64, 3);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) image.pixel(x, y)[x < 32 ? 0 : 1] = 1;
  }
  return image;
}

}  // namespace

TEST_CASE("bake: --map channels bakes the constants of two materials, and says where none are") {
  const Folder folder;
  const TriangleMesh mesh = icosphere(2);
  std::string text = obj_text(mesh);
  const auto first = text.find("\nf ");
  text.insert(text.find("\nf ", first + text.size() / 4 - first / 4) + 1, "usemtl wood\n");
  text.insert(first + 1, "mtllib a.mtl\nusemtl red\n");
  write_bytes(folder / "a.obj", text);
  write_bytes(folder / "a.mtl",
              "newmtl red\nKd 1 0 0\nPr 0.2\nPm 0.6\nnewmtl wood\nKd 0 1 0\nPr 0.4\nKe 4 0 2\n");
  REQUIRE(sphparam_program({"bake", folder / "a.obj", "--map", "channels", "--size", "64", "-o",
                            folder / "a_{map}.png"})
              .code == 0);
  const Image colour = read_image(folder / "a_basecolor.png"),
              orm = read_image(folder / "a_orm.png"), light = read_image(folder / "a_emissive.png");
  CHECK_FALSE(std::filesystem::exists(folder / "a_normal-tangent.png"));
  long red = 0, green = 0;
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool is_red = colour.pixel(x, y)[0] == 1 && colour.pixel(x, y)[1] == 0;
      const bool is_green = colour.pixel(x, y)[0] == 0 && colour.pixel(x, y)[1] == 1;
      red += is_red;
      green += is_green;
      if (!is_red && !is_green) continue;  // the mean of both, along their border
      CHECK(orm.pixel(x, y)[0] == 1);
      CHECK(orm.pixel(x, y)[1] == Approx(is_red ? 0.2 : 0.4));
      CHECK(orm.pixel(x, y)[2] == Approx(is_red ? 0.6 : 0).margin(1e-6));
      CHECK(light.pixel(x, y)[0] == (is_red ? 0 : 1));
    }
  }
  CHECK(red > 100);
  CHECK(green > 100);
  const Ended bare = sphparam_program(
      {"bake", "-", "--map", "channels", "-o", folder / "b_{map}.png"}, obj_text(mesh));
  CHECK(bare.code == 2);
  CHECK_THAT(bare.err, Contains("neither materials nor colours") && !Contains("--sphere"));
  const std::string map = folder / "bare.sph.ply";
  REQUIRE(sphparam_program({"map", "-", "-o", map}, obj_text(mesh)).code == 0);
  CHECK_THAT(sphparam_program({"bake", map, "--map", "channels", "-o", folder / "b_{map}.png"}).err,
             Contains("A map carries no materials") &&
                 Contains("`sphparam bake ASSET --sphere " + map + " --map channels`"));
  write_bytes(folder / "lost.obj", "mtllib lost.mtl\nusemtl red\n" + obj_text(mesh));
  CHECK_THAT(sphparam_program(
                 {"bake", folder / "lost.obj", "--map", "channels", "-o", folder / "b_{map}.png"})
                 .err,
             Contains("nothing that could be read says what its materials look like") &&
                 Contains("'lost.mtl' (No such file or directory)"));
}

TEST_CASE("bake: conventions show the same colours elsewhere") {
  const Folder folder;
  write_image(folder / "skin.png", two_colours());
  std::optional<Image> ours;
  struct Case {
    const char* convention;
    int turns, shift;
  };
  for (const auto& [convention, turns, shift] : {Case{"sphparam", 1, 0}, Case{"three", 1, 32},
                                                 Case{"envmap", -1, 16}, Case{"blender", -1, 32}}) {
    const Ended ended = sphparam_program(
        {"bake", "-", "--texture", folder / "skin.png", "--size", "64", "--convention", convention,
         "-o", folder / "ball.png", "--json", folder / "ball.json"},
        textured_ball());
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    const Image image = read_image(folder / "ball.png");
    REQUIRE(image.width == 64);
    REQUIRE(image.height == 32);
    if (!ours) ours = image;
    double red = 0;
    for (int c = 0; c < 64; ++c) {
      const int column = ((turns * (c - shift) - (turns < 0)) % 64 + 64) % 64;
      CHECK(image.pixel(c, 16)[0] == ours->pixel(column, 16)[0]);
      red += static_cast<double>(image.pixel(c, 16)[0]) / 64;
    }
    CHECK(red == Approx(0.5).margin(0.1));  // of the equator, half is on the red side
    const auto json = nlohmann::json::parse(bytes_of(folder / "ball.json"));
    CHECK(json["convention"] == convention);
    CHECK(json["images"][0]["map"] == "basecolor");
  }
}

TEST_CASE("bake: every format and depth holds colours, directions, data and labels") {
  const Mapped mapped(200);
  const std::vector<std::pair<std::string, std::vector<std::string>>> formats = {
      {".png", {"u8", "u16"}},
      {".tif", {"u8", "u16", "float"}},
      {".exr", {"half", "float"}},
      {".jpg", {"u8"}}};
  for (const auto& [ending, depths] : formats) {
    for (const std::string& depth : depths) {
      INFO(ending << " " << depth);
      const std::string image = mapped.folder / (depth + "_{map}" + ending);
      const Ended ended =
          sphparam_program({"bake", mapped.path, "--map",
                            "axes,checker,graticule,normal-object,position,curvature,id:face",
                            "--size", "64", "--depth", depth, "-o", image});
      const Ended heat =
          sphparam_program({"bake", mapped.path, "--map", "area", "--heat", "--size", "64",
                            "--depth", depth, "-o", mapped.folder / (depth + "_heat" + ending)});
      INFO(ended.err << heat.err);
      REQUIRE(ended.code == 0);
      REQUIRE(heat.code == 0);
      for (const std::string& name : mapped.folder.names()) {
        const bool scale = name.find("scale") != std::string::npos;
        if (scale || !name.starts_with(depth + "_") || !name.ends_with(ending)) continue;
        INFO(name);
        const std::string bytes = bytes_of(mapped.folder / name);
        const ImageHeader header = image_header(bytes);
        CHECK(header.width == 64);
        CHECK(header.height == 32);
        CHECK(header.bits == (depth == "u8" ? 8U : depth == "float" ? 32U : 16U));
        CHECK(read_image(mapped.folder / name).width == 64);
      }
    }
  }
}

TEST_CASE("bake: what integers cut off an area ratio is told, files of floats have all of it") {
  const Folder folder;
  write_bytes(folder / "limb.obj", obj_text(tube(60, 5)));
  const auto baked = [&](const std::string& name) {
    const Ended ended =
        sphparam_program({"bake", folder / "limb.obj", "--map", "area", "-o", folder / name,
                          "--size", "128", "--json", folder / "bake.json"});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    return std::pair(ended.err, Json::parse(bytes_of(folder / "bake.json"))["images"][0]);
  };
  const auto [said, image] = baked("area.png");
  CHECK(image["range"] == Json({-3.0, 3.0}));
  CHECK(image["beyond"].get<double>() > 0);
  CHECK_THAT(said, Contains("% of the texels lie beyond -3 to 3, and end there"));
  const auto [of_floats, floats] = baked("area.exr");
  CHECK_FALSE(floats.contains("range"));
  CHECK_THAT(of_floats, !Contains("beyond"));
}

TEST_CASE("bake: several maps go to files of their own, all or none") {
  const Folder folder;
  const Ended ended =
      sphparam_program({"bake", "-", "--map", "position,normal-object,axes,id:face,area", "--size",
                        "32", "-o", folder / "ball_{map}.png"},
                       textured_ball());
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK(folder.names() == std::vector<std::string>{"ball_area.png", "ball_axes.png",
                                                   "ball_id-face.png", "ball_normal-object.png",
                                                   "ball_position.png"});
  const Ended failed = sphparam_program(
      {"bake", "-", "--map", "position,scalar:none", "--size", "32", "-o", folder / "x_{map}.png"},
      textured_ball());
  CHECK(failed.code == 2);
  CHECK(folder.names().size() == 5);
}

TEST_CASE("bake: same bytes for any number of threads, and for levels") {
  const Folder folder;
  for (const std::string name : {"a.exr", "b.exr"}) {
    REQUIRE(sphparam_program({"bake", "-", "--map", "position", "--size", "130", "--mip",
                              "--threads", name == "a.exr" ? "1" : "3", "-o", folder / name},
                             textured_ball())
                .code == 0);
  }
  CHECK(bytes_of(folder / "a.exr") == bytes_of(folder / "b.exr"));
}

TEST_CASE("bake: no output replaces an input") {
  const Folder folder;
  const std::string mesh = folder / "ball_scale.png", obj = textured_ball();
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
           {"-o", folder / "x.png", "--json", mesh}, {"-o", folder / "ball.png", "--heat"}}) {
    write_bytes(mesh, obj);
    std::vector<std::string> arguments = {"bake", mesh, "--map", "area", "--size", "32"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = sphparam_program(arguments);
    INFO(ended.err);
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err, Contains("is the input"));
    CHECK(bytes_of(mesh) == obj);
    CHECK(folder.names() == std::vector<std::string>{"ball_scale.png"});
  }
}

TEST_CASE("bake: a low mesh must be on the sphere of the high one") {
  const Folder folder;
  TriangleMesh egg = icosphere(3);
  egg.positions.col(0) *= 1.5;
  egg.positions.col(2) *= 0.75;
  const std::string high = folder / "high.sph.ply", low = folder / "low.sph.ply",
                    own = folder / "own.sph.ply", image = folder / "x.png",
                    report = folder / "x.json";
  const std::string text = obj_text(egg);
  REQUIRE(sphparam_program({"map", "-", "-o", high}, text).code == 0);
  REQUIRE(sphparam_program({"remesh", high, "--grid", "ico:2", "-o", low}).code == 0);
  // The same shape, mapped with other vertices at the poles.
  REQUIRE(sphparam_program({"map", "-", "-o", own, "--poles", "100,300"}, text).code == 0);
  const auto bake = [&](const std::string& target) {
    return sphparam_program({"bake", high, "--for", target, "--map", "normal-tangent", "--size",
                             "32", "-o", image, "--json", report});
  };
  const Ended good = bake(low);
  INFO(good.err);
  REQUIRE(good.code == 0);
  CHECK_THAT(good.err, !Contains("warning"));
  CHECK(nlohmann::json::parse(bytes_of(report))["for_distance"] < 1e-9);
  fs::remove(image);
  const Ended bad = bake(own);
  INFO(bad.err);
  CHECK(bad.code == 2);
  CHECK_THAT(bad.err, Contains("own.sph.ply: is not on the same sphere"));
  CHECK_FALSE(fs::exists(image));
  write_bytes(folder / "plain.obj", text);
  const Ended plain = bake(folder / "plain.obj");
  INFO(plain.err);
  CHECK(plain.code == 2);
  CHECK_THAT(plain.err, Contains("--for: ") && Contains("plain.obj: carries no map") &&
                            !Contains("mapped now"));
  CHECK(type_advice(bad.err, folder / ".") == 2);
  for (const char* made : {"high_ico6.sph.ply", "own_like.sph.ply"}) {
    const Ended again = bake(folder / made);
    INFO(again.err);
    CHECK(again.code == 0);
  }
}

TEST_CASE("bake: what is advised for --for can be typed, of a mesh without a map and mended too") {
  const Folder folder;
  TriangleMesh egg = icosphere(3), low = icosphere(2);
  egg.positions.col(0) *= 1.5;
  low.positions.col(0) *= 1.5;
  const std::string high = folder / "my egg.obj", target = folder / "low.obj";
  write_bytes(target, obj_text(low));
  const Triangles all = egg.triangles;
  for (const bool hurt : {false, true}) {
    if (hurt) egg.triangles = all.bottomRows(all.rows() - 1);
    write_bytes(high, obj_text(egg));
    const auto bake = [&](const std::string& other) {
      std::vector<std::string> words = {"bake",           high, "--for",          other,    "--map",
                                        "normal-tangent", "-o", folder / "x.png", "--size", "32"};
      if (hurt) words.insert(words.end(), {"--repair=holes", "--max-hole", "7"});
      return sphparam_program(words);
    };
    const Ended bare = bake(target);
    INFO(bare.err);
    REQUIRE(bare.code == 2);
    CHECK_THAT(bare.err, Contains("low.obj: carries no map"));
    if (hurt) CHECK_THAT(bare.err, Contains("egg.obj' --repair=holes --max-hole 7 -o"));
    CHECK(type_advice(bare.err, folder / ".") == 3);
    for (const char* made : {"my egg_ico6.sph.ply", "low_like.sph.ply"}) {
      const Ended again = bake(folder / made);
      INFO(again.err);
      CHECK(again.code == 0);
      CHECK_THAT(again.err, !Contains("warning"));
    }
  }
}

TEST_CASE("bake: --from bakes another surface on the mesh, and tells how it was found") {
  const Folder folder;
  const std::string mesh = folder / "ball.sph.ply", skin = folder / "skin.png",
                    soup = folder / "soup.obj", report = folder / "x.json",
                    image = folder / "x_{map}.png";
  REQUIRE(sphparam_program({"map", "-", "-o", mesh}, obj_text(icosphere(3))).code == 0);
  write_image(skin, two_colours());
  // Two balls, one in the other, of the same texture: the outer one is shown.
  std::string text = textured_ball();
  text.insert(0, "mtllib soup.mtl\n");
  text.insert(text.find("\nf ") + 1, "usemtl skin\n");
  write_bytes(folder / "soup.mtl", "newmtl skin\nmap_Kd skin.png\n");
  write_bytes(soup, text);
  const auto bake = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"bake", mesh, "--from", soup,     "--size",
                                          "64",   "-o", image,    "--json", report};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return sphparam_program(arguments);
  };
  const Ended good = bake({"--map", "basecolor,found,height", "--threads", "2"});
  INFO(good.err);
  REQUIRE(good.code == 0);
  CHECK_THAT(good.err, Contains("soup.obj: the mesh lies on it everywhere"));
  const Json from = Json::parse(bytes_of(report))["from"];
  CHECK(from["triangles"] == 1280);
  CHECK(from["nearest"] == 0);
  CHECK(from["farthest"] < 1e-6);
  // The same as by the map, where both are one mesh.
  REQUIRE(
      sphparam_program({"bake", soup, "--sphere", mesh, "--size", "64", "-o", folder / "own.png"})
          .code == 0);
  const Image colours = read_image(folder / "x_basecolor.png"),
              own = read_image(folder / "own.png");
  int apart = 0;
  for (int i = 0; i < 64 * 32; ++i)
    for (int c = 0; c < 3; ++c)
      apart += std::abs(colours.pixel(i % 64, i / 64)[c] - own.pixel(i % 64, i / 64)[c]) > 0.02F;
  CHECK(apart < 20);
  CHECK(own.pixel(0, 16)[0] != own.pixel(32, 16)[0]);
  const std::string bytes = bytes_of(folder / "x_basecolor.png");
  REQUIRE(bake({"--map", "basecolor,found", "--threads", "1"}).code == 0);
  CHECK(bytes_of(folder / "x_basecolor.png") == bytes);

  const Ended both = bake({"--map", "basecolor,height", "--for", mesh});
  CHECK(both.code == 2);
  CHECK_THAT(both.err, Contains("--from and --for"));
  const Ended area = bake({"--map", "area,height"});
  CHECK(area.code == 2);
  CHECK_THAT(area.err, Contains("area: is of a closed surface with a map"));
  const Ended channels = sphparam_program({"bake", mesh, "--from", mesh, "--map", "channels",
                                           "--size", "64", "-o", folder / "y_{map}.png"});
  CHECK(channels.code == 0);  // only its shape has something to say
  CHECK(fs::exists(folder / "y_normal-tangent.png"));
  CHECK_FALSE(fs::exists(folder / "y_basecolor.png"));
}

TEST_CASE("bake: numbers of faces are exact or refused, and a misspelt property is found") {
  const Folder folder;
  const std::string exr = folder / "x.exr";
  const std::string many = obj_text(icosphere(4));  // 5120 faces
  const Ended half = sphparam_program(
      {"bake", "-", "--map", "id:face", "--depth", "half", "--size", "32", "-o", exr}, many);
  CHECK(half.code == 2);
  CHECK_THAT(half.err, Contains("up to 2048 exactly"));
  CHECK(folder.names().empty());
  CHECK(sphparam_program({"bake", "-", "--map", "id:face", "--size", "32", "-o", exr}, many).code ==
        0);
  const Ended misspelt = sphparam_program(
      {"bake", "-", "--map", "scalar:haet", "--size", "32", "-o", folder / "t.png"},
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
      "property float y\nproperty float z\nproperty float heat\n"
      "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
      "1 1 1 0\n-1 -1 1 1\n-1 1 -1 2\n1 -1 -1 3\n"
      "3 0 1 3\n3 0 2 1\n3 0 3 2\n3 1 2 3\n");
  CHECK(misspelt.code == 2);
  CHECK_THAT(misspelt.err, Contains("no such property"));
  CHECK_THAT(misspelt.err, Contains("did you mean heat?"));
}

TEST_CASE("bake: an image named without its option is told what to type") {
  const Ended bare = sphparam_program({"bake", "m.ply", "normal-object", "-o", "x.png"});
  CHECK(bare.code == 2);
  CHECK_THAT(bare.err, Contains("unexpected argument normal-object; --map normal-object bakes it"));
  const Ended size = sphparam_program({"bake", "m.ply", "--size", "--map", "ao", "-o", "x.png"});
  CHECK(size.code == 2);
  CHECK_THAT(size.err, Contains("--size: expected a number"));
  const Ended other = sphparam_program({"bake", "m.ply", "n.ply"});
  CHECK(other.code == 2);
  CHECK_THAT(other.err, Contains("unexpected argument n.ply") && !Contains("--map"));
}

TEST_CASE("bake: what cannot be done is said before anything is written") {
  const Folder folder;
  const std::string out = folder / "x.png", obj = textured_ball();
  write_bytes(folder / "broken.png", "\x89PNG\r\n\x1a\nnot really");
  struct Mistake {
    std::vector<std::string> arguments;
    int code;
    std::string said;
  };
  for (const Mistake& mistake : {
           Mistake{{"--map", "postion"}, 2, "did you mean position?"},
           {{"--map", "colour"}, 2, "there is no map colour; did you mean basecolor?"},
           {{"--map", "nothing"}, 2, "there are axes"},
           {{"--map", "scalar:heat"}, 2, "no such property"},
           {{"--map", "position,uv"}, 2, "{map}"},
           {{"--texture", folder / "missing.png"}, 3, "missing.png"},
           {{"--texture", folder / "broken.png"}, 3, "broken.png"},
           {{}, 2, "--texture IMAGE"},
           {{"--map", "vcolor"}, 2, "no colours"},
           {{"--map", "position:what"}, 2, "nothing can follow position"},
           {{"--map", "axes:x"}, 2, "nothing can follow axes"},
           {{"--map", "position", "--json", out}, 2, "-o and --json: the same file"},
           {{"--map", "area", "--heat", "--json", folder / "x_scale.png"},
            2,
            "--heat and --json: the same file"},
           {{"--map", "position", "--size", "0"}, 2, "--size"},
           {{"--map", "position", "--size", "33"}, 2, "even"},
           {{"--map", "position", "--size", "34", "--convention", "envmap"}, 2, "multiple of 4"},
           {{"--map", "position", "--depth", "float"}, 2, "--depth"},
           {{"--map", "position", "--mip"}, 2, "--mip"},
           {{"--map", "position", "--range", "0,1"}, 2, "--range is for --map scalar:NAME"},
           {{"--map", "scalar:a", "--range", "1,1"}, 2, "--range: expected two numbers"},
           {{"--map", "scalar:a", "--range", "0"}, 2, "--range: expected two numbers"},
           {{"--map", "position", "--samples", "0"}, 2, "--samples"},
           {{"--map", "normal-tangent", "--for", folder / "nothing.ply"}, 3, "nothing.ply"},
       }) {
    std::vector<std::string> arguments = {"bake", "-", "-o", out};
    arguments.insert(arguments.end(), mistake.arguments.begin(), mistake.arguments.end());
    const Ended ended = sphparam_program(arguments, obj);
    INFO(ended.err);
    CHECK(ended.code == mistake.code);
    CHECK_THAT(ended.err, Contains(mistake.said));
    CHECK(folder.names() == std::vector<std::string>{"broken.png"});
  }
  const Ended floats = sphparam_program(
      {"bake", "-", "--map", "scalar:a", "--range", "0,1", "-o", folder / "x.exr"}, obj);
  CHECK(floats.code == 2);
  CHECK_THAT(floats.err, Contains("--range is for --map scalar:NAME in integers: floats hold"));
  const Ended bare = sphparam_program({"bake", "-", "--texture", folder / "broken.png", "-o", out},
                                      obj_text(icosphere(1)));
  CHECK(bare.code != 0);
  const Ended named =
      sphparam_program({"bake", "-", "--map", "position", "-o", folder / "x.gif"}, obj);
  CHECK(named.code == 2);
  CHECK_THAT(named.err, Contains(".png, .jpg, .tif or .exr"));
  for (const char* path : {"no/x.png", "no/"}) {
    const Ended lost = sphparam_program({"bake", "-", "--map", "area", "-o", folder / path}, obj);
    CHECK(lost.code == 3);
    CHECK_THAT(lost.err, Contains("the folder " + (folder / "no") + " does not exist"));
  }
}

TEST_CASE("bake: --body writes what tells GDAL where an image lies, and says whose longitudes") {
  const Folder folder;
  const std::string map = folder / "stone.sph.ply";
  TriangleMesh mesh = icosphere(3);
  mesh.positions *= Vector3(17, 9, 7).asDiagonal();
  REQUIRE(sphparam_program({"map", "-", "-o", map, "--method", "radial"}, obj_text(mesh)).code ==
          0);
  const Ended ended = sphparam_program({"bake", map, "--body", "eros", "--unit", "km", "--map",
                                        "radius,elevation,lon", "--size", "64", "-o",
                                        folder / "{map}.tif", "--json", folder / "b.json"});
  INFO(ended.err);
  REQUIRE(ended.code == 0);
  CHECK_THAT(ended.err, Contains("longitude and latitude: Eros (2015) - Sphere / Ocentric"));
  for (const std::string name : {"radius", "elevation", "lon"}) {
    const std::string beside = bytes_of(folder / (name + ".tif.aux.xml"));
    CHECK_THAT(beside, Contains("<GeoTransform>-180, 5.625, 0, 90, 0, -5.625</GeoTransform>") &&
                           Contains("<Scale>") && Contains("<Description>" + name));
  }
  const Json report = Json::parse(bytes_of(folder / "b.json"));
  CHECK(report["convention"] == "gis");
  CHECK(report["body"]["name"] == "Eros");
  CHECK(report["images"][0]["sidecar"] == folder / "radius.tif.aux.xml");
  const Ended own = sphparam_program({"bake", "-", "--body", "17", "--unit", "km", "--map",
                                      "radius", "--size", "64", "-o", folder / "own.png"},
                                     obj_text(mesh));
  INFO(own.err);
  CHECK(own.code == 0);
  CHECK_THAT(own.err, Contains("longitude and latitude: sphparam map of"));
}

TEST_CASE(
    "bake: what --body, --unit, --west and --centre may not say ends with 2, without a file") {
  const Folder folder;
  const std::string ball = obj_text(icosphere(2)), image = folder / "x.tif";
  const std::string wkt =
      "GEOGCRS[\"X\",DATUM[\"X\",ELLIPSOID[\"X\",9,0,LENGTHUNIT[\"metre\",1]]],CS[ellipsoidal,2],"
      "AXIS[\"latitude\",north],AXIS[\"longitude\",east],ANGLEUNIT[\"degree\",0.017453]]";
  const std::vector<std::pair<std::vector<std::string>, std::string>> senseless = {
      {{"--body", "vespa"}, "did you mean vesta?"},
      {{"--body", "0"}, "above 0"},
      {{"--body", "1,2"}, "three semi-axes"},
      {{"--body", "vesta", "--convention", "three"},
       "`gdalwarp -te 0 -90 360 90 IMAGE.tif OUT.tif`"},
      {{"--body", "vesta", "--unit", "mile"}, "--unit"},
      {{"--body", wkt, "--west"}, "--west contradicts --body"},
      {{"--unit", "km"}, "--unit is for --body only"},
      {{"--west"}, "--west is for --body, and for the maps lon and lonlat"},
      {{"--centre", "1,2"}, "--centre"},
      {{"--map", "elevation"}, "above which body?"},
  };
  for (const auto& [options, said] : senseless) {
    std::vector<std::string> arguments = {"bake", "-", "-o", image, "--size", "16"};
    if (options.front() != "--map") arguments.insert(arguments.end(), {"--map", "radius"});
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Ended ended = sphparam_program(arguments, ball);
    INFO(options.back() << ": " << ended.err);
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err, Contains(said));
  }
  CHECK(folder.names().empty());
  write_bytes(folder / "x.tif.aux.xml", "mine");
  const Ended read = sphparam_program({"bake", "-", "--map", "radius", "--body", "1", "--texture",
                                       folder / "x.tif.aux.xml", "-o", image, "--size", "16"},
                                      ball);
  CHECK(read.code == 2);
  CHECK(bytes_of(folder / "x.tif.aux.xml") == "mine");
}

TEST_CASE("bake: where an image of a material cannot be had, what to type is told, and works") {
  const Folder folder;
  const std::string shape = folder / "ball.obj";
  write_bytes(folder / "m.mtl", "newmtl skin\nKd 0 0 1\nmap_Kd nothing.png\n");
  const std::string ball = "mtllib m.mtl\nusemtl skin\n" + obj_text(icosphere(2));
  write_bytes(shape, ball);
  const std::vector<std::string> channels = {"bake",   shape, "--map", "channels",
                                             "--size", "32",  "-o",    folder / "."};
  const Ended bare = sphparam_program(channels);
  INFO(bare.err);
  CHECK(bare.code == 3);
  CHECK_THAT(bare.err, Contains("nothing.png cannot be read") &&
                           Contains("; --texture IMAGE names another for basecolor, `sphparam "
                                    "asset " +
                                    shape + "` leaves out images that cannot be read"));
  const Ended asset = sphparam_program(
      {"asset", shape, "-o", folder / "made", "--size", "32", "--no-page", "--textures", "png"});
  INFO(asset.err);
  REQUIRE(asset.code == 0);
  CHECK_THAT(asset.err, Contains("not carried: nothing.png of material skin: ") &&
                            Contains(" baked, ") && Contains("\n  in the .glb: "));
  const Image blue = read_image(folder / "made/ball_basecolor.png");
  CHECK(blue.pixel(3, 9)[0] == 0);
  CHECK(blue.pixel(3, 9)[2] == 1);
}

TEST_CASE("bake: an image whose sidecar cannot be written does not appear either") {
  const Folder folder;
  fs::create_directory(folder / "b.tif.aux.xml");
  const Ended ended = sphparam_program({"bake", "-", "--body", "1", "--map", "radius,slope",
                                        "--size", "16", "-o", folder / "{map}.tif"},
                                       obj_text(icosphere(2)));
  CHECK(ended.code == 0);
  CHECK(fs::exists(folder / "slope.tif.aux.xml"));
  const Ended lost = sphparam_program(
      {"bake", "-", "--body", "1", "--map", "radius", "--size", "16", "-o", folder / "b.tif"},
      obj_text(icosphere(2)));
  CHECK(lost.code == 3);
  CHECK_FALSE(fs::exists(folder / "b.tif"));
}

TEST_CASE("bake: a texture that is not in the map's file is told, faces without coordinates too") {
  const Folder folder;
  const std::string mesh = folder / "ball.obj", map = folder / "ball.sph.ply",
                    skin = folder / "skin.png", out = folder / "x.png";
  write_image(skin, two_colours());
  write_bytes(folder / "ball.mtl", "newmtl skin\nmap_Kd skin.png\n");
  std::string text = "mtllib ball.mtl\n" + textured_ball();
  text.insert(text.find("\nf ") + 1, "usemtl skin\n");
  for (size_t i = text.find("\nv "); i != std::string::npos; i = text.find("\nv ", i + 1))
    text.insert(text.find('\n', i + 1), " 0.5 0.5 0.5");
  write_bytes(mesh, text);
  REQUIRE(sphparam_program({"map", mesh, "-o", map}).code == 0);
  const auto told = [&](std::vector<std::string> more) {
    std::vector<std::string> words = {"bake", map, "--size", "32", "-o", out};
    words.insert(words.end(), more.begin(), more.end());
    const Ended ended = sphparam_program(words);
    INFO(ended.err);
    CHECK(ended.code == 0);
    return ended.err;
  };
  CHECK_THAT(told({"--map", "basecolor"}),
             Contains("warning: ball.sph.ply: baked without its texture, which is not in this "
                      "file (") &&
                 Contains("--texture IMAGE names it, or the file that was mapped, with --sphere "
                          "ball.sph.ply, has it"));
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--map", "ao"}, {"--map", "basecolor", "--texture", skin}})
    CHECK_THAT(told(more), !Contains("texture"));
  const size_t face = text.find("\nf ") + 1;
  std::string bare = text.substr(face, text.find('\n', face) - face), plain;
  for (size_t i = 0; i < bare.size(); ++i) {
    if (bare[i] == '/') i = std::min(bare.find(' ', i), bare.size());
    if (i < bare.size()) plain += bare[i];
  }
  write_bytes(mesh, text.replace(face, bare.size(), plain));
  const Ended unplaced = sphparam_program({"bake", mesh, "--size", "32", "-o", out});
  INFO(unplaced.err);
  CHECK(unplaced.code == 0);
  CHECK_THAT(unplaced.err, Contains("warning: 1 triangle has no texture coordinates, or all at "
                                    "(0, 0): the texture's corner is seen there"));
}

TEST_CASE("bake: heights above triangles that are smaller than texels are told") {
  const Folder folder;
  const std::string mesh = folder / "ball.obj", map = folder / "ball.sph.ply";
  write_bytes(mesh, obj_text(icosphere(3)));
  REQUIRE(sphparam_program({"map", mesh, "-o", map}).code == 0);
  const auto told = [&](const std::string& field, const std::string& size) {
    return sphparam_program({"bake", map, "--from", mesh, "--map", field, "--size", size, "-o",
                             folder / "x.tif"})
        .err;
  };
  CHECK_THAT(told("height", "16"), Contains("warning: height: 99.1 % of the mesh has triangles "
                                            "smaller than texels"));
  CHECK_THAT(told("height", "1024"), !Contains("smaller than texels"));
  CHECK_THAT(told("height:radial", "16"), !Contains("smaller than texels"));
}

}  // namespace sphparam::tests
