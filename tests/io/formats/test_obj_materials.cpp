#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "io/attributes/material_comments.h"
#include "io/reading.h"
#include "support/folder.h"

using namespace sphparam;
using namespace sphparam::tests;
namespace fs = std::filesystem;

namespace {

/// A folder of its own with an OBJ of two materials, red and wood, and what a test writes beside
/// it.
class ObjFolder {
 public:
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((path() / name).parent_path());
    std::ofstream(path() / name, std::ios::binary) << text;
  }

  MeshFile read_with(const std::string& statement, const std::string& library = "") const {
    write("a.obj", statement +
                       "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                       "usemtl red\nf 1/1 2/2 3/3\nusemtl wood\nf 3/3 2/2 1/1\n");
    if (!library.empty()) write("a.mtl", library);
    return read_mesh(folder_ / "a.obj");
  }

  const fs::path& path() const { return folder_.path; }

 private:
  Folder folder_;
};

}  // namespace

TEST_CASE("obj_materials: base colours are those of the library") {
  const ObjFolder folder;
  const MeshFile file = folder.read_with("mtllib a.mtl",
                                         "# by hand\nnewmtl wood\nKd 0.8 0.8 0.8\nmap_Kd -clamp on "
                                         "-s 1 1 1 -bm 0.5 maps\\my wood.png\n"
                                         "newmtl red\n\tKd 1 0.25 0\nd 0.5\nKs 0 0 0\nillum 2\n");
  REQUIRE(file.base_colours.size() == 2);
  const MaterialTexture &red = file.base_colours[0], &wood = file.base_colours[1];
  CHECK(red.factor == std::array<double, 4>{1, 0.25, 0, 0.5});
  CHECK(red.image.empty());
  CHECK(wood.factor == std::array<double, 4>{1, 1, 1, 1});
  CHECK(wood.image == "maps/my wood.png");
  CHECK(wood.path == "maps/my wood.png");
  CHECK(wood.folder == folder.path().string());
  CHECK(wood.wrap_s == Wrapping::Clamp);
  CHECK(wood.problem.empty());
  CHECK(file.notes.empty());
  CHECK(file.companions == std::vector<std::string>{(folder.path() / "a.mtl").string()});
  CHECK(file.comments ==
        std::vector<std::string>{"base colour of wood: texture maps/my wood.png, Kd 0.8 0.8 0.8"});
  CHECK(diffuse_beside_texture(file, "wood") == std::array<double, 3>{0.8, 0.8, 0.8});
  CHECK_FALSE(diffuse_beside_texture(file, "red"));
  const MeshFile tinted = folder.read_with("mtllib a.mtl",
                                           "newmtl wood\nKd 0.8 0.8 0\nmap_Kd w.png\n"
                                           "newmtl red\nKd 1 0 0\n");
  CHECK(tinted.base_colours.at(1).factor == std::array<double, 4>{1, 1, 1, 1});
  CHECK(tinted.notes ==
        std::vector<std::string>{
            "not carried: tints of textures (Kd beside map_Kd) of 1 of 2 materials"});
}

TEST_CASE("obj_materials: a byte order mark before the first line is no part of it") {
  const ObjFolder folder;
  const MeshFile file = folder.read_with("mtllib a.mtl",
                                         "\xef\xbb\xbf"
                                         "newmtl wood\nKd 0.25 0.5 1\nnewmtl red\nKd 1 0.25 0\n");
  REQUIRE(file.base_colours.size() == 2);
  CHECK(file.base_colours[1].factor == std::array<double, 4>{0.25, 0.5, 1, 1});
}

TEST_CASE("obj_materials: what else they say is told once") {
  const ObjFolder folder;
  const MeshFile file = folder.read_with(
      "mtllib a.mtl",
      "newmtl red\nKs 1 1 1\ndisp b.png\nnewmtl wood\nmap_Ks k.png\nTr 0.25\nKd spectral x\n");
  CHECK(file.notes ==
        std::vector<std::string>{"not carried: displacement and highlights of 2 of 2 materials"});
  CHECK(file.base_colours.at(1).factor == std::array<double, 4>{1, 1, 1, 0.75});
}

