#include "sphparam/io/polygons.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

#include "io/polygons/doublets.h"
#include "io/polygons/ear_clipping.h"
#include "number_text.h"

// A polygon is projected to the plane of its Newell normal n = Σ pᵢ × pᵢ₊₁, after a shift to its
// first corner and a power-of-two scale, so that no coordinates overflow. Quads compare their two
// diagonals, larger polygons try the fan of corner 0, then clip ears. Edges in use are remembered
// so that no diagonal doubles one. Doublets are found beforehand: vertices with two corners between
// the same two neighbours; before that, corners that repeat the one before them are left out.

namespace sphparam {
namespace {

constexpr int max_clipped_degree = 4096;

// Half-edges are numbered by int, three to a triangle.
constexpr std::int64_t most_triangles = std::numeric_limits<int>::max() / 3;

/// The corners relative to the first one, scaled by a power of two to at most 1.
void local_corners(const Points& positions, std::span<const int> polygon,
                   std::vector<Vector3>& local) {
  const Vector3 origin = 0.5 * positions.row(polygon[0]);
  double extent = 0;
  local.clear();
  for (const int v : polygon) {
    local.push_back(0.5 * positions.row(v).transpose() - origin);
    extent = std::max(extent, local.back().lpNorm<Eigen::Infinity>());
  }
  const double scale = extent > 0 ? std::ldexp(1.0, -std::max(-1021, std::ilogb(extent) + 1)) : 1;
  for (Vector3& corner : local) corner *= scale;
}

Vector3 newell_normal(const std::vector<Vector3>& corners) {
  Vector3 normal = Vector3::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i)
    normal += corners[i].cross(corners[(i + 1) % corners.size()]);
  return normal;
}

std::vector<PlanePoint> project(const std::vector<Vector3>& corners, const Vector3& normal) {
  Eigen::Index smallest = 0;
  normal.cwiseAbs().minCoeff(&smallest);
  const Vector3 u = normal.cross(Vector3::Unit(smallest)).normalized();
  const Vector3 v = normal.cross(u).normalized();
  std::vector<PlanePoint> plane;
  plane.reserve(corners.size());
  for (const Vector3& corner : corners) plane.emplace_back(corner.dot(u), corner.dot(v));
  return plane;
}

/// Three corners of a polygon that names a vertex twice, however it is shortened, of which two are
/// at that vertex.
std::vector<int> repeating_triangle(std::span<const int> polygon) {
  std::vector<int> order(polygon.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int i, int j) { return std::pair(polygon[i], i) < std::pair(polygon[j], j); });
  const auto twin = std::adjacent_find(order.begin(), order.end(),
                                       [&](int i, int j) { return polygon[i] == polygon[j]; });
  const int first = twin[0], second = twin[1];
  int third = 0;
  while (third == first || third == second) ++third;
  return {first, second, third};
}

class Triangulator {
 public:
  Triangulator(const Points& positions, const Polygons& polygons, const std::vector<int>& doublets)
      : positions_(positions), edges_(polygons.corners.size()), doublets_(doublets) {
    for (std::int64_t p = 0; p < polygons.count(); ++p)
      if (!polygons.repeats(p)) insert_boundary(polygons.polygon(p));
  }

  /// Corner triples of one polygon; valid until the next call.
  const std::vector<int>& cut(std::span<const int> polygon, bool repeats) {
    if (polygon.size() == 3) return triples_ = {0, 1, 2};
    if (repeats) return triples_ = repeating_triangle(polygon);
    triples_.clear();
    if (const auto doublet = doublet_corner(polygon)) {
      cut_fan(polygon, *doublet == 0 ? static_cast<int>(polygon.size()) - 1 : *doublet - 1);
      return triples_;
    }
    local_corners(positions_, polygon, local_);
    if (polygon.size() == 4)
      cut_quad(polygon);
    else
      cut_polygon(polygon);
    return triples_;
  }

  /// Polygons so far of which triangles overlap.
  long overlapping() const { return overlapping_; }

 private:
  void insert_boundary(std::span<const int> polygon) {
    int previous = polygon.back();
    for (const int v : polygon) {
      edges_.insert(previous, v);
      previous = v;
    }
  }

  /// The corner at the doublet of lowest id, so that both polygons choose the same.
  std::optional<int> doublet_corner(std::span<const int> polygon) const {
    std::optional<int> found;
    for (int i = 0; i < static_cast<int>(polygon.size()); ++i) {
      const bool is_doublet = std::binary_search(doublets_.begin(), doublets_.end(), polygon[i]);
      if (is_doublet && (!found || polygon[i] < polygon[*found])) found = i;
    }
    return found;
  }

  void cut_fan(std::span<const int> polygon, int centre) {
    const int degree = static_cast<int>(polygon.size());
    for (int i = 1; i + 1 < degree; ++i)
      triples_.insert(triples_.end(), {centre, (centre + i) % degree, (centre + i + 1) % degree});
    insert_triangles(polygon);
  }

