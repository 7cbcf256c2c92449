#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "image/image_codec.h"
#include "mapped.h"
#include "program.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/version.h"
#include "support/joined.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

using Catch::Contains;

using Words = std::vector<std::string>;

/// What a subcommand reads and writes: options, or parts of a word that end where the file's name
/// begins. An empty one is a positional argument.
struct Subcommand {
  std::string name;
  Words reads, writes;
  Words needed = {};   // options that it cannot do without
  int positional = 1;  // arguments before `reads` come
};

const std::vector<Subcommand> subcommands = {
    {"asset", {""}, {"-o", "--json"}},
    {"bake", {"", "--texture", "--sphere", "--for", "--from"}, {"-o", "--json"}},
    {"compare", {"", "--add x="}, {"-o"}},
    {"export",
     {"", "--sphere", "--image", "--normal-map", "--occlusion-map", "--orm-map", "--emissive-map",
      "--images"},
     {"-o", "--json"}},
    {"info", {""}, {"--json"}},
    {"map", {"", "--pin", "--like"}, {"-o", "--write-sphere", "--json", "--plots", "--loops"}},
    {"match",
     {"", "--landmarks", "--sphere", "--sphere-b"},
     {"-o", "--write-shape", "--write-values", "--write-back", "--morph", "--page", "--json"},
     {"--landmarks"},
     2},
    {"group", {"", "--template", "--landmarks"}, {"-o"}},
    {"measure", {"", ""}, {"--per-vertex", "--aligned", "--json"}, {}, 2},
    {"paint", {"", "--image", "--sphere"}, {"-o"}, {"--image"}},
    {"remesh",
     {"", "--sphere", "--grid like:"},
     {"-o", "--geometry-image", "--normal-image", "--attribute-image q=", "--limit-mesh",
      "--displace", "--rebuild", "--csv", "--json"},
     {"--grid"}},
    {"render", {"", "--texture", "--sphere"}, {"-o"}},
    {"repair", {""}, {"-o", "--loops", "--json"}},
    {"report", {"", "--sphere", "--texture"}, {"-o", "--json"}},
    {"spharm",
     {"", "--sphere", "--flip-template"},
     {"--json", "--csv", "--shadr", "--coef", "--reconstruct"}},
    {"survey", {}, {"-o", "--records", "--json"}},
    {"unimage", {"", "--normals", "--attribute q="}, {"-o"}},
    {"verify", {""}, {"--json"}, {}, 2},
    {"wrap", {""}, {"-o", "--json"}},
};

