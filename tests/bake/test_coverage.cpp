#include <array>
#include <catch2/catch.hpp>

#include "bake/texels/coverage.h"

using namespace sphparam;

namespace {

/// A field that is ½ in all channels, on a surface whose face 1 is a filler.
SurfaceField half(int channels) {
  SurfaceField field{.name = "half", .channels = channels, .kind = FieldKind::Colour};
  field.evaluate = [channels](std::span<const SurfaceSample> samples, float* values) {
    std::fill_n(values, samples.size() * static_cast<size_t>(channels), 0.5F);
  };
  return with_coverage(std::move(field), {0, 1});
}

std::vector<float> of_both_faces(const SurfaceField& field) {
  const std::array<SurfaceSample, 2> samples = {SurfaceSample{{0, {1, 0, 0}}, 0},
                                                SurfaceSample{{1, {1, 0, 0}}, 0}};
  std::vector<float> values(2 * static_cast<size_t>(field.channels));
  field.evaluate(samples, values.data());
  return values;
}

}  // namespace

TEST_CASE("coverage: a channel more, 1 on the surface and 0 on fillers") {
  for (const int channels : {1, 3}) {
    const SurfaceField field = half(channels);
    CHECK(field.channels == channels + 1);
    CHECK(field.has_coverage);
    CHECK(field.proper_channels() == channels);
    std::vector<float> wanted(2 * static_cast<size_t>(field.channels), 0.5F);
    wanted[static_cast<size_t>(channels)] = 1;
    wanted.back() = 0;
    CHECK(of_both_faces(field) == wanted);
  }
}

TEST_CASE("coverage: of colours that have alpha it is a factor of that") {
  const SurfaceField field = half(4);
  CHECK(field.channels == 4);
  CHECK_FALSE(field.has_coverage);
  CHECK(of_both_faces(field) == std::vector<float>{0.5F, 0.5F, 0.5F, 0.5F, 0.5F, 0.5F, 0.5F, 0});
}
