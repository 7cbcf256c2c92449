#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "reading.h"
#include "sphparam/io/brain_names.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/vertex_data.h"
#include "support/folder.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

VertexData read_values(const std::string& bytes, const std::string& name,
                       Eigen::Index vertices = 0) {
  return read_vertex_data(bytes, name, vertices);
}

std::string values_complaint(const std::string& bytes, const std::string& name,
                             Eigen::Index vertices = 0) {
  try {
    read_values(bytes, name, vertices);
  } catch (const ReadError& error) {
    return error.what();
  }
  return {};
}

std::string writing_complaint(const std::string& name, const VertexData& data) {
  try {
    serialise_vertex_data(name, data);
  } catch (const WriteError& error) {
    return error.what();
  }
  return {};
}

VertexData thickness() {
  VertexData data;
  data.name = "thickness";
  data.columns.push_back({"thick", ScalarType::Float32, {1.5, 2.25, 0, -3}});
  return data;
}

VertexData lobes() {
  VertexData data;
  data.name = "lobes";
  data.kind = DataKind::Labels;
  data.columns.push_back({"lobes", ScalarType::Int32, {0, 2, 1, 2}});
  data.labels = {{0, {{0, 0, 0, 0}}, "???"},
                 {1, {{1, 0, 0, 1}}, "frontal"},
                 {2, {{0, 0.2F, 1, 1}}, "parietal"}};
  return data;
}

std::string int32(int value) {
  std::string bytes(4, '\0');
  for (int i = 0; i < 4; ++i)
    bytes[static_cast<size_t>(i)] =
        static_cast<char>((static_cast<unsigned>(value) >> (24 - 8 * i)) & 255U);
  return bytes;
}

std::string text(const std::string& words) {
  return int32(static_cast<int>(words.size()) + 1) + words + std::string(1, '\0');
}

/// As FreeSurfer writes it; vertices in an order of their own.
std::string annotation() {
  const int red = 255, blue = 255 << 16;
  return int32(3) + int32(2) + int32(red) + int32(0) + int32(blue) + int32(1) + int32(0) +
         int32(1) + int32(-2) + int32(3) + text("table.txt") + int32(2) + int32(0) +
         text("frontal") + int32(255) + int32(0) + int32(0) + int32(0) + int32(2) + text("blue") +
         int32(0) + int32(0) + int32(255) + int32(0);
}

void check_same(const VertexData& a, const VertexData& b) {
  REQUIRE(a.columns.size() == b.columns.size());
  CHECK(a.kind == b.kind);
  for (size_t k = 0; k < a.columns.size(); ++k) CHECK(a.columns[k].values == b.columns[k].values);
  REQUIRE(a.labels.size() == b.labels.size());
  for (size_t i = 0; i < a.labels.size(); ++i) {
    CHECK(a.labels[i].key == b.labels[i].key);
    CHECK(a.labels[i].name == b.labels[i].name);
    CHECK(a.labels[i].colour == b.labels[i].colour);
  }
}

}  // namespace

TEST_CASE("vertex_data: measures come back from every format that has them") {
  for (const char* name :
       {"lh.thickness", "x.curv", "a.shape.gii", "a.mgh", "a.mgz", "a.func.gii.gz"}) {
    INFO(name);
    const VertexData again = read_values(serialise_vertex_data(name, thickness()), name, 4);
    check_same(again, thickness());
    CHECK(again.notes.empty());
    CHECK(serialise_vertex_data(name, again) == serialise_vertex_data(name, thickness()));
  }
}

TEST_CASE("vertex_data: labels come back with their table") {
  for (const char* name : {"a.label.gii", "lh.lobes.annot"}) {
    INFO(name);
    const VertexData again = read_values(serialise_vertex_data(name, lobes()), name);
    check_same(again, lobes());
    CHECK(serialise_vertex_data(name, again) == serialise_vertex_data(name, lobes()));
  }
}

TEST_CASE("vertex_data: curv is laid out as FreeSurfer has it, and keeps its number of triangles") {
  VertexData data = thickness();
  data.triangles = 6;
  const std::string bytes = serialise_vertex_data("lh.thickness", data);
  CHECK(bytes.starts_with("\xff\xff\xff" + int32(4) + int32(6) + int32(1) +
                          std::string("\x3f\xc0\0\0", 4)));
  CHECK(read_values(bytes, "lh.thickness").triangles == 6);
  CHECK(contains(values_complaint(bytes, "lh.thickness", 5), "4 vertices, and the surface has 5"));
  CHECK(contains(values_complaint(bytes.substr(0, 20), "lh.thickness"), "ends within"));
}