bool contains(const Words& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Adds "--attribute" and "q=FILE" of "--attribute q=", or "--json" and "FILE".
void add(Words& line, const std::string& option, const std::string& file) {
  const size_t blank = option.find(' ');
  line.push_back(option.substr(0, blank));
  line.push_back((blank == std::string::npos ? "" : option.substr(blank + 1)) + file);
}

/// A command line that reads `input` and writes `output` with these options, and names other files
/// wherever one must be named.
Words command_line(const Subcommand& command, const std::string& read, const std::string& input,
                   const std::string& write, const std::string& output) {
  Words line = {command.name};
  for (int i = 0; i < command.positional; ++i)
    line.push_back(read.empty() && i + 1 == command.positional ? input : "other.ply");
  if (!read.empty()) add(line, read, input);
  for (const std::string& option : command.needed)
    if (!read.starts_with(option)) add(line, option, "other");
  add(line, write, output);
  if (write != "-o") add(line, "-o", "elsewhere.ply");
  const bool has_none = contains({"info", "measure", "spharm", "verify"}, command.name);
  if (has_none && write != "-o") line.resize(line.size() - 2);
  return line;
}

std::string as_text(const Words& words) {
  std::string text;
  for (const std::string& word : words) text += word + " ";
  return text;
}

/// A command line of every subcommand with --json that works, by a mesh and its map.
std::vector<Words> reporting_lines(const Folder& folder, const std::string& mesh) {
  const auto to = [&](const std::string& name) { return folder / name; };
  return {
      {"asset", mesh, "-o", to("asset"), "--size", "16", "--no-page"},
      {"bake", mesh, "--map", "axes", "--size", "16", "-o", to("x.png")},
      {"export", mesh, "--image-size", "16", "-o", to("x.glb")},
      {"info", mesh},
      {"map", mesh, "-o", to("y.sph.ply")},
      {"match", mesh, mesh, "-o", to("x.sph.ply")},
      {"measure", mesh, mesh},
      {"remesh", mesh, "--grid", "ico:1", "-o", to("x.ply")},
      {"repair", mesh, "-o", to("y.ply")},
      {"report", mesh, "--size", "64", "--no-viewer", "-o", to("x.html")},
      {"spharm", mesh, "--degree", "2"},
      {"survey", to("shapes"), "--size", "0", "-o", to("y.html")},
      {"verify", mesh},
      {"wrap", mesh, "--resolution", "16", "-o", to("z.ply")},
      {"map", to("two.obj"), "--all-components", "-o", to("two.sph.ply")},
      {"bake", to("two.sph.ply"), "--all-components", "--map", "axes", "--size", "16", "-o",
       to("two.png")},
      {"export", to("two.sph.ply"), "--all-components", "--image-size", "16", "-o", to("two.glb")}};
}

/// The first two keys of a report and what they say.
std::string head_of(const std::string& report) {
  const auto json = nlohmann::ordered_json::parse(report, nullptr, false);
  if (!json.is_object() || json.size() < 2) return "no report";
  std::string head;
  for (auto entry = json.begin(); entry != std::next(json.begin(), 2); ++entry)
    head += entry.key() + " " + entry.value().dump() + "; ";
  return head;
}

std::string head_wanted(const std::string& command) {
  return std::string("sphparam \"") + sphparam::version + "\"; command \"" + command + "\"; ";
}

}  // namespace

TEST_CASE("outputs: no option of any subcommand may write what another one reads") {
  const Folder folder;
  const std::string input = folder / "input.ply";
  write_bytes(input, "precious");
  fs::create_symlink("input.ply", folder / "symbolic.ply");
  fs::create_hard_link(input, folder / "hard.ply");
  fs::create_directory(folder / "sub");
  const Words spellings = {input, folder / "./input.ply", folder / "sub/../input.ply",
                           folder / "symbolic.ply", folder / "hard.ply"};
  for (const Subcommand& command : subcommands) {
    for (const std::string& read : command.reads) {
      for (const std::string& write : command.writes) {
        // Every spelling with one option, one of them with the others.
        for (const std::string& output : spellings) {
          if (output != input && write != command.writes.front()) continue;
          const Words line = command_line(command, read, input, write, output);
          INFO(as_text(line));
          const Ended ended = sphparam_program(line);
          CHECK(ended.code == 2);
          CHECK_THAT(ended.err, Contains("would be replaced"));
        }
      }
    }
  }
  CHECK(bytes_of(input) == "precious");
}

TEST_CASE("outputs: every option that takes a file is known to read or to write it") {
  const std::set<std::string> kinds = {"FILE", "IMAGE", "PNG", "FOLDER", "PAGE.html", "NAME=FILE"};
  int found = 0;
  for (const Subcommand& command : subcommands) {
    std::istringstream help(sphparam_program({command.name, "--help"}).out);
    for (std::string text; std::getline(help, text);) {
      std::istringstream words(text);
      std::string names, kind;
      if (!(words >> names >> kind) || !names.starts_with("-") || !kinds.contains(kind)) continue;
      ++found;
      const std::string name = names.substr(0, names.find(','));
      INFO(command.name << " " << name);
      const auto is_it = [&](const std::string& option) {
        return option.substr(0, option.find(' ')) == name;
      };
      CHECK(std::any_of(command.reads.begin(), command.reads.end(), is_it) !=
            std::any_of(command.writes.begin(), command.writes.end(), is_it));
    }
  }
  CHECK(found > 30);
}

