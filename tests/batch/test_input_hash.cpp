#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "batch/content_hash.h"
#include "batch/input_hash.h"
#include "io/files/gzip.h"
#include "support/folder.h"

/// What tells that an input is another one than before: its bytes, and the files it is read from.
namespace sphparam::tests {

namespace {

namespace fs = std::filesystem;

class Inputs {
 public:
  Inputs() { fs::create_directories(folder_ / "maps"); }

  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }

  std::string link(const std::string& name, const std::string& target) const {
    fs::create_symlink(target, folder_ / name);
    return folder_ / name;
  }

  /// Does the content of the file count for the input, from when it is there?
  bool counts(const std::string& file, const std::string& input) const {
    const InputHash without = hash_of_input(input);
    if (without.alone) return false;
    write(file, "one");
    const std::string one = hash_of_input(input).hash;
    write(file, "two");
    const std::string two = hash_of_input(input).hash;
    fs::remove(folder_ / file);
    return without.hash != one && one != two && two != without.hash &&
           hash_of_input(input).hash == without.hash;
  }

 private:
  const Folder folder_;
};

/// "RelativeFilename" and its text as a binary FBX has them.
std::string fbx_property(const std::string& text) {
  return "\x10RelativeFilenameS" + std::string(1, static_cast<char>(text.size())) +
         std::string(3, '\0') + text;
}

}  // namespace

TEST_CASE("input hash: a file that names no others has its own, and its stamp may be trusted") {
  const Inputs in;
  for (const auto& [name, text] :
       {std::pair<std::string, std::string>{"a.obj", "v 0 0 0\n# mtllib of old\nvmtllib x\n"},
        {"a.gltf", R"({"buffers": [{"uri": "data:application/octet-stream;base64,AAAA"}]})"},
        {"broken.gltf", R"({"buffers": [)"},
        {"broken.glb", "glTF\2"},
        {"a.ply", "ply\n"},
        {"empty.ply", ""}}) {
    const std::string path = in.write(name, text);
    CHECK(hash_of_input(path).alone);
    CHECK(hash_of_input(path).hash == hash_of_file(path));
  }
}

TEST_CASE(
    "input hash: while what is named is not there it is the file's, and no stamp is trusted") {
  const Inputs in;
  const std::string path = in.write("a.obj", "mtllib a.mtl\nv 0 0 0\n");
  CHECK_FALSE(hash_of_input(path).alone);
  CHECK(hash_of_input(path).hash == hash_of_file(path));
}

TEST_CASE("input hash: buffers and images of glTF count") {
  const Inputs in;
  const std::string json =
      R"({"buffers": [{"byteLength": 3, "uri": "a%20b.bin"}], "images": [{"uri": "maps/c.png"}]})";
  const std::string text = in.write("a.gltf", json);
  CHECK(in.counts("a b.bin", text));
  CHECK(in.counts("maps/c.png", text));
  CHECK_FALSE(in.counts("other.bin", text));
  CHECK(in.counts("a b.bin", in.write("b.gltf.gz", zip(json))));
  const auto word = [](std::size_t n) {
    return std::string{static_cast<char>(n), static_cast<char>(n >> 8), 0, 0};
  };
  const std::string padded = json + std::string((4 - json.size() % 4) % 4, ' ');
  CHECK(in.counts("maps/c.png", in.write("a.glb", "glTF" + word(2) + word(20 + padded.size()) +
                                                      word(padded.size()) + "JSON" + padded)));
}

TEST_CASE("input hash: libraries of OBJ and their images count") {
  const Inputs in;
  const std::string path = in.write("a.obj", "\xEF\xBB\xBFmtllib \\\r\n a.mtl\r\nv 0 0 0\n");
  CHECK(in.counts("a.mtl", path));
  in.write("a.mtl", "newmtl m\nmap_Kd -s 1 1 1 maps\\c d.png\nnorm n.png\n");
  CHECK(in.counts("maps/c d.png", path));
  CHECK(in.counts("n.png", path));
}

