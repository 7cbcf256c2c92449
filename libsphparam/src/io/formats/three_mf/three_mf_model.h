#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "sphparam/io/read_options.h"

namespace sphparam {

/// A row vector (x, y, z, 1) times this is where a point goes.
using ThreeMfPlace = Eigen::Matrix<double, 4, 3>;

/// An object where something puts it: the build, or another object that it is a component of.
struct ThreeMfPart {
  std::string path;  // of the model part that has it; empty: the same
  std::int64_t object;
  ThreeMfPlace place;
};

/// Of a corner, or of a triangle: the entry `index` of the group with this number.
struct ThreeMfPaint {
  static constexpr std::int64_t none = -1;
  std::int64_t group = none;
  std::array<std::int64_t, 3> index = {0, 0, 0};  // a corner
};

struct ThreeMfObject {
  std::string name, type = "model";
  std::vector<double> positions;    // three a vertex
  std::vector<int> triangles;       // three a triangle
  std::vector<ThreeMfPaint> paint;  // one a triangle
  std::vector<ThreeMfPart> components;
};

/// Colours, with names where they are materials'.
struct ThreeMfGroup {
  bool is_material = false;
  std::vector<std::string> names;                    // as many; of colours empty
  std::vector<std::array<std::uint8_t, 4>> colours;  // sRGB and alpha
};

using ThreeMfGroups = std::map<std::int64_t, ThreeMfGroup>;

/// A model part of a 3MF file, as it stands.
struct ThreeMfModel {
  std::string unit = "millimeter";
  std::vector<std::pair<std::string, std::string>> metadata;  // of the model
  std::map<std::int64_t, ThreeMfObject> objects;
  ThreeMfGroups groups;
  std::vector<ThreeMfPart> build;
  std::map<std::string, std::int64_t> other_elements;  // that are not read, with what is in them
  std::int64_t painted_in_slicer = 0;                  // triangles
};

/// Reads the XML of a model part. Of the core specification 1.3, materials (base materials, colour
/// groups) and the paths of the production extension; elements of other extensions are counted.
/// Throws: ReadError with the line; for more vertices or triangles than `options` allow, numbers of
/// vertices that are not there, and triangles that name one twice where options do not let that
/// pass.
ThreeMfModel parse_three_mf_model(std::string_view xml, const std::string& name,
                                  const ReadOptions& options);

}  // namespace sphparam
