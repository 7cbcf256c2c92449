#include <catch2/catch.hpp>

#include "io/attributes/specular_glossiness.h"

using namespace sphparam;
using Catch::Detail::Approx;

namespace {

using Colour = std::array<double, 3>;

Colour grey(double x) { return {x, x, x}; }

}  // namespace

TEST_CASE("specular_glossiness: plastic has the diffuse colour, metal the specular one") {
  const MetallicRoughness plastic = as_metallic_roughness({0.8, 0.1, 0.3}, grey(0.04), 0.25);
  CHECK(plastic.metallic == 0);
  CHECK(plastic.roughness == 0.75);
  for (std::size_t c = 0; c < 3; ++c)
    CHECK(plastic.base_colour[c] == Approx(Colour{0.8, 0.1, 0.3}[c]));
  const MetallicRoughness gold = as_metallic_roughness(grey(0), {1, 0.77, 0.34}, 1);
  CHECK(gold.metallic == Approx(1));
  CHECK(gold.roughness == Approx(0));
  for (std::size_t c = 0; c < 3; ++c)
    CHECK(gold.base_colour[c] == Approx(Colour{1, 0.77, 0.34}[c]));
}

TEST_CASE("specular_glossiness: what was made of metallic and roughness comes back") {
  for (const double base : {0.1, 0.5, 0.9}) {
    for (const double metallic : {0.0, 0.2, 0.5, 0.9, 1.0}) {
      const double specular = 0.04 * (1 - metallic) + base * metallic;
      const double diffuse = base * 0.96 * (1 - metallic) / (1 - specular);
      const MetallicRoughness back = as_metallic_roughness(grey(diffuse), grey(specular), 0.5);
      INFO(base << ", " << metallic);
      CHECK(back.metallic == Approx(metallic).margin(1e-9));
      for (const double x : back.base_colour) CHECK(x == Approx(base));
    }
  }
}

TEST_CASE("specular_glossiness: whatever the numbers, the result is in range") {
  for (const double diffuse : {0.0, 0.5, 1.0, 7.0}) {
    for (const double specular : {0.0, 0.04, 1.0, 3.0}) {
      for (const double glossiness : {-1.0, 0.0, 2.0}) {
        const MetallicRoughness made =
            as_metallic_roughness({diffuse, 0, 1}, {specular, 1, 0}, glossiness);
        for (const double x :
             {made.metallic, made.roughness, made.base_colour[0], made.base_colour[1]}) {
          CHECK(x >= 0);
          CHECK(x <= 1);
        }
      }
    }
  }
}

TEST_CASE("specular_glossiness: without its images a texture has what the factors say") {
  SpecularGlossiness said;
  said.diffuse.factor = {0.5, 0.5, 0.5, 0.25};
  said.specular.factor = {0.04, 0.04, 0.04, 0.75};
  const auto left = [&](int channel) {
    MaterialTexture texture{.image = "a.png", .channel = channel};
    texture.made_of = std::make_shared<const SpecularGlossiness>(said);
    leave_factors(texture);
    CHECK(texture.image.empty());
    CHECK_FALSE(texture.made_of);
    return texture.factor;
  };
  CHECK(left(0)[1] == Approx(0.5));
  CHECK(left(0)[3] == 0.25);
  CHECK(left(1)[0] == 0.25);
  CHECK(left(2)[0] == 0);
}
