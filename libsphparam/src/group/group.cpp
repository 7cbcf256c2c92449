#include "sphparam/group/group.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

#include "correspondence/matchable.h"
#include "embedding/energy/energy_domain.h"
#include "group/group_scalars.h"
#include "group/into_correspondence.h"
#include "io/attributes/other_coordinates.h"
#include "io/match_targets.h"
#include "mesh/vertex_normals.h"
#include "option_domain.h"
#include "sphparam/correspondence/surface_map.h"
#include "sphparam/errors.h"
#include "sphparam/group/surface_size.h"
#include "sphparam/parallel.h"
#include "sphparam/remesh/remesh.h"
#include "sphparam/remesh/resample.h"

// Shapes are brought to the template side by side, each by one thread, one alone by all; then,
// round by round, to their mean on the grid, which starts where they are. The template goes along,
// so that its vertices have directions at the end.

namespace sphparam {
namespace {

size_t at(std::int64_t i) { return static_cast<size_t>(i); }

void require_sensible(const std::vector<MappedMesh>& shapes, const GroupOptions& options) {
  if (shapes.empty()) throw std::invalid_argument("a group has one shape at least");
  require_one_of("start", options.start, GroupStart::Maps);
  require_domain(options.energy);
  require_at_least("rounds", options.rounds, 0);
  require_at_least("modes", options.modes, 0);
  if (options.grid && has_quads(*options.grid))
    throw std::invalid_argument("grid is " + name_of(*options.grid) +
                                ": it must be one of triangles");
}

/// Work on each of many, side by side, told as one.
class SideBySide {
 public:
  SideBySide(std::int64_t count, int threads, const Progress& progress)
      : count_(count), threads_(threads), progress_(progress) {}

  /// One call at a time, by whoever works; what it tells is how many are done.
  Progress inner_progress(const char* stage) {
    return [this, stage](std::string_view, double) { return tell(stage, 0); };
  }

  void run(const char* stage, const std::function<void(size_t)>& work) {
    done_ = 0;
    parallel_for(count_, 1, threads_, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t i = first; i < last; ++i) {
        work(at(i));
        if (!tell(stage, 1)) throw Cancelled();
      }
    });
  }

 private:
  bool tell(const char* stage, int more) {
    const std::lock_guard lock(mutex_);
    done_ += more;
    return !progress_ || progress_(stage, static_cast<double>(done_) / static_cast<double>(count_));
  }

  std::int64_t count_;
  int threads_;
  const Progress& progress_;
  std::mutex mutex_;
  std::int64_t done_ = 0;
};

/// The triangles and the map of a mesh, at points of the coordinates of another.
MappedMesh with_positions(const MappedMesh& mesh, const MappedMesh& other, const Points& positions,
                          const std::string& name) {
  MeshFile file = mesh.file();
  move_into(file, other.file(), positions);
  return MappedMesh({.file = std::move(file),
                     .map = mesh.map(),
                     .provenance = mesh.provenance(),
                     .topology = mesh.topology(),
                     .name = name},
                    1);
}

/// What vertices have, for `RemeshOptions::transfer`; but normals, which are not turned along.
std::vector<std::string> values_of(const MeshFile& file) {
  std::vector<std::string> names;
  for (const Property& property : file.vertex_properties)
    if (const std::string& name = property.name; name != "nx" && name != "ny" && name != "nz")
      names.push_back(name);
  return names;
}

/// How far a shape's own vertices are from the resampled one.
void measure_resampling(GroupMember& member) {
  const TriangleMesh& mesh = member.mapped.mesh();
  const std::vector<SurfacePoint> points = SurfaceMap(member.mapped, member.resampled).forth(1);
  const VectorX areas = vertex_areas(member.mapped.surface());
  double squares = 0, most = 0;
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    if (areas[v] == 0) continue;  // of fillers alone
    const double square =
        (position(member.resampled.mesh(), points[at(v)]) - mesh.position(v)).squaredNorm();
    squares += areas[v] * square;
    most = std::max(most, square);
  }
  member.resampling_rms = areas.sum() > 0 ? std::sqrt(squares / areas.sum()) : 0;
  member.resampling_max = std::sqrt(most);
}

class GroupWork {
 public:
  GroupWork(const std::vector<MappedMesh>& shapes, const MappedMesh& reference,
            const GroupOptions& options)
      : shapes_(shapes), options_(options), reference_(reference) {
    const auto is_reference = [&](const MappedMesh& shape) {
      return &shape.mesh() == &reference.mesh();
    };
    const auto found = std::ranges::find_if(shapes, is_reference);
    if (found != shapes.end()) own_reference_ = found - shapes.begin();
  }

