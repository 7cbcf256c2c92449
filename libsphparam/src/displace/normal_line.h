#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <span>

#include "rays/ray_scene.h"
#include "sphere/row_locator.h"
#include "sphparam/mesh/surface_point.h"
#include "sphparam/mesh/topology.h"

namespace sphparam {

/// How a point of a surface was found on a line.
enum class LineHit {
  Walk,  // from triangle to triangle, from the point that belongs to the line
  Ray,   // by rays both ways, where the walk came to nothing
  Near,  // not at all: where the line comes nearest to the surface
};

/// Lines, a component at a time.
struct LineTable {
  explicit LineTable(size_t count);
  std::array<PaddedNumbers, 3> origins, normals;
};

/// Where the normals of a base meet a surface.
///
/// A point of the surface is known that belongs to the line's origin; what is looked for is where
/// the line leaves the surface near to it. A walk over the surface, seen along the line, gets there
/// across few edges wherever the surface stands over the base like a landscape. It is believed if
/// it comes no farther than that point is, or than thrice the distance to the surface, which is
/// where a slope of 70° is met. Elsewhere rays look for the nearest crossing as near, outwards if
/// there is one, and where there is none the line's point that is nearest to the surface must do.
/// Our own.
class NormalLines {
 public:
  /// All outlive this. The scene for rays is made when it is first asked.
  NormalLines(const TriangleMesh& surface, const Topology& topology);

  struct Crossing {
    double height = 0;  // along the normal
    LineHit hit = LineHit::Near;
  };
  /// Requires: unit normal. May be called from many threads.
  /// Cost: some 0.1 µs where the walk arrives, 10 µs elsewhere.
  Crossing find(const Vector3& origin, const Vector3& normal, const SurfacePoint& known) const;
  /// The same for many lines, but for rounding. Requires: a known point and a crossing a line.
  /// Cost: a tenth where lines leave the surface through the triangle of the known point, which
  /// those beside one another share.
  void find_all(const LineTable& lines, const PointTable& known,
                std::span<Crossing> crossings) const;

 private:
  struct Line {
    Vector3 origin, normal;
    Vector3 at(double height) const { return origin + height * normal; }
  };
  struct Walked {
    double height;
    bool started_outwards;  // the triangle it began in is one that the line leaves through
  };
  void find_few(const LineTable& lines, const PointTable& known, size_t first, size_t count,
                std::span<Crossing> crossings) const;
  std::optional<Walked> walk(const Line& line, Face start) const;
  std::optional<double> cast(const Line& line, double reach) const;
  double approach(const Line& line, double height) const;
  Vector3 point(const SurfacePoint& on) const;
  const RayScene& scene() const;

  const TriangleMesh& surface_;
  const Topology& topology_;
  mutable std::once_flag scene_made_;
  mutable std::unique_ptr<RayScene> scene_;
};

}  // namespace sphparam
