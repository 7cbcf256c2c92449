#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "sphparam/mesh/triangle_mesh.h"
#include "sphparam/progress.h"

namespace sphparam {

/// Where distances are measured from, and how many times.
struct DistanceOptions {
  std::int64_t samples = 1'000'000;  // on faces, and as many on edges
  std::uint64_t seed = 1;
  bool faces = true;      // what mean and RMS are taken over: uniform over the area …
  bool edges = false;     // … uniform over the edges, each once …
  bool vertices = false;  // … and the vertices that triangles use
  bool extremes = true;   // false: mean and RMS alone, in half the time
  /// Also on which side of the second surface the points of the first are, which must be closed.
  bool deviations = false;
  /// What encloses the inside, where that is not the second surface itself, which may be open then:
  /// as a rule that with its fillers. Closed; borrowed.
  const TriangleMesh* enclosing = nullptr;
  /// Also which share of the samples is no farther than this from the other surface.
  std::optional<double> within = {};
  /// Leaves out of everything but `at_vertices` the points whose nearest point lies on the border
  /// of the other surface, as those over its holes and beyond its end do, but not those on it.
  /// Between samples no maximum is sought then.
  bool leave_out_borders = false;
  int threads = 0;  // 0: all cores
  Progress progress = {};
};

/// How far the points of one surface are from a closed one: as far as they are, less than 0 inside
/// of it. Inside is where it winds about a point, one way or the other: parts may overlap, and it
/// may be inside out. On it, to the rounding of coordinates, is 0 or more.
struct SignedDeviation {
  double min = 0, max = 0;  // of all points that were looked at, `farthest` among them
  double mean = 0;          // of the samples that `OneSidedDistance::mean` is of
  double sd = 0;            // standard deviation of these
  double median = 0;
  VectorX at_vertices;  // of every vertex; empty where they were not looked at
};

/// How far the points of one surface are from another surface.
struct OneSidedDistance {
  double max = 0;        // of any point that was looked at: see `max_bound`
  double max_bound = 0;  // no point is farther; infinite without `extremes`, or what is left out
  double min = 0;        // of all points that were looked at
  double mean = 0, rms = 0;  // of the samples
  double sd = 0;             // their standard deviation
  /// No more than so much is as far as half, 95 and 99 of 100 samples are, by nearest rank; of
  /// every second one or fewer where there are more than four million.
  double median = 0, p95 = 0, p99 = 0;
  std::optional<double> within = {};   // the share of the samples that is
  std::int64_t samples = 0;            // those of mean and rms
  Vector3 farthest = Vector3::Zero();  // the point at `max`
  VectorX at_vertices;                 // of every vertex; empty where they were not looked at
  /// With `leave_out_borders`: the share of the samples that was left out (`samples` are the rest),
  /// and a mark a vertex, 1 where it was; empty where they were not looked at.
  std::optional<double> left_out = {};
  std::vector<std::uint8_t> left_out_vertices = {};
  std::optional<SignedDeviation> deviation = {};  // forth, where `deviations` are wanted
};

struct SurfaceDistance {
  OneSidedDistance forth, back;                    // from the first to the second; the other way
  double diagonal_first = 0, diagonal_second = 0;  // of the boxes about what triangles use

  /// The larger of both sides. The Hausdorff distance is between max and max_bound.
  double max() const;
  double max_bound() const;
  double mean() const;
  double rms() const;
  double p95() const;  // what is called HD95
};

enum class Side { First, Second };

/// A surface that cannot be measured, and why.
class UnmeasurableSurface : public std::invalid_argument {
 public:
  UnmeasurableSurface(Side side, const std::string& reason)
      : std::invalid_argument(reason), side_(side) {}
  Side side() const { return side_; }

 private:
  Side side_;
};

/// Measures how far two surfaces are apart, by samples of each and their exact nearest points on
/// the other; then, with `extremes`, of each vertex, and the maximum is sought between the samples,
/// by `find_farthest`. Neither needs to be closed, but for `deviations` the second. What is nearer
/// than the rounding of a sample's own coordinates counts as 0: a surface is no distance from
/// itself. Source: the measures of Metro (Cignoni, Rocchini and Scopigno 1998), as MeshLab has
/// them; the samples are stratified by area. Requires: some sample wanted, samples ≥ 1. Throws:
/// std::invalid_argument if not, or for less than 0 as `within`; UnmeasurableSurface where there is
/// no triangle, one names a vertex that is not there, a coordinate is not finite, what is to be
/// sampled has no area or length or is left out as a whole, or the second, or what encloses for it,
/// is to be closed and is not; Cancelled. Ensures: the same bits for any number of threads. Cost:
/// about 1 µs a sample and vertex, some times that among thin triangles, with `extremes` up to 3 µs
/// a sample for the bound, and about 10 µs for the side of each; memory linear in the meshes, and
/// up to 200 MB for the bound. A point that is equally far from many triangles, as a ball's centre
/// is from the ball, asks all of them.
SurfaceDistance measure_distance(const TriangleMesh& first, const TriangleMesh& second,
                                 const DistanceOptions& options = {});

}  // namespace sphparam
