#include "sphparam/mesh/mesh_repair.h"

#include <algorithm>

#include "mesh/enclosed_volume.h"
#include "mesh/index_range.h"
#include "mesh/repair/repair_state.h"
#include "mesh/triangle_geometry.h"
#include "number_text.h"
#include "option_domain.h"
#include "sphparam/mesh/topology.h"

// The steps are the table below, each blind to the others: one can be left out, and what one leaves
// the next finds. Splitting an edge may touch a third sheet, dropping a face may open a hole: the
// table is gone through again until a round does nothing.

namespace sphparam {
namespace {

constexpr int most_rounds = 5;

/// Whether inside and outside are those of the surface, whatever shape the fillers have.
bool encloses(const RepairState& state) {
  if (!state.has_fillers()) return true;
  double area = 0, filled = 0;
  for (Face f = 0; f < state.face_count(); ++f) {
    const auto& [a, b, c] = state.faces[f];
    const double of_face = triangle_area(state.shape[a], state.shape[b], state.shape[c]);
    area += of_face;
    if (state.fillers[f]) filled += of_face;
  }
  return filled <= most_filled * area;
}

bool turn_outward(RepairState& state, const MeshInspection& inspection) {
  const auto inside_out = [](const MeshDefect& d) { return d.kind == DefectKind::InsideOut; };
  if (!inspection.is_sphere() ||
      std::none_of(inspection.defects.begin(), inspection.defects.end(), inside_out) ||
      !encloses(state)) {
    return false;
  }
  for (Face f = 0; f < state.face_count(); ++f) state.turn_over(f);
  state.log(RepairKind::TurnedOutward, {0});
  return true;
}

/// Of the input's vertices, whether one of these is it, or a copy of it.
std::vector<char> present_origins(const RepairState& state, const std::vector<char>& counted) {
  std::vector<char> present;
  for (Vertex v = 0; v < state.vertex_count(); ++v) {
    const auto origin = static_cast<size_t>(state.vertex_origin[v]);
    if (state.vertex_origin[v] < 0) continue;
    if (present.size() <= origin) present.resize(origin + 1, 0);
    if (counted[v]) present[origin] = 1;
  }
  return present;
}

/// Only what the input loses is told: no vertex that was created, and no copy of one that stays.
void drop_unused(RepairState& state) {
  std::vector<char> used(state.positions.size(), 0);
  for (const auto& face : state.faces) {
    for (const Vertex v : face) used[v] = 1;
  }
  std::vector<char> told = present_origins(state, used);
  for (Vertex v = 0; v < state.vertex_count(); ++v) {
    const Vertex origin = state.vertex_origin[v];
    if (used[v] || origin < 0 || told[origin]) continue;
    told[origin] = 1;
    state.log(RepairKind::UnusedVertexDropped, {origin});
  }
  state.drop_unused_vertices();
}

/// Later rounds work on what the first has chosen.
void choose_component(RepairState& state, const RepairOptions& options, bool first_round) {
  if (state.parts.refused) return;
  const bool named = options.component > 0;
  keep_component(state, first_round && named ? options.component : 1,
                 named ? 0 : options.least_kept);
}

bool is_given_up(const RepairState& state, const RepairOptions& options) {
  return options.only_whole && state.parts.refused;
}

bool is_closed_manifold(const RepairState& state) {
  return Topology::try_build(state.triangles(), state.vertex_count()).has_value();
}

void run_round(RepairState& state, const RepairOptions& options, bool first) {
  if (options.duplicates) {
    remove_invalid_faces(state);
    remove_duplicate_faces(state);
  }
  // Once: splitting sheets makes copies of vertices at one place, which are to stay apart.
  if (options.cracks && first && !is_closed_manifold(state)) close_cracks(state, options);
  const bool closed = is_closed_manifold(state);  // which these three would find out one by one
  if (options.orientation && !closed) orient_alike(state);
  if (options.non_manifold && !closed) split_non_manifold(state);
  if (options.components) choose_component(state, options, first);
  if (is_given_up(state, options)) return;
  if (closed) state.largest_hole_left = 0;
  if (options.holes && !closed) fill_holes(state, options);
  if (options.handles) remove_handles(state, options);
  if (options.flat_faces) mend_flat_faces(state);
  if (options.unused) drop_unused(state);
}

bool all_indices_inside(const RepairState& state) {
  return std::all_of(state.faces.begin(), state.faces.end(), [&](const auto& face) {
    return std::all_of(face.begin(), face.end(),
                       [&](Vertex v) { return v >= 0 && v < state.vertex_count(); });
  });
}

/// Whether there was something to do.
bool halve_wanted(RepairState& state, const RepairOptions& options) {
  if (options.edge_share == 0 && options.edge_length == 0) return false;
  const long done_before = state.log_size();
  halve_long_edges(state, options);
  return state.log_size() > done_before;
}

bool names_no_place(const TriangleMesh& mesh, Face f) {
  for (int k = 0; k < 3; ++k) {
    const Vertex v = mesh.triangles(f, k);
    if (v >= 0 && v < mesh.vertex_count() && !mesh.position(v).allFinite()) return true;
  }
  return false;
}

/// The kind has two reasons; where faces named vertices that were never there, which it was. Those
/// that named one without a place as well went with that.
void tell_absent_vertices(RepairedMesh& result, const TriangleMesh& given) {
  long absent = 0;
  for (Face f = 0; f < given.face_count(); ++f) {
    if (!is_inside(given.triangles, f, given.vertex_count()) && !names_no_place(given, f)) ++absent;
  }
  if (absent == 0) return;
  for (RepairAction& action : result.actions) {
    if (action.kind != RepairKind::InvalidFaceRemoved) continue;
    const std::string places = action.message.substr(action.message.rfind(": faces"));
    action.message = counted(absent, "face", "faces") + " removed that named " +
                     (absent == 1 ? "a vertex that does not exist" : "vertices that do not exist");
    if (const long twice = action.count - absent; twice > 0)
      action.message += ", " + std::to_string(twice) + " that named a vertex twice";
    action.message += places;
  }
}

RepairedMesh as_result(RepairState&& state, MeshInspection inspection) {
  RepairedMesh result;
  result.mesh = state.mesh();
  result.vertex_origin = std::move(state.vertex_origin);
  result.face_origin = std::move(state.face_origin);
  result.actions = std::move(state.actions);
  result.parts = std::move(state.parts);
  result.handles = std::move(state.handles);
  result.shortest_handle_left = state.shortest_handle_left;
  result.largest_hole_left = state.largest_hole_left;
  if (state.has_fillers()) result.fillers = std::move(state.fillers);
  result.inspection = std::move(inspection);
  for (const auto& corners : state.corner_origin) {
    for (const int like : corners) {
      const int corner = static_cast<int>(result.corner_origin.size());
      if (like < 0) result.blended.push_back({corner, state.blend_at(like).between});
      result.corner_origin.push_back(like < 0 ? state.blend_at(like).like : like);
    }
  }
  for (Vertex v = 0; v < static_cast<Vertex>(result.vertex_origin.size()); ++v) {
    if (result.vertex_origin[v] < 0) result.created.push_back({v, std::move(state.mean_of[v])});
  }
  std::stable_sort(result.actions.begin(), result.actions.end(),
                   [](const RepairAction& x, const RepairAction& y) { return x.kind < y.kind; });
  for (RepairAction& action : result.actions) {
    action.message = describe(action);
    if (action.kind == RepairKind::ComponentDropped)
      action.message = with_cavities(action, state.cavities);
  }
  return result;
}

}  // namespace

RepairedMesh repair_mesh(const TriangleMesh& mesh, const RepairOptions& options) {
  require_at_least("component", options.component, 0);
  require_between("least_kept", options.least_kept, 0, 1);
  require_at_least("largest_hole", options.largest_hole, 3);
  require_one_of("handle_choice", options.handle_choice, HandleChoice::Area);
  require_at_least("longest_handle", options.longest_handle, 0);
  require_at_least("longest_handle_length", options.longest_handle_length, 0);
  require_at_least("edge_share", options.edge_share, 0);
  require_at_least("edge_length", options.edge_length, 0);
  require_at_least("weld_share", options.weld_share, -1);
  require_at_least("weld_length", options.weld_length, -1);
  require_numbered(mesh.face_count(), mesh.vertex_count());
  RepairState state(mesh);
  MeshInspection inspection = inspect_mesh(mesh);
  if (counts_from_one(mesh)) return as_result(std::move(state), std::move(inspection));
  if (options.non_finite && !mesh.positions.allFinite()) {
    remove_non_finite(state);
    inspection = inspect_mesh(state.mesh());
  }
  if (!state.is_finite()) return as_result(std::move(state), std::move(inspection));
  for (int round = 0; round < most_rounds; ++round) {
    const bool first = round == 0;
    const bool other_component = first && options.components && options.component > 1;
    if (inspection.defects.empty() && !other_component) break;
    if (!options.duplicates && !all_indices_inside(state)) break;
    const long done_before = state.log_size();
    run_round(state, options, first);
    if (state.log_size() > done_before) inspection = inspect_mesh(state.mesh());
    if (options.orientation && turn_outward(state, inspection)) {
      inspection = inspect_mesh(state.mesh());
    }
    if (state.log_size() == done_before || is_given_up(state, options)) break;
  }
  if (halve_wanted(state, options)) inspection = inspect_mesh(state.mesh());
  RepairedMesh result = as_result(std::move(state), std::move(inspection));
  tell_absent_vertices(result, mesh);
  return result;
}

}  // namespace sphparam
