#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "sphparam/records/told.h"

namespace sphparam::tests {

using Json = nlohmann::ordered_json;

TEST_CASE("told: a record says what was told beside it, each thing once") {
  const std::string record =
      R"({"file": "egg.obj", "area": 0.1, "losses": ["not carried: skins"], "seconds": 1})";
  const Json json = Json::parse(with_told(
      record, {.warnings = {"inside out"},
               .losses = {"egg.obj: not carried: skins", "egg.ply: not carried: quads"}}));
  CHECK(json == Json::parse(R"({"file": "egg.obj", "area": 0.1,
                        "losses": ["not carried: skins", "egg.ply: not carried: quads"],
                        "seconds": 1, "warnings": ["inside out"], "notes": []})"));
  CHECK(json["area"].dump() == "0.1");
}

TEST_CASE("told: a line that only ends as another does is another") {
  const Json json = Json::parse(with_told(R"({"warnings": ["flat", ""]})",
                                          {.warnings = {"not flat", "egg.obj: flat", "odd"}}));
  CHECK(json["warnings"] == Json::parse(R"(["flat", "", "not flat", "odd"])"));
}

TEST_CASE(
    "told: nothing is three empty lists, and bytes of file names that are no text do not matter") {
  CHECK(Json::parse(with_told("{}", {})) ==
        Json::parse(R"({"warnings": [], "notes": [], "losses": []})"));
  CHECK(Json::parse(with_told("{}", {.notes = {"a\xFF.obj: odd"}}))["notes"].size() == 1);
}

}  // namespace sphparam::tests
