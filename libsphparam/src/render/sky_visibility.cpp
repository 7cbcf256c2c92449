#include "render/sky_visibility.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "elementary.h"
#include "image/raster.h"
#include "render/drawing_size.h"
#include "sphparam/parallel.h"

// The sky is sampled in directions spread over the sphere by the golden angle. For each, the whole
// mesh is drawn into a small depth buffer seen from there; a vertex sees that part of the sky if
// nothing in the buffer lies clearly before it. Four neighbouring cells are asked, so that shadows
// have soft borders.

namespace sphparam {
namespace {

constexpr int fewest_cells = 96;
constexpr std::int64_t directions_a_chunk = 8;  // each chunk keeps a sum a vertex

/// The depth buffer of the mesh seen from one direction.
class SkyView {
 public:
  SkyView(const TriangleMesh& mesh, const Vector3& centre, double radius, const Vector3& direction,
          int cells)
      : cells_(cells),
        depth_(static_cast<size_t>(cells * cells), -std::numeric_limits<float>::infinity()) {
    const Vector3 side = direction.unitOrthogonal();
    const double scale = cells / (2.1 * radius);
    axes_ << scale * side.transpose(), scale * direction.cross(side).transpose(),
        direction.transpose();
    offset_ = Vector3(0.5 * cells, 0.5 * cells, 0) - axes_ * centre;
    for (Eigen::Index f = 0; f < mesh.face_count(); ++f) draw(mesh, f);
  }

  /// Share of the four cells about a point in which nothing is nearer to the sky than it.
  float visible(const Vector3& point) const {
    const Vector3 p = axes_ * point + offset_;
    if (!p.allFinite()) return 1;
    const int x = cell_of(p.x()), y = cell_of(p.y());
    float seen = 0;
    for (const auto& [i, j] : {std::pair{x, y}, {x + 1, y}, {x, y + 1}, {x + 1, y + 1}}) {
      seen += p.z() >= depth_[static_cast<size_t>(j * cells_ + i)] ? 0.25F : 0;
    }
    return seen;
  }

 private:
  void draw(const TriangleMesh& mesh, Eigen::Index f) {
    const auto corner = [&](int k) -> Vector3 {
      return axes_ * mesh.position(mesh.triangles(f, k)) + offset_;
    };
    const Vector3 a = corner(0), b = corner(1), c = corner(2);
    const Vector3 depths(a.z(), b.z(), c.z());
    for_each_sample(a, b, c, 0, 0, cells_, cells_,
                    [&](int x, int y, const Eigen::Vector3d& weights) {
                      float& cell = depth_[static_cast<size_t>(y * cells_ + x)];
                      cell = std::max(cell, static_cast<float>(weights.dot(depths)));
                    });
  }

  /// The first of two neighbouring cells, both of the buffer.
  int cell_of(double place) const {
    return static_cast<int>(std::clamp(place - 0.5, 0.0, cells_ - 2.0));
  }

  int cells_;
  Eigen::Matrix3d axes_;
  Vector3 offset_;
  std::vector<float> depth_;
};

Vector3 sky_direction(int i, int count) {
  const double z = 1 - (2.0 * i + 1) / count, r = std::sqrt(1 - z * z);
  const double angle = std::numbers::pi * (3 - std::sqrt(5.0)) * i;
  return {r * elementary::cos(angle), r * elementary::sin(angle), z};
}

}  // namespace

int sky_cells_for(int pixels) { return std::clamp(pixels, fewest_cells, most_sky_cells); }

Eigen::VectorXf sky_visibility(const TriangleMesh& given, const Points& normals, int directions,
                               int cells, int threads) {
  const TriangleMesh mesh = at_drawing_size(given);
  const Vector3 low = mesh.positions.colwise().minCoeff(),
                high = mesh.positions.colwise().maxCoeff();
  const Vector3 centre = (low + high) / 2;
  const double radius = (high - low).norm() / 2;
  const Eigen::Index vertices = mesh.vertex_count();
  if (!(radius > 0)) return Eigen::VectorXf::Ones(vertices);  // all in one point
  const auto chunks = (directions + directions_a_chunk - 1) / directions_a_chunk;
  std::vector<Eigen::VectorXf> seen(static_cast<size_t>(chunks), Eigen::VectorXf::Zero(vertices));
  std::vector<Eigen::VectorXf> total = seen;
  parallel_for(directions, directions_a_chunk, threads, [&](std::int64_t first, std::int64_t last) {
    const auto chunk = static_cast<size_t>(first / directions_a_chunk);
    for (std::int64_t i = first; i < last; ++i) {
      const Vector3 direction = sky_direction(static_cast<int>(i), directions);
      const SkyView view(mesh, centre, radius, direction, cells);
      for (Eigen::Index v = 0; v < vertices; ++v) {
        const auto cosine = static_cast<float>(normals.row(v).dot(direction));
        if (cosine <= 0) continue;
        // Lifted off the surface by about two cells, or it would shade itself.
        const Vector3 lifted = mesh.positions.row(v) + normals.row(v) * (4.2 * radius / cells);
        total[chunk][v] += cosine;
        seen[chunk][v] += cosine * view.visible(lifted);
      }
    }
  });
  for (size_t c = 1; c < seen.size(); ++c) {
    seen[0] += seen[c];
    total[0] += total[c];
  }
  return (seen[0].array() / total[0].array().max(1e-6F)).matrix();
}

}  // namespace sphparam
