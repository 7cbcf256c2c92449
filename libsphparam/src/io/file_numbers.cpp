#include "sphparam/io/file_numbers.h"

#include <algorithm>

// Renumbered meshes carry the old numbers as a vertex property; sorted, it answers both ways.

namespace sphparam {

FileNumbers::FileNumbers(const MeshFile& file)
    : vertices_(static_cast<Vertex>(file.mesh.vertex_count())) {
  const Property* property = file.find_vertex_property("source_vertex");
  const auto is_id = [](double value) { return holds_exactly(ScalarType::Int32, value); };
  // A file may have a property of that name for something else.
  if (!property || !std::all_of(property->values.begin(), property->values.end(), is_id)) return;
  numbers_ = property->values;
  by_number_.reserve(numbers_.size());
  for (Vertex v = 0; v < vertices_; ++v) {
    by_number_.emplace_back(numbers_[static_cast<size_t>(v)], v);
  }
  std::sort(by_number_.begin(), by_number_.end());
}

Vertex FileNumbers::vertex(long number) const {
  if (numbers_.empty()) {
    return number >= 0 && number < vertices_ ? static_cast<Vertex>(number) : -1;
  }
  if (number < 0) return -1;  // what repair has created is numbered −1
  const std::pair<double, Vertex> wanted(static_cast<double>(number), 0);
  const auto found = std::lower_bound(by_number_.begin(), by_number_.end(), wanted);
  const bool there = found != by_number_.end() && found->first == wanted.first;
  return there ? found->second : -1;
}

long FileNumbers::number(Vertex vertex) const {
  return numbers_.empty() ? vertex : static_cast<long>(numbers_[static_cast<size_t>(vertex)]);
}

std::string FileNumbers::absence(long number) const {
  return "the mesh has no vertex " + std::to_string(number) +
         (numbers_.empty() ? "; they are 0 to " + std::to_string(vertices_ - 1)
                           : " (it was merged with another, or no face used it)");
}

ParameterizeOptions with_vertices_of_mesh(ParameterizeOptions options, const FileNumbers& numbers) {
  const auto settle = [&](const char* whose, Vertex& vertex) {
    const Vertex found = numbers.vertex(vertex);
    if (found < 0) throw NoSuchVertex(whose, numbers.absence(vertex));
    vertex = found;
  };
  if (options.poles) {
    auto& [north, south] = *options.poles;
    settle("poles", north);
    settle("poles", south);
    if (north == south)
      throw NoSuchVertex("poles", "the two are one vertex, welded where positions agree");
  }
  if (options.meridian) settle("meridian", *options.meridian);
  return options;
}

}  // namespace sphparam
