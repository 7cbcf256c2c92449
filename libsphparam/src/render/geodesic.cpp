#include "render/geodesic.h"

#include <array>
#include <cstdint>
#include <unordered_map>

#include "elementary.h"

// The longest side of a triangle is halved as long as it is too long. Where a side is cut depends
// on its two ends alone, so both triangles there agree, and the surface has no gaps. Points are
// kept as they lie on the chords, for attributes are linear there; to halve the angle between a and
// b, the chord is cut at (|b| a + |a| b) / (|a| + |b|).

namespace sphparam {
namespace {

// Radians: an arc rises 0.0003 over its chord, 0.1 of 400 pixels.
constexpr double longest_arc = 0.05;
constexpr int deepest = 48;  // halvings of one triangle; six halve any side often enough

using Barycentric = Eigen::Matrix<float, 3, 3, Eigen::RowMajor>;  // a row a corner

struct Piece {
  std::array<int, 3> corners;
  Face source;
  std::uint8_t inner;   // bit k: the side that faces corner k is none of the source's
  Barycentric weights;  // of the corners in the source triangle
  int depth = 0;
};

struct NewVertex {
  int a, b;
  float weight;  // of b
};

class Refinement {
 public:
  Refinement(const Triangles& triangles, const Points& rays) : rays_(rays) {
    points_.reserve(static_cast<size_t>(rays.rows()));
    for (const auto& ray : rays.rowwise()) points_.push_back(ray.transpose());
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
      refine({{triangles(f, 0), triangles(f, 1), triangles(f, 2)},
              static_cast<Face>(f),
              0,
              Barycentric::Identity()});
    }
  }

  const std::vector<Piece>& pieces() const { return pieces_; }

  Points unit_points() const {
    Points unit(static_cast<Eigen::Index>(points_.size()), 3);
    unit.topRows(rays_.rows()) = rays_;
    for (Eigen::Index v = rays_.rows(); v < unit.rows(); ++v) {
      unit.row(v) = points_[static_cast<size_t>(v)].normalized();
    }
    return unit;
  }

  /// Values of the source's vertices, and of the new ones between them.
  void extend(std::vector<Rgb>& colours) const {
    for (const NewVertex& v : new_vertices_) {
      const Rgb a = colours[static_cast<size_t>(v.a)], b = colours[static_cast<size_t>(v.b)];
      colours.push_back(a + v.weight * (b - a));
    }
  }

 private:
  double angle(int a, int b) const {
    const Vector3 &p = point(a), &q = point(b);
    return elementary::atan2(p.cross(q).norm(), p.dot(q));
  }

  const Vector3& point(int v) const { return points_[static_cast<size_t>(v)]; }

  void refine(const Piece& whole) {
    std::vector<Piece> waiting = {whole};
    while (!waiting.empty()) {
      const Piece piece = waiting.back();
      waiting.pop_back();
      int longest = 0;
      std::array<double, 3> length;
      for (int k = 0; k < 3; ++k) {
        length[k] = angle(piece.corners[(k + 1) % 3], piece.corners[(k + 2) % 3]);
        if (length[k] > length[longest]) longest = k;
      }
      if (length[longest] <= longest_arc || piece.depth == deepest) {
        pieces_.push_back(piece);
      } else {
        halve(piece, longest, waiting);
      }
    }
  }

  /// Cuts from corner k to the middle of the side that faces it.
  void halve(const Piece& piece, int k, std::vector<Piece>& waiting) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const int middle = middle_of(piece.corners[i], piece.corners[j]);
    const double at_i = point(piece.corners[j]).norm(), at_j = point(piece.corners[i]).norm();
    const auto weight = static_cast<float>(at_j / (at_i + at_j));
    const Eigen::RowVector3f between =
        (1 - weight) * piece.weights.row(i) + weight * piece.weights.row(j);
    const auto half = [&](int replaced, int uncut) {
      Piece part = piece;
      part.corners[replaced] = middle;
      part.weights.row(replaced) = between;
      part.inner |= static_cast<std::uint8_t>(1 << uncut);  // from corner k to the middle
      ++part.depth;
      waiting.push_back(part);
    };
    half(i, j);  // keeps j: the side that faces j runs from k to the middle
    half(j, i);
  }

  int middle_of(int a, int b) {
    if (a > b) std::swap(a, b);
    const auto key = static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b);
    const auto [found, is_new] = middles_.emplace(key, static_cast<int>(points_.size()));
    if (is_new) {
      const double at_a = point(b).norm(), at_b = point(a).norm(), sum = at_a + at_b;
      new_vertices_.push_back({a, b, static_cast<float>(at_b / sum)});
      points_.push_back((at_a * point(a) + at_b * point(b)) / sum);
    }
    return found->second;
  }

  const Points& rays_;
  std::vector<Vector3> points_;
  std::vector<NewVertex> new_vertices_;
  std::vector<Piece> pieces_;
  std::unordered_map<std::uint64_t, int> middles_;
};

