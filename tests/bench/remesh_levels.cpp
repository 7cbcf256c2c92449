// How near a shape its mesh on ico:L is, L from 2 to 8: a plot and a table. Where the shape is
// smooth and the grid's edges are longer than the source's, halving them should divide the RMS
// distance by 4; craters have rims, which are smooth only to fine grids.
//
// Usage: remesh_levels [-o remesh_levels.svg] [--samples N]

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

#include "geodesic_sphere.h"
#include "panels.h"
#include "report/svg.h"
#include "sample_meshes.h"
#include "sphparam/measure/surface_distance.h"
#include "sphparam/parameterize.h"
#include "sphparam/remesh/remesh.h"

using namespace sphparam;

namespace {

constexpr int coarsest = 2, finest = 8;
constexpr int frequency = 128;  // of sources: 327,680 triangles, as many as ico:7

struct Curve {
  std::string shape;
  double source_level;      // of an icosahedral grid with as many triangles as the source
  std::vector<double> rms;  // % of the diagonal, from the coarsest level on
};

/// A formula's surface over a fine sphere. Its map is that sphere, turned so that the vertices of
/// grids do not fall on its own.
MappedMesh surface(Vector3 (*formula)(const Vector3&)) {
  MappedMesh::Parts made{.file = {}, .map = {}};
  made.file.mesh = samples::geodesic_sphere(frequency, 0.1).mesh;
  Points& points = made.file.mesh.positions;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  made.map.points = (points * turn.transpose()).rowwise().normalized();
  for (Eigen::Index v = 0; v < points.rows(); ++v) points.row(v) = formula(points.row(v));
  return MappedMesh(std::move(made));
}

MappedMesh mapped(const MeshFile& file) {
  return MappedMesh({.file = file, .map = parameterize(file.mesh).map});
}

Vector3 ellipsoid(const Vector3& q) { return {2 * q.x(), q.y(), 0.6 * q.z()}; }

Vector3 bumpy(const Vector3& q) {
  return q * (1 + 0.2 * std::sin(3 * q.x()) * std::cos(2 * q.y() + q.z()));
}

Curve measure(const std::string& shape, const MappedMesh& source, std::int64_t samples) {
  Curve curve{.shape = shape,
              .source_level = std::log(static_cast<double>(source.mesh().face_count()) / 20) /
                              std::numbers::ln2 / 2,
              .rms = {}};
  std::printf("\n| %s: grid | RMS, %% of the diagonal | falls by |\n|---|---|---|\n",
              shape.c_str());
  for (int level = coarsest; level <= finest; ++level) {
    const Remeshed result =
        remesh(source, GridSpec{GridKind::Icosahedron, level}, {.transfer = {"none"}});
    const SurfaceDistance distance =
        measure_distance(source.mesh(), result.mesh(), {.samples = samples});
    const double rms = 100 * distance.rms() / distance.diagonal_first;
    std::printf("| ico:%d | %.3g | ", level, rms);
    curve.rms.empty() ? std::printf("|\n") : std::printf("%.2f |\n", curve.rms.back() / rms);
    std::fflush(stdout);
    curve.rms.push_back(rms);
  }
  return curve;
}

// --- the plot: RMS logarithmic, levels linear

constexpr bench::PanelRow frame = {.width = 280, .height = 320, .left = 70, .gap = 60};
constexpr double least = 1e-5, greatest = 10;

double x_of(double origin, double level) {
  return origin + frame.width * (level - coarsest + 0.5) / (finest - coarsest + 1);
}
double y_of(double rms) { return frame.height_at(bench::log_share(rms, least, greatest)); }

std::string axes(double origin, const std::string& title) {
  std::string svg = frame.title(origin, title);
  for (int level = coarsest; level <= finest; ++level)
    svg += frame.column_label(x_of(origin, level), std::to_string(level));
  for (double rms = greatest; rms > 0.9 * least; rms /= 10)
    svg += frame.row(origin, y_of(rms), significant(rms));
  return svg + frame.caption(origin, "RMS distance, % of the diagonal ↑   by level of ico: →");
}

std::string panel(const Curve& curve, double origin) {
  std::string svg = axes(origin, curve.shape);
  const double x = x_of(origin, curve.source_level);
  svg += svg_line(x, frame.top, x, frame.bottom(), "axis");
  svg += svg_text(x - 5, frame.top + 14, "label", "end", "the source's own triangles");
  const double fallen = curve.rms.front() / std::pow(4, finest - coarsest);
  svg += svg_line(x_of(origin, coarsest), y_of(curve.rms.front()), x_of(origin, finest),
                  y_of(fallen), "optimum");
  svg +=
      svg_text(x_of(origin, 6) - 12, y_of(fallen * 16) + 8, "caption", "end", "a quarter a level");
  std::vector<std::array<double, 2>> points;
  for (size_t i = 0; i < curve.rms.size(); ++i) {
    const double at = x_of(origin, coarsest + static_cast<double>(i)), height = y_of(curve.rms[i]);
    points.push_back({at, height});
    svg += bench::svg_dot(at, height, 3.5, "series0");
  }
  return svg + bench::svg_path(points, "series0");
}

std::string plot(const std::vector<Curve>& curves) {
  std::vector<std::string> panels;
  for (const Curve& curve : curves) panels.push_back(panel(curve, frame.origin(panels.size())));
  return frame.plot("Distance of a remeshed surface from its source, by level", panels);
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Plots the distance of remeshed shapes from their sources, by level.");
  std::string out = "remesh_levels.svg";
  std::int64_t samples = 400'000;
  app.add_option("-o", out, "the plot")->capture_default_str();
  app.add_option("--samples", samples, "of each surface")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  std::vector<Curve> curves;
  const MappedMesh known = surface(ellipsoid), bumps = surface(bumpy);
  const MeshFile body = samples::make_body(frequency);
  curves.push_back(measure("ellipsoid", known, samples));
  curves.push_back(measure("bumpy sphere, mapped", mapped(bumps.file()), samples));
  curves.push_back(measure("body with craters, mapped", mapped(body), samples));
  std::ofstream(out) << plot(curves);
} catch (const std::exception& error) {
  std::cerr << "remesh_levels: " << error.what() << "\n";
  return 1;
}