TEST_CASE("outputs: subcommands that are not in this test write no file") {
  std::set<std::string> known = {"manual", "completion",
                                 "batch"};  // has subcommands of its own: test_batch.cpp
  for (const Subcommand& command : subcommands) known.insert(command.name);
  std::istringstream help(sphparam_program({"--help"}).out);
  bool in_list = false;
  for (std::string text; std::getline(help, text);) {
    if (text.starts_with("Subcommands:")) in_list = true;
    if (!in_list) continue;
    if (text.empty()) break;
    std::istringstream words(text);
    if (std::string name; text.starts_with("  ") && text[2] != ' ' && words >> name)
      CHECK(known.contains(name));
  }
  CHECK(in_list);
}

TEST_CASE("outputs: the texture that a glTF file names is read too, and not replaced") {
  const Mapped mapped(100);
  sphparam::write_image(mapped.folder / "skin.png", sphparam::Image(8, 4, 3));
  const Ended exported =
      sphparam_program({"export", mapped.path, "--image", mapped.folder / "skin.png", "-o",
                        mapped.folder / "a.gltf"});
  INFO(exported.err);
  REQUIRE(exported.code == 0);
  std::string texture;
  for (const std::string& name : mapped.folder.names())
    if (name.starts_with("a") && name.ends_with(".png")) texture = mapped.folder / name;
  REQUIRE_FALSE(texture.empty());
  const std::string before = bytes_of(texture);
  for (const Words& options : {Words{"bake", "--map", "axes"}, Words{"render"}}) {
    Words line = {options.front(), mapped.folder / "a.gltf", "--size", "16", "-o", texture};
    line.insert(line.end(), options.begin() + 1, options.end());
    const Ended ended = sphparam_program(line);
    INFO(as_text(line));
    CHECK(ended.code == 3);
    CHECK_THAT(ended.err, Contains("would be replaced"));
  }
  CHECK(bytes_of(texture) == before);
}

TEST_CASE("outputs: a survey replaces no mesh of its folder") {
  const Folder folder;
  fs::create_directories(folder / "scans/deep");
  const std::string mesh = folder / "scans/deep/a.obj", page = folder / "scans/page.html";
  write_bytes(mesh, obj_text(icosphere(1)));
  fs::create_symlink(mesh, folder / "link.json");
  const std::string before = bytes_of(mesh);
  for (const std::string& json :
       {mesh, folder / "scans/../scans/deep/a.obj", folder / "link.json"}) {
    const Ended ended =
        sphparam_program({"survey", folder / "scans", "-o", page, "--size", "0", "--json", json});
    INFO(json << ": " << ended.err);
    CHECK(ended.code == 2);
    CHECK_THAT(ended.err, Contains("would be replaced"));
    CHECK(bytes_of(mesh) == before);
    CHECK_FALSE(fs::exists(page));
  }
  CHECK(sphparam_program({"survey", folder / "scans", "-o", page, "--size", "0"}).code == 0);
}

TEST_CASE("outputs: what a batch tells of itself replaces none of its own files") {
  const Folder folder;
  const std::string mesh = folder / "a.obj", work = folder / "work";
  write_bytes(mesh, obj_text(icosphere(1)));
  REQUIRE(sphparam_program({"batch", "plan", mesh, "-o", work, "--", "map"}).code == 0);
  REQUIRE(sphparam_program({"batch", "run", work}).code == 0);
  std::string manifest;
  for (const auto& entry : fs::directory_iterator(work))
    if (entry.path().extension() == ".tsv") manifest = entry.path().filename();
  const Words own = {"plan",       manifest,         "Snakefile", "results/a/a.sph.ply",
                     "failed/new", "results/new.csv"};
  for (const std::string& name : own) {
    for (const Words& words : {Words{"table", "-o"}, {"report", "-o"}, {"status", "--json"}}) {
      const std::string output = work + "/" + name;
      const bool is_there = fs::exists(output);
      const std::string before = is_there ? bytes_of(output) : "";
      const Ended ended = sphparam_program({"batch", words[0], work, words[1], output});
      INFO(words[0] << " " << name << ": " << ended.err);
      CHECK(ended.code == 2);
      CHECK_THAT(ended.err, Contains(words[1] + ": " + output + " is a file of the batch itself"));
      CHECK(fs::exists(output) == is_there);
      CHECK((!is_there || bytes_of(output) == before));
    }
  }
  CHECK(sphparam_program({"batch", "table", work, "-o", work + "/all.csv"}).code == 0);
  CHECK(sphparam_program({"batch", "report", work, "-o", work + "/all.html"}).code == 0);
  CHECK(sphparam_program({"batch", "status", work, "--json", work + "/status.json"}).code == 0);
}

