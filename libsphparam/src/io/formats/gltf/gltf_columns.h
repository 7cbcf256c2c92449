#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// The numbers of vertices, as they come primitive by primitive: one that lacks a property leaves a
/// gap, which is white and opaque in colours and 0 elsewhere.
class GltfColumns {
 public:
  /// On their way to the corners, for no vertex property is what would take part in welding, and be
  /// written. No attribute of a file has a name with a blank.
  static const std::string second_texcoord[2], tangent[4];

  /// Values of a property, those of the vertices `before`, `before` + 1, ….
  void append(const std::string& property, ScalarType type, std::size_t before,
              const std::vector<double>& values);

  /// Gives the file its vertex properties and tables of corners, and notes what has gaps.
  /// Requires: its mesh is complete. To be called once.
  void finish(MeshFile& file);

 private:
  struct Column {
    ScalarType type = ScalarType::Float32;
    double gap = 0;
    std::vector<double> values = {};
    std::size_t written = 0;
  };
  void finish_column(const std::string& name, MeshFile& file);
  template <class Table>
  void fill(Table& table, const std::string* names, const MeshFile& file) const;

  std::map<std::string, Column> columns_;
  std::vector<std::string> order_;  // as first seen
};

}  // namespace sphparam
