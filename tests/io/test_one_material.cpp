#include <catch2/catch.hpp>

#include "io/attributes/appearance.h"
#include "io/attributes/finish_terms.h"
#include "io/attributes/one_material.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

/// An icosahedron: `first` of its 20 faces have material 0, the others 1.
MeshFile two_materials(int first) {
  MeshFile file;
  file.mesh = icosahedron();
  file.materials = {"a", "b"};
  file.base_colours.resize(2);
  file.channels.resize(2);
  Property material{"material", ScalarType::Int32, std::vector<double>(20, 1)};
  std::fill_n(material.values.begin(), first, 0);
  file.set_face_property(std::move(material));
  return file;
}

}  // namespace

TEST_CASE("finish: as a text and back it stays, without what nobody can see") {
  MaterialFinish finish;
  CHECK(to_text(finish).empty());
  finish.sheen = {0.1, 1.0 / 3, 1};
  finish.ior = 1.7;
  finish.clearcoat_roughness = 1;  // of no coat
  finish.thickness = 2;            // of what nothing goes through
  CHECK(to_text(finish) == "sheenColorFactor=0.1,0.3333333333333333,1 ior=1.7");
  CHECK(extensions_of(finish) ==
        std::vector<std::string>{"KHR_materials_sheen", "KHR_materials_ior"});
  MaterialFinish seen;
  seen.sheen = finish.sheen;
  seen.ior = finish.ior;
  CHECK(finish_in(to_text(finish)) == seen);
  CHECK(finish_in("ior=x sheenColorFactor=1,2 unknown=1 = clearcoatFactor=7 ior") ==
        MaterialFinish());
}

TEST_CASE("one_material: what most of the area has, and the share of what has it otherwise") {
  MeshFile file = two_materials(5);
  CHECK(one_material(MeshFile()).warnings.empty());
  CHECK(one_material(file).finish == MaterialFinish());
  CHECK(one_material(file).warnings.empty());

  file.channels[1].finish.clearcoat = 1;
  OneMaterial one = one_material(file);
  CHECK(one.finish.clearcoat == 1);
  REQUIRE(one.warnings.size() == 1);
  CHECK(one.warnings[0] ==
        "materials become one: KHR_materials_clearcoat as the largest part of the area has it; "
        "25 % of the area has it otherwise");

  file.mesh.positions *= 1e-3;  // shares, not areas
  CHECK(one_material(file).finish.clearcoat == 1);
  CHECK(one_material(file).warnings == one.warnings);

  file = two_materials(15);
  file.channels[1].finish.clearcoat = 1;
  CHECK(one_material(file).finish.clearcoat == 0);
  CHECK(one_material(file).warnings ==
        std::vector<std::string>{"materials become one: no KHR_materials_clearcoat, as the largest "
                                 "part of the area has none; 25 % of the area has it"});
  file.channels[0].finish.sheen = {1, 1, 1};
  CHECK(one_material(file).warnings ==
        std::vector<std::string>{
            "materials become one: no KHR_materials_clearcoat and KHR_materials_sheen as the "
            "largest part of the area has it; 25 % of the area has it otherwise"});

  file.channels[0].unlit = true;
  CHECK(one_material(file).unlit);
  CHECK(one_material(file).warnings.size() == 1);  // nobody sees the coat in no light
  file.channels[1].unlit = true;
  CHECK(one_material(file).warnings.empty());

  // A material that no face has does not count; faces without one do.
  file = two_materials(0);
  file.channels[0].finish.transmission = 1;
  CHECK(one_material(file).warnings.empty());
  file.channels[1].finish.transmission = 1;
  Property none = *file.find_face_property("material");
  std::fill_n(none.values.begin(), 12, -1);
  file.set_face_property(none);
  CHECK(one_material(file).finish == MaterialFinish());
  CHECK(one_material(file).warnings.size() == 1);
}

TEST_CASE("one_material: blended where all of the area is, masked where some of it is") {
  const auto one = [](int first, AlphaMode of_first, AlphaMode of_others) {
    MeshFile file = two_materials(first);
    file.channels[0].alpha_mode = of_first;
    file.channels[1].alpha_mode = of_others;
    file.channels[1].alpha_cutoff = 0.25;
    return one_material(file);
  };
  using enum AlphaMode;
  CHECK(one(20, Blend, Opaque).alpha_mode == Blend);  // no face has the other
  CHECK(one(20, Blend, Opaque).warnings.empty());
  CHECK(one(5, Blend, Blend).alpha_mode == Blend);
  CHECK(one(19, Opaque, Mask).alpha_mode == Mask);
  CHECK(one(19, Opaque, Mask).alpha_cutoff == 0.25);
  CHECK(one(19, Opaque, Mask).warnings.empty());
  CHECK(one(15, Blend, Mask).alpha_mode == Mask);
  CHECK(one(5, Mask, Mask).alpha_cutoff == 0.25);  // the other's 0.5 is what alphas are scaled from
  const OneMaterial glazed = one(5, Blend, Opaque);
  CHECK(glazed.alpha_mode == Opaque);
  REQUIRE(glazed.warnings.size() == 1);
  CHECK(glazed.warnings[0] ==
        "materials become one, which is not blended: 25 % of the area is, and is drawn over what "
        "lies behind it");
  MeshFile bare = two_materials(5);
  bare.channels[0].alpha_mode = bare.channels[1].alpha_mode = Blend;
  Property none = *bare.find_face_property("material");
  none.values[0] = -1;  // glTF has it opaque
  bare.set_face_property(none);
  CHECK(one_material(bare).alpha_mode == Opaque);
}

TEST_CASE("appearance: corners have the texture coordinates of their vertices or their own") {
  MeshFile file;
  file.mesh = tetrahedron();
  CHECK_FALSE(texcoords_of(file));
  file.set_vertex_property({"s", ScalarType::Float32, {0, 1, 2, 3}});
  CHECK_FALSE(texcoords_of(file));
  file.set_vertex_property({"t", ScalarType::Float32, {10, 11, 12, 13}});
  REQUIRE(texcoords_of(file));
  CornerTexcoords corners(12, 2);
  for (int i = 0; i < 12; ++i) {
    const Vertex v = file.mesh.triangles(i / 3, i % 3);
    corners.row(i) << v, v + 10;
  }
  CHECK(*texcoords_of(file) == corners);
  file.corner_texcoords = 2 * corners;
  CHECK(*texcoords_of(file) == 2 * corners);
}
