#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <set>

#include "batch/shape_id.h"
#include "batch/tables.h"
#include "sphparam/batch/inputs.h"
#include "support/folder.h"

/// What a batch is made of, found in folders, lists and tables.
namespace sphparam::tests {

namespace {

namespace fs = std::filesystem;
using Catch::Contains;

struct TreeOfFiles {
  const Folder folder;
  const fs::path root = folder.path;

  explicit TreeOfFiles(const std::vector<std::string>& files) {
    for (const std::string& file : files) write(file, "x");
  }

  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((root / name).parent_path());
    std::ofstream(root / name, std::ios::binary) << text;
  }
  std::vector<std::string> ids(const std::string& place, const std::string& surface = "white") {
    std::vector<std::string> ids;
    for (const BatchInput& shape : find_batch_inputs({(root / place).string()}, {surface}).shapes)
      ids.push_back(shape.id);
    return ids;
  }
};

using Ids = std::vector<std::string>;

}  // namespace

TEST_CASE("inputs: a folder is its meshes, below it too, and nothing else") {
  TreeOfFiles tree({"b.obj", "a.ply", "notes.txt", ".hidden.ply", "deep/er/c.sph.ply"});
  CHECK(tree.ids("") == Ids{"a", "b", "c"});
}

TEST_CASE("inputs: a folder of texts is told how shape models among them are named") {
  TreeOfFiles tree({"in/eros.txt", "in/notes.txt"});
  CHECK_THROWS_WITH(tree.ids("in"),
                    Contains("no mesh in this folder; 2 files are called *.txt: shape models of "
                             "bodies among them are named by a pattern, as '") &&
                        Contains("in/*.txt'"));
  CHECK(tree.ids("in/*.txt") == Ids{"eros.txt", "notes.txt"});
}

TEST_CASE("inputs: meshes of one name are told apart by as many folders as it takes") {
  TreeOfFiles tree({"x/left/m.ply", "y/left/m.ply", "only.ply"});
  CHECK(tree.ids("") == Ids{"only", "x_left_m", "y_left_m"});
}

TEST_CASE("inputs: FreeSurfer's subjects, the surface that is wanted, left before right") {
  TreeOfFiles tree({"s2/surf/lh.white", "s2/surf/rh.white", "s1/surf/rh.white.gii",
                    "s1/surf/rh.white", "s1/surf/lh.pial", "fsaverage.txt"});
  CHECK(tree.ids("") == Ids{"s1_rh_white", "s2_lh_white", "s2_rh_white"});
  CHECK(tree.ids("", "pial") == Ids{"s1_lh_pial"});
  const auto inputs = find_batch_inputs({tree.root.string()});
  CHECK_THAT(inputs.shapes.front().path, Contains("rh.white.gii"));
}

TEST_CASE(
    "inputs: subjects without the surface that is wanted are told, and refused where all are") {
  TreeOfFiles tree({"s1/surf/lh.white", "s1/surf/lh.pial", "s2/surf/lh.white", "s3/surf/rh.white"});
  const auto inputs = find_batch_inputs({tree.root.string()}, {"pial"});
  CHECK(inputs.shapes.size() == 1);
  CHECK(inputs.notes ==
        Ids{"2 subjects are left out (s2, s3) of 3, without the surface pial",
            "1 subject of 3 without rh.pial, with the other hemisphere alone (s1)"});
  CHECK_THROWS_WITH(tree.ids("", "inflated"),
                    Contains("none of 3 subjects") && Contains("--surface"));
  CHECK(tree.ids("") == Ids{"s1_lh_white", "s2_lh_white", "s3_rh_white"});
}

TEST_CASE("inputs: subjects of one hemisphere are told, and folders that have no surface at all") {
  TreeOfFiles tree({"s1/surf/lh.white", "s1/surf/rh.white", "s2/surf/lh.white", "s3/surf/rh.white",
                    "s4/mri/orig.mgz", "s6/surf/notes.txt", "work/results/a/a.ply",
                    "work/staging/x", "work/failed/y", "list.txt"});
  fs::create_directories(tree.root / "s5/surf");
  const auto inputs = find_batch_inputs({tree.root.string()});
  CHECK(inputs.shapes.size() == 4);
  CHECK(inputs.notes == Ids{"1 subject of 3 without lh.white, with the other hemisphere alone (s3)",
                            "1 subject of 3 without rh.white, with the other hemisphere alone (s2)",
                            "3 folders are left out (s4, s5, s6) as what has no surface in surf/"});
}