TEST_CASE("outputs: libraries of materials and buffers are read too, and not replaced") {
  const Mapped mapped(100);
  const Folder& folder = mapped.folder;
  const std::string is_read = ": is read by this command; it would be replaced",
                    is_foreign = ": is there, and is no library of an export";
  const auto kept = [&](const std::string& file, const Words& line, const std::string& why) {
    const std::string before = bytes_of(file);
    const Ended ended = sphparam_program(line);
    INFO(as_text(line));
    CHECK(ended.code == 3);
    CHECK_THAT(ended.err, Contains(file + why));
    CHECK(bytes_of(file) == before);
  };
  write_bytes(folder / "a.obj", "mtllib b.mtl\nusemtl red\n" + obj_text(icosphere(1)));
  write_bytes(folder / "b.mtl", "newmtl red\nKd 1 0 0\n");
  kept(folder / "b.mtl", {"export", folder / "a.obj", "--image-size", "16", "-o", folder / "b.obj"},
       is_foreign);
  write_bytes(folder / "unused.obj", "mtllib b.mtl\n" + obj_text(icosphere(1)));
  kept(folder / "b.mtl",
       {"export", folder / "unused.obj", "--image-size", "16", "-o", folder / "b.obj"}, is_foreign);
  kept(folder / "b.mtl",
       {"map", folder / "a.obj", "-o", folder / "a.sph.ply", "--json", folder / "b.mtl"}, is_read);
  kept(folder / "b.mtl",
       {"bake", mapped.path, "--from", folder / "a.obj", "--map", "axes", "--size", "16", "-o",
        folder / "a.png", "--json", folder / "b.mtl"},
       is_read);
  REQUIRE(sphparam_program({"export", mapped.path, "--image-size", "16", "-o", folder / "c.gltf"})
              .code == 0);
  std::string text = bytes_of(folder / "c.gltf");
  fs::rename(folder / "c.bin", folder / "d.bin");
  write_bytes(folder / "c.gltf", text.replace(text.find("c.bin"), 5, "d.bin"));
  kept(folder / "d.bin",
       {"export", folder / "c.gltf", "--image-size", "16", "-o", folder / "d.gltf"},
       ": is there, and is no buffer of an export: -o " + (folder / "d_sphparam.gltf"));
}

TEST_CASE("outputs: a texture that lies where an export puts its own stays, its own is replaced") {
  const Mapped mapped(100);
  const Folder& folder = mapped.folder;
  const std::string texture = folder / "a_checker.png";
  for (const char* kind : {".gltf", ".obj", ".ply"}) {
    const Words line = {"export", mapped.path, "--image-size",
                        "16",     "-o",        folder / (std::string("a") + kind)};
    write_bytes(texture, "an artist's");
    const std::vector<std::string> before = folder.names();
    const Ended ended = sphparam_program(line);
    INFO(kind << ended.err);
    CHECK(ended.code == 3);
    CHECK_THAT(ended.err, Contains(texture + ": is there, and is no image of an export: -o " +
                                   (folder / "a_sphparam") + kind + " leaves it as it is"));
    CHECK(bytes_of(texture) == "an artist's");
    CHECK(folder.names() == before);
    fs::remove(texture);
    CHECK(sphparam_program(line).code == 0);
    CHECK(sphparam_program(line).code == 0);
    for (const char* written : {"a.gltf", "a.bin", "a.obj", "a.mtl", "a.ply"})
      fs::remove(folder / written);
  }
}

TEST_CASE("outputs: a name that its own file cannot say in a line is refused before any work") {
  const Mapped mapped(100);
  for (const char* name : {"w\nv 9 9 9\n.obj", " lead.obj", "a\tb.ply"}) {
    INFO(name);
    const std::vector<std::string> before = mapped.folder.names();
    const Ended ended = sphparam_program({"export", mapped.path, "-o", mapped.folder / name});
    CHECK(ended.code == 3);
    CHECK_THAT(ended.err, Contains("are named in lines of text"));
    CHECK(mapped.folder.names() == before);
  }
}