TEST_CASE("vertex_data: values may be missing where they are measured") {
  VertexData data = thickness();
  data.columns[0].values[1] = missing;
  for (const char* name : {"lh.thickness", "a.shape.gii", "a.mgz"}) {
    const VertexData again = read_values(serialise_vertex_data(name, data), name);
    CHECK(std::isnan(again.columns[0].values[1]));
    CHECK(again.columns[0].values[3] == -3);
  }
  std::vector<std::string> losses;
  CHECK(without_missing(data, losses).columns.empty());
  CHECK(losses.at(0) == "not carried: 'thickness': 1 of 4 values are no finite numbers");
}

TEST_CASE("vertex_data: an annotation has its labels by colour, in any order of vertices") {
  const VertexData data = read_values(annotation(), "lh.a.annot");
  CHECK(data.columns[0].values == std::vector<double>{2, -1, 0});
  REQUIRE(data.labels.size() == 3);
  CHECK(data.labels[0].name == "???");  // the table has a key 0, which is something else
  CHECK(data.labels[0].key == -1);
  CHECK(data.labels[2].name == "blue");
  CHECK(data.structure == "CortexLeft");
  const std::string bytes = serialise_vertex_data("lh.b.annot", data);
  const VertexData again = read_values(bytes, "lh.b.annot");
  check_same(again, data);
  CHECK(again.notes.empty());
  CHECK(contains(bytes, "table.txt"));
}

TEST_CASE("vertex_data: colours that the table of an annotation lacks are told") {
  std::string bytes = annotation();
  bytes.replace(8, 4, int32(77));
  const VertexData data = read_values(bytes, "lh.a.annot");
  CHECK(losses_among(data.notes).at(0) ==
        "not carried: labels of 1 of 3 vertices: the colour table has no such colours");
  CHECK(data.columns[0].values[2] == -1);
  bytes.replace(4, 4, int32(1));
  CHECK(contains(values_complaint(bytes, "lh.a.annot"), "names vertex 1 twice"));
  CHECK(contains(values_complaint(annotation().substr(0, 28), "lh.a.annot"), "no colour table"));
}

TEST_CASE(
    "vertex_data: labels of one colour, which the vertices of an annotation cannot be of, are "
    "told") {
  const std::string blue_too = text("azure") + int32(0) + int32(0) + int32(255) + int32(0);
  const auto with = [&](const std::string& label) {
    return replaced(annotation() + int32(3) + label, int32(2) + int32(0) + text("frontal"),
                    int32(3) + int32(0) + text("frontal"));
  };
  const VertexData data = read_values(with(blue_too), "lh.a.annot");
  CHECK(data.notes == std::vector<std::string>{
                          "not carried: vertices of 'azure': 1 of 3 vertices have one colour with "
                          "'blue', and are taken for it"});
  CHECK(data.labels.size() == 4);
  const std::string twice_black = text("a") + int32(9) + int32(9) + int32(9) + int32(0);
  CHECK(read_values(with(twice_black), "lh.a.annot").notes.empty());
}

TEST_CASE("vertex_data: a key 0 that the table of an annotation lacks is that of no label") {
  const std::string frontal = text("frontal");
  const VertexData data =
      read_values(replaced(annotation(), int32(0) + frontal, int32(5) + frontal), "lh.a.annot");
  CHECK(data.columns[0].values == std::vector<double>{2, 0, 5});
  REQUIRE(data.labels.size() == 3);
  CHECK(data.labels[0].key == 0);
  CHECK(data.labels[0].name == "???");
}

TEST_CASE("vertex_data: keys and colours of an annotation are within their limits") {
  const std::string blue = int32(2) + text("blue"), channels = int32(0) + int32(0) + int32(255);
  const auto with = [&](int key, int red, int transparency) {
    return replaced(
        annotation(), blue + channels + int32(0),
        int32(key) + text("blue") + int32(red) + int32(0) + int32(255) + int32(transparency));
  };
  const auto said = [](const std::string& bytes) { return values_complaint(bytes, "lh.a.annot"); };
  CHECK(read_values(with(1000000, 0, 255), "lh.a.annot").columns[0].values[0] == 1000000);
  CHECK(contains(said(with(1000001, 0, 0)), "has a label of number 1000001"));
  CHECK(contains(said(with(-1, 0, 0)), "has a label of number -1"));
  CHECK(contains(said(with(2, 256, 0)), "has a label with a colour of 256"));
  CHECK(contains(said(with(2, 0, 256)), "has a label with a colour of 256"));
  CHECK(contains(said(with(2, -1, 0)), "has a label with a colour of -1"));
}

