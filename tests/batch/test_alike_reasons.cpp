#include <catch2/catch.hpp>
#include <string>
#include <utility>
#include <vector>

#include "batch/alike_reasons.h"

using namespace sphparam;

namespace {

using Reasons = std::vector<std::pair<std::string, std::string>>;  // of an id

BatchItem item_of(const std::string& id) { return {.id = id, .path = "/in/" + id + ".off"}; }

bool alike(const Reasons& reasons) {
  const std::string kind = wording_of(reasons[0].second, item_of(reasons[0].first)).kind;
  for (const auto& [id, reason] : reasons)
    if (wording_of(reason, item_of(id)).kind != kind) return false;
  return true;
}

std::string told(const Reasons& reasons) {
  AlikeReasons together;
  for (const auto& [id, reason] : reasons)
    together.add(reason, item_of(id), wording_of(reason, item_of(id)));
  return together.text();
}

}  // namespace

TEST_CASE("alike_reasons: numbers that differ are told from the least to the greatest") {
  const Reasons reasons{{"a", "2 separate components; the largest has 432 faces and 50 %"},
                        {"b", "12 separate components; the largest has 9.5 faces and 94 %"},
                        {"c", "3 separate components; the largest has 1000 faces and 50 %"}};
  CHECK(alike(reasons));
  CHECK(told(reasons) ==
        "2 to 12 separate components; the largest has 9.5 to 1000 faces and 50 to 94 %");
  CHECK(told({{"a", "at -3.5, 1e-05 and 7"}, {"b", "at 2, 1e+20 and 7"}}) ==
        "at -3.5 to 2, 1e-05 to 1e+20 and 7");
}

TEST_CASE("alike_reasons: one reason, and equal ones, are told as they are but for folders") {
  CHECK(told({{"sub-01", "/in/sub-01.off:3: no number"}}) == "sub-01.off:3: no number");
  const Reasons equal{{"a", "vertex 7 of 8"}, {"b", "vertex 7 of 8"}};
  CHECK(told(equal) == "vertex 7 of 8");
}

TEST_CASE(
    "alike_reasons: a shape's names are NAME where they stand alone, numbers in words a star") {
  const Reasons reasons{{"ell", "/in/ell.off:3: pins_001.txt of ell has a bad cell"},
                        {"sub-2", "/in/sub-2.off:5: pins_02.txt of sub-2 has a bad cell"}};
  CHECK(alike(reasons));
  CHECK(told(reasons) == "NAME:3 to 5: pins_*.txt of NAME has a bad cell");
}

TEST_CASE(
    "alike_reasons: control characters of strangers are told as spaces, not taken for marks") {
  CHECK(told({{"a", "bad word \x01\x02\x03 of 7"}, {"b", "bad word \x02\x02\x02 of 9"}}) ==
        "bad word     of 7 to 9");
  CHECK(told({{"a", "cell \x02"}}) == "cell  ");
  const Reasons apart{{"a", "cell \x02"}, {"b", "cell 5"}};
  CHECK_FALSE(alike(apart));
}

TEST_CASE("alike_reasons: no reason at all is one as well") {
  CHECK(told({{"a", ""}, {"b", ""}}).empty());
}

TEST_CASE("alike_reasons: an id of digits is a number like others") {
  const Reasons reasons{{"1", "1 hole: 11 edges"}, {"2", "2 holes: 5 edges"}};
  CHECK_FALSE(alike(reasons));
  CHECK(told({{"1", "vertex 11 of 12"}, {"2", "vertex 2 of 12"}}) == "vertex 2 to 11 of 12");
}
