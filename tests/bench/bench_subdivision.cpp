// Measures a subdivision fit in multiples of one sparse factorisation of the same normal matrix, by
// Eigen's SimplicialLDLT (analysis and factors) in the same run: some 10,000 control points, and
// samples on both sides of 200,000.
//
// Usage: bench_subdivision [--repeat N] [--threads N] [MESH]
// Without a mesh: the sample body, 348,480 triangles. Never a test: machines are noisy.

#include <CLI/CLI.hpp>
#include <Eigen/SparseCholesky>
#include <cstdio>
#include <iostream>
#include <limits>

#include "io/polygons/welding.h"
#include "remesh/subdivision/limit_stencils.h"
#include "sample_meshes.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/parameterize.h"
#include "sphparam/remesh/subdivision.h"
#include "yardstick.h"

using namespace sphparam;
using namespace sphparam::bench;

namespace {

constexpr int body_frequency = 132;

/// Σ Wᵀ W.
Eigen::SparseMatrix<double> normal_matrix(const SphereGrid& grid, Scheme scheme,
                                          int samples_along) {
  const auto count = static_cast<int>(grid.directions.rows());
  const LimitTopology topology(grid.faces, count, scheme);
  const LimitStencils stencils(topology, middles_of_pieces(scheme, samples_along));
  std::vector<Eigen::Triplet<double>> entries;
  for (int p = 0; p < stencils.patch_count(); ++p) {
    const Eigen::MatrixXd product = stencils.weights(p).transpose() * stencils.weights(p);
    const auto controls = stencils.controls(p);
    for (int i = 0; i < product.rows(); ++i) {
      for (int j = 0; j < product.cols(); ++j) {
        entries.emplace_back(controls[static_cast<size_t>(i)], controls[static_cast<size_t>(j)],
                             product(i, j));
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

void compare(const MeshFile& source, const SphereMap& map, const char* name, Scheme scheme,
             int samples_along, int repeat, int threads) {
  const SphereGrid grid = make_grid(parse_grid(name));
  const Eigen::SparseMatrix<double> matrix = normal_matrix(grid, scheme, samples_along);
  double factorisation = std::numeric_limits<double>::max(), whole = factorisation;
  SubdivisionFit best;
  for (int i = 0; i < repeat; ++i) {  // turn by turn: other programs slow both down
    double start = now();
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
    factorisation = std::min(factorisation, now() - start);
    start = now();
    SubdivisionFit fit = fit_subdivision(
        MappedMesh({.file = source, .map = map}, threads), grid,
        {.scheme = scheme, .samples_along_edge = samples_along, .threads = threads});
    const double seconds = now() - start;
    if (seconds < whole) {
      whole = seconds;
      best = std::move(fit);
    }
  }
  std::printf("%s: %ld control points, %ld samples: %.3f s, factorisation %.3f s, ratio %.2f\n",
              name, static_cast<long>(best.control.rows()), static_cast<long>(best.samples), whole,
              factorisation, whole / factorisation);
  std::printf("  samples %.3f s, solving %.3f s (steps", best.sampling_seconds,
              best.solving_seconds);
  for (const int steps : best.steps) std::printf(" %d", steps);
  std::printf("), nearest points %.3f s\n", best.projecting_seconds);
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Measures subdivision fits in multiples of a sparse factorisation.");
  std::string path;
  int repeat = 5, threads = 2;
  app.add_option("MESH", path);
  app.add_option("--repeat", repeat)->capture_default_str();
  app.add_option("--threads", threads)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const MeshFile source = path.empty()
                              ? samples::make_body(body_frequency)
                              : prepare_for_mapping(read_mesh(std::filesystem::path(path)));
  const SphereMap map = parameterize(source.mesh, {.threads = threads}).map;
  for (const int along : {3, 4}) {
    compare(source, map, "ico:5", Scheme::Loop, along, repeat, threads);
  }
  for (const int along : {4, 5}) {
    compare(source, map, "cube:41", Scheme::CatmullClark, along, repeat, threads);
  }
} catch (const std::exception& error) {
  std::cerr << "bench_subdivision: " << error.what() << "\n";
  return 1;
}
