#pragma once

#include <vector>

#include "embedding/energy/image_point.h"
#include "embedding/multigrid/aggregates.h"
#include "embedding/multigrid/block_matrix.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// An aggregate moves by so many fields, see near_nullspace.cpp: the unknowns of a row of a coarse
/// matrix.
inline constexpr int near_nullspace = 4;

/// Where an aggregate's modes are measured, and its radius.
struct AggregateSite {
  Vector3 centre;
  double radius;
};

/// What the unknowns of the finest matrix's rows are: tangent coordinates (`tangent_frame`) of the
/// row's point, in the row's unit. Borrowed.
struct PointRows {
  const ImagePoint* points;
  const float* units;  // also the points' radii
};

/// The sites of aggregates of points, or of aggregates.
std::vector<AggregateSite> gather_sites(const PointRows& rows, const Aggregates& aggregates,
                                        int threads);
std::vector<AggregateSite> gather_sites(const std::vector<AggregateSite>& children,
                                        const Aggregates& aggregates);

/// P from the modes of aggregates to the unknowns of points; zero in rows without an aggregate.
std::vector<Block<2, near_nullspace>> point_prolongation(const PointRows& rows,
                                                         const Aggregates& aggregates,
                                                         const std::vector<AggregateSite>& sites,
                                                         int threads);
/// The same P, too large to be kept: b = Pᵀ r …
void restrict_from_points(const PointRows& rows, const Aggregates& aggregates,
                          const std::vector<AggregateSite>& sites, const double* r, double* b,
                          int threads);
/// … and x += P y.
void prolong_to_points(const PointRows& rows, const Aggregates& aggregates,
                       const std::vector<AggregateSite>& sites, const double* y, double* x,
                       int threads);

/// P from the modes of aggregates (`parents`) to those of their members.
std::vector<Block<near_nullspace>> site_prolongation(const std::vector<AggregateSite>& children,
                                                     const Aggregates& aggregates,
                                                     const std::vector<AggregateSite>& parents);

}  // namespace sphparam