  Group run() {
    bring_all(reference_, options_.start, "template");
    for (int round = 0; round < options_.rounds && !options_.hold; ++round) {
      const std::vector<Points> positions = resampled(grid_of(brought_reference()));
      const MappedMesh mean =
          with_positions(*resampled_reference_, reference_, aligned(positions).mean, "mean");
      bring_all(mean, GroupStart::Maps, "mean");
    }
    return finished(
        resampled(options_.grid ? make_grid(*options_.grid) : grid_of(brought_reference()), true));
  }

 private:
  std::int64_t count() const { return std::ssize(shapes_) + (own_reference_ ? 0 : 1); }
  bool is_shape(size_t i) const { return i < shapes_.size(); }
  const MappedMesh& begun(size_t i) const {
    if (!brought_.empty()) return brought_[i]->mapped;
    return is_shape(i) ? shapes_[i] : reference_;
  }

  void bring_all(const MappedMesh& mapped, GroupStart start, const char* stage) {
    SideBySide work(count(), options_.threads, options_.progress);
    const GroupTarget target = group_target(mapped, start, options_.alike, options_.threads);
    target.mapped.locator();
    const MatchOptions match{.alike = options_.alike,
                             .energy = options_.energy,
                             .threads = options_.threads,
                             .progress = work.inner_progress(stage)};
    std::vector<std::optional<Brought>> brought(at(count()));
    work.run(stage, [&](size_t i) {
      const bool is_target = &begun(i).mesh() == &mapped.mesh();
      brought[i] = is_target ? Brought{.mapped = mapped, .start = "template"}
                             : bring(target, begun(i), start, match);
      keep_first_words(i, *brought[i]);
    });
    brought_ = std::move(brought);
  }

  /// What is told of the start is of the first round.
  void keep_first_words(size_t i, Brought& brought) const {
    if (brought_.empty()) return;
    const Brought& before = *brought_[i];
    brought.start = before.start;
    brought.confidence = before.confidence;
    brought.doubts = before.doubts;
    brought.mirrored = before.mirrored;
  }

  /// Mirror images are decided on once: of what is brought to the template.
  Brought bring(const GroupTarget& target, const MappedMesh& shape, GroupStart start,
                const MatchOptions& match) const {
    const bool either = options_.mirror && brought_.empty();
    return either ? bring_either_to(target, shape, start, options_.hold, match)
                  : bring_to(target, shape, start, options_.hold, match);
  }

  const MappedMesh& brought_reference() const {
    return brought_[own_reference_ ? at(*own_reference_) : shapes_.size()]->mapped;
  }

  /// All on a grid; `with_values`: with what the vertices of the shapes have.
  std::vector<Points> resampled(const SphereGrid& grid, bool with_values = false) {
    const auto on_grid = [&](const MappedMesh& mapped, std::vector<std::string> values) {
      return remesh(mapped, grid, {.transfer = std::move(values), .threads = 1});
    };
    SideBySide work(std::ssize(shapes_), options_.threads, options_.progress);
    members_.resize(shapes_.size());
    work.run("resample", [&](size_t i) {
      const MappedMesh& mapped = brought_[i]->mapped;
      members_[i] =
          on_grid(mapped, with_values ? values_of(mapped.file()) : std::vector<std::string>{});
    });
    resampled_reference_ = on_grid(brought_reference(), {});
    std::vector<Points> positions;
    for (const auto& member : members_) positions.push_back(member->mesh().positions);
    return positions;
  }

  /// The mean share of the area.
  VectorX weights() const {
    VectorX sum = VectorX::Zero(members_.front()->mesh().vertex_count());
    for (const auto& member : members_) {
      const VectorX areas = vertex_areas(member->surface());
      if (!(areas.sum() > 0))
        throw UnmeasurableMesh(member->name() +
                               ": nothing of its surface is left on the grid: try a finer --grid");
      sum += areas / areas.sum();
    }
    return sum / sum.sum();
  }

  /// Each shape's own, whatever the others' shares of the area are.
  VectorX sizes() const {
    VectorX result(std::ssize(members_));
    for (size_t i = 0; i < members_.size(); ++i)
      result[static_cast<Eigen::Index>(i)] = surface_size(members_[i]->surface());
    return result;
  }

  Procrustes aligned(const std::vector<Points>& positions) const {
    return align_by_procrustes(
        positions, resampled_reference_->mesh().positions, weights(),
        {.scale = options_.scale, .sizes = sizes(), .threads = options_.threads});
  }

