#pragma once

#include <array>
#include <initializer_list>
#include <vector>

#include "mesh/repair/dropped_cavities.h"
#include "sphparam/mesh/mesh_repair.h"

namespace sphparam {

/// A mesh while it is mended: what RepairedMesh holds, in arrays that grow, and the log.
struct RepairState {
  explicit RepairState(const TriangleMesh& mesh);

  std::vector<Vector3> positions;
  /// Positions, the surface centred and scaled to a box from −1 to 1: for all decisions.
  std::vector<Vector3> shape;
  std::vector<std::array<Vertex, 3>> faces;
  std::vector<Vertex> vertex_origin;
  std::vector<Face> face_origin;
  /// Corners of the input that these are like; negative ones are of `blends`, see `blend`.
  std::vector<std::array<int, 3>> corner_origin;
  struct Blend {
    int like;
    SurfacePoint between;
  };
  std::vector<Blend> blends;
  FillerMarks fillers;                              // #F: of holes that are kept
  std::vector<std::vector<WeighedVertex>> mean_of;  // #V: of created vertices, else empty
  std::vector<RepairAction> actions;                // one a kind
  KeptParts parts;
  DroppedCavities cavities;
  std::vector<HandleLoop> handles;
  double shortest_handle_left = 0;  // found when handles were last looked for
  double scale = 1;                 // a length of `positions` is this times that of `shape`
  long largest_hole_left = 0;       // found when holes were last looked for

  bool is_finite() const;
  int vertex_count() const { return static_cast<int>(positions.size()); }
  int face_count() const { return static_cast<int>(faces.size()); }
  Vertex corner(int i) const { return faces[i / 3][i % 3]; }
  int corner_like(int i) const { return corner_origin[i / 3][i % 3]; }
  const Blend& blend_at(int corner_like) const {
    return blends[static_cast<size_t>(-1 - corner_like)];
  }

  /// Counts an action at an element: a face or vertex by its id in the input, an edge by two.
  void log(RepairKind kind, std::initializer_list<int> input_ids);
  long log_size() const;

  Vertex copy_vertex(Vertex v);
  Vertex create_mean(const std::vector<Vertex>& parents);
  void add_face(const std::array<Vertex, 3>& vertices, const std::array<int, 3>& corners_like);
  /// Between two corners that are like these, `share` of the way to the second; like the nearer one
  /// where they are of different faces of the input.
  int blend(int first, int second, double share);
  void turn_over(Face f);
  void keep_faces(const std::vector<char>& kept);
  void keep_vertices(const std::vector<char>& kept);  // no face names the others
  bool has_fillers() const;
  void drop_unused_vertices();
  void measure();           // `shape` and `scale`, of the positions there are
  double diagonal() const;  // of the box about the surface, as `shape` has it

  Triangles triangles() const;
  TriangleMesh mesh() const;
};

// The steps, each in a file of its own. They log what they do.
void remove_non_finite(RepairState& state);
void remove_invalid_faces(RepairState& state);
void remove_duplicate_faces(RepairState& state);
void close_cracks(RepairState& state, const RepairOptions& options);
void orient_alike(RepairState& state);
void split_non_manifold(RepairState& state);
void keep_component(RepairState& state, int rank, double least_kept);
void fill_holes(RepairState& state, const RepairOptions& options);
void remove_handles(RepairState& state, const RepairOptions& options);
void mend_flat_faces(RepairState& state);
void halve_long_edges(RepairState& state, const RepairOptions& options);

}  // namespace sphparam