TEST_CASE("obj_materials: what would be invisible by Tr is what MeshLab calls opaque") {
  const ObjFolder folder;
  const MeshFile file =
      folder.read_with("mtllib a.mtl", "newmtl red\nTr 1.000000\nnewmtl wood\nd 0.5\nTr 1\n");
  CHECK(file.base_colours.at(0).factor[3] == 1);
  CHECK(file.channels.at(0).alpha_mode == AlphaMode::Opaque);
  CHECK(file.base_colours.at(1).factor[3] == 0.5);
}

TEST_CASE("obj_materials: emission, roughness, metallic and normal maps are channels") {
  const ObjFolder folder;
  const MeshFile file = folder.read_with(
      "mtllib a.mtl",
      "newmtl red\nKe 2 0.5 0\nPr 0.25\nPm 0.75\nd 0.5\nnewmtl wood\nmap_Ke -clamp on e.png\n"
      "map_Pr r.png\nmap_Pm m.png\nnorm n.png\nKe 0 0 0\n");
  REQUIRE(file.channels.size() == 2);
  const MaterialChannels &red = file.channels[0], &wood = file.channels[1];
  CHECK(red.emission.factor == std::array<double, 4>{2, 0.5, 0, 1});
  CHECK(red.roughness.factor[0] == 0.25);
  CHECK(red.metallic.factor[0] == 0.75);
  CHECK(red.alpha_mode == AlphaMode::Blend);
  CHECK(wood.alpha_mode == AlphaMode::Opaque);
  CHECK(wood.emission.factor == std::array<double, 4>{1, 1, 1, 1});
  CHECK(wood.emission.image == "e.png");
  CHECK(wood.emission.wrap_s == Wrapping::Clamp);
  CHECK(wood.roughness.image == "r.png");
  CHECK(wood.roughness.factor[0] == 1);
  CHECK(wood.metallic.path == "m.png");
  CHECK(wood.metallic.factor[0] == 1);
  CHECK(wood.normal.image == "n.png");
  CHECK(file.notes.empty());
  // A material of which nothing is said is rough and no metal.
  const MaterialChannels bare = folder.read_with("mtllib a.mtl", "newmtl red\n").channels.at(0);
  CHECK(bare.roughness.factor[0] == 1);
  CHECK(bare.metallic.factor == std::array<double, 4>{0, 1, 1, 1});
  CHECK(bare.emission.factor == std::array<double, 4>{0, 0, 0, 1});
  // Shares are at most all, and at least nothing.
  const MaterialChannels beyond =
      folder.read_with("mtllib a.mtl", "newmtl red\nPr 1.5\nPm -1\n").channels.at(0);
  CHECK(beyond.roughness.factor[0] == 1);
  CHECK(beyond.metallic.factor[0] == 0);
}

TEST_CASE(
    "obj_materials: bumps are normal maps, an image of alpha is one, coats and sheen a finish") {
  const ObjFolder folder;
  const MeshFile file = folder.read_with(
      "mtllib a.mtl",
      "newmtl red\nbump -bm 0.5 h.png\nmap_d -clamp on a.png\nPc 0.5\nPcr 0.25\nPs 0.75\n"
      "newmtl wood\nmap_Kd -s 2 3 1 -o 0.25 0.5 w.png\nmap_d w.png\nnorm n.png\nmap_Bump b.png\n");
  const MaterialChannels &red = file.channels.at(0), &wood = file.channels.at(1);
  CHECK(red.normal.image == "h.png");
  CHECK(red.normal.bump == 0.5);
  CHECK(red.opacity.image == "a.png");
  CHECK(red.opacity.wrap_s == Wrapping::Clamp);
  CHECK(red.alpha_mode == AlphaMode::Blend);
  CHECK(red.finish.clearcoat == 0.5);
  CHECK(red.finish.clearcoat_roughness == 0.25);
  CHECK(red.finish.sheen == std::array<double, 3>{0.75, 0.75, 0.75});
  // Its colours have alpha of their own; a normal map wins over bumps.
  CHECK(wood.opacity.image.empty());
  CHECK(wood.alpha_mode == AlphaMode::Blend);
  CHECK(wood.normal.image == "n.png");
  CHECK(wood.normal.bump == 0);
  CHECK(file.base_colours.at(1).placement == TexturePlacement{{{2, 0, 0.25}, {0, 3, 0.5}}});
  CHECK(file.base_colours.at(1).problem.empty());
  CHECK(file.notes.empty());
  const MeshFile flat = folder.read_with("mtllib a.mtl", "newmtl red\nbump -bm 0 h.png\n");
  CHECK(flat.channels.at(0).normal.image.empty());
}

