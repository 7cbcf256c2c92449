#include "yardstick.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <set>
#include <vector>

#include "sample_meshes.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/mesh/edge_weights.h"
#include "sphparam/mesh/topology.h"
#include "support/places.h"

namespace sphparam::bench {
namespace {

constexpr int runs = 5;
constexpr int body_parallels = 59;  // of the sample body: 69,620 triangles

/// The Laplacian with one vertex fixed: symmetric positive definite.
Eigen::SparseMatrix<double> laplacian(const TriangleMesh& mesh) {
  const Topology topology(mesh);
  const std::vector<double> weights =
      EdgeWeights(mesh, topology, WeightKind::SymmetricMeanValue).with(topology);
  std::vector<Eigen::Triplet<double>> entries;
  for (Halfedge h = 0; h < topology.halfedge_count(); ++h) {
    const int i = topology.origin(h) - 1, j = topology.target(h) - 1;  // vertex 0 is fixed
    if (i < 0) continue;
    entries.emplace_back(i, i, weights[static_cast<size_t>(h)]);
    if (j >= 0) entries.emplace_back(i, j, -weights[static_cast<size_t>(h)]);
  }
  Eigen::SparseMatrix<double> matrix(topology.vertex_count() - 1, topology.vertex_count() - 1);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

Yardstick::Yardstick(const TriangleMesh& mesh)
    : matrix_(laplacian(mesh)),
      right_(Eigen::MatrixXd::Random(matrix_.rows(), 2)),
      triangles_(static_cast<double>(mesh.face_count())) {}

double Yardstick::measure() const {
  const double start = now();
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor;
  factor.analyzePattern(matrix_);
  factor.factorize(matrix_);
  const double sum = factor.solve(right_).sum();
  const double seconds = now() - start;
  if (sum == 0) std::puts("");  // keeps the solves alive
  return seconds / triangles_;
}

double measure_yardstick(const TriangleMesh& mesh) {
  const Yardstick yardstick(mesh);
  std::vector<double> seconds;
  for (int run = 0; run < runs; ++run) seconds.push_back(yardstick.measure());
  std::sort(seconds.begin(), seconds.end());
  return seconds[runs / 2];
}

TriangleMesh yardstick_mesh(const std::string& folder) {
  const std::string path = folder + "nefertiti-lowres.obj";
  if (std::filesystem::exists(path)) return sphparam::read_mesh(path).mesh;
  return samples::make_body(body_parallels).mesh;
}

std::string meshes_folder() { return (tests::meshes_folder() / "genus0" / "").string(); }

std::vector<std::filesystem::path> mesh_files(const std::string& folder) {
  const std::set<std::string> known{".obj", ".ply", ".off", ".stl", ".glb", ".gii"};
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (known.contains(entry.path().extension().string())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

double now() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

}  // namespace sphparam::bench
