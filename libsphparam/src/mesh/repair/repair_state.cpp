#include "mesh/repair/repair_state.h"

#include <algorithm>
#include <cmath>

#include "mesh/box.h"

// Vertices and faces are renumbered in place, everything that belongs to them alike. Decisions look
// at coordinates in the unit box, so that squares neither overflow nor vanish.

namespace sphparam {
namespace {

constexpr size_t listed = 10;  // places kept of an action

/// Whether faces name it, per vertex.
std::vector<char> used_vertices(const RepairState& state) {
  std::vector<char> used(state.positions.size(), 0);
  for (const auto& face : state.faces) {
    for (const Vertex v : face)
      if (v >= 0 && v < state.vertex_count()) used[v] = 1;
  }
  return used;
}

template <class Value>
void keep(std::vector<Value>& values, const std::vector<char>& kept) {
  size_t to = 0;
  for (size_t from = 0; from < values.size(); ++from) {
    if (!kept[from]) continue;
    if (to != from) values[to] = std::move(values[from]);
    ++to;
  }
  values.erase(values.begin() + static_cast<std::ptrdiff_t>(to), values.end());
}

double total_weight(const std::vector<WeighedVertex>& vertices) {
  double total = 0;
  for (const auto& [vertex, weight] : vertices) total += weight;
  return total;
}

/// Each once, in ascending order.
void merge_same(std::vector<WeighedVertex>& vertices) {
  std::ranges::stable_sort(vertices, {}, &WeighedVertex::vertex);
  size_t last = 0;
  for (size_t i = 1; i < vertices.size(); ++i) {
    if (vertices[i].vertex == vertices[last].vertex)
      vertices[last].weight += vertices[i].weight;
    else
      vertices[++last] = vertices[i];
  }
  vertices.resize(last + 1);
}

/// What these are means of, each as heavy as the others: weights stay whole numbers where what is
/// halved again and again is asked, so that nothing is lost by rounding.
std::vector<WeighedVertex> origins_of(const RepairState& state,
                                      const std::vector<Vertex>& parents) {
  double heaviest = 1;
  for (const Vertex v : parents) heaviest = std::max(heaviest, total_weight(state.mean_of[v]));
  std::vector<WeighedVertex> origins;
  for (const Vertex v : parents) {
    if (state.vertex_origin[v] >= 0) origins.push_back({state.vertex_origin[v], heaviest});
    const double times = heaviest / total_weight(state.mean_of[v]);
    for (const auto& [vertex, weight] : state.mean_of[v])
      origins.push_back({vertex, times * weight});
  }
  if (heaviest > 1) merge_same(origins);
  return origins;
}

/// Where a corner lies in its face of the input.
SurfacePoint place_of(const RepairState& state, int corner_like) {
  if (corner_like < 0) return state.blend_at(corner_like).between;
  return {corner_like / 3, Vector3::Unit(corner_like % 3)};
}

}  // namespace

RepairState::RepairState(const TriangleMesh& mesh) {
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
    positions.emplace_back(mesh.positions.row(v));
    vertex_origin.push_back(static_cast<Vertex>(v));
  }
  mean_of.resize(positions.size());
  for (int f = 0; f < static_cast<int>(mesh.face_count()); ++f) {
    faces.push_back({mesh.triangles(f, 0), mesh.triangles(f, 1), mesh.triangles(f, 2)});
    face_origin.push_back(f);
    corner_origin.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  }
  fillers.assign(faces.size(), 0);
  measure();
}

void RepairState::log(RepairKind kind, std::initializer_list<int> input_ids) {
  auto action = std::find_if(actions.begin(), actions.end(),
                             [&](const RepairAction& known) { return known.kind == kind; });
  if (action == actions.end()) action = actions.insert(action, {kind, 0, {}, {}});
  ++action->count;
  if (action->elements.size() + input_ids.size() <= listed * input_ids.size()) {
    action->elements.insert(action->elements.end(), input_ids);
  }
}

long RepairState::log_size() const {
  long total = 0;
  for (const RepairAction& action : actions) total += action.count;
  return total;
}

