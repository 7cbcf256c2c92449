// Angle against area as λ goes from 1e-8 to 1e3: a plot and a table, for up to a few meshes.
//
// Usage: tradeoff MESH … [-o tradeoff.svg]
// A mesh is a panel; a dot is a map, λ written beside some. The presets are marked, and so is the
// map of the paper's method (folds and all), where it has one.

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "io/polygons/welding.h"
#include "panels.h"
#include "report/svg.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/parameterize.h"

using namespace sphparam;

namespace {

struct Dot {
  std::string label;
  double angle, area;  // mean |ln angle ratio|; mean |log2 area ratio|, weighted by source area
  bool certified;
  double lambda;
};

struct Curve {
  std::string mesh;
  std::vector<Dot> sweep, presets;
};

Dot map_with(const TriangleMesh& mesh, const ParameterizeOptions& options,
             const std::string& label) {
  const Parameterization result = parameterize(mesh, options);
  const DistortionSummary d = summarise(measure_distortion(mesh, result.map));
  const Dot dot{label, d.mean_abs_ln_angle, d.weighted_abs_log2_area,
                result.certificate.bijective(), options.energy.lambda};
  std::printf("| %s | %.4f | %.4f | %s |\n", label.c_str(), dot.angle, dot.area,
              dot.certified ? "yes" : "no");
  std::fflush(stdout);
  return dot;
}

Curve measure(const std::string& path) {
  const TriangleMesh mesh = prepare_for_mapping(read_mesh(path)).mesh;
  Curve curve{.mesh = std::filesystem::path(path).stem(), .sweep = {}, .presets = {}};
  std::printf(
      "\n| %s: λ | mean \\|ln angle\\| | weighted \\|log2 area\\| | certified |\n"
      "|---|---|---|---|\n",
      curve.mesh.c_str());
  for (const double lambda : {1e-8, 1e-6, 1e-4, 1e-3, 1e-2, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0, 1e3}) {
    curve.sweep.push_back(map_with(mesh, {.energy = {.lambda = lambda}}, significant(lambda)));
  }
  curve.presets.push_back(map_with(mesh, {.balance = Balance::Conformal}, "conformal"));
  curve.presets.push_back(map_with(mesh, {.balance = Balance::EqualArea}, "equal-area"));
  curve.presets.push_back(map_with(mesh, {.method = Method::Curvilinear}, "curvilinear"));
  curve.presets.push_back(map_with(mesh, {.method = Method::Paper}, "the paper"));
  return curve;
}

/// The others would cover each other.
bool labelled(double lambda) {
  for (const double shown : {1e-4, 0.01, 0.1, 1.0, 10.0, 100.0, 1e3}) {
    if (lambda == shown) return true;
  }
  return false;
}

// --- the plot: both axes logarithmic

constexpr bench::PanelRow frame = {.width = 400, .height = 320, .left = 60, .gap = 70};
constexpr double least_angle = 0.01, greatest_angle = 3, least_area = 0.01, greatest_area = 30;

double x_of(double origin, double angle) {
  return origin + frame.width * bench::log_share(angle, least_angle, greatest_angle);
}
double y_of(double area) {
  return frame.height_at(bench::log_share(area, least_area, greatest_area));
}

std::string axes(double origin, const std::string& title) {
  std::string svg = frame.title(origin, title);
  for (const double angle : {0.01, 0.03, 0.1, 0.3, 1.0})
    svg += frame.column(x_of(origin, angle), significant(angle));
  for (const double area : {0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0})
    svg += frame.row(origin, y_of(area), significant(area));
  return svg + frame.caption(
                   origin, "mean |ln angle ratio| →   against   weighted mean |log₂ area ratio| ↑");
}

std::string panel(const Curve& curve, double origin) {
  std::string svg = axes(origin, curve.mesh);
  std::vector<std::array<double, 2>> points;
  for (const Dot& dot : curve.sweep) {
    const double x = x_of(origin, dot.angle), y = y_of(dot.area);
    points.push_back({x, y});
    svg += bench::svg_dot(x, y, 3.5, "series0");
    if (labelled(dot.lambda)) svg += svg_text(x - 7, y + 11, "label", "end", "λ = " + dot.label);
  }
  svg += bench::svg_path(points, "series0");
  for (const Dot& dot : curve.presets) {
    svg += bench::svg_dot(x_of(origin, dot.angle), y_of(dot.area), 5, "series1");
    svg += svg_text(x_of(origin, dot.angle) + 8, y_of(dot.area) - 5, "caption", "start",
                    dot.label + (dot.certified ? "" : " (folds)"));
  }
  return svg;
}

std::string plot(const std::vector<Curve>& curves) {
  std::vector<std::string> panels;
  for (const Curve& curve : curves) panels.push_back(panel(curve, frame.origin(panels.size())));
  return frame.plot("Angle against area distortion, by λ", panels);
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Plots angle against area distortion, by λ.");
  std::vector<std::string> meshes;
  std::string out = "tradeoff.svg";
  app.add_option("MESH", meshes)->required();
  app.add_option("-o", out, "the plot");
  CLI11_PARSE(app, argc, argv);
  std::vector<Curve> curves;
  for (const std::string& path : meshes) curves.push_back(measure(path));
  std::ofstream(out) << plot(curves);
} catch (const std::exception& error) {
  std::cerr << "tradeoff: " << error.what() << "\n";
  return 1;
}