  std::vector<GroupMember> members(Procrustes& procrustes) {
    std::vector<GroupMember> result;
    const VectorX size = sizes();
    for (size_t i = 0; i < shapes_.size(); ++i) {
      Brought& brought = *brought_[i];
      result.push_back({.mapped = std::move(brought.mapped),
                        .resampled = *std::move(members_[i]),
                        .aligned = std::move(procrustes.shapes[i]),
                        .size = size[static_cast<Eigen::Index>(i)],
                        .motion = procrustes.motions[i],
                        .start = std::move(brought.start),
                        .energy = brought.energy,
                        .confidence = brought.confidence,
                        .warnings = std::move(brought.doubts),
                        .mirrored = brought.mirrored});
      std::vector<std::string>& warnings = result.back().warnings;
      std::ranges::move(brought.warnings, std::back_inserter(warnings));
      add_match_loss(warnings, shapes_[i].file());
      if (auto facing = opposite_facing(shapes_[i], reference_))
        warnings.insert(warnings.begin(), *std::move(facing));
    }
    SideBySide work(std::ssize(result), options_.threads, options_.progress);
    work.run("measure", [&](size_t i) { measure_resampling(result[i]); });
    return result;
  }

  Group finished(const std::vector<Points>& positions) {
    const VectorX weights_of = weights();
    Procrustes procrustes = aligned(positions);
    const MappedMesh reference = brought_reference();
    const MappedMesh mean =
        with_positions(*resampled_reference_, reference_, procrustes.mean, "mean");
    ShapeModes modes = shape_modes(procrustes.shapes, procrustes.mean, weights_of, options_.modes,
                                   options_.threads);
    const int iterations = procrustes.iterations;
    MatrixX distances = procrustes_distances(procrustes.shapes, weights_of, options_.threads);
    std::vector<GroupMember> all = members(procrustes);
    std::vector<GroupScalar> scalars = group_scalars(all);
    Group group{.members = std::move(all),
                .reference = reference,
                .mean = mean,
                .weights = weights_of,
                .modes = std::move(modes),
                .distances = std::move(distances),
                .deviation = {},
                .normal_deviation = {},
                .iterations = iterations,
                .scalars = std::move(scalars)};
    measure_deviation(group);
    return group;
  }

  static void measure_deviation(Group& group) {
    const TriangleMesh& mean = group.mean.mesh();
    const Points normals = vertex_normals(mean);
    VectorX squares = VectorX::Zero(mean.vertex_count()), along = squares;
    for (const GroupMember& member : group.members) {
      const Points away = member.aligned - mean.positions;
      squares += away.rowwise().squaredNorm();
      along += away.cwiseProduct(normals).rowwise().sum().cwiseAbs2();
    }
    const double free = std::max<double>(1, static_cast<double>(group.members.size()) - 1);
    group.deviation = (squares / free).cwiseSqrt();
    group.normal_deviation = (along / free).cwiseSqrt();
  }

  const std::vector<MappedMesh>& shapes_;
  const GroupOptions& options_;
  const MappedMesh& reference_;
  std::optional<std::ptrdiff_t> own_reference_;  // it is this shape
  std::vector<std::optional<Brought>> brought_;  // shapes, then the template where it is none
  std::vector<std::optional<MappedMesh>> members_;
  std::optional<MappedMesh> resampled_reference_;
};

}  // namespace

std::string name_of(GroupStart start) {
  switch (start) {
    case GroupStart::Ends:
      return "ends";
    case GroupStart::Maps:
      return "maps";
    case GroupStart::Ellipsoid:
      return "ellipsoid";
    default:
      return "rotation";
  }
}

Group make_group(const std::vector<MappedMesh>& shapes, const MappedMesh& reference,
                 const GroupOptions& options) {
  require_sensible(shapes, options);
  for (const MappedMesh& shape : shapes) require_area(shape);
  require_area(reference);
  return GroupWork(shapes, reference, options).run();
}

MappedMesh group_shape(const Group& group, int mode, double deviations) {
  return with_positions(group.mean, group.mean,
                        along_mode(group.mean.mesh().positions, group.modes, mode, deviations),
                        "mean and " + std::to_string(deviations) + " deviations");
}

MappedMesh aligned_shape(const Group& group, size_t member) {
  const GroupMember& shape = group.members.at(member);
  return with_positions(shape.resampled, group.mean, shape.aligned, shape.mapped.name());
}

std::vector<SurfacePoint> carried_to(const Group& group, size_t member,
                                     const std::vector<Vertex>& vertices) {
  const SphereLocator& locator = group.members.at(member).mapped.locator();
  std::vector<SurfacePoint> points;
  require_vertices("vertices", vertices, group.reference.mesh().vertex_count());
  for (const Vertex v : vertices) points.push_back(locator.locate(group.reference.map().point(v)));
  return points;
}

}  // namespace sphparam