TEST_CASE("obj_materials: names that lead elsewhere mean the file beside the library") {
  const ObjFolder folder;
  folder.write("lib/b.mtl",
               "newmtl red\nmap_Kd C:\\Users\\me\\red.png\nnewmtl wood\nmap_Kd ../../w.png\n");
  const MeshFile file = folder.read_with("mtllib lib/b.mtl");
  CHECK(file.base_colours.at(0).path == "lib/red.png");
  CHECK(file.base_colours.at(1).path == "lib/w.png");
  CHECK(file.base_colours.at(0).problem ==
        "'C:\\Users\\me\\red.png' leads to another folder, which is not followed: copy it "
        "beside the file that names it");
  folder.write("lib/w.jpg", "");
  folder.write("lib/red.png", "");
  const MeshFile other = folder.read_with("mtllib lib/b.mtl");
  CHECK(other.base_colours.at(0).problem.empty());
  CHECK(other.base_colours.at(1).problem ==
        "'../../w.png' leads to another folder, which is not followed; there is no file of that "
        "name; beside it is 'w.jpg'");
  // A colon that is no drive's leads nowhere.
  folder.write("c.mtl", "newmtl red\nmap_Kd a:b.png\n");
  CHECK(folder.read_with("mtllib c.mtl").base_colours.at(0).problem.empty());
}

TEST_CASE("obj_materials: several libraries, and names with blanks") {
  const ObjFolder folder;
  folder.write("my red.mtl", "newmtl red\nKd 1 0 0\n");
  folder.write("wood.mtl", "newmtl wood\nKd 0 1 0\n");
  folder.write("red.mtl", "newmtl red\nKd 0 0 1\n");
  CHECK(folder.read_with("mtllib my red.mtl\nmtllib wood.mtl").base_colours.at(0).factor[0] == 1);
  const MeshFile both = folder.read_with("mtllib red.mtl wood.mtl");
  CHECK(both.base_colours.at(0).factor[2] == 1);
  CHECK(both.base_colours.at(1).factor[1] == 1);
}

TEST_CASE("obj_materials: a library that cannot be read leaves the mesh, and is told") {
  const ObjFolder folder;
  const MeshFile missing = folder.read_with("mtllib a.mtl");
  CHECK(missing.base_colours.empty());
  CHECK(missing.mesh.face_count() == 2);
  REQUIRE(missing.notes.size() == 1);
  CHECK(contains(missing.notes[0], "2 materials in 'a.mtl' (No such file or directory)"));
  const MeshFile binary = folder.read_with("mtllib a.mtl", std::string("newmtl red\n\0", 12));
  REQUIRE(binary.notes.size() == 1);
  CHECK(contains(binary.notes[0], "'a.mtl' ("));
  CHECK(folder.read_with("mtllib a.mtl", "Kd 1 0 0\nnewmtl other\n").base_colours.empty());
  const MeshFile moved = folder.read_with("mtllib a.mtl", "newmtl wood\nmap_Kd -o 1e9 0 0 x.png\n");
  CHECK(contains(moved.base_colours.at(1).problem, "beyond what can be looked up"));
  REQUIRE(moved.notes.size() == 1);
  CHECK(contains(moved.notes[0], "materials 'red' are white"));
}

TEST_CASE("obj_materials: a line that makes no sense is passed over, the rest is read") {
  const ObjFolder folder;
  const MeshFile file = folder.read_with(
      "mtllib a.mtl",
      "newmtl red\nKd nan 0 0\nd 1e999\nmap_Kd -o 1e-310 0 0 r.png\nnewmtl wood\nKd 0 1 0\n");
  CHECK(file.base_colours.at(0).factor == std::array<double, 4>{1, 1, 1, 1});
  CHECK(file.base_colours.at(0).image == "r.png");
  CHECK(file.base_colours.at(1).factor[1] == 1);
  CHECK(file.notes.empty());
}

