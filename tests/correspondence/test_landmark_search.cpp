#include <catch2/catch.hpp>

#include "correspondence/landmark_search.h"

namespace sphparam::tests {

namespace {

SuggestedLandmarks suggestion(Vertex partner, double score) {
  return {.landmarks = {{0, partner}}, .energy = 2, .agreement = 0, .score = score};
}

}  // namespace

TEST_CASE("confidence: from 0 where another is as good to 1, also where nothing is amiss in both") {
  CHECK(confidence_of({suggestion(1, 0.5)}) == 1);
  CHECK(confidence_of({suggestion(1, 0.5), suggestion(1, 0.5)}) == 1);  // it says the same
  CHECK(confidence_of({suggestion(1, 0.5), suggestion(2, 1)}) == 0.5);
  CHECK(confidence_of({suggestion(1, 0), suggestion(2, 1)}) == 1);
  CHECK(confidence_of({suggestion(1, 0), suggestion(2, 0)}) == 0);
  CHECK(confidence_of({suggestion(1, -1e-17), suggestion(2, 1)}) == 1);
}

}  // namespace sphparam::tests
