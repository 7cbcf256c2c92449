#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "render/heat.h"
#include "render/render.h"
#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// How the numbers of a property become colours: by the table that names them, else by a scale.
struct ValueColours {
  bool names = false;  // they are labels, which have no mean, and neither have their colours
  std::map<double, Rgb> table = {};               // of labels
  std::optional<HeatScale> scale = std::nullopt;  // none: the table has them

  /// Grey for what is missing, or not in the table.
  Rgb of(double value) const;
};

/// Labels have the colours of their table, whether it came with the property (`attach_data`) or
/// with the surface ("gifti label"). What is measured goes from dark to yellow between the 2nd and
/// the 98th percentile, from blue by white to red where that range has 0 inside; a few vertices
/// that stand out would leave one colour for all others; or over a range that is given. The scale
/// says whether values lie beyond. Labels without a table, as whole numbers of files are, have a
/// scale from the least to the greatest. Requires: the property is there. Cost: O(#V), expected.
ValueColours vertex_value_colours(const MeshFile& file, const std::string& property,
                                  const std::optional<std::pair<double, double>>& range = {});

/// The same of a property of faces. Requires: it is there. Cost: O(#F), expected.
ValueColours face_value_colours(const MeshFile& file, const std::string& property,
                                const std::optional<std::pair<double, double>>& range = {});

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

/// The colours of all vertices, those of labels never mixed between them. Requires, cost: as
/// `vertex_value_colours`.
ValuePaint value_paint(const MeshFile& file, const std::string& property,
                       const std::optional<std::pair<double, double>>& range = {});

/// The colours of all faces. Requires, cost: as `face_value_colours`.
FaceValuePaint face_value_paint(const MeshFile& file, const std::string& property,
                                const std::optional<std::pair<double, double>>& range = {});

}  // namespace sphparam
