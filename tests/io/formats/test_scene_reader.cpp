#include <catch2/catch.hpp>
#include <fstream>

#include "io/polygons/welding.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/read_options.h"
#include "sphparam/io/up_axis.h"
#include "sphparam/mesh/mesh_defects.h"
#include "support/folder.h"

using namespace sphparam;

namespace {

/// A tetrahedron of red, twice as large by its node.
std::string collada(const std::string& triangles = "0 2 1 0 1 3 1 2 3 0 3 2") {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>Y_UP</up_axis></asset>
<library_effects><effect id="e"><profile_COMMON><technique sid="t"><lambert>
<diffuse><color>1 0 0 1</color></diffuse></lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m" name="paint"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="12">0 0 0 1 0 0 0 1 0 0 0 1</float_array>
<technique_common><accessor source="#a" count="4" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles material="m" count="4"><input semantic="VERTEX" source="#v" offset="0"/>
<p>)" + triangles +
         R"(</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><scale>2 2 2</scale>
<instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="m" target="#m"/></technique_common></bind_material></instance_geometry>
</node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

/// A square pyramid; `up`: 1 is y, 2 is z.
const std::string of_metres = "P: \"UnitScaleFactor\", \"double\", \"Number\", \"\",100";

/// A pyramid, 3 high along z. `more`: of the settings.
std::string fbx(int up, const std::string& more = of_metres) {
  return R"(; FBX 7.4.0 project file
FBXHeaderExtension:  {
	FBXHeaderVersion: 1003
	FBXVersion: 7400
}
GlobalSettings:  {
	Version: 1000
	Properties70:  {
		P: "UpAxis", "int", "Integer", "",)" +
         std::to_string(up) + R"(
		P: "UpAxisSign", "int", "Integer", "",1
		)" +
         more + R"(
	}
}
Objects:  {
	Geometry: 1001, "Geometry::pyramid", "Mesh" {
		Vertices: *15 {
			a: -1,-1,0,1,-1,0,1,1,0,-1,1,0,0,0,3
		}
		PolygonVertexIndex: *16 {
			a: 3,2,1,-1,0,1,-5,1,2,-5,2,3,-5,3,0,-5
		}
	}
	Model: 1002, "Model::pyramid", "Mesh" {
		Version: 232
	}
}
Connections:  {
	C: "OO",1002,0
	C: "OO",1001,1002
}
)";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// The same with a skin: what is bound three times as large, to a bone that goes up from 4 to 5.
std::string skinned_collada() {
  const auto source = [](const std::string& id, const std::string& array,
                         const std::string& numbers, int count, const std::string& parameter) {
    const std::string values = std::to_string(count);
    return "<source id=\"" + id + "\"><" + array + " id=\"" + id + "a\" count=\"" + values + "\">" +
           numbers + "</" + array + "><technique_common><accessor source=\"#" + id +
           "a\" count=\"1\" stride=\"" + values + "\"><param " + parameter +
           "/></accessor></technique_common></source>\n";
  };
  const std::string skin =
      R"(<library_controllers><controller id="c"><skin source="#g">)"
      "<bind_shape_matrix>3 0 0 0 0 3 0 0 0 0 3 0 0 0 0 1</bind_shape_matrix>\n" +
      source("j", "Name_array", "bone", 1, R"(name="JOINT" type="name")") +
      source("i", "float_array", "1 0 0 0 0 1 0 0 0 0 1 -4 0 0 0 1", 16,
             R"(name="TRANSFORM" type="float4x4")") +
      source("w", "float_array", "1", 1, R"(name="WEIGHT" type="float")") +
      R"(<joints><input semantic="JOINT" source="#j"/>
<input semantic="INV_BIND_MATRIX" source="#i"/></joints>
<vertex_weights count="4"><input semantic="JOINT" source="#j" offset="0"/>
<input semantic="WEIGHT" source="#w" offset="1"/><vcount>1 1 1 1</vcount>
<v>0 0 0 0 0 0 0 0</v></vertex_weights></skin></controller></library_controllers>
<library_visual_scenes>)";
  std::string scene = replaced(collada(), "<library_visual_scenes>", skin);
  scene =
      replaced(scene, R"(<node id="n">)",
               R"(<node id="bone" sid="bone" name="bone" type="JOINT"><translate>0 0 5</translate>
</node><node id="n">)");
  scene = replaced(scene, R"(<instance_geometry url="#g">)",
                   R"(<instance_controller url="#c"><skeleton>#bone</skeleton>)");
  return replaced(scene, "</instance_geometry>", "</instance_controller>");
}

