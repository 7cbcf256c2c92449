// Spherical harmonics: how near the reconstruction is, by degree; how fast the fit is beside a
// dense least-squares solve of the same problem; how many digits survive to high degrees.
//
// Usage: spharm_tables [MESH or FOLDER …] [--degree L …] [--samples N] [--speed-degree L]
// Without names: the folder of real meshes where it is there, else the samples.
// The dense solve is what a user without a transform does: the matrix of all harmonics at all
// vertices, its normal matrix, Cholesky. The matrix does not fit into memory, so rows come in
// blocks; the time of the first few blocks is multiplied up, the factorisation is timed in full.

#include <CLI/CLI.hpp>
#include <Eigen/Cholesky>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "geodesic_sphere.h"
#include "io/polygons/welding.h"
#include "sample_meshes.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/measure/surface_distance.h"
#include "sphparam/parameterize.h"
#include "sphparam/sphere/spherical_harmonics.h"
#include "yardstick.h"

using namespace sphparam;

namespace {

// --- error by degree
// ------------------------------------------------------------------------------

struct Reconstruction {
  double rms;          // surface to surface, % of the diagonal
  double at_vertices;  // the same of the residual at the vertices
  int iterations;
  double seconds;
};

Reconstruction reconstruct(const TriangleMesh& mesh, const Topology& topology, const SphereMap& map,
                           int degree, std::int64_t samples) {
  const double start = bench::now();
  const HarmonicFit fit = fit_harmonics(topology, map, mesh.positions, {.degree = degree});
  const double seconds = bench::now() - start;
  const TriangleMesh rebuilt{synthesise(fit.coefficients, map.points), mesh.triangles};
  const SurfaceDistance distance = measure_distance(mesh, rebuilt, {.samples = samples});
  return {100 * distance.rms() / distance.diagonal_first,
          100 * fit.rms.norm() / distance.diagonal_first, fit.iterations, seconds};
}

/// Did the error fall at every step?
bool print_row(const std::string& name, const TriangleMesh& mesh, const std::vector<int>& degrees,
               std::int64_t samples) {
  const Topology topology(mesh);
  const SphereMap map = parameterize(mesh).map;
  std::printf("| %s | %d |", name.c_str(), topology.face_count());
  std::vector<double> errors;
  for (const int degree : degrees) {
    const Reconstruction r = reconstruct(mesh, topology, map, degree, samples);
    std::printf(" %.3g / %.3g (%d, %.2g s) |", r.rms, r.at_vertices, r.iterations, r.seconds);
    std::fflush(stdout);
    errors.push_back(r.rms);
  }
  const bool falls = std::is_sorted(errors.rbegin(), errors.rend());
  std::printf(" %s |\n", falls ? "yes" : "NO");
  return falls;
}

struct NamedMesh {
  std::string name;
  TriangleMesh mesh;
};

std::vector<NamedMesh> meshes_of(std::vector<std::string> names) {
  std::vector<NamedMesh> meshes;
  if (names.empty() && std::filesystem::is_directory(bench::meshes_folder())) {
    names = {bench::meshes_folder()};
  } else if (names.empty()) {
    meshes = {{"sample body", samples::make_body().mesh},
              {"sample creature", samples::make_creature().mesh},
              {"sample cortex", samples::make_cortex().mesh}};
  }
  for (const std::string& name : names) {
    const bool is_folder = std::filesystem::is_directory(name);
    for (const std::filesystem::path& path :
         is_folder ? bench::mesh_files(name) : std::vector<std::filesystem::path>{name}) {
      meshes.push_back({path.stem(), prepare_for_mapping(read_mesh(path)).mesh});
    }
  }
  std::stable_sort(meshes.begin(), meshes.end(), [](const NamedMesh& a, const NamedMesh& b) {
    return a.mesh.face_count() < b.mesh.face_count();
  });
  return meshes;
}

bool print_errors(const std::vector<NamedMesh>& meshes, const std::vector<int>& degrees,
                  std::int64_t samples) {
  std::printf(
      "RMS surface to surface / at the vertices, %% of the diagonal (iterations, time)\n\n"
      "| mesh | triangles |");
  for (const int degree : degrees) std::printf(" L = %d |", degree);
  std::printf(" falls |\n|---|---|");
  for (size_t i = 0; i <= degrees.size(); ++i) std::printf("---|");
  std::printf("\n");
  bool all_fall = true;
  for (const NamedMesh& mesh : meshes) {
    all_fall = print_row(mesh.name, mesh.mesh, degrees, samples) && all_fall;
  }
  return all_fall;
}

// --- speed
// ----------------------------------------------------------------------------------------

/// All harmonics at some of the directions, a row each.
Functions basis_at(const Points& directions, int degree) {
  const int count = harmonic_index(degree, degree) + 1;
  return synthesise(Functions::Identity(count, count), directions, 1);
}

struct DenseTime {
  double rows, factorisation;
  double total() const { return rows + factorisation; }
};

/// YᵀY from blocks of rows, and LLᵀ = YᵀY, on one thread.
DenseTime dense_solve(const Points& directions, const Functions& values, int degree) {
  constexpr Eigen::Index block = 512, blocks = 6;
  const int count = harmonic_index(degree, degree) + 1;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(count, values.cols());
  double rows_seconds = 0;
  for (Eigen::Index b = 0; b < blocks; ++b) {
    const Functions basis = basis_at(directions.middleRows(b * block, block), degree);  // not timed
    const double start = bench::now();
    normal.selfadjointView<Eigen::Lower>().rankUpdate(basis.transpose());
    right.noalias() += basis.transpose() * values.middleRows(b * block, block);
    rows_seconds += bench::now() - start;
  }
  normal.diagonal().array() +=
      static_cast<double>(block * blocks);  // these few rows leave it singular
  const double start = bench::now();
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(normal);
  factor.solveInPlace(right);
  const double seconds = bench::now() - start;
  return {rows_seconds * static_cast<double>(directions.rows()) / (block * blocks), seconds};
}

void print_speed(int degree) {
  const TriangleMesh mesh = samples::make_body(132).mesh;
  const Topology topology(mesh);
  const SphereMap map = parameterize(mesh).map;
  std::printf("\nDegree %d, %d triangles, one thread:\n", degree, topology.face_count());
  for (const bool least_squares : {false, true}) {
    const double start = bench::now();
    const HarmonicFit fit =
        fit_harmonics(topology, map, mesh.positions,
                      {.degree = degree, .least_squares = least_squares, .threads = 1});
    const double seconds = bench::now() - start;
    std::printf("%s: %.2f s, %d iterations\n", least_squares ? "least squares" : "quadrature",
                seconds, fit.iterations);
    if (!least_squares) continue;
    const DenseTime dense = dense_solve(map.points, mesh.positions, degree);
    std::printf(
        "dense: %.1f s (normal matrix %.1f s, extrapolated; Cholesky %.1f s): %.0f times as long\n",
        dense.total(), dense.rows, dense.factorisation, dense.total() / seconds);
  }
}

// --- digits
// ---------------------------------------------------------------------------------------

/// Known coefficients, all of about the same size, found again on a mesh of the sphere.
void print_stability(const std::vector<int>& degrees) {
  std::printf(
      "\n| degree | vertices | largest error of a coefficient of size 1 | iterations |\n"
      "|---|---|---|---|\n");
  for (const int degree : degrees) {
    const TriangleMesh mesh = samples::geodesic_sphere(degree, 0.1).mesh;
    const SphereMap map = normalised(mesh.positions);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-1, 1);
    Functions known(harmonic_index(degree, degree) + 1, 1);
    for (double& c : known.reshaped()) c = number(random);
    const HarmonicFit fit =
        fit_harmonics(Topology(mesh), map, synthesise(known, map.points), {.degree = degree});
    std::printf("| %d | %ld | %.1e | %d |\n", degree, static_cast<long>(mesh.vertex_count()),
                (fit.coefficients - known).cwiseAbs().maxCoeff(), fit.iterations);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Measures spherical harmonics: errors by degree, speed, digits.");
  std::vector<std::string> names;
  std::vector<int> degrees = {5, 10, 20, 40, 80};
  std::int64_t samples = 100'000;
  int speed_degree = 64;
  app.add_option("MESH", names);
  app.add_option("--degree", degrees)->capture_default_str();
  app.add_option("--samples", samples, "of each surface")->capture_default_str();
  app.add_option("--speed-degree", speed_degree, "0: no such table")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const bool all_fall = print_errors(meshes_of(names), degrees, samples);
  print_stability({50, 100, 200});
  if (speed_degree > 0) print_speed(speed_degree);
  return all_fall ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << "spharm_tables: " << error.what() << "\n";
  return 1;
}