Vertex RepairState::copy_vertex(Vertex v) {
  positions.push_back(Vector3(positions[v]));
  shape.push_back(Vector3(shape[v]));
  vertex_origin.push_back(vertex_origin[v]);
  mean_of.push_back(std::vector<WeighedVertex>(mean_of[v]));
  return vertex_count() - 1;
}

Vertex RepairState::create_mean(const std::vector<Vertex>& parents) {
  Vector3 position = Vector3::Zero(), place = Vector3::Zero();
  const double share = 1.0 / static_cast<double>(parents.size());
  for (const Vertex v : parents) {
    position += share * positions[v];
    place += share * shape[v];
  }
  std::vector<WeighedVertex> origins = origins_of(*this, parents);
  positions.push_back(position);
  shape.push_back(place);
  vertex_origin.push_back(-1);
  mean_of.push_back(std::move(origins));
  return vertex_count() - 1;
}

void RepairState::add_face(const std::array<Vertex, 3>& vertices,
                           const std::array<int, 3>& corners_like) {
  faces.push_back(vertices);
  face_origin.push_back(-1);
  corner_origin.push_back(corners_like);
  fillers.push_back(0);
}

int RepairState::blend(int first, int second, double share) {
  const SurfacePoint a = place_of(*this, first), b = place_of(*this, second);
  const int nearer = share <= 0.5 ? first : second;
  if (a.face != b.face) return nearer;
  const int like = nearer < 0 ? blend_at(nearer).like : nearer;
  blends.push_back({like, {a.face, (1 - share) * a.barycentric + share * b.barycentric}});
  return -static_cast<int>(blends.size());
}

void RepairState::turn_over(Face f) {
  std::swap(faces[f][1], faces[f][2]);
  std::swap(corner_origin[f][1], corner_origin[f][2]);
}

void RepairState::keep_faces(const std::vector<char>& kept) {
  keep(faces, kept);
  keep(face_origin, kept);
  keep(corner_origin, kept);
  keep(fillers, kept);
}

bool RepairState::has_fillers() const {
  return std::find(fillers.begin(), fillers.end(), 1) != fillers.end();
}

void RepairState::keep_vertices(const std::vector<char>& kept) {
  std::vector<Vertex> name(positions.size(), -1);
  Vertex next = 0;
  for (size_t v = 0; v < kept.size(); ++v) {
    if (kept[v]) name[v] = next++;
  }
  keep(positions, kept);
  keep(shape, kept);
  keep(vertex_origin, kept);
  keep(mean_of, kept);
  // Faces may name vertices that are not there: these stay so.
  const auto count = static_cast<Vertex>(name.size());
  for (auto& face : faces) {
    for (Vertex& v : face) v = v >= 0 && v < count ? name[v] : -1;
  }
}

void RepairState::drop_unused_vertices() { keep_vertices(used_vertices(*this)); }

void RepairState::measure() {
  const Box box = surface_box(mesh());
  const Vector3 centre = box.lower / 2 + box.upper / 2;
  const double extent = (box.upper / 2 - box.lower / 2).maxCoeff();
  scale = extent > 0 && std::isfinite(extent) ? extent : 1;
  shape.clear();
  shape.reserve(positions.size());
  for (const Vector3& p : positions) shape.push_back((p - centre) / scale);
}

double RepairState::diagonal() const {
  Box box;
  for (const auto& face : faces) {
    for (const Vertex v : face) box.add(shape[v]);
  }
  return faces.empty() ? 0 : (box.upper - box.lower).norm();
}

bool RepairState::is_finite() const {
  return std::all_of(positions.begin(), positions.end(),
                     [](const Vector3& p) { return p.allFinite(); });
}

Triangles RepairState::triangles() const {
  Triangles triangles(face_count(), 3);
  for (Face f = 0; f < face_count(); ++f) {
    triangles.row(f) << faces[f][0], faces[f][1], faces[f][2];
  }
  return triangles;
}

TriangleMesh RepairState::mesh() const {
  TriangleMesh mesh{Points(vertex_count(), 3), triangles()};
  for (Vertex v = 0; v < vertex_count(); ++v) mesh.positions.row(v) = positions[v];
  return mesh;
}

}  // namespace sphparam