  // Diagonals in order of preference: new edges, unfolded triangles, short, from corner 0.
  void cut_quad(std::span<const int> polygon) {
    const Vector3 &a = local_[0], &b = local_[1], &c = local_[2], &d = local_[3];
    const Vector3 normal = (c - a).cross(d - b);
    const auto unfolded = [&](const Vector3& p, const Vector3& q, const Vector3& r) {
      return (q - p).cross(r - p).dot(normal) > 0;
    };
    struct Diagonal {
      bool used, folded;
      double length;
      auto operator<=>(const Diagonal&) const = default;
    };
    const Diagonal ac{edges_.contains(polygon[0], polygon[2]),
                      !(unfolded(a, b, c) && unfolded(a, c, d)), (c - a).squaredNorm()};
    const Diagonal bd{edges_.contains(polygon[1], polygon[3]),
                      !(unfolded(b, c, d) && unfolded(b, d, a)), (d - b).squaredNorm()};
    if (bd < ac) {
      triples_ = {0, 1, 3, 1, 2, 3};
      edges_.insert(polygon[1], polygon[3]);
    } else {
      triples_ = {0, 1, 2, 0, 2, 3};
      edges_.insert(polygon[0], polygon[2]);
    }
  }

  void cut_polygon(std::span<const int> polygon) {
    const Vector3 normal = newell_normal(local_);
    const int degree = static_cast<int>(polygon.size());
    const bool has_plane = normal.squaredNorm() > 0;
    if (!has_plane || fan_is_good(polygon, normal)) return cut_fan(polygon, 0);
    const std::vector<PlanePoint> plane = project(local_, normal);
    if (degree > max_clipped_degree) {
      cut_fan(polygon, 0);
    } else {
      clip_ears(polygon, plane, edges_, triples_);
      insert_triangles(polygon);
    }
    overlapping_ += overlap(plane, triples_);
  }

  bool fan_is_good(std::span<const int> polygon, const Vector3& normal) const {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      if (local_[i].cross(local_[i + 1]).dot(normal) <= 0) return false;
      if (i > 1 && edges_.contains(polygon[0], polygon[i])) return false;
    }
    return true;
  }

  void insert_triangles(std::span<const int> polygon) {
    for (std::size_t t = 0; t < triples_.size(); t += 3)
      for (int k = 0; k < 3; ++k)
        edges_.insert(polygon[triples_[t + k]], polygon[triples_[t + (k + 1) % 3]]);
  }

  const Points& positions_;
  EdgeSet edges_;
  const std::vector<int>& doublets_;
  std::vector<Vector3> local_;
  std::vector<int> triples_;
  long overlapping_ = 0;
};

