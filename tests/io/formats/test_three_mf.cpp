#include <catch2/catch.hpp>
#include <string>
#include <utility>
#include <vector>

#include "io/files/gzip.h"
#include "io/formats/three_mf/three_mf_reader.h"
#include "io/reading.h"
#include "sphparam/io/losses.h"
#include "support/test_meshes.h"
#include "support/zipped.h"

namespace sphparam::tests {

namespace {

using Catch::Contains;
/// A tetrahedron with corners at the origin and at 1 on the axes.
std::string tetra(const std::string& attributes_of_first = "") {
  return "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>"
         "<vertex x=\"0\" y=\"1\" z=\"0\"/><vertex x=\"0\" y=\"0\" z=\"1\"/></vertices><triangles>"
         "<triangle v1=\"0\" v2=\"2\" v3=\"1\"" +
         attributes_of_first +
         "/><triangle v1=\"0\" v2=\"1\" v3=\"3\"/><triangle v1=\"0\" v2=\"3\" v3=\"2\"/>"
         "<triangle v1=\"1\" v2=\"2\" v3=\"3\"/></triangles></mesh>";
}

std::string model(const std::string& resources, const std::string& build,
                  const std::string& more = "") {
  return "<?xml version=\"1.0\"?><model unit=\"inch\" xmlns=\"c\" xmlns:m=\"m\" xmlns:p=\"p\" "
         "xmlns:prod=\"p\">" +
         more + "<resources>" + resources + "</resources><build>" + build + "</build></model>";
}

const std::string one_object = "<object id=\"7\" name=\"wedge\">" + tetra() + "</object>";
const std::string one_item = "<item objectid=\"7\"/>";

MeshFile read_model(const std::string& text, Packing how = {}) {
  return read(zipped({{"[Content_Types].xml", "<Types/>"}, {"3D/3dmodel.model", text}}, how),
              "a.3mf");
}

void refused(const std::string& text, const std::string& why) {
  INFO(why);
  CHECK_THROWS_WITH(read_model(text), Contains(why));
}

}  // namespace

TEST_CASE("three_mf: numbers below the smallest are 0, those above the largest are refused") {
  const auto with = [](const std::string& number) {
    std::string object = one_object;
    object.replace(object.find("x=\"1\""), 5, "x=\"" + number + "\"");
    return model(object, one_item);
  };
  CHECK(read_model(with("1e-400")).mesh.positions(1, 0) == 0);
  CHECK(read_model(with("-1e-310")).mesh.positions(1, 0) == -1e-310);
  refused(with("1e400"), "expected a number for x");
}

TEST_CASE("three_mf: an object comes as it stands, stored, deflated or with fields of Zip64") {
  for (const Packing how : {Packing{}, Packing{.deflated = true}, Packing{.large = true},
                            Packing{.deflated = true, .large = true}}) {
    const MeshFile file = read_model(model(one_object, one_item), how);
    CHECK(file.format == "3MF");
    Points corners(4, 3);
    corners << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    Triangles faces(4, 3);
    faces << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
    CHECK(file.mesh.positions == corners);
    CHECK(file.mesh.triangles == faces);
    CHECK(file.face_properties.empty());
    CHECK(file.comments == std::vector<std::string>{"unit inch"});
    CHECK(file.notes == std::vector<std::string>{
                            "its unit is the inch, not the millimetre: lengths stay as they are"});
  }
}

TEST_CASE(
    "three_mf: the build puts objects where it says, in its order, and their names are told") {
  const std::string mirror = "<item objectid=\"7\" transform=\"-2 0 0 0 2 0 0 0 2 10 20 30\"/>";
  const MeshFile file = read_model(
      model(one_object, one_item + mirror, "<metadata name=\"Title\">Two of them</metadata>"));
  REQUIRE(file.mesh.vertex_count() == 8);
  CHECK(file.mesh.position(5) == Vector3(8, 20, 30));
  CHECK(file.mesh.position(6) == Vector3(10, 22, 30));
  CHECK(file.mesh.position(7) == Vector3(10, 20, 32));
  CHECK(file.mesh.triangles.row(4) == Eigen::RowVector3i(4, 5, 6));  // turned about: it looks out
  CHECK(values_of(file.find_face_property("object")) ==
        std::vector<double>{0, 0, 0, 0, 1, 1, 1, 1});
  CHECK(file.comments == std::vector<std::string>{"Title Two of them", "unit inch",
                                                  "object 0 wedge", "object 1 wedge"});
}

TEST_CASE("three_mf: components are placed within one another, also those of other parts") {
  const std::string elsewhere =
      model("<object id=\"3\">" + tetra() + "</object><object id=\"4\" type=\"other\">" + tetra() +
                "</object>",
            "");
  const std::string root = model(
      "<object id=\"1\"><components><component prod:path=\"/3D/Objects/A.model\" objectid=\"3\" "
      "transform=\"0 1 0 -1 0 0 0 0 1 5 0 0\"/><component p:path=\"/3D/Objects/A.model\" "
      "objectid=\"4\"/></components></object>",
      "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 0 0 7\"/>");
  const MeshFile file = read(zipped({{"_rels/.rels",
                                      "<Relationships><Relationship Target=\"/3D/Root.model\" "
                                      "Type=\"http://schemas/3dmodel\"/></Relationships>"},
                                     {"3D/Objects/a.model", elsewhere},
                                     {"3D/Root.model", root}}),
                             "b.3mf");
  REQUIRE(file.mesh.vertex_count() == 4);
  CHECK(file.mesh.position(0) == Vector3(5, 0, 7));
  CHECK(file.mesh.position(1) == Vector3(5, 1, 7));  // x turned to y
  CHECK(file.mesh.position(2) == Vector3(4, 0, 7));
  CHECK(file.mesh.position(3) == Vector3(5, 0, 8));
  CHECK(losses_among(file.notes) ==
        std::vector<std::string>{"not carried: 1 object of type 'other'"});
}

TEST_CASE("three_mf: base materials are materials, and their colours are linear") {
  const MeshFile file = read_model(
      model("<basematerials id=\"2\"><base name=\"PLA red\" displaycolor=\"#FF0000\"/><base "
            "name=\"TPU\" displaycolor=\"#00BC0080\"/></basematerials><object id=\"7\" pid=\"2\" "
            "pindex=\"1\">" +
                tetra(" pid=\"2\" p1=\"0\"") + "</object>",
            one_item));
  CHECK(file.materials == std::vector<std::string>{"PLA red", "TPU"});
  CHECK(values_of(file.find_face_property("material")) == std::vector<double>{0, 1, 1, 1});
  REQUIRE(file.base_colours.size() == 2);
  CHECK(file.base_colours[0].factor == std::array<double, 4>{1, 0, 0, 1});
  CHECK(file.base_colours[1].factor[1] == Approx(0.50289).epsilon(1e-4));
  CHECK(file.base_colours[1].factor[3] == 128 / 255.0);
}

TEST_CASE("three_mf: colours are those of vertices where no vertex has two, else of faces") {
  const auto painted = [](const std::string& attributes) {
    return read_model(
        model("<m:colorgroup id=\"2\"><m:color color=\"#102030\"/><m:color color=\"#405060FF\"/>"
              "</m:colorgroup><object id=\"7\" pid=\"2\" pindex=\"0\">" +
                  tetra(attributes) + "</object>",
              one_item));
  };
  const MeshFile plain = painted("");
  CHECK(values_of(plain.find_vertex_property("red")) == std::vector<double>(4, 0x10));
  CHECK(values_of(plain.find_vertex_property("blue")) == std::vector<double>(4, 0x30));
  CHECK(!plain.find_vertex_property("alpha"));
  CHECK(plain.notes.size() == 1);  // the unit
  const MeshFile mixed = painted(" p1=\"1\" p2=\"1\" p3=\"0\"");
  CHECK(!mixed.find_vertex_property("red"));
  CHECK(values_of(mixed.find_face_property("red")) ==
        std::vector<double>{48, 0x10, 0x10, 0x10});  // (2·0x40 + 0x10) / 3
  CHECK(losses_among(mixed.notes) ==
        std::vector<std::string>{
            "not carried: colours within 1 triangle, of which the mean is kept"});
}

TEST_CASE("three_mf: what slicers and other extensions add is left and told") {
  const std::string of_slicer =
      "<config><object id=\"7\"><volume firstid=\"0\" lastid=\"3\"><metadata type=\"volume\" "
      "key=\"volume_type\" value=\"ModelPart\"/></volume><volume firstid=\"4\" lastid=\"7\">"
      "<metadata type=\"volume\" key=\"volume_type\" value=\"ParameterModifier\"/></volume>"
      "</object></config>";
  std::string two = tetra(" slic3rpe:mmu_segmentation=\"8\"");
  const std::string more =
      "<vertex x=\"5\" y=\"0\" z=\"0\"/><vertex x=\"6\" y=\"0\" z=\"0\"/><vertex x=\"5\" y=\"1\" "
      "z=\"0\"/><vertex x=\"5\" y=\"0\" z=\"1\"/>";
  two.insert(two.find("</vertices>"), more);
  two.insert(two.find("</triangles>"),
             "<triangle v1=\"4\" v2=\"6\" v3=\"5\"/><triangle v1=\"4\" v2=\"5\" v3=\"7\"/>"
             "<triangle v1=\"4\" v2=\"7\" v3=\"6\"/><triangle v1=\"5\" v2=\"6\" v3=\"7\"/>");
  const std::string text = model(
      "<s:slicestack id=\"9\"><s:slice><s:vertices><s:vertex x=\"0\" y=\"0\"/></s:vertices>"
      "</s:slice></s:slicestack><object id=\"7\">" +
          two + "</object>",
      one_item);
  const MeshFile file =
      read(zipped({{"3D/3dmodel.model", text}, {"Metadata/Slic3r_PE_model.config", of_slicer}}),
           "c.3mf");
  CHECK(file.mesh.positions == read_model(model(one_object, one_item)).mesh.positions);
  CHECK(file.mesh.triangles == read_model(model(one_object, one_item)).mesh.triangles);
  CHECK(
      losses_among(file.notes) ==
      std::vector<std::string>{
          "not carried: 1 volume of PrusaSlicer (modifiers, negative volumes, places for supports)",
          "not carried: 1 element 'slicestack'",
          "not carried: what a slicer painted on 1 triangle"});
}

TEST_CASE("three_mf: what is wrong is said, with the part and its line") {
  refused(model(one_object, ""), "its build holds no item");
  refused(model(one_object, "<item objectid=\"8\"/>"), "object 8 is placed, and is not there");
  refused(model(one_object + one_object, one_item), "two objects 7");
  refused(model("<object id=\"7\">" + tetra(" v4=\"0\"") + "</object><vertex x=\"1\"/>", one_item),
          "a.3mf/3D/3dmodel.model:1: a mesh or component stands outside of objects");
  refused(model(one_object, "<item objectid=\"7\" transform=\"1 0 0\"/>"), "twelve finite numbers");
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string text = model(one_object, one_item);
    return text.replace(text.find(from), from.size(), to);
  };
  refused(changed("x=\"1\"", "x=\"one\""), "expected a number for x, found 'one'");
  refused(changed("x=\"1\"", "x=\"1,0\""), "expected a number for x, found '1,0'");
  refused(changed("x=\"1\"", "x=\"nan\""), "a coordinate is not a finite number");
  refused(changed("v1=\"1\"", "v1=\"4\""), "triangle names vertex 4 of 4 (counted from 0)");
  refused(changed("v1=\"1\"", "v1=\"2\""), "triangle names a vertex twice");
  refused(changed("</build>", ""), "malformed XML");
  refused(model("<object id=\"7\"><components><component objectid=\"7\"/><component "
                "objectid=\"7\"/></components></object>",
                one_item),
          "components lie within one another too deep");
  refused(model("<m:colorgroup id=\"2\"><m:color color=\"red\"/></m:colorgroup>" + one_object,
                one_item),
          "expected a colour as #RRGGBB, found 'red'");
  refused(model("<m:colorgroup id=\"2\"><m:color color=\"#000000\"/></m:colorgroup><basematerials "
                "id=\"2\"/>" +
                    one_object,
                one_item),
          "two groups 2");
  refused(model(one_object,
                "<item objectid=\"7\" transform=\"1e308 0 0 1e308 1 0 1e308 0 1 1e308 0 0\"/>"),
          "not a finite number where it is placed");
  refused(model("<m:colorgroup id=\"2\"/><object id=\"7\" pid=\"2\">" + tetra() + "</object>",
                one_item),
          "entry 0 of a group of 0 colours");
}

