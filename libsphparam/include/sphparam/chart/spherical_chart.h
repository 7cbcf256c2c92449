#pragma once

#include <cstdint>
#include <vector>

#include "sphparam/chart/chart_certificate.h"
#include "sphparam/mesh/surface_point.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/progress.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// #W×2 texture coordinates, one (u, v) a row. u in turns, so that the seam 0 ≡ 1 is exact.
using TextureCoordinates = RowTable<double, 2>;

/// What a wedge is there for.
enum class WedgeKind : std::uint8_t {
  Ordinary,
  Seam,      // on the meridian θ = 0, seen from the east: u = 0
  SeamCopy,  // the same, seen from the west: u = 1; in a wrapped chart any u + 1
  PoleFan,   // the apex of one pole triangle: v = 0 or 1, u in the middle of its link edge
};

/// What building a chart did.
struct ChartCounts {
  int pole_splits = 0;       // ±z inside a face or an edge
  int meridian_splits = 0;   // edges cut by the meridian θ = 0
  int fold_splits = 0;       // edges split so that nothing folds in (u, v)
  int folded_faces = 0;      // triangles between poles and meridian that folded before
  int snapped_vertices = 0;  // within rounding of ±z or the meridian: moved there
  int nudged_vertices = 0;   // moved in (u, v), as triangles there are thinner than it can tell
  bool at_limit = false;     // the folds need more splits than were allowed: some are left

  int splits() const { return pole_splits + meridian_splits + fold_splits; }
};

/// The (u, v) triangulation of a sphere map that a texture needs, one row a triangle in `triangles`
/// and `wedges` alike.
///
/// A *wedge* is a copy of a refined vertex with its own (u, v): a vertex buffer has one entry a
/// wedge. Wedge i < #V′ belongs to refined vertex i; copies follow. A pole triangle owns the whole
/// trapezoid between its link edge and v = 0 or 1; its apex is a `PoleFan` wedge.
struct SphericalChart {
  // The refined mesh: closed, genus 0. Vertices 0 … #V−1 and, where nothing split them, faces
  // 0 … #F−1 are the source's own; children of a face follow, the first in its place.
  Triangles triangles;  // #F′×3 refined vertices
  Points points;        // #V′×3 on the sphere; the source's rays but for snapped ones
  std::vector<SurfacePoint> surface_points;  // #V′: where a refined vertex lies in the source mesh
  std::vector<Face> source_faces;            // #F′
  Vertex north = -1, south = -1;  // refined vertices at ±z; −1: none (only in a wrapped chart)

  Triangles wedges;                    // #F′×3
  TextureCoordinates uv;               // #W×2
  std::vector<Vertex> wedge_vertices;  // #W: refined vertex
  std::vector<WedgeKind> wedge_kinds;  // #W

  ChartCounts counts;
  ChartCertificate certificate;

  Eigen::Index wedge_count() const { return uv.rows(); }
  /// The corner of a face that is at ±z; −1: an ordinary triangle.
  int pole_corner(Face f) const {
    for (int k = 0; k < 3; ++k) {
      if (triangles(f, k) == north || triangles(f, k) == south) return k;
    }
    return -1;
  }
};

/// Makes the chart of a bijective sphere map: splits faces at ±z, edges along the meridian θ = 0,
/// and every triangle that would fold when interpolated linearly in (u, v) at points of its own
/// geodesic edges, until the chart certificate holds.
///
/// New vertices lie on the geodesic map: f(Σ λᵢ vᵢ) = Σ λᵢ xᵢ / |Σ λᵢ xᵢ|, so positions and all
/// other attributes of the source interpolate linearly (`carry_vertex_attribute`). Vertices closer
/// to ±z or to the meridian than double (u, v) can tell are moved there.
///
/// Where triangles, or the strips between neighbouring edges, are thinner than (u, v) can tell,
/// some 1e-15 radians, vertices are nudged by some roundings; where that does not do, (u, v)
/// settles on multiples of 2⁻²⁴ of a turn, and vertices that crowd there move apart, by little more
/// than makes room for all. Where splits would give the chart more than twice the vertices of the
/// mesh, fewer are made, where folds are deepest, and vertices move with the chords of the edges
/// that are left whole, by less than 2⁻⁷ of a turn; where they would move further, more is split,
/// in the end everything. `counts.nudged_vertices` says how many moved, `certificate.max_shift` how
/// far.
///
/// Requires: a map that `certify` calls bijective, rays of unit length up to rounding.
/// Ensures: `certificate` is certify_chart's of the data returned. It fails only where folds need
///          more than `splits_a_vertex`·#V + 4096 splits: `counts.at_limit` tells, limbs stacked
///          sixty deep may take more; or where no room is found, which is rare. Every split leaves
///          the refined map positive on the sphere; where rounding does not let it,
///          `certificate.inverted` lists the faces. Same bytes for any number of threads.
/// Progress is told of "chart": the largest share so far of the splits allowed.
/// Throws: std::invalid_argument for a map of wrong size or with a ray that is zero or not finite,
/// splits below 0, or where no face holds ±z; Cancelled. Our own; the need for it: Section 3 of the
/// paper has the date line along edges, which a relaxed map leaves. Cost: a few passes, a tenth of
/// the default map's time, half of it the certificate; and 1 to 3 µs a split: some 2 to 10 a fold,
/// 10 to 75 where needles (1 : 1000) lie on each other by the thousand near ±z; moves some seconds.
SphericalChart spherical_chart(const TriangleMesh& mesh, const Topology& topology,
                               const SphereMap& map, int threads = 0, const Progress& progress = {},
                               int splits_a_vertex = 256);

/// The same without new vertices: for those who must keep the topology. Triangles across the
/// meridian get u up to 1.5 (wrap REPEAT), those at a pole vertex a fan wedge. The certificate
/// lists in `folded` what folds and in `around_pole` the faces that hold ±z where no vertex is:
/// their interior cannot be right.
SphericalChart wrapped_chart(const TriangleMesh& mesh, const Topology& topology,
                             const SphereMap& map, int threads = 0);

}  // namespace sphparam