TEST_CASE("outputs: reports hold what is told, also where nobody is told") {
  const Mapped mapped(100);
  const Folder& folder = mapped.folder;
  write_bytes(folder / "a.obj", "mtllib b.mtl\nusemtl red\n" + obj_text(icosphere(1)));
  write_bytes(folder / "b.mtl", "newmtl red\nKd 1 0 0\n");
  const auto report_of = [&](Words line) {
    line.insert(line.end(), {"--json", folder / "report.json", "-q"});
    const Ended ended = sphparam_program(line);
    INFO(as_text(line) << ended.err);
    REQUIRE(ended.code == 0);
    CHECK(ended.err.empty());
    return nlohmann::json::parse(bytes_of(folder / "report.json"));
  };
  const std::string mesh = mapped.path, obj = folder / "a.obj";
  for (const Words& line : {Words{"export", mesh, "--image-size", "16", "-o", folder / "x.glb"},
                            {"bake", mesh, "--map", "axes", "--size", "16", "-o", folder / "x.png"},
                            {"remesh", mesh, "--grid", "ico:1", "-o", folder / "x.ply"},
                            {"match", mesh, mesh, "-o", folder / "x.sph.ply"},
                            {"spharm", mesh, "--degree", "2"},
                            {"map", obj, "-o", folder / "y.sph.ply"},
                            {"repair", obj, "-o", folder / "y.ply"},
                            {"verify", mesh},
                            {"info", obj},
                            {"measure", mesh, mesh}}) {
    INFO(as_text(line));
    const nlohmann::json report = report_of(line);
    for (const char* key : {"warnings", "notes", "losses"}) CHECK(report.at(key).is_array());
  }
  CHECK(report_of({"remesh", obj, "--grid", "ico:1", "-o", folder / "r.ply"}).at("losses") ==
        nlohmann::json::array({"r.ply: not carried: colours and textures of materials"}));
}

TEST_CASE("outputs: every report says first of which version and subcommand it is") {
  const Mapped mapped(100);
  const Folder& folder = mapped.folder;
  fs::create_directories(folder / "shapes");
  write_bytes(folder / "shapes/ball.obj", obj_text(icosphere(1)));
  write_bytes(folder / "two.obj", obj_text(joined(icosphere(1), icosphere(0), {3, 0, 0})));
  std::set<std::string> told;
  for (Words line : reporting_lines(folder, mapped.path)) {
    INFO(as_text(line));
    told.insert(line.front());
    line.insert(line.end(), {"--json", folder / "report.json", "-q"});
    const Ended ended = sphparam_program(line);
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    CHECK(head_of(bytes_of(folder / "report.json")) == head_wanted(line.front()));
  }
  for (const Subcommand& command : subcommands)
    CHECK(told.contains(command.name) == contains(command.writes, "--json"));
  const std::string work = folder / "work";
  REQUIRE(sphparam_program({"batch", "plan", folder / "shapes", "-o", work, "--", "map"}).code ==
          0);
  CHECK(head_of(sphparam_program({"batch", "status", work, "--json", "-", "-q"}).out) ==
        head_wanted("batch status"));
}

TEST_CASE("outputs: the report of a refusal says first of which version and subcommand it is") {
  const Folder folder;
  TriangleMesh open = icosphere(1);
  open.triangles.conservativeResize(open.face_count() - 1, 3);
  const std::string mesh = folder / "open.obj";
  write_bytes(mesh, obj_text(open));
  TriangleMesh flat = icosphere(1);
  flat.positions.setZero();
  write_bytes(folder / "flat.obj", obj_text(flat));
  for (Words line : reporting_lines(folder, mesh)) {
    const std::string command = line.front();
    if (command == "asset" || command == "survey" || contains(line, "--all-components")) continue;
    if (command == "measure" || command == "wrap") line[1] = folder / "flat.obj";
    if (command == "repair") line.push_back("--repair=unused");
    line.insert(line.end(), {"--json", folder / (command + ".json"), "-q"});
    const Ended ended = sphparam_program(line);
    INFO(as_text(line) << ended.err);
    CHECK(ended.code == 4);
    CHECK(head_of(bytes_of(folder / (command + ".json"))) == head_wanted(command));
  }
}