bool has_repeated_corner(std::span<const int> polygon) {
  constexpr std::size_t few_corners = 8;
  if (polygon.size() <= few_corners) {
    for (std::size_t i = 1; i < polygon.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (polygon[i] == polygon[j]) return true;
    return false;
  }
  std::vector<int> sorted(polygon.begin(), polygon.end());
  std::sort(sorted.begin(), sorted.end());
  return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

Triangles as_triangles(const std::vector<int>& indices) {
  return Eigen::Map<const Triangles>(indices.data(), static_cast<Eigen::Index>(indices.size() / 3),
                                     3);
}

/// Polygons without some of their corners.
struct Shortened {
  Polygons polygons;
  std::vector<int> corner;  // of each of their corners, which it was
  long count = 0;           // polygons with fewer corners than before
};

/// Leaves out corners at the vertex of the corner before: many exporters of quads write triangles
/// so. A polygon of which fewer than three corners would be left keeps them all.
Shortened without_repeats_in_a_row(const Polygons& polygons) {
  Shortened result;
  for (std::int64_t p = 0; p < polygons.count(); ++p) {
    const std::span<const int> polygon = polygons.polygon(p);
    const std::size_t first = result.corner.size();
    const bool repeats = polygons.repeats(p);
    for (int i = 0, before = polygon.back(); i < polygons.degree(p); before = polygon[i++])
      if (!repeats || polygon[i] != before) result.corner.push_back(polygons.starts[p] + i);
    if (result.corner.size() - first < 3) {
      result.corner.resize(first + polygon.size());
      std::iota(result.corner.begin() + static_cast<std::ptrdiff_t>(first), result.corner.end(),
                polygons.starts[p]);
    }
    for (std::size_t i = first; i < result.corner.size(); ++i)
      result.polygons.add_corner(polygons.corners[result.corner[i]]);
    result.polygons.starts.push_back(static_cast<int>(result.corner.size()));
    result.count += result.polygons.degree(p) < polygons.degree(p);
    if (repeats && has_repeated_corner(result.polygons.polygon(p)))
      result.polygons.repeating.push_back(static_cast<int>(p));
  }
  return result;
}

/// All but `split` and `shortened`.
Triangulation cut(const Points& positions, const Polygons& polygons) {
  Triangulation result;
  result.doublets = find_doublets(polygons, positions.rows());
  Triangulator triangulator(positions, polygons, result.doublets);
  std::vector<int> indices;
  for (std::int64_t p = 0; p < polygons.count(); ++p) {
    const std::span<const int> polygon = polygons.polygon(p);
    for (const int corner : triangulator.cut(polygon, polygons.repeats(p))) {
      indices.push_back(polygon[corner]);
      result.corner.push_back(polygons.starts[p] + corner);
    }
    result.polygon.resize(indices.size() / 3, static_cast<int>(p));
  }
  result.triangles = as_triangles(indices);
  result.overlapping = triangulator.overlapping();
  return result;
}

std::string overlapping_note(long count) {
  return counted(count, "face") + " of more than four corners " +
         (count == 1 ? "crosses itself" : "cross themselves") + ", or turn" +
         (count == 1 ? "s" : "") + " inward with more than " + std::to_string(max_clipped_degree) +
         " corners: triangles of " + (count == 1 ? "it" : "theirs") +
         " overlap, and areas count double there; cut into triangles where it was made, the mesh "
         "would not";
}

std::string shortened_note(long count) {
  return count == 1 ? "1 face names a vertex twice in a row: taken once"
                    : std::to_string(count) + " faces name a vertex twice in a row: taken once";
}

}  // namespace

std::string Polygons::close_polygon(const ReadOptions& options) {
  const std::int64_t corner_count = open_degree();
  const std::int64_t triangle_limit = std::min(options.max_faces, most_triangles);
  if (corner_count < 3) return "face has fewer than 3 corners";
  if (corner_count > options.max_polygon_degree)
    return "face has more corners than the limit of " + std::to_string(options.max_polygon_degree);
  triangle_count_ += corner_count - 2;
  if (triangle_count_ > triangle_limit)
    return "more triangles than the limit of " + std::to_string(triangle_limit);
  starts.push_back(static_cast<int>(corners.size()));
  if (!has_repeated_corner(polygon(count() - 1))) return {};
  if (!options.repeated_corners) return "face names a vertex twice" + repeated_corners_advice();
  repeating.push_back(static_cast<int>(count() - 1));
  return {};
}

Triangulation triangulate(const Points& positions, const Polygons& polygons) {
  Triangulation result;
  long split = 0;
  for (std::int64_t p = 0; p < polygons.count(); ++p) split += polygons.degree(p) != 3;
  if (split == 0) {
    result.triangles = as_triangles(polygons.corners);
  } else if (polygons.repeating.empty()) {
    result = cut(positions, polygons);
  } else {
    const Shortened shortened = without_repeats_in_a_row(polygons);
    result = cut(positions, shortened.polygons);
    for (int& corner : result.corner) corner = shortened.corner[corner];
    result.shortened = shortened.count;
  }
  result.split = split;
  return result;
}

Polygons triangles_as_polygons(const Triangles& triangles) {
  Polygons polygons;
  polygons.corners.assign(triangles.data(), triangles.data() + triangles.size());
  polygons.starts.resize(static_cast<std::size_t>(triangles.rows()) + 1);
  for (std::size_t f = 0; f < polygons.starts.size(); ++f)
    polygons.starts[f] = 3 * static_cast<int>(f);
  return polygons;
}

std::vector<int> corners_in(const Triangles& triangles, const Polygons& polygons) {
  std::vector<int> found;
  found.reserve(polygons.corners.size());
  std::vector<int> corner_at;  // of each vertex, in the polygon read last
  std::int64_t first = 0;      // corner of the polygon's triangles
  for (std::int64_t p = 0; p < polygons.count(); ++p) {
    const std::int64_t last = first + 3 * std::int64_t{polygons.degree(p) - 2};
    if (last > triangles.size()) throw std::logic_error("fewer triangles than polygons make");
    for (std::int64_t i = last - 1; i >= first; --i) {
      const auto v = static_cast<std::size_t>(triangles.data()[i]);
      if (v >= corner_at.size()) corner_at.resize(v + 1, -1);
      corner_at[v] = static_cast<int>(i);
    }
    for (const int v : polygons.polygon(p)) {
      const int corner = static_cast<std::size_t>(v) < corner_at.size() ? corner_at[v] : -1;
      if (corner < first) throw std::logic_error("a polygon and its triangles have other vertices");
      found.push_back(corner);
    }
    first = last;
  }
  if (first < triangles.size()) throw std::logic_error("more triangles than polygons make");
  return found;
}

void adopt_triangulation(MeshFile& file, Triangulation triangulation) {
  file.mesh.triangles = std::move(triangulation.triangles);
  file.polygons = triangulation.split;
  if (triangulation.split == 0) return;
  if (triangulation.shortened > 0) file.notes.push_back(shortened_note(triangulation.shortened));
  if (triangulation.overlapping > 0)
    file.notes.push_back(overlapping_note(triangulation.overlapping));
  if (!triangulation.doublets.empty()) file.notes.push_back(doublet_note(triangulation.doublets));
  for (Property& property : file.face_properties) {
    std::vector<double> spread;
    spread.reserve(triangulation.polygon.size());
    for (const int p : triangulation.polygon) spread.push_back(property.values[p]);
    property.values = std::move(spread);
  }
  Property source{"source_face", ScalarType::Int32, {}};
  source.values.assign(triangulation.polygon.begin(), triangulation.polygon.end());
  file.set_face_property(std::move(source));
}

}  // namespace sphparam