TEST_CASE("vertex_data: an annotation without labels has an empty table") {
  VertexData data = lobes();
  data.columns[0].values = {-1, -1};
  data.labels.clear();
  const std::string bytes = serialise_vertex_data("lh.a.annot", data);
  CHECK(bytes == int32(2) + int32(0) + int32(0) + int32(1) + int32(0) + int32(1) + int32(-2) +
                     int32(0) + text("NOFILE") + int32(0));
  CHECK(read_values(bytes, "lh.a.annot").columns[0].values == std::vector<double>{0, 0});
}

TEST_CASE("vertex_data: what an annotation cannot tell apart is refused") {
  VertexData data = lobes();
  data.labels[2].colour = data.labels[1].colour;
  CHECK(
      contains(writing_complaint("lh.x.annot", data), "'parietal' and 'frontal' have one colour"));
  data.labels.pop_back();
  CHECK(contains(writing_complaint("lh.x.annot", data), "not in the label table"));
  CHECK(contains(writing_complaint("lh.x.annot", thickness()), "thickness is measured"));
  CHECK(contains(writing_complaint("lh.x", lobes()), "lobes has labels"));
  CHECK(contains(writing_complaint("x.txt", lobes()), "values are written as"));
  VertexData two = thickness();
  two.columns.push_back(two.columns[0]);
  CHECK(contains(writing_complaint("lh.x", two), "has one number a vertex, and thickness has 2"));
}

TEST_CASE("vertex_data: a FreeSurfer label is one label, of a surface that is named") {
  const std::string bytes = "#!ascii label  , from subject me\n2\n3 0 0 0 0\n1  1.5 2 -3 0.5\n";
  const VertexData data = read_values(bytes, "lh.cortex.label", 4);
  CHECK(data.columns[0].values == std::vector<double>{0, 1, 0, 1});
  CHECK(data.labels.at(1).name == "cortex");
  CHECK(data.notes.at(0) == "not carried: the numbers of 1 of 2 vertices in the label");
  // 0 and 1 say no more than that the vertex is in the label.
  CHECK(read_values(replaced(bytes, "0.5", "1"), "lh.cortex.label", 4).notes.empty());
  CHECK(contains(values_complaint(bytes, "lh.cortex.label"), "name the surface"));
  CHECK(contains(values_complaint(bytes, "lh.cortex.label", 3), "names vertex 3 of 3"));
  CHECK(contains(values_complaint(replaced(bytes, "\n2\n", "\n3\n"), "a.label", 4),
                 "ends after 2 of 3"));
  const Points places = tetrahedron().positions;
  CHECK(serialise_vertex_data("lh.cortex.label", data, &places) ==
        "#!ascii label  , made by sphparam\n2\n1  -1 -1 1 0\n3  1 -1 -1 0\n");
  CHECK(contains(writing_complaint("a.label", lobes()), "holds one label"));
}

TEST_CASE("vertex_data: an overlay in MGH has a column a frame, and is no volume") {
  VertexData data = thickness();
  data.columns.push_back({"", ScalarType::Float32, {4, 3, 2, 1}});
  std::string bytes = serialise_vertex_data("a.mgh", data);
  CHECK(bytes.size() == 284 + 32);
  check_same(read_values(bytes, "a.mgh"), data);
  const std::string scanner = int32(0x4426aaab) + std::string(16, '\0');  // 2000 ms / 3
  const VertexData series = read_values(bytes + scanner + "command", "a.mgh");
  CHECK(series.kind == DataKind::TimeSeries);
  CHECK(series.columns[1].values == data.columns[1].values);
  CHECK(series.notes ==
        std::vector<std::string>{"not carried: the time between frames, 666.667 ms",
                                 "not carried: 7 bytes after the values (how the file was made)"});
  CHECK(read_values(bytes + scanner, "a.mgh").notes.size() == 1);
  bytes.replace(8, 4, int32(2));  // the second size
  CHECK(contains(values_complaint(bytes, "a.mgh"), "a volume of 4 × 2 × 1"));
  bytes.replace(8, 4, int32(1));
  bytes.replace(20, 4, int32(7));
  CHECK(contains(values_complaint(bytes, "a.mgh"), "numbers of type 7"));
  data.columns.resize(100, data.columns[0]);  // of more bytes than the header
  bytes = serialise_vertex_data("a.mgh", data);
  CHECK(bytes.size() == 284 + 1600);
  check_same(read_values(bytes, "a.mgh"), data);
}