/// The tetrahedron, its node moved by an animation of this name.
std::string moved_collada(const std::string& animation) {
  const auto source = [](const std::string& id, const std::string& array,
                         const std::string& numbers, int stride, const std::string& parameter) {
    return "<source id=\"" + id + "\"><" + array + " id=\"" + id + "a\" count=\"" +
           std::to_string(2 * stride) + "\">" + numbers + "</" + array +
           "><technique_common><accessor source=\"#" + id + "a\" count=\"2\" stride=\"" +
           std::to_string(stride) + "\">" + parameter + "</accessor></technique_common></source>\n";
  };
  const std::string times =
      source("t", "float_array", "0 1", 1, R"(<param name="TIME" type="float"/>)");
  const std::string places = source("o", "float_array", "5 0 0 9 0 0", 3,
                                    R"(<param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/>)");
  const std::string kinds =
      source("k", "Name_array", "LINEAR LINEAR", 1, R"(<param name="INTERPOLATION" type="name"/>)");
  const std::string library = R"(<library_animations><animation id="m0" name=")" + animation +
                              "\">\n" + times + places + kinds + R"(<sampler id="q">
<input semantic="INPUT" source="#t"/><input semantic="OUTPUT" source="#o"/>
<input semantic="INTERPOLATION" source="#k"/></sampler>
<channel source="#q" target="n/move"/></animation></library_animations>
<library_visual_scenes>)";
  const std::string scene =
      replaced(collada(), R"(<node id="n">)",
               R"(<node id="n" name="n"><translate sid="move">0 0 7</translate>)");
  return replaced(scene, "<library_visual_scenes>", library);
}

/// The pyramid, bound to a bone at z = 4 that stands at z = 5.
std::string skinned_fbx() {
  const std::string deformers = R"(	Deformer: 2001, "Deformer::skin", "Skin" {
		Version: 101
	}
	Deformer: 2002, "SubDeformer::bone", "Cluster" {
		Version: 100
		Indexes: *5 {
			a: 0,1,2,3,4
		}
		Weights: *5 {
			a: 1,1,1,1,1
		}
		Transform: *16 {
			a: 1,0,0,0,0,1,0,0,0,0,1,0,0,0,-4,1
		}
		TransformLink: *16 {
			a: 1,0,0,0,0,1,0,0,0,0,1,0,0,0,4,1
		}
	}
	Model: 1003, "Model::bone", "LimbNode" {
		Version: 232
		Properties70:  {
			P: "Lcl Translation", "Lcl Translation", "", "A",0,0,5
		}
	}
	Model: 1002)";
  return replaced(replaced(fbx(1), "	Model: 1002", deformers), "	C: \"OO\",1002,0\n",
                  "	C: \"OO\",1002,0\n	C: \"OO\",1003,0\n	C: \"OO\",2001,1001\n"
                  "	C: \"OO\",2002,2001\n	C: \"OO\",1003,2002\n");
}

std::string chunk(int kind, const std::string& what) {
  std::string bytes;
  for (int i = 0; i < 2; ++i) bytes.push_back(static_cast<char>(kind >> 8 * i));
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>((what.size() + 6) >> 8 * i));
  return bytes + what;
}