TEST_CASE(
    "outputs: what the written mesh has no place for is told by map, remesh and bake --from") {
  const Mapped mapped(100);
  const Folder& folder = mapped.folder;
  write_bytes(folder / "a.obj", "mtllib b.mtl\nusemtl red\n" + obj_text(icosphere(1)));
  write_bytes(folder / "b.mtl", "newmtl red\nKd 1 0 0\n");
  const Ended map = sphparam_program({"map", folder / "a.obj", "-o", folder / "a.sph.ply"});
  CHECK_THAT(map.err, Contains("a.sph.ply: not carried: colours and textures of materials"));
  CHECK_THAT(map.err, !Contains("material of faces"));
  const Ended remesh =
      sphparam_program({"remesh", folder / "a.obj", "--grid", "ico:1", "-o", folder / "r.ply"});
  CHECK_THAT(remesh.err, Contains("r.ply: not carried: colours and textures of materials"));
  write_bytes(folder / "b.mtl", "newmtl red\nKd 1 0 0\nmap_Kd red.png\n");
  sphparam::write_image(folder / "red.png", sphparam::Image(4, 2, 3));
  const Ended bake = sphparam_program({"bake", folder / "a.sph.ply", "--from", folder / "a.obj",
                                       "--map", "axes", "--size", "16", "-o", folder / "a.png"});
  CHECK_THAT(bake.err, Contains("a.obj: not carried: tints of textures"));
  write_bytes(folder / "c.ply",
              "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
              "property float z\nproperty float sx\nelement face 4\n"
              "property list uchar int vertex_indices\nend_header\n0 0 0 5\n1 0 0 6\n0 1 0 7\n"
              "0 0 1 8\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  const Ended own = sphparam_program({"map", folder / "c.ply", "-o", folder / "c.sph.ply"});
  CHECK_THAT(own.err, Contains("not carried: sx of vertices: the map's stand there"));
}

TEST_CASE("outputs: numbers under the names of a map's are told by all that write the map") {
  const Folder folder;
  MeshFile file;
  file.mesh = icosphere(2);
  const auto count = size_t(file.mesh.vertex_count());
  file.set_vertex_property({"phi", ScalarType::Float64, std::vector(count, 7.0)});
  const std::string mesh = folder / "a.ply", out = folder / "out.sph.ply", images = folder / "g";
  write_bytes(mesh, serialise_ply(file));
  const std::string told = mesh + ": not carried: phi of vertices: the map's stand there\n";
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"remesh", mesh, "--grid", "ico:2", "-o", out},
           {"match", mesh, mesh, "--alike", "-o", out},
           {"group", mesh, "--hold", "--size", "0", "--grid", "ico:2", "-o", images}}) {
    const Ended ended = sphparam_program(words);
    INFO(words[0] << ": " << ended.err);
    CHECK(ended.code == 0);
    CHECK_THAT(ended.err, Contains(told.substr(told.rfind('/') + 1)));
  }
  REQUIRE(sphparam_program({"map", mesh, "-o", out}).code == 0);
  const Ended again = sphparam_program({"remesh", out, "--grid", "ico:2", "-o", mesh});
  CHECK_THAT(again.err, !Contains("not carried: phi"));  // the map's own
}

TEST_CASE("outputs: a file may be replaced again, and keeps its permissions") {
  const Mapped mapped(100);
  const std::string picture = mapped.folder / "a.png";
  const Words line = {"bake", mapped.path, "--map", "axes", "--size", "16", "-o", picture};
  REQUIRE(sphparam_program(line).code == 0);
  ::chmod(picture.c_str(), 0640);
  REQUIRE(sphparam_program(line).code == 0);
  CHECK((fs::status(picture).permissions() & fs::perms::all) ==
        (fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read));
}

