#include "support/volume_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace sphparam::tests {
namespace {

using Point = std::array<int, 3>;

/// Each cube of the grid is cut into six tetrahedra about its diagonal.
class TetrahedraMarcher {
 public:
  TetrahedraMarcher(const Point& size, const std::function<double(int, int, int)>& field)
      : size_({size[0] + 2, size[1] + 2, size[2] + 2}) {
    values_.resize(static_cast<size_t>(size_[0]) * size_[1] * size_[2], -1.0);
    for (int z = 0; z < size[2]; ++z) {
      for (int y = 0; y < size[1]; ++y) {
        for (int x = 0; x < size[0]; ++x) values_[index({x + 1, y + 1, z + 1})] = field(x, y, z);
      }
    }
  }

  TriangleMesh run() {
    constexpr std::array<Point, 6> orders = {
        {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
    for (int z = 0; z + 1 < size_[2]; ++z) {
      for (int y = 0; y + 1 < size_[1]; ++y) {
        for (int x = 0; x + 1 < size_[0]; ++x) {
          for (const Point& order : orders) {
            std::array<Point, 4> corners = {{{x, y, z}, {x, y, z}, {x, y, z}, {x, y, z}}};
            for (size_t k = 0; k < 3; ++k) {
              for (size_t later = k + 1; later < 4; ++later) {
                ++corners[later][static_cast<size_t>(order[k])];
              }
            }
            march(corners);
          }
        }
      }
    }
    TriangleMesh mesh;
    mesh.positions.resize(static_cast<Eigen::Index>(points_.size()), 3);
    for (size_t v = 0; v < points_.size(); ++v) {
      mesh.positions.row(static_cast<Eigen::Index>(v)) = points_[v];
    }
    mesh.triangles.resize(static_cast<Eigen::Index>(faces_.size()), 3);
    for (size_t f = 0; f < faces_.size(); ++f) {
      mesh.triangles.row(static_cast<Eigen::Index>(f)) << faces_[f][0], faces_[f][1], faces_[f][2];
    }
    return mesh;
  }

 private:
  size_t index(const Point& p) const {
    return (static_cast<size_t>(p[2]) * size_[1] + p[1]) * size_[0] + p[0];
  }
  static Vector3 place(const Point& p) { return Vector3(p[0], p[1], p[2]); }

  int vertex_between(const Point& in, const Point& out) {
    const std::pair<size_t, size_t> key = std::minmax(index(in), index(out));
    const auto [known, is_new] = vertices_.emplace(key, static_cast<int>(points_.size()));
    if (is_new) {
      const double inside = values_[index(in)], outside = values_[index(out)];
      const double t = std::clamp(inside / (inside - outside), 0.1, 0.9);
      points_.push_back((1 - t) * place(in) + t * place(out));
    }
    return known->second;
  }

  void add(int a, int b, int c, const Vector3& outwards) {
    const Vector3 normal = (points_[b] - points_[a]).cross(points_[c] - points_[a]);
    if (normal.dot(outwards) < 0) std::swap(b, c);
    faces_.push_back({a, b, c});
  }

  void march(const std::array<Point, 4>& corners) {
    std::vector<Point> in, out;
    for (const Point& corner : corners) (values_[index(corner)] > 0 ? in : out).push_back(corner);
    if (in.empty() || out.empty()) return;
    Vector3 outwards = Vector3::Zero();
    for (const Point& p : out) outwards += place(p) / static_cast<double>(out.size());
    for (const Point& p : in) outwards -= place(p) / static_cast<double>(in.size());
    std::vector<int> ring;  // in order about the section
    if (in.size() == 2) {
      for (const auto& [i, o] : {std::pair(0, 0), {0, 1}, {1, 1}, {1, 0}}) {
        ring.push_back(vertex_between(in[static_cast<size_t>(i)], out[static_cast<size_t>(o)]));
      }
    } else {
      for (const Point& i : in) {
        for (const Point& o : out) ring.push_back(vertex_between(i, o));
      }
    }
    add(ring[0], ring[1], ring[2], outwards);
    if (ring.size() == 4) add(ring[0], ring[2], ring[3], outwards);
  }

  Point size_;
  std::vector<double> values_;
  std::map<std::pair<size_t, size_t>, int> vertices_;
  std::vector<Vector3> points_;
  std::vector<std::array<int, 3>> faces_;
};

/// Noise of standard deviation 1, blurred along the axes.
std::vector<double> smooth_noise(int across, unsigned seed) {
  std::mt19937 random(seed);
  const auto n = static_cast<size_t>(across);
  std::vector<double> values(n * n * n);
  for (double& value : values) {
    value = static_cast<double>(random()) / 2147483648.0 - 1;
  }
  for (const size_t stride : {size_t{1}, n, n * n}) {
    for (int pass = 0; pass < 2; ++pass) {
      std::vector<double> blurred = values;
      for (size_t i = stride; i + stride < values.size(); ++i) {
        blurred[i] = (values[i - stride] + 2 * values[i] + values[i + stride]) / 4;
      }
      values = std::move(blurred);
    }
  }
  double squares = 0;
  for (const double value : values) squares += value * value;
  const double deviation = std::sqrt(squares / static_cast<double>(values.size()));
  for (double& value : values) value /= deviation;
  return values;
}

}  // namespace

TriangleMesh volume_surface(const std::array<int, 3>& size,
                            const std::function<double(int, int, int)>& field) {
  return TetrahedraMarcher(size, field).run();
}

TriangleMesh largest_part(const TriangleMesh& mesh) {
  std::vector<int> root(static_cast<size_t>(mesh.vertex_count()));
  for (size_t v = 0; v < root.size(); ++v) root[v] = static_cast<int>(v);
  const auto find = [&](int v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    for (const int k : {1, 2}) {
      root[find(mesh.triangles(f, k))] = find(mesh.triangles(f, 0));
    }
  }
  std::map<int, long> faces;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) ++faces[find(mesh.triangles(f, 0))];
  const int largest = std::max_element(faces.begin(), faces.end(), [](auto& x, auto& y) {
                        return x.second < y.second;
                      })->first;
  std::vector<int> name(root.size(), -1);
  TriangleMesh part;
  part.positions.resize(mesh.vertex_count(), 3);
  part.triangles.resize(faces[largest], 3);
  int vertices = 0;
  Eigen::Index kept = 0;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    if (find(mesh.triangles(f, 0)) != largest) continue;
    for (int k = 0; k < 3; ++k) {
      int& known = name[mesh.triangles(f, k)];
      if (known < 0) {
        part.positions.row(vertices) = mesh.positions.row(mesh.triangles(f, k));
        known = vertices++;
      }
      part.triangles(kept, k) = known;
    }
    ++kept;
  }
  part.positions.conservativeResize(vertices, 3);
  return part;
}