TEST_CASE("inputs: in a folder, what cannot be read and what batches made is left out and told") {
  TreeOfFiles tree({"a.ply", "work/mine.ply", "work/results/a/a.sph.ply", "work/failed/b.json",
                    "work/staging/x/files/c.ply", "results/d.ply"});
  fs::create_symlink("nowhere", tree.root / "gone.ply");
  const auto inputs = find_batch_inputs({tree.root.string()});
  CHECK(tree.ids("") == Ids{"a", "d", "mine"});
  REQUIRE(inputs.notes.size() == 2);
  CHECK_THAT(inputs.notes[0], Contains("gone.ply"));
  CHECK_THAT(inputs.notes[1], Contains("work/results"));
  CHECK(tree.ids("work/results") == Ids{"a"});
  CHECK_THROWS_WITH(tree.ids("gone.ply"), Contains("no such file"));
}

TEST_CASE("inputs: of two files of one name, those that lie in one folder are told") {
  TreeOfFiles tree({"1/part.stl", "2/part.obj", "2/part.stl"});
  CHECK_THROWS_WITH(tree.ids(""), Contains("2/part.obj and") && Contains("2/part.stl"));
}

TEST_CASE("inputs: a BIDS data set has the surfaces of its subjects") {
  TreeOfFiles tree({"dataset_description.json", "sub-1/anat/sub-1_hemi-L_white.surf.gii",
                    "sub-1/anat/sub-1_hemi-L_pial.surf.gii", "other/mesh.ply"});
  CHECK(tree.ids("") == Ids{"sub-1_hemi-L_white"});
  CHECK_THROWS_WITH(tree.ids("", "inflated"), Contains("--surface"));
}

TEST_CASE("inputs: a list is relative to itself, has remarks, and all it names must be there") {
  TreeOfFiles tree({"in/a.ply", "in/b c.ply"});
  tree.write("in/list.txt", "# two\na.ply\r\n\nb c.ply  # with a blank\n");
  CHECK(tree.ids("in/list.txt") == Ids{"a", "b_c"});
  tree.write("in/list.txt",
             "\xEF\xBB\xBF"
             "a.ply\t# the first\n  # none\nb c.ply\n");
  CHECK(tree.ids("in/list.txt") == Ids{"a", "b_c"});
  tree.write("in/list.txt", "a.ply\nnot_there.ply\n");
  CHECK_THROWS_WITH(tree.ids("in/list.txt"),
                    Contains("of which 1 is not there") && Contains("not_there.ply"));
  tree.write("in/letter.txt", "Dear reader,\n" + std::string(5000, 'x') + "\n");
  CHECK_THROWS_WITH(tree.ids("in/letter.txt"), Contains("letter.txt was read as a list of paths"));
  tree.write("in/list.txt", "a.ply\n./a.ply\n");
  CHECK_THROWS_WITH(tree.ids("in/list.txt"), Contains("once"));
}

TEST_CASE("inputs: a shape model of a body is a mesh, and no list, where it is called .txt") {
  TreeOfFiles tree({"other.ply"});
  tree.write("plates.txt", "4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n4\n1 3 2\n1 2 4\n1 4 3\n2 3 4\n");
  CHECK(tree.ids("plates.txt") == Ids{"plates.txt"});
  tree.write("list.txt", "plates.txt\n");
  CHECK(tree.ids("list.txt") == Ids{"plates.txt"});
}

TEST_CASE("inputs: a sign of remarks within a name of a list belongs to the name") {
  TreeOfFiles tree({"a#1.ply", "b.ply"});
  tree.write("list.txt", "a#1.ply # remark\nb.ply ## more\n");
  CHECK(tree.ids("list.txt") == Ids{"a_1", "b"});
}

TEST_CASE("inputs: a table has ids and columns of its own") {
  TreeOfFiles tree({"a.ply", "b.ply"});
  tree.write("t.csv", "id, path,pins\nfirst,a.ply,\"x, \"\"y\"\".txt\"\nsecond,b.ply,\n");
  const auto inputs = find_batch_inputs({(tree.root / "t.csv").string()});
  CHECK(inputs.columns == Ids{"pins"});
  REQUIRE(inputs.shapes.size() == 2);
  CHECK(inputs.shapes[0].id == "first");
  CHECK(inputs.shapes[0].values == Ids{"x, \"y\".txt"});
  tree.write("t.csv", "id,path\nfirst,a.ply,too much\n");
  CHECK_THROWS_WITH(tree.ids("t.csv"), Contains("t.csv:2: 3 fields, the header has 2"));
  tree.write("t.csv", "id,file\nfirst,a.ply\n");
  CHECK_THROWS_WITH(tree.ids("t.csv"), Contains("no column `path`") && !Contains("separated"));
  tree.write("t.csv", "id;path\nfirst;a.ply\n");
  CHECK_THROWS_WITH(tree.ids("t.csv"),
                    Contains("no column `path` among id;path: columns are separated by commas, or "
                             "by tabs in a .tsv"));
  tree.write("t.csv", "path\n\"a.ply\n");
  CHECK_THROWS_WITH(tree.ids("t.csv"), Contains("quote that does not end"));
}

