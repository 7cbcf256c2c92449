#include <catch2/catch.hpp>

#include "sphparam/frame_check.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

TriangleMesh egg() {
  TriangleMesh mesh = icosphere(2);
  mesh.positions.col(2) *= 1.5;
  return mesh;
}

Parameterization mapped(const ParameterizeOptions& options) {
  const TriangleMesh mesh = egg();
  return parameterize(mesh, require_sphere(mesh), options);
}

}  // namespace

TEST_CASE("frame check: what was asked for holds in a map made for it, and not in others") {
  ParameterizeOptions wanted;
  wanted.poles = Poles{3, 90};
  const Parameterization result = mapped(wanted);
  const FrameCheck good = check_frame(result, wanted);
  CHECK(good.holds());
  CHECK(good.pole_residuals == std::vector<double>{0, 0});

  wanted.poles = Poles{90, 3};
  const FrameCheck turned = check_frame(result, wanted);
  CHECK_FALSE(turned.poles);
  CHECK(turned.pins);
  CHECK_FALSE(turned.holds());
  CHECK(turned.pole_residuals[0] == Approx(3.14159265));
}

TEST_CASE("frame check: nothing asked for holds always, without a map nothing else does") {
  const Parameterization none;
  CHECK(check_frame(none, {}).holds());
  ParameterizeOptions wanted;
  wanted.poles = Poles{1, 2};
  wanted.meridian = 5;
  wanted.pins = {{.vertex = 7, .coordinates = {}}};
  const FrameCheck check = check_frame(none, wanted);
  CHECK_FALSE(check.pins);
  CHECK_FALSE(check.poles);
  CHECK_FALSE(check.meridian);
  CHECK(check.pole_residuals.empty());
}

TEST_CASE("frame check: pins and a meridian hold where they are exactly at their places") {
  ParameterizeOptions wanted;
  wanted.meridian = 17;
  CHECK(check_frame(mapped(wanted), wanted).holds());
  ParameterizeOptions pinned;
  pinned.pins = {{.vertex = 4, .coordinates = {1, 1}}};
  Parameterization result = mapped(pinned);
  CHECK(check_frame(result, pinned).pins);
  result.pin_residuals[0] = 1e-12;
  CHECK_FALSE(check_frame(result, pinned).pins);
}
