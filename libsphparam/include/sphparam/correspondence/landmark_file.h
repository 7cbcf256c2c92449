#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sphparam/correspondence/match.h"
#include "sphparam/io/vertex_place.h"

namespace sphparam {

/// Landmarks of `match --landmarks FILE`, a pair a line: the vertex of the first mesh and that of
/// the second, by their numbers in the meshes' files, or, in six numbers, a point of the first and
/// one of the second, in their coordinates, for the vertices nearest to them. `#` starts a comment;
/// empty lines are skipped. The file can be read before the meshes, which may take minutes to map.
class LandmarkFile {
 public:
  /// Throws: ReadError with the line, also where there is no pair.
  explicit LandmarkFile(const std::string& path);
  /// The same from text in memory; `name` is for messages.
  LandmarkFile(std::string_view text, const std::string& name);

  struct Found {
    std::vector<LandmarkPair> pairs;
    SnappedPoints snapped = {};
  };
  /// Ensures: vertices of the meshes, none twice on either side. Throws: ReadError with the line.
  Found pairs(const MeshFile& from, const MeshFile& to) const;

 private:
  struct Line {
    VertexPlace first, second;
    long number;
  };
  void parse(std::string_view text, const std::string& name);

  std::string name_;
  std::vector<Line> lines_;
};

}  // namespace sphparam
