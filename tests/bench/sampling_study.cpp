// How a grid's vertices are spread best: the distance of remeshed surfaces from their sources by
// the λ of the map, and with `--adaptive`. Tables and a plot; everything relative to λ = 1.
//
// Usage: sampling_study [MESH or FOLDER …] [-o sampling.svg] [--grid ico:5 …] [--samples N]
// Without names: the samples, and the folder of real meshes where it is there.

#include <CLI/CLI.hpp>
#include <algorithm>
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
#include "sample_meshes.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/measure/surface_distance.h"
#include "sphparam/parameterize.h"
#include "sphparam/remesh/adaptation.h"
#include "sphparam/remesh/remesh.h"
#include "yardstick.h"

using namespace sphparam;

namespace {

const std::vector<double> lambdas = {0.01, 0.03, 0.1, 0.3, 1, 2, 3, 5, 10, 30, 100};
constexpr size_t unit_lambda = 4;  // what everything is relative to

/// What was measured: the RMS distance, or the greatest.
struct Distances {
  std::vector<double> by_lambda;
  double adaptive;
};
struct Study {
  std::string mesh;
  Distances rms, max;
};

struct Distance {
  double rms, max;  // % of the diagonal
};

Distance distance_on(const std::string& grid, const MeshFile& source, const SphereMap& map,
                     std::int64_t samples) {
  const MappedMesh mapped({.file = source, .map = map});
  const Remeshed result = remesh(mapped, parse_grid(grid), {.transfer = {"none"}});
  const SurfaceDistance d = measure_distance(source.mesh, result.mesh(), {.samples = samples});
  return {100 * d.rms() / d.diagonal_first, 100 * d.max() / d.diagonal_first};
}

struct Maps {
  std::vector<SphereMap> by_lambda;
  SphereMap best;  // of `remeshing_lambda`
};

Maps make_maps(const TriangleMesh& mesh) {
  Maps maps;
  for (const double lambda : lambdas) {
    maps.by_lambda.push_back(parameterize(mesh, {.energy = {.lambda = lambda}}).map);
  }
  maps.best = parameterize(mesh, {.energy = {.lambda = remeshing_lambda}}).map;
  return maps;
}

Study study(const std::string& name, const std::string& grid, const MeshFile& source,
            const Maps& maps, std::int64_t samples) {
  Study result{name, {{}, 0}, {{}, 0}};
  for (const SphereMap& map : maps.by_lambda) {
    const Distance d = distance_on(grid, source, map, samples);
    result.rms.by_lambda.push_back(d.rms);
    result.max.by_lambda.push_back(d.max);
  }
  const MappedMesh best({.file = source, .map = maps.best});
  const Adaptation adapted = adapt_map(best, vertex_count(parse_grid(grid)));
  const Distance d = distance_on(grid, source, adapted.mapped.map(), samples);
  result.rms.adaptive = d.rms;
  result.max.adaptive = d.max;
  return result;
}

// --- tables

void print_head(const std::string& what) {
  std::printf("\n| %s | at λ = 1, %% of the diagonal |", what.c_str());
  for (const double lambda : lambdas) std::printf(" %g |", lambda);
  std::printf(" adaptive |\n|---|---|");
  for (size_t i = 0; i <= lambdas.size(); ++i) std::printf("---|");
  std::printf("\n");
}

/// Everything divided by what λ = 1 has.
Distances relative(const Distances& distances) {
  Distances result = distances;
  const double unit = distances.by_lambda[unit_lambda];
  for (double& d : result.by_lambda) d /= unit;
  result.adaptive /= unit;
  return result;
}

void print_row(const std::string& name, const std::string& unit, const Distances& ratios) {
  std::printf("| %s | %s |", name.c_str(), unit.c_str());
  for (const double ratio : ratios.by_lambda) std::printf(" %.2f |", ratio);
  std::printf(" %.2f |\n", ratios.adaptive);
  std::fflush(stdout);
}

/// Of all meshes: combine(ratios) for each λ, and with `--adaptive`.
template <class Combine>
Distances combined(const std::vector<Distances>& rows, const Combine& combine) {
  Distances result{{}, 0};
  std::vector<double> column;
  for (size_t i = 0; i < lambdas.size(); ++i) {
    column.clear();
    for (const Distances& row : rows) column.push_back(row.by_lambda[i]);
    result.by_lambda.push_back(combine(column));
  }
  column.clear();
  for (const Distances& row : rows) column.push_back(row.adaptive);
  result.adaptive = combine(column);
  return result;
}

double geometric_mean(const std::vector<double>& ratios) {
  double sum = 0;
  for (const double ratio : ratios) sum += std::log(ratio);
  return std::exp(sum / static_cast<double>(ratios.size()));
}

double worst(const std::vector<double>& ratios) {
  return *std::max_element(ratios.begin(), ratios.end());
}

void print_table(const std::string& what, const std::vector<Study>& studies,
                 Distances Study::*which) {
  print_head(what);
  std::vector<Distances> rows;
  for (const Study& s : studies) {
    rows.push_back(relative(s.*which));
    print_row(s.mesh, significant((s.*which).by_lambda[unit_lambda]), rows.back());
  }
  print_row("geometric mean", "", combined(rows, geometric_mean));
  print_row("worst", "", combined(rows, worst));
}

// --- the plot: both axes logarithmic, and a place of its own for `--adaptive`

constexpr bench::PanelRow frame = {.width = 380, .height = 300, .left = 60, .gap = 80};
constexpr double least = 0.2, greatest = 10;
constexpr double adaptive_place = 4.9;  // in decades from the least λ

double x_of(double origin, double decades) { return origin + frame.width * (decades + 0.2) / 5.4; }
double x_of_lambda(double origin, double lambda) {
  return x_of(origin, std::log10(lambda / lambdas.front()));
}
double y_of(double ratio) { return frame.height_at(bench::log_share(ratio, least, greatest)); }

std::string axes(double origin, const std::string& title) {
  std::string svg = frame.title(origin, title);
  for (const double lambda : {0.01, 0.1, 1.0, 10.0, 100.0})
    svg += frame.column(x_of_lambda(origin, lambda), significant(lambda));
  svg += frame.column_label(x_of(origin, adaptive_place), "adaptive");
  for (const double ratio : {0.2, 0.3, 0.5, 0.7, 1.0, 2.0, 3.0, 5.0, 10.0})
    svg += frame.row(origin, y_of(ratio), significant(ratio));
  return svg + frame.caption(origin, "distance against λ = 1 ↑   by λ of the map →");
}

std::string curve(const Distances& ratios, double origin, const char* series, double width) {
  std::vector<std::array<double, 2>> points;
  for (size_t i = 0; i < lambdas.size(); ++i)
    points.push_back({x_of_lambda(origin, lambdas[i]), y_of(ratios.by_lambda[i])});
  const std::string style =
      ";stroke-width:" + decimal(width, 1) + (width < 1 ? ";opacity:0.5" : "");
  return bench::svg_path(points, series, style) +
         bench::svg_dot(x_of(origin, adaptive_place), y_of(ratios.adaptive), 1.5 + width, series);
}

std::string panel(const std::string& title, const std::vector<Study>& studies,
                  Distances Study::*which, double origin) {
  std::string svg = axes(origin, title);
  std::vector<Distances> rows;
  for (const Study& s : studies) {
    rows.push_back(relative(s.*which));
    svg += curve(rows.back(), origin, "series0", 0.7);
  }
  return svg + curve(combined(rows, geometric_mean), origin, "series1", 2.5);
}

std::string plot(const std::vector<std::string>& grids,
                 const std::vector<std::vector<Study>>& studies) {
  std::vector<std::string> panels;
  for (size_t g = 0; g < grids.size(); ++g) {
    panels.push_back(
        panel(grids[g] + ": RMS", studies[g], &Study::rms, frame.origin(panels.size())));
    panels.push_back(
        panel(grids[g] + ": greatest", studies[g], &Study::max, frame.origin(panels.size())));
  }
  return frame.plot("Distance of remeshed surfaces by λ of the map", panels);
}

// --- the meshes

struct NamedMesh {
  std::string name;
  MeshFile file;
};

std::vector<std::filesystem::path> files_of(const std::vector<std::string>& names) {
  std::vector<std::filesystem::path> files;
  for (const std::string& name : names) {
    if (!std::filesystem::is_directory(name)) {
      files.emplace_back(name);
      continue;
    }
    for (const std::filesystem::path& file : bench::mesh_files(name)) files.push_back(file);
  }
  return files;
}

std::vector<NamedMesh> meshes_of(std::vector<std::string> names) {
  std::vector<NamedMesh> meshes;
  if (names.empty()) {
    meshes = {{"sample body", samples::make_body()},
              {"sample creature", samples::make_creature()},
              {"sample cortex", samples::make_cortex()}};
    if (std::filesystem::is_directory(bench::meshes_folder())) names = {bench::meshes_folder()};
  }
  for (const std::filesystem::path& path : files_of(names)) {
    meshes.push_back({path.stem(), prepare_for_mapping(read_mesh(path))});
  }
  return meshes;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Measures how the map decides what a grid's vertices are worth.");
  std::vector<std::string> names, grids = {"ico:5", "octa:65"};
  std::string out = "sampling.svg";
  std::int64_t samples = 200'000;
  app.add_option("MESH", names);
  app.add_option("-o", out, "the plot")->capture_default_str();
  app.add_option("--grid", grids)->capture_default_str();
  app.add_option("--samples", samples, "of each surface")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  std::vector<std::vector<Study>> studies(grids.size());
  for (const NamedMesh& mesh : meshes_of(names)) {
    const Maps maps = make_maps(mesh.file.mesh);
    for (size_t g = 0; g < grids.size(); ++g) {
      studies[g].push_back(study(mesh.name, grids[g], mesh.file, maps, samples));
    }
    std::cerr << mesh.name << "\n";
  }
  for (size_t g = 0; g < grids.size(); ++g) {
    print_table(grids[g] + ": RMS", studies[g], &Study::rms);
    print_table(grids[g] + ": greatest", studies[g], &Study::max);
  }
  std::ofstream(out) << plot(grids, studies);
} catch (const std::exception& error) {
  std::cerr << "sampling_study: " << error.what() << "\n";
  return 1;
}
