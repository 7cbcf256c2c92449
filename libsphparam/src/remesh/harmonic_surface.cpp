#include "sphparam/remesh/harmonic_surface.h"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

#include "option_domain.h"
#include "remesh/grid_domain.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/version.h"

namespace sphparam {
namespace {

constexpr Eigen::Index axes = 3;

void require_positions(const HarmonicExpansion& expansion) {
  const std::vector<std::string>& names = expansion.functions;
  const bool has_positions =
      std::ssize(names) >= axes && names[0] == "x" && names[1] == "y" && names[2] == "z";
  if (!has_positions || std::ssize(names) != expansion.fit.coefficients.cols())
    throw std::invalid_argument(
        "harmonic_surface: functions x, y, z, and then others, are needed, one a column");
}

MeshFile at_directions(const HarmonicExpansion& expansion, const Points& directions, int threads) {
  const Functions values = synthesise(expansion.fit.coefficients, directions, threads);
  MeshFile file;
  file.comments = expansion.comments;
  forget_vertices_of_file(file);
  file.mesh.positions = values.leftCols<axes>();
  for (Eigen::Index k = axes; k < values.cols(); ++k) {
    const VectorX column = values.col(k);
    file.set_vertex_property({expansion.functions[static_cast<size_t>(k)],
                              ScalarType::Float64,
                              {column.begin(), column.end()}});
  }
  return file;
}

Provenance provenance_of(const HarmonicExpansion& expansion, const std::string& grid) {
  Provenance lines = {{"version", version},
                      {"method", "harmonics"},
                      {"grid", std::filesystem::path(grid).filename().string()},
                      {"harmonics", std::to_string(expansion.degree())}};
  for (const auto& [key, value] : expansion.map) {
    if (key == "method") lines.emplace_back("source", value);
    if (key == "upright") lines.emplace_back(key, value);
  }
  if (expansion.aligned != HarmonicAlignment::None)
    lines.emplace_back("aligned", "first-order ellipsoid");
  lines.emplace_back("verdict", "one-to-one");
  return lines;
}

}  // namespace

HarmonicExpansion low_pass(HarmonicExpansion expansion, int degree) {
  if (degree < 0 || degree > expansion.degree())
    refuse_option("degree", degree, "0 to " + std::to_string(expansion.degree()));
  const Functions kept = expansion.fit.coefficients.topRows(harmonic_index(degree, degree) + 1);
  expansion.fit = {.coefficients = kept, .rms = {}};
  expansion.values.resize(0, kept.cols());
  expansion.plain_rms.resize(0);
  return expansion;
}

MappedMesh harmonic_surface(const HarmonicExpansion& expansion, SphereGrid grid, int threads) {
  require_positions(expansion);
  require_domain(grid);
  SphereMap map = unit_rays({std::move(grid.directions)});
  MeshFile file = at_directions(expansion, map.points, threads);
  adopt_triangulation(file, triangulate(file.mesh.positions, grid.faces));
  return MappedMesh({.file = std::move(file),
                     .map = std::move(map),
                     .provenance = provenance_of(expansion, grid.name),
                     .polygons = std::move(grid.faces),
                     .name = grid.name},
                    threads);
}

}  // namespace sphparam
