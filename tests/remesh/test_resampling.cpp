#include <catch2/catch.hpp>
#include <cmath>

#include "remesh/resampling.h"
#include "sphparam/io/mesh_file.h"

// Colours of one triangle, at a point of it and over a cell, with numbers worked out by hand.

using namespace sphparam;

namespace {

const Triangles one_triangle = (Triangles(1, 3) << 0, 1, 2).finished();

/// A sample that is a mean over a cell of vertices 0 and 1, by these weights.
Resampling cell(double first, double second) {
  static Gather cells;
  cells = {{0, 2}, {0, 1}, {first, second}};
  static const std::vector<SurfacePoint> points = {{0, {1, 0, 0}}};
  return {one_triangle, points, cells, 1};
}

/// A sample at the middle of the edge of vertices 0 and 1.
Resampling middle() {
  static const Gather none;
  static const std::vector<SurfacePoint> points = {{0, {0.5, 0.5, 0}}};
  return {one_triangle, points, none, 1};
}

double colour(const Resampling& resampling, const char* name, ScalarType type, double a, double b) {
  return resample_colour(resampling, {name, type, {a, b, b}}).front();
}

/// The curve of IEC 61966-2-1, and back.
double light(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }
double shown(double l) { return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055; }

}  // namespace

TEST_CASE("resampling: over cells colours are means of light, in the unit of their type") {
  const double half = shown(0.5), quarter = shown(0.25 * light(0.2) + 0.75 * light(0.8));
  CHECK(colour(cell(0.5, 0.5), "red", ScalarType::Uint8, 0, 255) == std::round(255 * half));
  for (const ScalarType type : {ScalarType::Int32, ScalarType::Int16, ScalarType::Uint32})
    CHECK(colour(cell(0.5, 0.5), "red", type, 0, 255) == std::round(255 * half));
  CHECK(colour(cell(0.5, 0.5), "blue", ScalarType::Uint16, 0, 65535) ==
        Approx(65535 * half).margin(2));
  CHECK(colour(cell(0.5, 0.5), "green", ScalarType::Float32, 0, 1) == Approx(half).margin(1e-5));
  CHECK(colour(cell(0.25, 0.75), "red", ScalarType::Float64, 0.2, 0.8) ==
        Approx(quarter).margin(1e-5));
}

TEST_CASE("resampling: alpha, and what is out of the range of the curve, are plain means") {
  CHECK(colour(cell(0.25, 0.75), "alpha", ScalarType::Uint8, 0, 240) == 180);
  CHECK(colour(cell(0.25, 0.75), "red", ScalarType::Float64, 0, 2) == 1.5);
  CHECK(colour(cell(0.25, 0.75), "red", ScalarType::Float64, -1, 1) == 0.5);
  CHECK(colour(cell(0.5, 0.5), "red", ScalarType::Uint8, 0, 256) == 128);
}

TEST_CASE("resampling: at points colours are means of light as over cells, alpha is a plain mean") {
  CHECK(colour(middle(), "red", ScalarType::Uint8, 0, 255) == 188);
  CHECK(colour(middle(), "red", ScalarType::Float64, 0.25, 0.75) ==
        Approx(shown(0.5 * light(0.25) + 0.5 * light(0.75))).margin(1e-5));
  CHECK(colour(middle(), "alpha", ScalarType::Float64, 0.25, 0.75) == 0.5);
  for (const double same : {0.0, 0.1, 0.7, 1.0})
    CHECK(colour(middle(), "red", ScalarType::Float64, same, same) == same);
}

TEST_CASE("resampling: what has no weight is not looked at") {
  const double nan = std::nan("");
  CHECK(resample_property(cell(1, 0), {"x", ScalarType::Float64, {3, nan, nan}}).front() == 3);
  CHECK(resample_property(middle(), {"x", ScalarType::Float64, {3, 4, nan}}).front() == 3.5);
}

TEST_CASE("resampling: whole numbers are rounded, floats are those of 32 bits") {
  CHECK(resample_property(cell(0.25, 0.75), {"x", ScalarType::Int32, {0, 5, 0}}).front() == 4);
  CHECK(resample_property(cell(0.25, 0.75), {"x", ScalarType::Float32, {0, 0.2, 0}}).front() ==
        static_cast<double>(static_cast<float>(0.75 * 0.2)));
  CHECK(resample_property(cell(0.25, 0.75), {"x", ScalarType::Float64, {0, 0.2, 0}}).front() ==
        0.75 * 0.2);
}