TriangleMesh noisy_ball(int across, double noise, unsigned seed) {
  const std::vector<double> values = smooth_noise(across, seed);
  const double middle = (across - 1) / 2.0;
  return largest_part(volume_surface({across, across, across}, [&](int x, int y, int z) {
    const double distance = Vector3(x - middle, y - middle, z - middle).norm() / middle;
    const size_t i = (static_cast<size_t>(z) * across + y) * across + x;
    return 0.8 - distance + noise * values[i];
  }));
}

TriangleMesh tube_grid(int nx, int ny, int step, double radius) {
  const std::array<int, 3> size = {nx * step, ny * step, step};
  return volume_surface(size, [&](int x, int y, int z) {
    const double px = (x + 0.5) / step - 0.5, py = (y + 0.5) / step - 0.5,
                 pz = (z + 0.5) / step - 0.5;
    const auto beyond = [](double p, int n) { return p - std::clamp(p, 0.0, n - 1.0); };
    const double to_line_x = Vector3(beyond(px, nx), py - std::round(py), pz).norm();
    const double to_line_y = Vector3(px - std::round(px), beyond(py, ny), pz).norm();
    return radius - std::min(to_line_x, to_line_y);
  });
}

TriangleMesh bumped_torus(int around, int along, double radius, double bumps, unsigned seed) {
  std::mt19937 random(seed);
  TriangleMesh mesh;
  mesh.positions.resize(static_cast<Eigen::Index>(around) * along, 3);
  mesh.triangles.resize(2 * mesh.positions.rows(), 3);
  const auto at = [&](int i, int j) { return (i % along) * around + j % around; };
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < around; ++j) {
      const double u = 2 * std::numbers::pi * i / along, v = 2 * std::numbers::pi * j / around;
      const double bump = 1 + bumps * (static_cast<double>(random()) / 2147483648.0 - 1);
      const double r = radius * bump, out = 1 + r * std::cos(v);
      mesh.positions.row(at(i, j)) << out * std::cos(u), out * std::sin(u), r * std::sin(v);
      mesh.triangles.row(2 * at(i, j)) << at(i, j), at(i + 1, j), at(i + 1, j + 1);
      mesh.triangles.row(2 * at(i, j) + 1) << at(i, j), at(i + 1, j + 1), at(i, j + 1);
    }
  }
  return mesh;
}

}  // namespace sphparam::tests
