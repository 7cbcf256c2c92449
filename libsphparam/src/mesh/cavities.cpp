#include "mesh/cavities.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "mesh/box.h"
#include "mesh/face_boxes.h"
#include "mesh/face_sides.h"
#include "mesh/triangle_geometry.h"
#include "mesh/union_find.h"
#include "mesh/volume_sign.h"

// A point is inside where more faces above it look up than down, or fewer, all signs exact. Where
// it is straight below an edge, it counts as moved by ε along x and ε² along y, as it is for all
// faces.

namespace sphparam {
namespace {

struct Part {
  std::vector<Face> faces;
  Vertex lowest = 0;
  double area = 0, volume = 0;
  bool is_closed = true;
};

bool can_be_looked_at(const TriangleMesh& mesh) {
  const bool names_all = mesh.face_count() > 0 && mesh.triangles.minCoeff() >= 0 &&
                         mesh.triangles.maxCoeff() < mesh.vertex_count();
  return names_all && mesh.positions.allFinite();
}

/// In a box from −1 to 1.
TriangleMesh scaled(const TriangleMesh& mesh, double& scale) {
  const Box box = surface_box(mesh);
  const double extent = (box.upper / 2 - box.lower / 2).maxCoeff();
  scale = extent > 0 && std::isfinite(extent) ? extent : 1;
  TriangleMesh result = mesh;
  const Vector3 centre = box.lower / 2 + box.upper / 2;
  result.positions = (mesh.positions.rowwise() - centre.transpose()) / scale;
  return result;
}

/// Whether two faces of each edge run through it, one each way, by component.
void find_open_parts(const TriangleMesh& mesh, UnionFind& classes, std::map<int, Part>& parts) {
  const std::vector<FaceSide> sides = sorted_sides(mesh.triangles, [](Face) { return true; });
  for_each_edge(sides, [&](size_t i, size_t j) {
    const bool is_whole = j - i == 2 && sides[i].forward != sides[i + 1].forward;
    if (!is_whole) parts[classes.find(sides[i].low)].is_closed = false;
  });
}

/// The largest first.
std::vector<Part> parts_of(const TriangleMesh& mesh) {
  UnionFind classes(static_cast<size_t>(mesh.vertex_count()));
  for (const auto& face : mesh.triangles.rowwise()) {
    classes.unite(face[0], face[1]);
    classes.unite(face[1], face[2]);
  }
  std::map<int, Part> by_lowest;
  for (Face f = 0; f < static_cast<Face>(mesh.face_count()); ++f) {
    const int lowest = classes.find(mesh.triangles(f, 0));
    Part& part = by_lowest[lowest];
    const auto corner = [&](int k) { return mesh.position(mesh.triangles(f, k)); };
    part.lowest = lowest;
    part.faces.push_back(f);
    part.area += face_area(mesh, f);
    part.volume += corner(0).dot(corner(1).cross(corner(2))) / 6;
  }
  if (by_lowest.size() > 1) find_open_parts(mesh, classes, by_lowest);
  std::vector<Part> parts;
  for (auto& [lowest, part] : by_lowest) parts.push_back(std::move(part));
  std::stable_sort(parts.begin(), parts.end(), [](const Part& x, const Part& y) {
    return std::pair(y.area, y.faces.size()) < std::pair(x.area, x.faces.size());
  });
  return parts;
}

/// The side of the line from a to b, seen from above, that p is on once it is moved.
int side_of(const Vector3& a, const Vector3& b, const Vector3& p) {
  if (const int sign = area_sign(a, b, p, 2); sign != 0) return sign;
  const auto sign_of = [](double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; };
  const int along_x = sign_of(a.y() - b.y());
  return along_x != 0 ? along_x : sign_of(b.x() - a.x());
}

/// How often these faces wind about a point, by those above it.
class Windings {
 public:
  Windings(const TriangleMesh& mesh, const Part& part) : mesh_(mesh), boxes_(mesh, part.faces) {}

  int about(const Vector3& p) const {
    int windings = 0;
    boxes_.visit_above(p, [&](Face f) { windings += above(f, p); });
    return windings;
  }

 private:
  /// +1 for a face above p that looks up, −1 for one that looks down.
  int above(Face f, const Vector3& p) const {
    const auto corner = [&](int k) { return mesh_.position(mesh_.triangles(f, k)); };
    const Vector3 a = corner(0), b = corner(1), c = corner(2);
    const int side = side_of(a, b, p);
    if (side == 0 || side_of(b, c, p) != side || side_of(c, a, p) != side) return 0;
    return volume_sign(a, b, c, p) == -side ? side : 0;
  }

  const TriangleMesh& mesh_;
  FaceBoxes boxes_;
};

/// Solids that lie in a cavity: nothing else encloses what they do.
void leave_out_islands(const TriangleMesh& mesh, const std::vector<const Part*>& cavities,
                       std::vector<Vertex>& lowest) {
  for (const Part* cavity : cavities) {
    if (lowest.empty()) return;
    const Windings windings(mesh, *cavity);
    std::erase_if(lowest, [&](Vertex v) { return windings.about(mesh.position(v)) != 0; });
  }
}

}  // namespace

Cavities find_cavities(const TriangleMesh& mesh) {
  if (!can_be_looked_at(mesh)) return {};
  double scale = 1;
  const TriangleMesh unit = scaled(mesh, scale);
  const std::vector<Part> parts = parts_of(unit);
  Cavities found;
  if (parts.size() < 2 || !parts.front().is_closed || parts.front().volume == 0) return found;
  const Part& largest = parts.front();
  const Windings windings(unit, largest);
  const double outward = largest.volume > 0 ? 1 : -1;
  double volume = 0;
  std::vector<const Part*> cavities;
  for (size_t i = 1; i < parts.size(); ++i) {
    const Part& part = parts[i];
    if (!part.is_closed || part.volume == 0) continue;
    if (windings.about(unit.position(part.lowest)) * outward <= 0) continue;
    if (part.volume * outward > 0) {
      found.lowest_of_solids.push_back(part.lowest);
      continue;
    }
    cavities.push_back(&part);
    found.lowest.push_back(part.lowest);
    volume += std::abs(part.volume);
  }
  leave_out_islands(unit, cavities, found.lowest_of_solids);
  std::sort(found.lowest.begin(), found.lowest.end());
  std::sort(found.lowest_of_solids.begin(), found.lowest_of_solids.end());
  found.volume = volume * scale * scale * scale;
  found.share = volume / std::abs(largest.volume);
  return found;
}

}  // namespace sphparam