TEST_CASE("vertex_data: GIFTI keeps structure, intents, names and metadata, and gets a key 0") {
  VertexData data = lobes();
  data.labels.erase(data.labels.begin());
  data.structure = "CortexRight";
  data.metadata = {{"ScaleMode", "MODE_AUTO\nSCALE"}};
  const std::string bytes = serialise_vertex_data("x.label.gii", data);
  const VertexData again = read_values(bytes, "x.label.gii");
  CHECK(again.structure == "CortexRight");
  CHECK(again.metadata == data.metadata);
  CHECK(again.labels.at(0).name == "???");
  CHECK(again.labels.at(0).colour->at(3) == 0);
  CHECK(contains(bytes, "NIFTI_INTENT_LABEL"));
  CHECK(contains(bytes, "Dimensionality=\"1\""));
  VertexData nameless = thickness();
  nameless.columns[0].name.clear();
  const auto names = [&] {
    std::string all;
    const auto shape = read_values(serialise_vertex_data("x.shape.gii", nameless), "x.shape.gii");
    for (const DataColumn& column : shape.columns) all += column.name + " ";
    return all;
  };
  CHECK(names() == "thickness ");
  nameless.columns.push_back(nameless.columns[0]);
  CHECK(names() == "thickness_1 thickness_2 ");
  VertexData series = thickness();
  series.kind = DataKind::TimeSeries;
  CHECK(contains(serialise_vertex_data("x.func.gii", series), "NIFTI_INTENT_TIME_SERIES"));
  series.kind = DataKind::Metric;
  CHECK(contains(serialise_vertex_data("x.shape.gii", series), "NIFTI_INTENT_SHAPE"));
  series.columns[0].intent = "NIFTI_INTENT_NONE";
  CHECK(contains(serialise_vertex_data("x.shape.gii", series), "NIFTI_INTENT_NONE"));
  series.columns[0].values[0] = 1e300;
  CHECK(contains(writing_complaint("x.shape.gii", series), "beyond numbers of 32 bits"));
}

TEST_CASE(
    "vertex_data: arrays of two dimensions are columns, sparse ones and surfaces are refused") {
  const auto gifti = [](const std::string& intent, const std::string& more) {
    return "<?xml version=\"1.0\"?><GIFTI Version=\"1.0\" NumberOfDataArrays=\"1\"><DataArray "
           "Intent=\"" +
           intent +
           "\" DataType=\"NIFTI_TYPE_FLOAT32\" Encoding=\"ASCII\" "
           "ArrayIndexingOrder=\"RowMajorOrder\" Endian=\"LittleEndian\" " +
           more + "<Data>1 2 3 4 5 6</Data></DataArray></GIFTI>";
  };
  const std::string table = "Dimensionality=\"2\" Dim0=\"3\" Dim1=\"2\">";
  const VertexData data = read_values(gifti("NIFTI_INTENT_NONE", table), "a.gii");
  REQUIRE(data.columns.size() == 2);
  CHECK(data.columns[1].values == std::vector<double>{2, 4, 6});
  CHECK(contains(values_complaint(gifti("NIFTI_INTENT_NODE_INDEX", table), "a.gii"), "sparse"));
  CHECK(contains(values_complaint(gifti("NIFTI_INTENT_POINTSET", table), "a.gii"), "a surface"));
  CHECK(contains(values_complaint("nothing", "a.txt"), "no file of values"));
  CHECK(contains(values_complaint("1\n2\n", "a.txt"),
                 "values={\"label\": numpy.loadtxt('a.txt', dtype=int)}).save(\"labelled.ply\")"));
  CHECK(contains(values_complaint("{}", "a.json"), "json.load(open('a.json'))[\"labels\"]}"));
  CHECK_FALSE(contains(values_complaint("nothing", "a.bin"), "Python"));
}

