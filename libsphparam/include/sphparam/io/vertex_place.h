#pragma once

#include <memory>
#include <optional>
#include <string>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// A vertex as people name it: by its number in the mesh's file, or as that nearest to a point.
struct VertexPlace {
  long number = -1;
  std::optional<Vector3> point = {};  // in the file's coordinates; then the number says nothing
};

/// A vertex of a mesh, and how far it is from the point that named it.
struct FoundVertex {
  Vertex vertex = -1;
  std::optional<double> distance = {};  // of a point
  double share = 0;                     // the same, of the diagonal of the mesh's bounding box
};

/// The vertices of a mesh that places name.
class VertexPlaces {
 public:
  /// Requires: the file outlives it. Cost: O(#V log #V).
  explicit VertexPlaces(const MeshFile& file);
  ~VertexPlaces();

  /// Of equally near ones that of the least number; vertices that a repair added, which the file
  /// does not have, are none. Throws: std::invalid_argument that says why there is none.
  FoundVertex at(const VertexPlace& place) const;

 private:
  struct Search;
  std::unique_ptr<Search> search_;
};

/// What is told of points that became vertices.
class SnappedPoints {
 public:
  /// `where`: "line 3". Of what no point named nothing is told.
  void add(const FoundVertex& found, const std::string& where);

  /// "2 points are taken for the vertices nearest to them, at most 0.012 away (0.3 % of the
  /// diagonal; line 3)"; empty where there was no point.
  std::string words() const;

  /// Whether one is so far away, 2 % of the diagonal or more, that it may be of another mesh.
  bool is_far() const;

 private:
  long count_ = 0;
  FoundVertex farthest_;
  std::string where_;
};

}  // namespace sphparam
