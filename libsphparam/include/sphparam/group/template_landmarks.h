#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sphparam/io/vertex_place.h"

namespace sphparam {

/// A vertex of a template that is to be found on all shapes.
struct TemplateLandmark {
  std::string name;
  Vertex vertex;
  std::optional<double> distance = {};  // of the vertex from the point that named it
};

/// Landmarks of a file, and what is told of points among them.
struct TemplateLandmarks {
  std::vector<TemplateLandmark> landmarks;
  SnappedPoints snapped = {};
};

/// Landmarks of `group --landmarks FILE`, one a line: a vertex of the template, by its number in
/// the file, and a name, or none: then the number is its name. Three numbers before the name, one
/// of them with a point or an exponent, are a point in the template's coordinates, for the vertex
/// nearest to it. `#` starts a comment.
///
/// Ensures: vertices of the mesh, no name twice. Throws: ReadError with the line.
TemplateLandmarks read_template_landmarks(const std::string& path, const MeshFile& file);
/// The same from text in memory; `name` is for messages.
TemplateLandmarks parse_template_landmarks(std::string_view text, const std::string& name,
                                           const MeshFile& file);

}  // namespace sphparam