TEST_CASE("input hash: of a link what lies beside the file that it leads to counts, too") {
  const Inputs in;
  in.write("maps/a.obj", "mtllib a.mtl\nv 0 0 0\n");
  in.write("maps/a.gltf", R"({"buffers": [{"byteLength": 3, "uri": "a.bin"}]})");
  const std::string obj = in.link("link.obj", "maps/a.obj"),
                    gltf = in.link("link.gltf", "maps/a.gltf");
  CHECK(in.counts("maps/a.mtl", obj));
  CHECK(in.counts("a.mtl", obj));
  CHECK(in.counts("maps/a.bin", gltf));
  in.write("maps/a.mtl", "newmtl m\nmap_Kd c.png\n");
  CHECK(in.counts("maps/c.png", obj));
  in.write("a.mtl", "");
  CHECK(in.counts("maps/c.png", obj));
  CHECK(hash_of_input(in.link("alone.obj", "a.mtl")).alone);
}

TEST_CASE("input hash: images that comments of PLY name count") {
  const Inputs in;
  const std::string header =
      "ply\r\ncomment TextureFile maps\\a b.png\r\ncomment TextureFile c.png";
  const std::string path =
      in.write("a.ply", header + "\r\nend_header\r\ncomment TextureFile d.png\n");
  CHECK(in.counts("maps/a b.png", path));
  CHECK(in.counts("c.png", path));
  CHECK_FALSE(in.counts("d.png", path));
  CHECK(in.counts("c.png", in.write("b.ply.gz", zip(header))));
  // Behind the header nothing is unpacked, nor found to be damaged.
  std::string noise;
  for (std::uint32_t i = 1, x = 1; i < 1u << 22; ++i)
    noise += static_cast<char>((x = x * 1664525 + 1013904223) >> 24);
  const std::string whole = zip(header + "\nend_header\n" + noise);
  CHECK(in.counts("c.png", in.write("c.ply.gz", whole.substr(0, whole.size() / 2))));
}

TEST_CASE("input hash: a statement of OBJ over thousands of lines is read once") {
  const Inputs in;
  std::string text;
  for (int i = 0; i < 3000; ++i) text += "mtllib \\\n";
  CHECK(in.counts("a.mtl", in.write("a.obj", text + "a.mtl\nmtllib b.mtl\nv 0 0 0\n")));
  CHECK(in.counts("b.mtl", in.write("a.obj", text + "a.mtl\nmtllib b.mtl\nv 0 0 0\n")));
}

TEST_CASE("input hash: images of COLLADA and FBX count, wherever they were") {
  const Inputs in;
  const std::string dae = in.write(
      "a.dae",
      "<?xml version=\"1.0\"?><COLLADA><image><init_from>C:\\work\\c.png</init_from></image>"
      "<image><init_from><ref>maps/d%20e.png</ref></init_from></image></COLLADA>");
  CHECK(in.counts("c.png", dae));
  CHECK(in.counts("maps/d e.png", dae));
  const std::string signs =
      in.write("b.dae",
               "<COLLADA><image><init_from sid=\"x\">\n  maps/a&amp;b.png\r\n</init_from></image>"
               "<image><init_from>\n<ref>a&lt;&apos;&amp;lt;.png</ref></init_from></image>"
               "<init_from_other>c.png</init_from_other><init_from/></COLLADA>");
  CHECK(in.counts("maps/a&b.png", signs));
  CHECK(in.counts("a<'&lt;.png", signs));
  CHECK_FALSE(in.counts("c.png", signs));
  const std::string fbx = in.write("a.fbx", "Kaydara FBX Binary  " + fbx_property("maps\\c.png"));
  CHECK(in.counts("maps/c.png", fbx));
  const std::string text =
      in.write("b.fbx", "; FBX 7.4.0 project file\nRelativeFilename: \"../c.png\"\n");
  CHECK(in.counts("c.png", text));
}

}  // namespace sphparam::tests
