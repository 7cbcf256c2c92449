#pragma once

#include <Eigen/SparseCore>
#include <filesystem>
#include <string>
#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::bench {

/// One Laplace solve: Eigen's SimplicialLDLT analyse + factor + two solves of a mesh's Laplacian
/// (symmetrised mean value weights, one vertex fixed) on one thread. Times are told in multiples of
/// it: machines differ, and so do moments on a machine that others use.
class Yardstick {
 public:
  explicit Yardstick(const TriangleMesh& mesh);
  /// Seconds a triangle, now.
  double measure() const;

 private:
  Eigen::SparseMatrix<double> matrix_;
  Eigen::MatrixXd right_;
  double triangles_;
};

/// The median of five measurements.
double measure_yardstick(const TriangleMesh& mesh);

/// The mesh whose Laplacian is the yardstick: nefertiti-lowres.obj of `folder`, 70,000 triangles,
/// or, where that is not there, the sample body with as many.
TriangleMesh yardstick_mesh(const std::string& folder);

/// The folder of real meshes, `genus0/` within SPHPARAM_MESHES or within the default folder.
std::string meshes_folder();

/// The mesh files of a folder, by name.
std::vector<std::filesystem::path> mesh_files(const std::string& folder);

/// Wall time in seconds since some moment.
double now();

}  // namespace sphparam::bench
