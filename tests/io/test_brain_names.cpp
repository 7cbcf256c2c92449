#include <catch2/catch.hpp>

#include "sphparam/io/brain_names.h"

using namespace sphparam;

namespace {

std::string words(const BrainName& name) {
  const std::string side(name.hemisphere != 0, name.hemisphere);
  return name.subject + "|" + side + "|" + name.what + "|" + name.space + "|" + name.density;
}

VertexData labels() {
  VertexData data;
  data.kind = DataKind::Labels;
  data.name = "aparc";
  data.columns.resize(1);
  return data;
}

VertexData measures(std::size_t columns) {
  VertexData data;
  data.name = "thickness";
  data.columns.resize(columns);
  return data;
}

}  // namespace

TEST_CASE("brain_names: names of all three patterns are taken apart") {
  const auto parsed = [](const char* path) { return words(parse_brain_name(path)); };
  CHECK(parsed("100307.L.sphere.32k_fs_LR.surf.gii") == "100307|L|sphere|fs_LR|32k");
  CHECK(parsed("x/S1200.R.white_MSMAll.32k_fs_LR.surf.gii") == "S1200|R|white_MSMAll|fs_LR|32k");
  CHECK(parsed("7.L.white.native.surf.gii") == "7|L|white|native|");
  CHECK(parsed("R.sphere.surf.gii") == "|R|sphere||");
  CHECK(parsed("tpl-fsLR_den-32k_hemi-L_sphere.surf.gii") == "|L|sphere|fs_LR|32k");
  CHECK(parsed("sub-01_hemi-R_space-fsaverage_desc-aparc_dseg.label.gii") ==
        "01|R|aparc|fsaverage|");
  CHECK(parsed("hemi-L_thickness.shape.gii.gz") == "|L|thickness||");
  CHECK(parsed("sub-01_ses-2_hemi-R_white.surf.gii") == "sub-01_ses-2|R|white||");
  CHECK(parsed("ses-2_hemi-R_white.surf.gii") == "ses-2|R|white||");
  CHECK(parsed("bert/surf/lh.white") == "bert|L|white||");
  CHECK(parsed("bert/label/rh.aparc.a2009s.annot") == "bert|R|aparc.a2009s||");
  CHECK(parsed("here/lh.curv") == "|L|curv||");
  CHECK(parsed("lh.sphere.reg") == "|L|sphere.reg||");
  CHECK(parsed("lh.white.sph.ply") == "|L|white||");
  CHECK(parsed("statue.obj") == "||statue||");
}

TEST_CASE("brain_names: names are made by each pattern") {
  const BrainName sphere{"100307", 'L', "sphere", "fs_LR", "32k"};
  CHECK(surface_name(sphere, NamePattern::Hcp) == "100307.L.sphere.32k_fs_LR.surf.gii");
  CHECK(surface_name(sphere, NamePattern::Bids) ==
        "sub-100307_hemi-L_space-fsLR_den-32k_sphere.surf.gii");
  CHECK(surface_name(sphere, NamePattern::FreeSurfer) == "lh.sphere");
  CHECK(surface_name({.hemisphere = 'L', .what = "sphere"}, NamePattern::Bids) ==
        "hemi-L_sphere.surf.gii");
  const auto bids = [](const char* path) {
    return surface_name(parse_brain_name(path), NamePattern::Bids);
  };
  CHECK(bids("sub-07/surf/lh.white") == "sub-07_hemi-L_white.surf.gii");
  CHECK(bids("sub-07_ses-1/surf/rh.pial") == "sub-07_ses-1_hemi-R_pial.surf.gii");
  CHECK(bids("sub-07_ses-1_hemi-L_pial.surf.gii") == "sub-07_ses-1_hemi-L_pial.surf.gii");
  CHECK(bids("ses-1_hemi-L_pial.surf.gii") == "ses-1_hemi-L_pial.surf.gii");
  CHECK(surface_name(parse_brain_name("sub-07/surf/lh.white"), NamePattern::Hcp) ==
        "sub-07.L.white.surf.gii");
  CHECK(surface_name(parse_brain_name("ses-1_hemi-L_pial.surf.gii"), NamePattern::Hcp) ==
        "ses-1.L.pial.surf.gii");
  const BrainName aparc{"1", 'R', "aparc", "", ""};
  CHECK(data_name(aparc, labels(), NamePattern::Hcp) == "1.R.aparc.label.gii");
  CHECK(data_name(aparc, labels(), NamePattern::Bids) == "sub-1_hemi-R_desc-aparc_dseg.label.gii");
  CHECK(data_name(aparc, labels(), NamePattern::FreeSurfer) == "rh.aparc.annot");
  CHECK(data_name(aparc, measures(2), NamePattern::FreeSurfer) == "rh.aparc.mgh");
}

TEST_CASE("brain_names: data lies beside a surface under a name of the same pattern") {
  CHECK(data_path("out/lh.white", measures(1)) == "out/lh.thickness");
  CHECK(data_path("out/lh.white", measures(2)) == "out/lh.thickness.mgh");
  CHECK(data_path("out/lh.white", labels()) == "out/lh.aparc.annot");
  CHECK(data_path("out/lh.white.surf.gii", labels()) == "out/lh.aparc.label.gii");
  CHECK(data_path("S.L.pial.32k_fs_LR.surf.gii", measures(1)) ==
        "S.L.thickness.32k_fs_LR.shape.gii");
  CHECK(data_path("sub-1_hemi-L_den-32k_pial.surf.gii", labels()) ==
        "sub-1_hemi-L_den-32k_desc-aparc_dseg.label.gii");
  CHECK(data_path("out/x.surf.gii", measures(1)) == "out/x.thickness.shape.gii");
  CHECK(data_path("out/x.pial", labels()) == "out/x.pial.aparc.annot");
  CHECK(data_path("out/x.pial", measures(1)) == "out/x.pial.thickness");
  for (const char* path : {"lh.white", "x.surf.gii", "x.pial", "hemi-L_x.surf.gii"})
    for (const VertexData& data : {labels(), measures(1), measures(3)})
      CHECK(is_written_data(data_path(path, data)));
}

TEST_CASE("brain_names: a name says which surface it is, as far as it does") {
  CHECK(structure_of_name("lh.white") == "CortexLeft");
  CHECK(structure_of_name("S.R.white.surf.gii") == "CortexRight");
  CHECK(structure_of_name("whitehouse.obj").empty());
  CHECK(surface_words_of_name("S.L.midthickness.surf.gii").secondary_structure == "MidThickness");
  CHECK(surface_words_of_name("lh.pial").geometric_type == "Anatomical");
  CHECK(surface_words_of_name("lh.inflated").geometric_type == "Inflated");
  CHECK(surface_words_of_name("lh.sphere").secondary_structure.empty());
  CHECK(surface_words_of_name("whitehouse.obj").geometric_type.empty());
}