TEST_CASE(
    "vertex_data: a mesh carries data through formats that have comments, and gives it back") {
  MeshFile mesh;
  mesh.mesh = tetrahedron();
  VertexData data = lobes();
  data.structure = "CortexLeft";
  data.metadata = {{"a key", "a value\nof two lines, 50 %"}};
  data.columns[0].metadata = {{"-", ""}};
  CHECK(attach_data(mesh, data) == std::vector<std::string>{"lobes"});
  VertexData second = lobes();
  second.labels.pop_back();
  second.columns[0].values = {1, 1, 0, 0};
  CHECK(attach_data(mesh, second) == std::vector<std::string>{"lobes_2"});
  CHECK(attach_data(mesh, thickness()) == std::vector<std::string>{"thickness"});
  for (const char* name : {"a.ply", "a.vtk", "a.vtp"}) {
    INFO(name);
    const MeshFile read_again = read(serialise_mesh(name, mesh), name);
    const std::vector<VertexData> all = attached_data(read_again);
    REQUIRE(all.size() == 3);
    check_same(all[0], data);
    CHECK(all[0].structure == "CortexLeft");
    CHECK(all[0].metadata == data.metadata);
    CHECK(all[0].columns[0].metadata == data.columns[0].metadata);
    CHECK(all[1].name != all[0].name);
    check_same(all[1], second);
    check_same(all[2], thickness());
    CHECK(all[2].columns[0].name == "thick");
  }
  const MeshFile bare = without_data(mesh);
  CHECK(bare.vertex_properties.empty());
  CHECK(bare.comments.empty());
  VertexData other = thickness();
  other.columns[0].values.pop_back();
  CHECK_THROWS_AS(attach_data(mesh, other), std::invalid_argument);
}

TEST_CASE("vertex_data: vertices that were dropped leave the others their values") {
  MeshFile mesh;
  mesh.mesh = tetrahedron();
  mesh.set_vertex_property({"source_vertex", ScalarType::Int32, {5, 0, 3, 2}});
  VertexData data = thickness();
  data.columns[0].values = {10, 11, 12, 13, 14, 15};
  attach_data(mesh, data);
  CHECK(mesh.find_vertex_property("thickness")->values == std::vector<double>{15, 10, 13, 12});
}

TEST_CASE(
    "vertex_data: data lies beside surfaces of GIFTI and FreeSurfer, with them or not at all") {
  MeshFile mesh;
  mesh.mesh = tetrahedron();
  attach_data(mesh, lobes());
  attach_data(mesh, thickness());
  const Folder folder;
  {
    PendingFiles files;
    const auto told = add_mesh(files, folder / "S.L.white.native.surf.gii", mesh);
    CHECK(told.at(0) == "lobes beside it: S.L.lobes.native.label.gii");
    add_mesh(files, folder / "lh.white", mesh);
    files.publish();
  }
  for (const char* name : {"S.L.lobes.native.label.gii", "lh.lobes.annot"})
    check_same(read_vertex_data(folder / name, 4), lobes());
  CHECK(read_vertex_data(folder / "lh.thickness", 4).triangles == 4);
  CHECK(read_vertex_data(folder / "S.L.thickness.native.shape.gii", 4).structure == "CortexLeft");
  const MeshFile surface = read_mesh(folder / "S.L.white.native.surf.gii");
  CHECK(surface.comments == std::vector<std::string>{"gifti AnatomicalStructurePrimary CortexLeft",
                                                     "gifti AnatomicalStructureSecondary GrayWhite",
                                                     "gifti GeometricType Anatomical"});
  PendingFiles files;
  mesh.mesh.positions(0, 0) = std::numeric_limits<double>::infinity();
  CHECK_THROWS(add_mesh(files, folder / "x.surf.gii", mesh));
}

TEST_CASE("vertex_data: a file beside a surface replaces none that is there") {
  MeshFile mesh;
  mesh.mesh = tetrahedron();
  attach_data(mesh, thickness());
  const Folder folder;
  VertexData original = thickness();
  original.columns[0].values[2] = 7;
  write_vertex_data(folder / "lh.thickness", original);
  {
    PendingFiles files;
    CHECK_THROWS_WITH(add_mesh(files, folder / "lh.white", mesh),
                      Catch::Contains("lh.thickness: is there already") &&
                          Catch::Contains("give -o another name"));
  }
  check_same(read_vertex_data(folder / "lh.thickness", 4), original);
  for (int again = 0; again < 2; ++again) {
    PendingFiles files;
    add_mesh(files, folder / "lh.pial.surf.gii", mesh);
    files.publish();
  }
  check_same(read_vertex_data(folder / "lh.thickness.shape.gii", 4), thickness());
}

TEST_CASE("vertex_data: names that mean something in a mesh are no names of data") {
  for (const char* name : {"theta", "phi", "sx", "source_vertex", "source_face", "filler",
                           "material", "nx", "red", "alpha", "s", "t", "x"}) {
    MeshFile mesh;
    mesh.mesh = tetrahedron();
    VertexData data = thickness();
    data.name = name;
    CHECK(attach_data(mesh, data).at(0) == std::string(name) + "_2");
    CHECK(attached_data(mesh).at(0).name == name);
  }
}