TEST_CASE("three_mf: a broken archive is refused, and no size it says is believed") {
  const std::string whole = zipped({{"3D/3dmodel.model", model(one_object, one_item)}});
  const auto complaint = [](const std::string& bytes, const ReadOptions& options = {}) {
    try {
      read_three_mf(bytes, "d.3mf", options);
    } catch (const ReadError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(complaint(whole).empty());
  CHECK_THAT(complaint(whole.substr(0, whole.size() / 2)), Contains("without its directory"));
  for (std::size_t cut = 1; cut < whole.size(); ++cut)
    CHECK(!complaint(whole.substr(0, cut)).empty());
  std::string flipped = whole;
  flipped[60] ^= 1;
  CHECK_THAT(complaint(flipped), Contains("d.3mf/3D/3dmodel.model: its ZIP data is corrupt"));
  CHECK_THAT(complaint(whole, {.max_file_bytes = 100}), Contains("the limit of 100 bytes"));
  CHECK_THAT(complaint(whole, {.max_vertices = 3}), Contains("more vertices than the limit of 3"));
  CHECK_THAT(complaint(whole, {.max_faces = 3}), Contains("more triangles than the limit of 3"));
  CHECK_THAT(complaint(zipped({{"a.model", "x"}})), Contains("holds no model part"));
  std::string locked = whole;
  locked[locked.rfind("PK\1\2") + 8] = 1;
  CHECK_THAT(complaint(locked), Contains("is encrypted"));
  std::string other = whole;
  other[other.rfind("PK\1\2") + 10] = 14;
  CHECK_THAT(complaint(other), Contains("packed by method 14"));
}

}  // namespace sphparam::tests
