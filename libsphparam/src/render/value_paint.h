#pragma once

#include <optional>
#include <string>
#include <utility>

#include "render/heat.h"
#include "render/render.h"
#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// A number a vertex as colours, and the scale of these where no table has them.
struct ValuePaint {
  VertexPaint paint;
  std::optional<HeatScale> scale;
};
/// The same of a number a face.
struct FaceValuePaint {
  FacePaint paint;
  std::optional<HeatScale> scale;
};

/// Labels have the colours of their table, whether it came with the property (`attach_data`) or
/// with the surface ("gifti label"), never mixed between vertices; a label without a colour is
/// grey. What is measured goes from dark to yellow between the 2nd and the 98th percentile, from
/// blue by white to red where that range has 0 inside; a few vertices that stand out would leave
/// one colour for all others; or over a range that is given. The scale says whether values lie
/// beyond. Numbers that are missing are grey. Labels without a table, as whole numbers of files
/// are, have a scale from the least to the greatest. Requires: the property is there. Cost: O(#V),
/// expected.
ValuePaint value_paint(const MeshFile& file, const std::string& property,
                       const std::optional<std::pair<double, double>>& range = {});

/// The same of a property of faces. Requires: it is there. Cost: O(#F), expected.
FaceValuePaint face_value_paint(const MeshFile& file, const std::string& property,
                                const std::optional<std::pair<double, double>>& range = {});

}  // namespace sphparam
