#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "sphparam/io/polygons.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

enum class Scheme {
  Loop,          // of triangles; box splines of degree 4
  CatmullClark,  // of quads, and of triangles, each of which is three quads; bicubic splines
};

/// A place of a limit surface: a patch and its parameters.
///
/// By Loop's scheme a face is a patch: corner 0 is at (s, t) = (0, 0), corner 1 at (1, 0), corner 2
/// at (0, 1), and s, t, 1 − s − t ≥ 0. By Catmull's and Clark's scheme a quad is a patch, with its
/// corners at (0, 0), (1, 0), (1, 1), (0, 1), and a triangle is three: patch k of it has corner k
/// at (0, 0), the middle of the edge to the next corner at (1, 0), the middle of the face at (1,
/// 1). Patches are numbered in the order of faces, which is Ptex's, and that of OpenSubdiv's
/// stencils.
struct LimitPlace {
  int patch = 0;
  double s = 0, t = 0;
};

/// A point of a limit surface and its first derivatives.
struct LimitPoint {
  Vector3 position = Vector3::Zero(), by_s = Vector3::Zero(), by_t = Vector3::Zero();

  /// Unit, outwards where the faces are counter-clockwise from outside; 0 where the derivatives
  /// are parallel.
  Vector3 normal() const;
};

/// Some points of a patch side by side, component by component.
struct LimitPoints {
  static constexpr size_t count = 8;
  using Numbers = std::array<double, count>;  // one a point
  std::array<Numbers, 3> position, by_s, by_t;

  LimitPoint operator[](size_t i) const;
};

/// Of a point of a limit surface, in 1/length and 1/length²: positive where it bends as a sphere
/// that is seen from outside does. 0 where the derivatives are parallel.
struct LimitCurvature {
  double mean = 0, gauss = 0;
};

/// Which faces a limit surface has; may be shared by surfaces with control points of their own.
class LimitTopology {
 public:
  /// A vertex with more faces about it is refused, as each of its patches depends on all of them.
  static constexpr int most_faces_about_a_vertex = 128;

  /// Requires: faces of a closed manifold on vertices 0 … vertex_count − 1, all of them used.
  /// Throws: std::invalid_argument for faces that the scheme does not take (Loop: triangles;
  /// Catmull-Clark: triangles and quads), and for vertices with too many.
  /// Cost: some 2 µs a face, of OpenSubdiv.
  LimitTopology(const Polygons& faces, int vertex_count, Scheme scheme);
  ~LimitTopology();
  LimitTopology(const LimitTopology&) = delete;
  LimitTopology& operator=(const LimitTopology&) = delete;

  Scheme scheme() const;
  int vertex_count() const;
  int patch_count() const;
  int face_of(int patch) const;
  /// The patches of face f: first_patch(f) … first_patch(f + 1) − 1.
  int first_patch(int face) const;

 private:
  friend class LimitPatch;
  friend class LimitStencils;
  struct Tables;
  std::unique_ptr<Tables> tables_;
};

/// One patch of a limit surface, made ready: many evaluations of it cost little.
class LimitPatch {
 public:
  /// Both outlive the patch. Throws: std::invalid_argument for a patch that there is not.
  LimitPatch(const LimitTopology& topology, const Points& control, int patch);
  /// The same patch of a surface of the same topology with other control points, in less time.
  /// Requires: as many of them; they and the topology outlive the patch.
  LimitPatch(const LimitPatch& other, const Points& control);
  ~LimitPatch();
  LimitPatch(LimitPatch&&) noexcept;
  LimitPatch& operator=(LimitPatch&&) noexcept;

  int index() const { return patch_; }
  /// Far from vertices of unusual valence a patch is one polynomial, also beyond its end.
  bool is_polynomial() const { return !irregular_; }

  /// Requires, of a patch that is no polynomial: (s, t) within it.
  /// Cost: 20 ns for a polynomial, else some 300 ns.
  LimitPoint evaluate(double s, double t) const;
  LimitCurvature curvature(double s, double t) const;
  /// At the first `count` of some places; of a polynomial, at all of them, which costs the same.
  /// Requires: as above, each; count at most that of LimitPoints; numbers for all of them.
  /// Ensures: the same bits as one by one. Cost: some 5 ns each for a polynomial.
  void evaluate(const LimitPoints::Numbers& s, const LimitPoints::Numbers& t, size_t count,
                LimitPoints& points) const;

  /// Of a polynomial, Σ coefficient · sⁱ tʲ: by Loop for i + j ≤ 4, i slow and j fast, 15 of them;
  /// by Catmull-Clark for i, j ≤ 3, 16 of them.
  using Coefficients = Eigen::Matrix<double, 16, 3, Eigen::RowMajor | Eigen::DontAlign>;
  const Coefficients& coefficients() const { return coefficients_; }

 private:
  struct Irregular;
  static constexpr int most_control_points = 16;  // of a polynomial
  void read_polynomial(const Points& control);

  int patch_;
  const LimitTopology* topology_;
  std::array<int, most_control_points> control_points_{};
  Coefficients coefficients_;
  std::unique_ptr<Irregular> irregular_;
};

/// The surface that subdivision of a control mesh ends in, anywhere on it.
///
/// Far from vertices of unusual valence it is made of polynomials, and exact; next to one the last
/// 2⁻⁶ of a face are a Gregory patch of OpenSubdiv's. Positions and normals are continuous
/// everywhere, curvature but at vertices of unusual valence, where these schemes have none.
/// Source: Loop, "Smooth subdivision surfaces based on triangles" (1987); Catmull and Clark,
/// "Recursively generated B-spline surfaces on arbitrary topological meshes" (1978); evaluation by
/// OpenSubdiv's Bfr, polynomials read off it.
class LimitSurface {
 public:
  /// Throws: std::invalid_argument where there is no topology, or not one control point for each of
  /// its vertices.
  LimitSurface(std::shared_ptr<const LimitTopology> topology, Points control);
  LimitSurface(const Polygons& faces, Points control, Scheme scheme);

  const LimitTopology& topology() const { return *topology_; }
  std::shared_ptr<const LimitTopology> shared_topology() const { return topology_; }
  const Points& control() const { return control_; }
  LimitPatch patch(int index) const { return {*topology_, control_, index}; }

  /// One by one; where many are wanted on a patch, ask for the patch. Throws: as LimitPatch.
  LimitPoint evaluate(const LimitPlace& place) const;
  LimitCurvature curvature(const LimitPlace& place) const;

  /// Places of one patch should follow one another.
  /// Ensures: the same bytes for any number of threads, and as one by one.
  std::vector<LimitPoint> evaluate_all(std::span<const LimitPlace> places, int threads = 0) const;
  std::vector<LimitCurvature> curvature_all(std::span<const LimitPlace> places,
                                            int threads = 0) const;

 private:
  std::shared_ptr<const LimitTopology> topology_;
  Points control_;
};

}  // namespace sphparam