/// A tetrahedron with corners at the origin and on the axes, at 2, 3 and 5.
std::string three_ds() {
  std::string vertices("\4\0", 2), faces("\4\0", 2);
  for (const float x : {0.F, 0.F, 0.F, 2.F, 0.F, 0.F, 0.F, 3.F, 0.F, 0.F, 0.F, 5.F})
    vertices.append(reinterpret_cast<const char*>(&x), sizeof x);
  for (const char v : {0, 2, 1, 7, 0, 1, 3, 7, 0, 3, 2, 7, 1, 2, 3, 7})  // and what edges show
    faces += {v, 0};
  const std::string mesh = chunk(0x4100, chunk(0x4110, vertices) + chunk(0x4120, faces));
  return chunk(0x4D4D, chunk(2, std::string("\3\0\0\0", 4)) +
                           chunk(0x3D3D, chunk(0x4000, std::string("t\0", 2) + mesh)));
}

double height_along(const MeshFile& file, int axis) {
  return file.mesh.positions.col(axis).maxCoeff() - file.mesh.positions.col(axis).minCoeff();
}

}  // namespace

TEST_CASE("scene_reader: COLLADA brings its meshes where their nodes put them, and materials") {
  const MeshFile file = read_mesh(collada(), "a.bin", {});
  CHECK(file.format == "COLLADA");
  CHECK(file.mesh.face_count() == 4);
  CHECK(inspect_mesh(prepare_for_mapping(file).mesh).is_sphere());
  CHECK(height_along(file, 0) == Approx(2));
  REQUIRE(file.base_colours.size() == 1);
  CHECK(file.base_colours[0].factor[0] == Approx(1));
  CHECK(file.base_colours[0].factor[1] == Approx(0));
  CHECK(noted_up(file).direction == Vector3::UnitY());
}

TEST_CASE(
    "scene_reader: what is lost is told in words of such files, not of the glTF they come as") {
  std::string shiny = collada();
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"<lambert>", "<phong>"},
                                 {"</lambert>",
                                  "<specular><color>1 1 1 1</color></specular>"
                                  "<shininess><float>20</float></shininess></phong>"}})
    shiny.replace(shiny.find(from), from.size(), to);
  CHECK(losses_among(read_mesh(shiny, "a.bin", {}).notes) ==
        std::vector<std::string>{"not carried: specular colour and shininess of 1 of 1 material"});
}

TEST_CASE("scene_reader: a picture is seen as it is, not times the colour beside it") {
  std::string text = fbx(1);
  text.replace(text.find("}\nConnections:  {"), 17, R"(	Material: 1003, "Material::m", "" {
		Properties70:  {
			P: "DiffuseColor", "Color", "", "A",0.8,0.8,0.8
			P: "EmissiveColor", "Color", "", "A",0,0,0
		}
	}
	Texture: 1004, "Texture::t", "" {
		FileName: "d.png"
		RelativeFilename: "d.png"
	}
	Texture: 1005, "Texture::e", "" {
		FileName: "e.png"
		RelativeFilename: "e.png"
	}
}
Connections:  {
	C: "OO",1003,1002
	C: "OP",1004,1003, "DiffuseColor"
	C: "OP",1005,1003, "EmissiveColor")");
  text.insert(text.find("	}\n	Model:"), R"(
		LayerElementMaterial: 0 {
			MappingInformationType: "AllSame"
			ReferenceInformationType: "IndexToDirect"
			Materials: *1 {
				a: 0
			}
		}
		Layer: 0 {
			LayerElement:  {
				Type: "LayerElementMaterial"
				TypedIndex: 0
			}
		}
)");
  const MeshFile file = read_mesh(text, "a.fbx", {});
  REQUIRE(file.base_colours.size() == 1);
  CHECK(file.base_colours[0].image == "d.png");
  CHECK(file.base_colours[0].factor == std::array<double, 4>{1, 1, 1, 1});
  CHECK(file.channels[0].emission.image == "e.png");
  CHECK(file.channels[0].emission.factor == std::array<double, 4>{1, 1, 1, 1});

  // One that is named and is not there leaves the colour.
  const tests::Folder folder;
  const std::string path = folder / "a.fbx";
  std::ofstream(path) << text;
  const MeshFile alone = read_mesh(path);
  CHECK(alone.base_colours[0].image == "d.png");
  CHECK(alone.base_colours[0].factor[1] == Approx(0.8));
  std::ofstream(folder / "d.png") << "a picture";
  CHECK(read_mesh(path).base_colours[0].factor[1] == 1);
}