TEST_CASE("vertex_data: keys that are no whole numbers are refused where labels are written") {
  for (const double key : {1.5, missing, 1e10}) {
    VertexData data = lobes();
    data.columns[0].values[1] = key;
    for (const char* name : {"a.label.gii", "lh.a.annot", "lh.a.label"})
      CHECK(contains(writing_complaint(name, data), "keys are whole numbers"));
  }
}

TEST_CASE("vertex_data: a name of GIFTI that says what is in it is not given to anything else") {
  VertexData data = lobes();
  for (const char* name : {"a.shape.gii", "a.func.gii", "a.shape.gii.gz"})
    CHECK(contains(writing_complaint(name, data), "holds what is measured, and "));
  CHECK_FALSE(serialise_vertex_data("a.gii", data).empty());
  data.kind = DataKind::Metric;
  CHECK(contains(writing_complaint("a.label.gii", data), "holds labels, and "));
  CHECK_FALSE(serialise_vertex_data("a.gii", data).empty());
}

TEST_CASE("vertex_data: text in UTF-8 passes through GIFTI, other bytes are told") {
  const Folder folder;
  PendingFiles files;
  VertexData data = lobes();
  data.labels[1].name = "cortex cérébral 脳 अ 𝛼";
  data.metadata = {{"Größe", "½ µm"}};
  CHECK(add_vertex_data(files, folder / "a.label.gii", data).empty());
  const VertexData again = read_values(serialise_vertex_data("a.label.gii", data), "a.label.gii");
  CHECK(again.labels.at(1).name == data.labels[1].name);
  CHECK(again.metadata == data.metadata);
  data.labels[1].name = "caf\xe9 \xed\xa0\x80 \xc0\x80\x01 \xa9\xa9 \xf8\x90\x80\x80";
  data.metadata[0].second = "\xff";
  CHECK(add_vertex_data(files, folder / "b.label.gii", data) ==
        std::vector<std::string>{"not carried: key, name or colour, as they were, of 1 of 3 labels",
                                 "not carried: 1 line of metadata"});
  CHECK(read_values(serialise_vertex_data("b.label.gii", data), "b.label.gii").labels.at(1).name ==
        "caf? ??? ??? ?? ????");
}

TEST_CASE("vertex_data: what other formats have no place for is told in a line each") {
  const Folder folder;
  PendingFiles files;
  VertexData series = thickness();
  series.kind = DataKind::TimeSeries;
  series.structure = "CortexLeft";
  series.columns[0].name.clear();
  CHECK(add_vertex_data(files, folder / "a.mgh", series) ==
        std::vector<std::string>{
            "not carried: that the columns are a time series (NIFTI_INTENT_TIME_SERIES)",
            "not carried: the structure CortexLeft"});
  VertexData curvature = series;
  curvature.kind = DataKind::Metric;
  curvature.columns[0].intent = "NIFTI_INTENT_ZSCORE";
  CHECK(add_vertex_data(files, folder / "lh.curv", curvature) ==
        std::vector<std::string>{"not carried: the intent of 1 column (NIFTI_INTENT_ZSCORE)"});
  // Colours of eight bits come back from six digits.
  const VertexData parcels = read_values(annotation(), "lh.a.annot");
  CHECK(add_vertex_data(files, folder / "lh.a.label.gii", parcels).empty());
  VertexData one = lobes();
  one.columns[0].values = {0, 2, 0, 2};
  CHECK(add_vertex_data(files, folder / "parietal.label", one) ==
        std::vector<std::string>{"not carried: key, name or colour, as they were, of 2 of 3 labels",
                                 "not carried: names of columns"});
  CHECK(add_vertex_data(files, folder / "lobes.label.gii", one).empty());
}

TEST_CASE("vertex_data: data that is attached keeps its number where other data is gone") {
  MeshFile mesh;
  mesh.mesh = tetrahedron();
  CHECK(last_attached(mesh) == 0);
  attach_data(mesh, lobes());
  attach_data(mesh, thickness());
  CHECK(last_attached(mesh) == 2);
  remove_properties(mesh.vertex_properties, {"thickness"});
  REQUIRE(attached_data(mesh).size() == 1);
  CHECK(attached_data(mesh)[0].attached_as == 1);
  CHECK(last_attached(mesh) == 2);
}
