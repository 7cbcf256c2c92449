#include <catch2/catch.hpp>
#include <clocale>
#include <cstdlib>
#include <limits>
#include <string>

#include "number_text.h"
#include "place_text.h"
#include "sphparam/names.h"
#include "sphparam/words.h"
#include "support/folder.h"

using namespace sphparam;
using sphparam::tests::Folder;

TEST_CASE("number_text: as many digits as people read, or all that matter") {
  CHECK(short_number(12.345) == "12.3");
  CHECK(short_number(0.001234) == "0.00123");
  CHECK(short_number(1234567, 6) == "1.23457e+06");
  CHECK(percent(0.12345) == "12.3 %");
  CHECK(percent(0.12345, 2) == "12 %");
  CHECK(percent(1, 2) == "100 %");
  CHECK(percent(0.9999, 2) == "100 %");
  CHECK(percent(12.346) == "1235 %");
  CHECK(percent(1e-7) == "1e-05 %");
  CHECK(percent(1e20) == "1e+22 %");
  CHECK(shortest(0.1) == "0.1");
  for (const double value : {1 / 3., std::numeric_limits<double>::min(), 1e300})
    CHECK(std::stod(shortest(value)) == value);
}

TEST_CASE("place_text: places of one shape are told apart wherever it stands") {
  CHECK(place_text({1.25, -2, 1 / 3.}, 4) == "1.25, -2, 0.333333");
  CHECK(place_text({391234.25, 5821456.5, 34.125}, 0.5, " ") == "391234.25 5821456.5 34.125");
  CHECK(place_text({1e8, 1e8 + 0.125, 0}, 1) == "100000000, 100000000.125, 0");
  CHECK(place_text({1, 2, 3}, 0) == "1, 2, 3");
}

TEST_CASE("number_text: numbers have a point, whatever locale the program has set") {
  const Folder folder;
  const std::string german = folder / "de_DE.UTF-8";
  REQUIRE(std::system(("localedef -i de_DE -f UTF-8 " + german).c_str()) == 0);
  REQUIRE(setenv("LOCPATH", (folder / "").c_str(), 1) == 0);
  const bool set = std::setlocale(LC_NUMERIC, "de_DE.UTF-8") != nullptr;
  REQUIRE(unsetenv("LOCPATH") == 0);
  REQUIRE(set);
  CHECK(std::to_string(0.5).starts_with("0,5"));
  CHECK(short_number(0.5) == "0.5");
  CHECK(percent(0.125) == "12.5 %");
  std::setlocale(LC_NUMERIC, "C");
}

TEST_CASE("number_text: one is one, and lists have commas") {
  CHECK(counted(1, "skin") == "1 skin");
  CHECK(counted(0, "skin") == "0 skins");
  CHECK(counted(1, "face has", "faces have") == "1 face has");
  CHECK(counted(3, "face has", "faces have") == "3 faces have");
  CHECK(joined({}).empty());
  CHECK(joined({"a"}) == "a");
  CHECK(joined({"a", "", "b"}) == "a, , b");
  CHECK(joined({"", "a"}) == ", a");
  CHECK(joined({"a", "b"}, "; ") == "a; b");
}

TEST_CASE("words: every defect with its hint") {
  const MeshDefect open{DefectKind::BoundaryEdge, true, 1, {}, "1 boundary edge", "fill it"};
  const MeshDefect odd{DefectKind::ZeroAreaFace, false, 1, {}, "1 flat face", ""};
  CHECK(defect_list({}).empty());
  CHECK(defect_list({open, odd}) == "  1 boundary edge\n    hint: fill it\n  1 flat face\n");
}

TEST_CASE("words: what choosing a component kept, where one was dropped") {
  CHECK(kept_line({}).empty());
  KeptParts parts;
  parts.count = 2;
  parts.area_share = 0.997;
  parts.face_share = 0.98;
  CHECK(kept_line(parts) == "kept 99.7 % of the area and 98 % of the faces, lost 0.3 % and 2 %");
  parts.area_share = parts.face_share = 0.00001;
  CHECK(kept_line(parts) ==
        "kept 0.001 % of the area and 0.001 % of the faces, lost 100 % and 100 %");
  parts.refused = true;
  CHECK(kept_line(parts).empty());
}

TEST_CASE("words: faces that had no place are told where shares are of areas that are known") {
  KeptParts parts;
  parts.face_share = 0.9;
  CHECK(kept_line(parts, {{RepairKind::HoleFilled, 3, {}, ""}}).empty());
  CHECK(kept_line(parts, {{RepairKind::NonFiniteFaceRemoved, 6, {}, ""}}) ==
        "kept 100 % of the area and 90 % of the faces, lost 0 % and 10 %; 6 faces had no area that "
        "can be measured");
}

TEST_CASE("words: a stage tells what was measured, and nothing else") {
  StageRecord stage{.name = "harmonic", .seconds = 0.125};
  CHECK(stage_line(stage) == "harmonic: 0.125 s");
  stage.folds = 3;
  stage.distortion = DistortionSummary{.mean_abs_ln_area = 0.591, .mean_abs_ln_angle = 0.55};
  CHECK(stage_line(stage) == "harmonic: 0.125 s, 3 folds, " + distortion_line(*stage.distortion));
  CHECK(distortion_line(*stage.distortion) == "angle 0.55 area 0.591");
  stage.distortion->flat_images = 3;
  stage.distortion->flat_faces = 2;
  CHECK(
      distortion_line(*stage.distortion) ==
      "angle 0.55 (but for 3 triangles too thin on the sphere) area 0.591 (without 2 triangles of "
      "no area)");
}

TEST_CASE("words: of a radial map that was moved as a whole nothing is planetocentric") {
  RadialRecord radial{.folds = 3, .moved = 0.25};
  CHECK_THAT(radial_line(radial), Catch::Contains("25 % of the vertices moved") &&
                                      Catch::Contains("the others are planetocentric"));
  radial.moved = 1;
  CHECK_THAT(radial_line(radial), Catch::Contains("all vertices moved") &&
                                      Catch::Contains("none is planetocentric") &&
                                      !Catch::Contains("others"));
}

TEST_CASE("names: repairs by their words, and what asks for more than the usual ones") {
  CHECK(names_of(RepairOptions::none()).empty());
  CHECK(names_of({}).size() == repair_switches().size());
  RepairOptions options = RepairOptions::none();
  options.holes = options.non_manifold = true;
  CHECK(names_of(options) == std::vector<std::string>{"non-manifold", "holes"});
  CHECK(options_line(RepairOptions{}) == "--repair");
  CHECK(options_line(RepairOptions{.component = 2, .largest_hole = 900}) ==
        "--repair --component 2 --max-hole 900");
  CHECK(options_line(RepairOptions{.handle_choice = HandleChoice::Cut, .longest_handle = 0.514}) ==
        "--repair --handles cut --max-handle 51.4%");
  CHECK(options_line(RepairOptions{.longest_handle_length = 12.5}) == "--repair --max-handle 12.5");
}

TEST_CASE("words: the centre of a radial map has the digits that its body needs") {
  const RadialRecord far{.centre = {500123.25, 5200456.5, 312.125}};
  CHECK(radial_line(far, 3) ==
        "planetocentric: the surface is star-shaped about (500123.25, 5200456.5, 312.125)");
  const RadialRecord near{.centre = {0.123456, 1, 2}};
  CHECK(radial_line(near, 3) == "planetocentric: the surface is star-shaped about (0.123, 1, 2)");
}