TEST_CASE("scene_reader: pictures are named beside the scene, wherever they were") {
  const auto image_of = [](const std::string& path) {
    const std::string scene =
        replaced(collada(), "<color>1 0 0 1</color>", R"(<texture texture="u" texcoord="c"/>)");
    const std::string with_image =
        replaced(scene, "<library_effects>",
                 R"(<library_images><image id="i"><init_from>)" + path +
                     "</init_from></image></library_images>\n<library_effects>");
    return read_mesh(replaced(with_image, R"(<technique sid="t">)",
                              R"(<newparam sid="w"><surface type="2D"><init_from>i</init_from>)"
                              R"(</surface></newparam><newparam sid="u"><sampler2D><source>w)"
                              R"(</source></sampler2D></newparam><technique sid="t">)"),
                     "a.bin", {})
        .base_colours.at(0)
        .image;
  };
  CHECK(image_of("maps/red.png") == "maps/red.png");
  CHECK(image_of("C:\\work\\maps\\red.png") == "red.png");
  CHECK(image_of("../../maps/red.png") == "red.png");
}

TEST_CASE("scene_reader: FBX is read, polygons cut, and turned so that y is up") {
  for (const int up : {1, 2}) {
    const MeshFile file = read_mesh(fbx(up), "a.bin", {});
    CHECK(file.format == "FBX");
    CHECK(file.mesh.face_count() == 6);
    CHECK(inspect_mesh(prepare_for_mapping(file).mesh).is_sphere());
    CHECK(height_along(file, up == 1 ? 2 : 1) == Approx(3));
    CHECK(noted_up(file).direction == Vector3::UnitY());
  }
}

TEST_CASE(
    "scene_reader: an FBX is in metres whatever its unit, which is the centimetre unless it says "
    "so") {
  const auto height_of = [](const std::string& unit) {
    return height_along(read_mesh(fbx(1, unit), "a.fbx", {}), 2);
  };
  CHECK(height_of(of_metres) == Approx(3));
  CHECK(height_of("") == Approx(0.03));
  CHECK(height_of("P: \"UnitScaleFactor\", \"double\", \"Number\", \"\",2.54") ==
        Approx(3 * 0.0254));
  CHECK(height_of("P: \"UnitScaleFactor\", \"double\", \"Number\", \"\",-1") == Approx(0.03));
}

TEST_CASE("scene_reader: axes of an FBX are turned to right, up and front") {
  // −y is right, z up, −x in front: where the tip of the pyramid is and a corner of its base.
  std::string axes = of_metres;
  for (const auto& [name, number] :
       {std::pair("CoordAxis", 1), {"CoordAxisSign", -1}, {"FrontAxis", 0}, {"FrontAxisSign", -1}})
    axes += "\n\t\tP: \"" + std::string(name) + "\", \"int\", \"Integer\", \"\"," +
            std::to_string(number);
  std::string text = fbx(2, axes);
  text.replace(text.find("-1,-1,0,"), 8, "-1,-2,0,");
  const MeshFile file = read_mesh(text, "a.fbx", {});
  const auto has = [&](const Vector3& place) {
    return ((file.mesh.positions.rowwise() - place.transpose()).rowwise().norm().array() < 1e-6)
        .any();
  };
  CHECK(has({0, 3, 0}));
  CHECK(has({2, 0, 1}));    // (−1, −2, 0)
  CHECK(has({-1, 0, -1}));  // (1, 1, 0)
}

