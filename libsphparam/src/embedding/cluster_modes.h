#pragma once

#include <vector>

#include "embedding/block_matrix.h"
#include "embedding/clusters.h"
#include "embedding/image_point.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// A cluster moves by so many fields, see cluster_modes.cpp: the unknowns of a row of a coarse
/// matrix.
inline constexpr int cluster_modes = 4;

/// Where a cluster's modes are measured, and its radius.
struct ClusterSite {
  Vector3 centre;
  double radius;
};

/// What the unknowns of the finest matrix's rows are: tangent coordinates (`tangent_frame`) of the
/// row's point, in the row's unit. Borrowed.
struct PointRows {
  const ImagePoint* points;
  const float* units;  // also the points' radii
};

/// The sites of clusters of points, or of clusters.
std::vector<ClusterSite> gather_sites(const PointRows& rows, const Clusters& clusters, int threads);
std::vector<ClusterSite> gather_sites(const std::vector<ClusterSite>& children,
                                      const Clusters& clusters);

/// P from the modes of clusters to the unknowns of points; zero in rows without a cluster.
std::vector<Block<2, cluster_modes>> point_prolongation(const PointRows& rows,
                                                        const Clusters& clusters,
                                                        const std::vector<ClusterSite>& sites,
                                                        int threads);
/// The same P, too large to be kept: b = Pᵀ r …
void restrict_from_points(const PointRows& rows, const Clusters& clusters,
                          const std::vector<ClusterSite>& sites, const float* r, float* b,
                          int threads);
/// … and x += P y.
void prolong_to_points(const PointRows& rows, const Clusters& clusters,
                       const std::vector<ClusterSite>& sites, const float* y, float* x,
                       int threads);

/// P from the modes of clusters (`parents`) to those of their members.
std::vector<Block<cluster_modes>> site_prolongation(const std::vector<ClusterSite>& children,
                                                    const Clusters& clusters,
                                                    const std::vector<ClusterSite>& parents);

}  // namespace sphparam
