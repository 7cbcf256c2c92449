#include <catch2/catch.hpp>

#include "bake/baked_chart.h"
#include "texture/baked_texts.h"

using namespace sphparam;

TEST_CASE("baked chart: what an image says of its chart is read again, a text each or all in one") {
  CHECK(pole_wedges_of(texts_of_chart(true, 4)) == 4);
  CHECK(pole_wedges_of(texts_of_chart(false, 4)) == std::nullopt);
  CHECK(pole_wedges_of({{"sphparam:interpolation", "uv"}}) == 1);
  CHECK(pole_wedges_of({}) == std::nullopt);
  const ImageTexts one = {{"Software", "sphparam:interpolation=sphere"},
                          {"ImageDescription",
                           "sphparam:map=position\nsphparam:interpolation=uv\n"
                           "sphparam:refine_poles=16\nsphparam:convention=gis"}};
  CHECK(pole_wedges_of(one) == 16);
  CHECK(baked_convention_of(one) == Convention::Gis);
  CHECK(baked_text(one, "sphparam:map") == "position");
  CHECK(baked_text(one, "sphparam:ma").empty());
  CHECK(baked_text(one, "Software") == "sphparam:interpolation=sphere");
}
