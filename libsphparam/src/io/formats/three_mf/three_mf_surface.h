#pragma once

#include <string>
#include <vector>

#include "io/formats/three_mf/three_mf_colours.h"
#include "io/formats/three_mf/three_mf_model.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

/// The triangles of objects where they are placed, put together.
class ThreeMfSurface {
 public:
  /// Requires: `name` and `options` outlive it.
  ThreeMfSurface(const std::string& name, const ReadOptions& options)
      : name_(name), options_(options) {}

  /// The triangles of an object; a place that mirrors turns them about. `item`: of the build.
  /// Throws: ReadError beyond the limits, and as `ThreeMfColours::add`.
  void append(const ThreeMfObject& object, const ThreeMfGroups& groups, const ThreeMfPlace& place,
              int item);

  /// As a mesh; where there are several items, with property `object` of faces.
  void attach_to(MeshFile& file) const;

 private:
  void require_room(std::size_t vertices, std::size_t triangles) const;

  const std::string& name_;
  const ReadOptions& options_;
  std::vector<double> positions_;
  std::vector<int> triangles_;
  std::vector<int> item_of_;  // a triangle
  ThreeMfColours colours_;
};

}  // namespace sphparam