/// Three of each piece.
std::vector<Rgb> refined_corners(const std::vector<Rgb>& colours, const Refinement& refinement) {
  std::vector<Rgb> result;
  if (colours.empty()) return result;
  for (const Piece& piece : refinement.pieces()) {
    const Rgb* const whole = &colours[3 * static_cast<size_t>(piece.source)];
    for (int k = 0; k < 3; ++k)
      result.emplace_back(piece.weights(k, 0) * whole[0] + piece.weights(k, 1) * whole[1] +
                          piece.weights(k, 2) * whole[2]);
  }
  return result;
}

FacePaint refined(const FacePaint& paint, const Refinement& refinement) {
  FacePaint result;
  for (const Piece& piece : refinement.pieces()) {
    result.colours.push_back(paint.colours[static_cast<size_t>(piece.source)]);
  }
  return result;
}

/// Those of a source's seams (texture_seams.h) that the sides of its piece are part of.
std::uint8_t seams_of(const Piece& piece, unsigned seams) {
  constexpr unsigned of_first_side = 1 + (1 << 3);
  unsigned result = 0;
  for (int side = 0; side < 3; ++side) {
    for (int k = 0; k < 3; ++k) {
      const bool is_on =
          piece.weights((side + 1) % 3, k) == 0 && piece.weights((side + 2) % 3, k) == 0;
      if (is_on) result |= (seams >> k & of_first_side) << side;
    }
  }
  return static_cast<std::uint8_t>(result);
}

TexturePaint refined(const TexturePaint& paint, const Refinement& refinement) {
  TexturePaint result{.texcoords = {}, .textures = paint.textures};
  result.tints = refined_corners(paint.tints, refinement);
  if (!paint.texture_of.empty()) {
    for (const Piece& piece : refinement.pieces()) {
      result.texture_of.push_back(paint.texture_of[static_cast<size_t>(piece.source)]);
    }
  }
  if (paint.texcoords.corners.rows() == 0) return result;
  result.texcoords.corners.resize(3 * static_cast<Eigen::Index>(refinement.pieces().size()), 2);
  Eigen::Index row = 0;
  for (const Piece& piece : refinement.pieces()) {
    result.texcoords.corners.middleRows<3>(row) =
        piece.weights.cast<double>() * paint.texcoords.corners.middleRows<3>(3 * piece.source);
    row += 3;
    result.texcoords.seams.push_back(seams_of(piece, paint.texcoords.seams_of(piece.source)));
  }
  return result;
}

Paint refined_paint(Paint paint, const Refinement& refinement, const Points& points) {
  if (auto* vertices = std::get_if<VertexPaint>(&paint)) {
    refinement.extend(vertices->colours);
    vertices->of_corners = refined_corners(vertices->of_corners, refinement);
  }
  if (auto* checker = std::get_if<CheckerPaint>(&paint)) checker->rays = points;
  if (const auto* faces = std::get_if<FacePaint>(&paint)) return refined(*faces, refinement);
  if (const auto* texture = std::get_if<TexturePaint>(&paint)) return refined(*texture, refinement);
  return paint;
}

}  // namespace

RenderObject on_sphere(const RenderObject& object, const Points& rays) {
  const Refinement refinement(object.mesh.triangles, rays);
  const std::vector<Piece>& pieces = refinement.pieces();
  RenderObject sphere = object;
  sphere.mesh.positions = refinement.unit_points();
  sphere.mesh.triangles.resize(static_cast<Eigen::Index>(pieces.size()), 3);
  for (size_t f = 0; f < pieces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      sphere.mesh.triangles(static_cast<Eigen::Index>(f), k) = pieces[f].corners[k];
    }
  }
  sphere.normals = sphere.mesh.positions;
  sphere.corner_normals.reset();
  sphere.paint = refined_paint(object.paint, refinement, sphere.mesh.positions);
  if (sphere.graticule) sphere.graticule->rays = sphere.mesh.positions;
  if (sphere.wireframe) {
    const std::vector<std::uint8_t> hidden = std::move(sphere.wireframe->hidden_sides);
    sphere.wireframe->hidden_sides.clear();
    for (const Piece& piece : pieces) {
      const unsigned before = hidden.empty() ? 0U : hidden[static_cast<size_t>(piece.source)];
      sphere.wireframe->hidden_sides.push_back(static_cast<std::uint8_t>(piece.inner | before));
    }
  }
  return sphere;
}

}  // namespace sphparam