TEST_CASE("scene_reader: meshes with a skin are as their joints stand, wherever their nodes are") {
  const std::vector<std::string> told = {
      "not carried: 1 skin: the mesh is read as the joints stand"};
  const MeshFile dae = read_mesh(skinned_collada(), "a.bin", {});
  CHECK(losses_among(dae.notes).back() == told.back());
  CHECK(inspect_mesh(prepare_for_mapping(dae).mesh).is_sphere());
  CHECK(dae.mesh.positions.colwise().minCoeff().isApprox(Eigen::RowVector3d(0, 0, 1)));
  CHECK(dae.mesh.positions.colwise().maxCoeff().isApprox(Eigen::RowVector3d(3, 3, 4)));
  const MeshFile fbx = read_mesh(skinned_fbx(), "a.bin", {});
  CHECK(losses_among(fbx.notes) == told);
  CHECK(inspect_mesh(prepare_for_mapping(fbx).mesh).is_sphere());
  CHECK(fbx.mesh.positions.colwise().minCoeff().isApprox(Eigen::RowVector3d(-1, -1, 1)));
  CHECK(fbx.mesh.positions.colwise().maxCoeff().isApprox(Eigen::RowVector3d(1, 1, 4)));
}

TEST_CASE("scene_reader: animations are left at rest and told, also where one has a node's name") {
  for (const char* const animation : {"walk", "n"}) {
    const MeshFile file = read_mesh(moved_collada(animation), "a.bin", {});
    CHECK(losses_among(file.notes).back() == "not carried: 1 animation");
    CHECK(file.mesh.positions.colwise().minCoeff().isApprox(Eigen::RowVector3d(0, 0, 7)));
  }
}

TEST_CASE("scene_reader: a skin whose bone is nowhere leaves its mesh where the node puts it") {
  const MeshFile file =
      read_mesh(replaced(skinned_collada(), "<node id=\"bone\" sid=\"bone\" name=\"bone\"",
                         "<node id=\"b\" sid=\"b\" name=\"b\""),
                "a.bin", {});
  CHECK(height_along(file, 0) == Approx(2));
}

TEST_CASE("scene_reader: 3DS has z up, and is turned so that y is") {
  for (const char* const name : {"a.3ds", "a.bin"}) {
    const MeshFile file = read_mesh(three_ds(), name, {});
    CHECK(file.format == "3DS");
    CHECK(file.mesh.face_count() == 4);
    CHECK(inspect_mesh(prepare_for_mapping(file).mesh).is_sphere());
    CHECK(height_along(file, 0) == 2);
    CHECK(height_along(file, 1) == 5);  // along z in the file
    CHECK(height_along(file, 2) == 3);
    CHECK(noted_up(file).direction == Vector3::UnitY());
  }
}

TEST_CASE("scene_reader: X3D brings its shapes where their transforms put them") {
  const MeshFile file = read_mesh(
      "<?xml version=\"1.0\"?><X3D version=\"3.0\"><Scene><Transform translation=\"0 0 7\"><Shape>"
      "<IndexedFaceSet coordIndex=\"0 2 1 -1 0 1 3 -1 0 3 2 -1 1 2 3 -1\"><Coordinate "
      "point=\"0 0 0 2 0 0 0 3 0 0 0 5\"/></IndexedFaceSet></Shape></Transform></Scene></X3D>",
      "a.bin", {});
  CHECK(file.format == "X3D");
  CHECK(inspect_mesh(prepare_for_mapping(file).mesh).is_sphere());
  CHECK(file.mesh.positions.colwise().minCoeff() == Eigen::RowVector3d(0, 0, 7));
  CHECK(file.mesh.positions.colwise().maxCoeff() == Eigen::RowVector3d(2, 3, 12));
}

TEST_CASE("scene_reader: what is broken is refused, and says what it was taken for") {
  const auto refused = [](const std::string& bytes, const std::string& name,
                          const std::string& words = "") {
    CHECK_THROWS_WITH(read_mesh(bytes, name, {}), Catch::StartsWith(name + ": " + words));
  };
  // In assimp's words.
  refused("; FBX 7.4.0 project file\nObjects:  {", "a.fbx", "FBX-Parser");
  refused("Kaydara FBX Binary  \x1a", "a.bin", "FBX-Tokenize");
  refused("nothing of the kind", "a.fbx");
  refused(collada().substr(0, 900), "a.dae");
  refused("<COLLADA/>", "a.dae", "Collada");
  refused("", "a.fbx", "the file is empty");
  refused(three_ds().substr(0, 60), "a.3ds");
  refused("<X3D>", "a.x3d");
}
