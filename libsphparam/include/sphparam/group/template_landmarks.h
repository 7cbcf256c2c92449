#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sphparam/io/file_numbers.h"

namespace sphparam {

/// A vertex of a template that is to be found on all shapes.
struct TemplateLandmark {
  std::string name;
  Vertex vertex;
};

/// Landmarks of `group --landmarks FILE`, one a line: a vertex of the template, by its number in
/// the file, and a name, or none: then the number is its name. `#` starts a comment.
///
/// Ensures: vertices of the mesh, no name twice. Throws: ReadError with the line.
std::vector<TemplateLandmark> read_template_landmarks(const std::string& path,
                                                      const FileNumbers& numbers);
/// The same from text in memory; `name` is for messages.
std::vector<TemplateLandmark> parse_template_landmarks(std::string_view text,
                                                       const std::string& name,
                                                       const FileNumbers& numbers);

}  // namespace sphparam
