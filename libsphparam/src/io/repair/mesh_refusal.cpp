// The library's repair names elements of the mesh it was given; people know the numbers of the
// file, which welding and dropping vertices have changed.

#include "sphparam/io/mesh_refusal.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <string_view>
#include <utility>

#include "io/repair/mesh_part.h"
#include "io/repair/repaired_file.h"
#include "mesh/defect_places.h"
#include "mesh/repair/repair_kinds.h"
#include "mesh/repair/weld_shares.h"
#include "mesh/triangle_geometry.h"
#include "number_text.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/io/repair_advice.h"
#include "sphparam/io/sphere_file.h"

namespace sphparam {

namespace {

/// What the message of an action ends with: ": faces 7, 9". What is before it may say more than
/// `describe` knows.
std::string places_of(const RepairAction& action) {
  const std::string text = describe(action);
  return text.substr(std::min(text.rfind(": "), text.size()));
}

/// Triangles of one polygon are one place, as of defects. How many fewer there are so.
long name_polygons_once(std::vector<int>& ids) {
  const auto are_one = [](int a, int b) { return a == b && a >= 0; };
  const auto end = std::unique(ids.begin(), ids.end(), are_one);
  const long fewer = ids.end() - end;
  ids.erase(end, ids.end());
  return fewer;
}

std::vector<RepairAction> by_file_numbers(std::vector<RepairAction> actions,
                                          const MeshSource& source) {
  const FileNumbers numbers(source.file);
  for (RepairAction& action : actions) {
    const bool names_faces = place_of(action.kind) == RepairPlace::Faces;
    const std::string before = places_of(action);
    for (int& id : action.elements) {
      if (id < 0) continue;
      id = static_cast<int>(names_faces ? numbers.face_number(id) : numbers.number(id));
    }
    const long fewer = names_faces ? name_polygons_once(action.elements) : 0;
    if (action.message.ends_with(before)) {
      action.message.resize(action.message.size() - before.size());
      RepairAction listed = action;
      listed.count -= fewer;
      action.message += places_of(listed);
    }
    const bool made_by_welding = info_of(action.kind).trait == RepairTrait::MayFollowWelding;
    if (source.welded && made_by_welding) action.message = "after welding, " + action.message;
  }
  return actions;
}

KeptParts by_file_numbers(KeptParts parts, const MeshSource& source) {
  const FileNumbers numbers(source.file);
  for (SurfacePart& part : parts.largest) {
    if (part.vertex >= 0) part.vertex = static_cast<Vertex>(numbers.number(part.vertex));
  }
  return parts;
}

std::vector<HandleLoop> by_file_numbers(std::vector<HandleLoop> loops, const MeshSource& source) {
  const FileNumbers numbers(source.file);
  for (HandleLoop& loop : loops) {
    for (Vertex& vertex : loop.vertices) {
      if (vertex >= 0) vertex = static_cast<Vertex>(numbers.number(vertex));
    }
  }
  return loops;
}

/// Those that stand in the way of a mended mesh, by the numbers of the file that it was mended
/// from.
std::vector<MeshDefect> remaining_ones(const RepairedMesh& mended, const MeshSource& source) {
  const FileNumbers numbers(source.file);
  std::vector<MeshDefect> remaining;
  for (const MeshDefect& defect : mended.inspection.defects) {
    if (!defect.fatal) continue;
    remaining.push_back(renumbered(
        defect,
        [&](Vertex v) {
          const Vertex origin = mended.vertex_origin[static_cast<std::size_t>(v)];
          return origin < 0 ? -1 : numbers.number(origin);
        },
        [&](Face f) {
          const Face origin = mended.face_origin[static_cast<std::size_t>(f)];
          return origin < 0 ? -1 : numbers.face_number(origin);
        }));
  }
  return remaining;
}

/// The limit that lets all of these go, in whole permille.
double limit_for(const std::vector<HandleLoop>& loops) {
  double longest = RepairOptions{}.longest_handle;
  for (const HandleLoop& loop : loops) {
    if (loop.share > longest) longest = std::ceil(loop.share * 1000 + 1e-6) / 1000;
  }
  return longest;
}

/// Whether repair would help; nothing where there is no memory to find out.
std::optional<RepairTrial> affordable_trial(const MeshSource& source,
                                            const RepairOptions& wanted = {}) {
  try {
    return try_repair_beyond(source, wanted);
  } catch (const std::bad_alloc&) {
    return std::nullopt;
  } catch (const NoSuchComponent&) {  // other repairs leave other components
    return std::nullopt;
  }
}

/// What the parts need, where some would be dropped.
std::optional<PartsTrial> affordable_parts(const MeshSource& source,
                                           const std::optional<RepairTrial>& trial) {
  if (!trial || trial->parts.count < 2) return std::nullopt;
  try {
    return try_parts(source);
  } catch (const std::bad_alloc&) {
    return std::nullopt;
  }
}

/// All repairs, the way that these are done.
RepairOptions all_as(const RepairOptions& wanted) {
  return {.component = wanted.component,
          .keep_holes = wanted.keep_holes,
          .handle_choice = wanted.handle_choice,
          .weld_share = wanted.weld_share,
          .weld_length = wanted.weld_length};
}

/// Of the surface, what was not there before.
double added_share(const RepairedMesh& mended) {
  double area = 0, added = 0;
  const TriangleMesh& mesh = mended.mesh;
  for (Face f = 0; f < static_cast<Face>(mesh.face_count()); ++f) {
    if (!mended.fillers.empty() && mended.fillers[f]) continue;
    const double of_face = face_area(mesh, f);
    area += of_face;
    if (mended.face_origin[f] < 0) added += of_face;
  }
  return added > 0 ? added / area : 0;
}

/// Of the area, what a repair puts in and what it drops.
double changed_share(const RepairedMesh& mended) {
  return added_share(mended) + 1 - mended.parts.area_share;
}

/// What a weld must spare to be told of where a repair is enough.
constexpr double least_spared = 1e-3;

/// Whether a mesh in one piece is better welded first.
bool is_spared(double changed, double changed_welded) {
  return changed >= least_spared && changed_welded <= changed / 2;
}

/// Whether holes were closed, by surface or by fillers.
bool closes_holes(const std::vector<RepairAction>& actions) {
  return count_of(actions, RepairKind::HoleFilled) + count_of(actions, RepairKind::HoleKept) > 0;
}

/// Whether holes were closed with little area: they may have none, but be what rounding leaves
/// between vertices that belong together, as the copies of a pole, one for each longitude.
bool closes_little(const std::vector<RepairAction>& actions, double changed) {
  return changed < least_spared && closes_holes(actions);
}

/// The least distance at which welding may join what belongs together, which is rounding where
/// holes have no area; 0: there is none.
double least_weld(const TriangleMesh& mesh, bool is_rounding) {
  if (is_rounding) return rounding_weld(mesh);
  const std::vector<double> shares = weld_shares(mesh);
  return shares.empty() ? 0 : shares.front();
}

std::vector<double> welds_to_try(const TriangleMesh& mesh, bool in_pieces, bool is_rounding) {
  if (in_pieces) return weld_shares(mesh);
  const double least = least_weld(mesh, is_rounding);
  return least > 0 ? std::vector{least} : std::vector<double>();
}

/// A weld was chosen, or a component of what is not welded.
bool leaves_no_weld(const RepairOptions& wanted) {
  return wanted.component > 0 || wanted.weld_share >= 0 || wanted.weld_length >= 0;
}

constexpr std::string_view weld_note_begins = "--repair --weld ";

/// What `weld_line` finds; empty where welding at the least distance that joins anything would
/// spare little. One more repair.
std::string weld_note(const TriangleMesh& mesh, const RepairedMesh& mended,
                      const RepairOptions& done) {
  const double changed = changed_share(mended);
  const bool closed_little = closes_little(mended.actions, changed);
  if (leaves_no_weld(done) || !done.cracks || (changed < least_spared && !closed_little)) return "";
  const double share = least_weld(mesh, closed_little);
  if (share == 0) return "";
  RepairOptions options = done;
  options.weld_share = share;
  const RepairedMesh welded = repair_mesh(mesh, options);
  if (!welded.inspection.is_sphere()) return "";
  const std::string weld =
      std::string(weld_note_begins) + short_number(100 * options.weld_share, 6) + "%";
  if (closed_little && !closes_holes(welded.actions))
    return weld + " leaves no hole to close: rounding keeps apart what belongs together";
  if (!is_spared(changed, changed_share(welded))) return "";
  return weld + " puts in and drops " + percent(changed_share(welded)) + " of the area, not " +
         percent(changed) + ": rounding keeps apart what belongs together";
}

void note_weld(MeshSource& source, const RepairedMesh& mended, const RepairOptions& done) try {
  std::string note = weld_note(source.file.mesh, mended, done);
  if (!note.empty()) source.notes.push_back(std::move(note));
} catch (const std::bad_alloc&) {  // what was mended is not lost for that
}

MeshSource with_repairs(MeshSource source, RepairedMesh mended) {
  if (!mended.actions.empty()) source.added_share = added_share(mended);
  source.repairs = by_file_numbers(mended.actions, source);
  source.parts = by_file_numbers(mended.parts, source);
  source.handles = by_file_numbers(std::move(mended.handles), source);
  source.file = repaired_file(source.file, mended);
  source.inspection = std::move(mended.inspection);
  source.inspection.defects =
      by_file_numbers(std::move(source.inspection.defects), FileNumbers(source.file));
  source.topology = Topology::try_build(source.file.mesh.triangles,
                                        static_cast<int>(source.file.mesh.vertex_count()));
  return source;
}

RepairTrial trial_of(const MeshSource& source, const RepairOptions& options, RepairedMesh mended,
                     KeptParts parts) {
  std::vector<MeshDefect> remaining = remaining_ones(mended, source);
  return {options, by_file_numbers(std::move(mended.actions), source), std::move(remaining),
          by_file_numbers(std::move(parts), source),
          by_file_numbers(std::move(mended.handles), source)};
}

struct Tried {
  RepairTrial trial;
  double changed;  // see `changed_share`
};

/// With these, and with what more they take until the mesh is a sphere, or nothing is left to try.
Tried tried(const MeshSource& source, RepairOptions options) {
  constexpr double any_length = std::numeric_limits<double>::max();  // in diagonals
  KeptParts parts;
  for (;;) {
    RepairedMesh mended = repair_mesh(source.file.mesh, options);
    if (options.component == 0) parts = mended.parts;
    if (!mended.inspection.is_sphere()) {
      if (mended.parts.refused && !options.only_whole) {
        options.component = 1;
        continue;
      }
      if (mended.largest_hole_left > 0) {
        options.largest_hole = static_cast<int>(mended.largest_hole_left);
        continue;
      }
      if (mended.shortest_handle_left > 0) {
        options.longest_handle = any_length;
        continue;
      }
    }
    options.longest_handle = limit_for(mended.handles);
    const double changed = changed_share(mended);
    return {trial_of(source, options, std::move(mended), std::move(parts)), changed};
  }
}

/// How much a repair does to a surface besides making it one.
long changes_in(const RepairTrial& trial) {
  long changes = 0;
  for (const RepairAction& done : trial.actions) {
    if (info_of(done.kind).trait != RepairTrait::KeepsSurface) changes += done.count;
  }
  return changes;
}

/// Where a mesh is in pieces because what belongs together is apart by small errors: the repair
/// that welds it and keeps it whole, at that of these distances that leaves least to be done
/// besides.
std::optional<Tried> tried_welding(const MeshSource& source, const RepairOptions& wanted,
                                   const std::vector<double>& shares) {
  std::optional<Tried> best;
  for (const double share : shares) {
    RepairOptions options = all_as(wanted);
    options.weld_share = share;
    options.only_whole = true;
    Tried welded = tried(source, options);
    welded.trial.options.only_whole = false;
    if (welded.trial.can_mend()) {
      if (best && changes_in(best->trial) <= changes_in(welded.trial)) break;  // it gets worse
      best = std::move(welded);
      if (changes_in(best->trial) == 0) break;
    }
  }
  return best;
}

/// But for a weld.
bool asks_no_more(const RepairTrial& trial) {
  return trial.can_mend() && trial.options.component == 0 &&
         trial.options.largest_hole == RepairOptions{}.largest_hole &&
         trial.options.longest_handle == RepairOptions{}.longest_handle;
}

[[noreturn]] void refuse_as(const MeshSource& left, std::optional<RepairTrial> trial,
                            std::optional<PartsTrial> parts) {
  if (trial && parts) throw PartsRefusal(left, std::move(*trial), std::move(*parts));
  throw MeshRefusal(left, std::move(trial));
}

}  // namespace

bool RepairTrial::mends_unasked() const { return options.weld_share < 0 && asks_no_more(*this); }

MeshRefusal::MeshRefusal(const MeshSource& source, std::optional<RepairTrial> trial)
    : MeshError(source.inspection.defects),
      path_(source.path),
      trial_(std::move(trial)),
      done_(source.repairs) {}

MeshSource mended(MeshSource source, const RepairOptions& options) {
  RepairedMesh result = repair_mesh(source.file.mesh, options);
  note_weld(source, result, options);
  return with_repairs(std::move(source), std::move(result));
}

MeshFile written_as_mended(const MeshSource& source, std::vector<std::string>& losses) {
  add_polygon_loss(losses, source.file);
  if (source.repairs.empty() || !read_sphere(source.file)) return source.file;
  add_loss(losses, "its map, which is of the mesh before the repair");
  return without_map(source.file);
}

MeshSource repaired(MeshSource source, const RepairOptions& options) {
  RepairedMesh result = repair_mesh(source.file.mesh, options);
  if (result.inspection.is_sphere()) {
    note_weld(source, result, options);
    return with_repairs(std::move(source), std::move(result));
  }
  // Components are numbered as they are in the mesh that was given.
  std::optional<RepairTrial> trial = affordable_trial(source, options);
  std::optional<PartsTrial> parts = affordable_parts(source, trial);
  refuse_as(with_repairs(std::move(source), std::move(result)), std::move(trial), std::move(parts));
}

RepairTrial try_repair(const MeshSource& source, bool keep_holes) {
  return try_repair_beyond(source, {.keep_holes = keep_holes});
}

RepairTrial try_part(const MeshSource& part) { return std::move(tried(part, all_as({})).trial); }

std::string weld_line(const MeshSource& source) {
  const auto is_of_weld = [](const std::string& note) {
    return note.starts_with(weld_note_begins);
  };
  const auto found = std::ranges::find_if(source.notes, is_of_weld);
  return found == source.notes.end() ? "" : *found;
}

RepairTrial try_repair_beyond(const MeshSource& source, const RepairOptions& wanted) {
  Tried plain = tried(source, all_as(wanted));
  const bool in_pieces = plain.trial.parts.refused,
             closed_little = closes_little(plain.trial.actions, plain.changed);
  if (!in_pieces && !closed_little && plain.changed < least_spared) return std::move(plain.trial);
  if (leaves_no_weld(wanted)) return std::move(plain.trial);
  std::optional<Tried> welded =
      tried_welding(source, wanted, welds_to_try(source.file.mesh, in_pieces, closed_little));
  const bool spares =
      welded && (in_pieces || (closed_little && !closes_holes(welded->trial.actions)) ||
                 is_spared(plain.changed, welded->changed));
  return spares ? std::move(welded->trial) : std::move(plain.trial);
}

UnaskedRepair try_repair_unasked(const MeshSource& source) {
  const RepairOptions unasked{.only_whole = true};
  RepairedMesh mended = repair_mesh(source.file.mesh, unasked);
  UnaskedRepair result{trial_of(source, unasked, mended, mended.parts), std::nullopt};
  if (result.trial.mends_unasked()) result.mended = with_repairs(source, std::move(mended));
  return result;
}

UnaskedRepair try_weld(const MeshSource& source) {
  std::optional<Tried> welded = tried_welding(source, {}, weld_shares(source.file.mesh));
  if (!welded || !asks_no_more(welded->trial)) return {};
  RepairOptions options = welded->trial.options;
  options.only_whole = true;
  MeshSource whole = with_repairs(source, repair_mesh(source.file.mesh, options));
  return {std::move(welded->trial), std::move(whole)};
}

bool mends_unasked(const MeshSource& source, const RepairTrial& trial) {
  if (trial.mends_unasked()) return true;
  const bool may_only_spare = trial.can_mend() && trial.options.weld_share >= 0;
  return may_only_spare && try_repair_unasked(source).mended.has_value();
}

void refuse(const MeshSource& source) {
  std::optional<RepairTrial> trial = affordable_trial(source);
  std::optional<PartsTrial> parts = affordable_parts(source, trial);
  refuse_as(source, std::move(trial), std::move(parts));
}

void require_mappable(const MeshSource& source) {
  if (!source.inspection.is_sphere()) refuse(source);
}

}  // namespace sphparam