TEST_CASE("obj_materials: of several libraries the later one wins, and a missing one is told") {
  const ObjFolder folder;
  folder.write("z.mtl", "newmtl red\nKd 1 0 0\nnewmtl wood\n");
  folder.write("b.mtl", "newmtl red\nKd 0 0 1\n");
  CHECK(folder.read_with("mtllib z.mtl\nmtllib b.mtl").base_colours.at(0).factor[2] == 1);
  const MeshFile file = folder.read_with("mtllib z.mtl x.mtl");
  REQUIRE(file.notes.size() == 1);
  CHECK(contains(file.notes[0], "'x.mtl' (No such file or directory)"));
}

TEST_CASE("obj_materials: keywords in any case are those that they are") {
  const ObjFolder folder;
  const MeshFile file = folder.read_with(
      "mtllib a.mtl", "NEWMTL red\nkd 1 0.25 0\nTR 0.5\nnewmtl wood\nmap_kd w.png\nKS 1 1 1\n");
  CHECK(file.base_colours.at(0).factor == std::array<double, 4>{1, 0.25, 0, 0.5});
  CHECK(file.base_colours.at(1).image == "w.png");
  CHECK(file.notes == std::vector<std::string>{"not carried: highlights of 1 of 2 materials"});
}

TEST_CASE("obj_materials: names that differ in case from the one file there are taken, and told") {
  const ObjFolder folder;
  folder.write("Maps/Page 1.JPG", "");
  folder.write("Lib.MTL", "newmtl wood\nmap_Kd maps\\page 1.jpg\nnewmtl red\nmap_Kd w.png\n");
  const MeshFile file = folder.read_with("mtllib lib.mtl");
  REQUIRE(file.base_colours.size() == 2);
  CHECK(file.base_colours[1].image == "Maps/Page 1.JPG");
  CHECK(file.base_colours[1].path == "Maps/Page 1.JPG");
  CHECK(file.base_colours[1].problem.empty());
  CHECK(file.companions == std::vector<std::string>{(folder.path() / "Lib.MTL").string()});
  CHECK(file.notes ==
        std::vector<std::string>{"names of files that differ in case on the disk: 'lib.mtl' is "
                                 "'Lib.MTL' and 'maps/page 1.jpg' is 'Maps/Page 1.JPG'"});
}

TEST_CASE("obj_materials: a file that may be meant by a name that none has is named") {
  const ObjFolder folder;
  const auto wood = [&](const std::string& name) {
    return folder.read_with("mtllib a.mtl", "newmtl wood\nmap_Kd " + name + "\n")
        .base_colours.at(1);
  };
  CHECK(wood("page.jpg").problem.empty());
  folder.write("Page.png", "");
  CHECK(wood("page.jpg").problem == "there is no file of that name; beside it is 'Page.png'");
  folder.write("PAGE.jpg", "");
  CHECK(wood("page.jpg").path == "PAGE.jpg");
  folder.write("Page.jpg", "");
  CHECK(wood("page.jpg").path == "page.jpg");
  CHECK(wood("page.jpg").problem ==
        "there is no file of that name; beside it are 'PAGE.jpg' and 'Page.jpg'");
  folder.write("page.jpg", "");
  CHECK(wood("page.jpg").problem.empty());
}

TEST_CASE("obj_materials: quotes about a name are none of it, where no file is called so") {
  const ObjFolder folder;
  const auto wood = [&](const std::string& name) {
    return folder.read_with("mtllib a.mtl", "newmtl wood\nmap_Kd " + name + "\n")
        .base_colours.at(1)
        .path;
  };
  CHECK(wood("\"my wood.png\"") == "my wood.png");
  CHECK(wood("'w.png'") == "w.png");
  CHECK(wood("\"w.png'") == "\"w.png'");
  folder.write("'w.png'", "");
  CHECK(wood("'w.png'") == "'w.png'");
}

TEST_CASE("obj_materials: (null) is a material where a library has it, else none") {
  const ObjFolder folder;
  folder.write("n.obj", "mtllib n.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl (null)\nf 1 2 3\n");
  folder.write("n.mtl", "newmtl (null)\nKd 1 0.25 0\n");
  const MeshFile named = read_mesh((folder.path() / "n.obj").string());
  CHECK(named.materials == std::vector<std::string>{"(null)"});
  REQUIRE(named.base_colours.size() == 1);
  CHECK(named.base_colours[0].factor == std::array<double, 4>{1, 0.25, 0, 1});
  folder.write("n.mtl", "newmtl wood\nKd 1 0.25 0\n");
  CHECK(read_mesh((folder.path() / "n.obj").string()).materials.empty());
}