TEST_CASE("outputs: means of what is as large as numbers go are numbers") {
  const Folder folder;
  for (const double reach : {1e160, 1.7e308}) {
    TriangleMesh mesh = icosphere(2);
    mesh.positions.row(80) *= reach;
    write_bytes(folder / "spike.obj", obj_text(mesh));
    const std::string made = folder / "made.ply";
    const Ended ended = sphparam_program(
        {"remesh", folder / "spike.obj", "--grid", "healpix:3", "--sample", "cell", "-o", made});
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    CHECK(read_mesh(made).mesh.positions.allFinite());
  }
}

TEST_CASE("outputs: what 32 bits cannot hold of a very small mesh is refused alike everywhere") {
  const Folder folder;
  for (const double size : {1e-45, 1e-160}) {
    TriangleMesh egg = icosphere(2);
    egg.positions.col(2) *= 1.3;
    egg.positions *= size;
    const std::string mesh = folder / "egg.obj";
    write_bytes(mesh, obj_text(egg));
    const std::string image = folder / "a.png";
    const Words lines[] = {
        {"export", mesh, "-o", folder / "a.glb", "--image-size", "16"},
        {"asset", mesh, "-o", folder / "asset", "--size", "16"},
        {"remesh", mesh, "--grid", "ico:2", "-o", folder / "a.surf.gii"},
        {"remesh", mesh, "--grid", "ico:2", "-o", folder / "a.mz3"},
        {"bake", mesh, "--map", "position", "--size", "16", "-o", image},
        {"bake", mesh, "--map", "height", "--size", "16", "-o", image},
        {"bake", mesh, "--map", "radius", "--size", "16", "-o", image},
        {"bake", mesh, "--map", "elevation", "--body", "1", "--size", "16", "-o", image},
        {"bake", mesh, "--map", "thickness", "--size", "16", "-o", image},
        {"bake", mesh, "--map", "curvature", "--size", "16", "-o", image}};
    for (const Words& line : lines) {
      const Ended ended = sphparam_program(line);
      INFO(line.front() << " " << line.back() << "\n" << ended.err);
      CHECK(ended.code == 4);
      CHECK_THAT(ended.err,
                 Contains(": the mesh is too small for numbers of 32 bits, its extent is ") &&
                     Contains("; scale it"));
      CHECK(folder.names() == Words{"egg.obj"});
    }
    // Texts have doubles, and what has no length is the same for any size.
    TriangleMesh large = egg;
    large.positions /= size;
    write_bytes(folder / "large.obj", obj_text(large));
    for (const char* field : {"normal-object", "ao", "slope", "lonlat", "area"}) {
      std::vector<float> values[2];
      for (const bool small : {false, true}) {
        const Ended ended =
            sphparam_program({"bake", small ? mesh : folder / "large.obj", "--map", field,
                              "--depth", "float", "--size", "16", "-o", folder / "a.exr"});
        INFO(field << "\n" << ended.err);
        CHECK(ended.code == 0);
        values[small] = read_image(folder / "a.exr").pixels;
      }
      int apart = 0;  // a ray may go by an edge on the other side
      for (size_t i = 0; i < values[0].size(); ++i)
        apart += std::abs(values[0][i] - values[1].at(i)) > 1e-3F;
      INFO(field);
      CHECK(apart <= 1);
    }
    const Ended text =
        sphparam_program({"export", mesh, "-o", folder / "b.ply", "--image-size", "16"});
    INFO(text.err);
    CHECK(text.code == 0);
    const Points written = read_mesh(folder / "b.ply").mesh.positions / size,
                 wanted = egg.positions / size;
    CHECK((written.colwise().maxCoeff() - wanted.colwise().maxCoeff()).norm() < 1e-12);
    for (const char* name : {"large.obj", "a.exr", "b.ply", "b_checker.png"})
      CHECK(fs::remove(folder / name));
  }
}

TEST_CASE("outputs: names may be as long as the file system lets them") {
  const Mapped mapped(100);
  const std::string longest = mapped.folder / (std::string(251, 'n') + ".ply");
  const Ended ended = sphparam_program({"remesh", mapped.path, "--grid", "ico:2", "-o", longest});
  INFO(ended.err);
  CHECK(ended.code == 0);
  CHECK(fs::exists(longest));
}

}  // namespace sphparam::tests