TEST_CASE("inputs: letters of any alphabet stay in ids, what is none is told apart by a hash") {
  TreeOfFiles tree({"日本.off", "中国.off", "a b.off", "a_b.off", "é.off", "è.off"});
  const Ids ids = tree.ids("");
  REQUIRE(ids.size() == 6);
  CHECK(std::set<std::string>(ids.begin(), ids.end()).size() == 6);
  CHECK(std::ranges::count(ids, "a_b") == 1);
  CHECK(std::ranges::count(ids, "日本") == 1);
  CHECK(std::ranges::count_if(ids, [](const std::string& id) {
          return id.starts_with("a_b_") && id.size() == 12;
        }) == 1);
}

TEST_CASE("inputs: ids that no folder can be called by") {
  const std::string name(230, 'n');
  TreeOfFiles tree({name + ".off", "a.off"});
  const Ids ids = tree.ids("");
  CHECK(ids.front() == "a");
  CHECK(ids.back().size() == 100);
  CHECK(ids.back().starts_with("nnn"));
  std::string wide = "甲乙丙";
  for (int i = 0; i < 33; ++i) wide.insert(0, "一");
  CHECK(shape_id_of(wide).find('_') != std::string::npos);
  CHECK(shape_id_of("a\xE0\x81\x81z") == "a___z");
  CHECK(shape_id_of("-statue") == "_-statue");  // steps would take {id}.ply for an option
  for (const std::string bad : {"b ü", "\"a,b\"", ".a", "-a", "a\xff", "a\u00a0b"}) {
    tree.write("t.csv", "id,path\n" + bad + ",a.off\n");
    CHECK_THROWS_WITH(tree.ids("t.csv"), Contains("names a folder"));
  }
  tree.write("t.csv", "id,path\nü-1.x,a.off\n");
  CHECK(tree.ids("t.csv") == Ids{"ü-1.x"});
}

TEST_CASE("inputs: a folder that links lead to is looked into once, also where they go round") {
  TreeOfFiles tree({"in/a.ply", "elsewhere/b.ply"});
  std::filesystem::create_directory_symlink(".", tree.root / "in/loop");
  std::filesystem::create_directory_symlink("../elsewhere", tree.root / "in/more");
  CHECK(tree.ids("in") == Ids{"a", "b"});
}

TEST_CASE("inputs: links that go round and names that are too long are no files, and no error") {
  TreeOfFiles tree({"in/a.ply", "subjects/s1/surf/lh.white"});
  std::filesystem::create_symlink("round", tree.root / "in/round");
  CHECK(tree.ids("in") == Ids{"a"});
  CHECK(tree.ids("in/*") == Ids{"a"});
  CHECK_THROWS_AS(tree.ids("subjects", std::string(300, 's')), BatchInputError);
  CHECK_THROWS_AS(tree.ids(std::string(300, 'n')), BatchInputError);
}

TEST_CASE("inputs: patterns, and places where nothing is") {
  TreeOfFiles tree({"a.ply", "b.ply", "c.obj"});
  CHECK(tree.ids("*.ply") == Ids{"a", "b"});
  CHECK_THROWS_WITH(tree.ids("*.stl"), Contains("no file matches"));
  CHECK_THROWS_WITH(tree.ids("nowhere"), Contains("no such file or folder"));
}

TEST_CASE("inputs: fields of manifests and tables come back as they were") {
  const std::string odd = "a\tb\\c\nd\re, \"f\"";
  CHECK(tsv_fields(tsv_field(odd) + "\t" + tsv_field("")) == Ids{odd, ""});
  CHECK(read_table("h\n" + csv_field(odd) + "\n", ',', "t").rows ==
        std::vector<std::vector<std::string>>{{odd}});
}

}  // namespace sphparam::tests
