#include "sphparam/io/file_numbers.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include "mesh/defect_places.h"

// Renumbered meshes carry the old numbers as a vertex property; sorted, it answers both ways.

namespace sphparam {

namespace {

constexpr std::string_view count_prefix = "source_vertices ";

/// 0 where no comment says it.
long said_count(const MeshFile& file) {
  for (std::string_view comment : file.comments) {
    if (!says_vertices_of_file(comment)) continue;
    comment.remove_prefix(count_prefix.size());
    long count = 0;
    const char* const end = comment.data() + comment.size();
    return std::from_chars(comment.data(), end, count).ptr == end ? count : 0;
  }
  return 0;
}

/// None where there is no such property, or one of that name for something else.
std::vector<double> ids_in(const Property* property) {
  const auto is_id = [](double value) { return holds_exactly(ScalarType::Int32, value); };
  if (!property || !std::ranges::all_of(property->values, is_id)) return {};
  return property->values;
}

}  // namespace

Eigen::Index vertices_of_file(const MeshFile& file) {
  const Property* const numbers = file.find_vertex_property("source_vertex");
  if (!numbers) return file.mesh.vertex_count();
  const long count = said_count(file);
  const bool can_be = count <= std::numeric_limits<Vertex>::max() &&
                      std::ranges::all_of(numbers->values, [&](double number) {
                        return number < static_cast<double>(count);
                      });
  return can_be ? std::max(count, 0L) : 0;
}

void keep_vertices_of_file(MeshFile& file, Eigen::Index count) {
  forget_vertices_of_file(file);
  file.comments.push_back(std::string(count_prefix) + std::to_string(count));
}

void forget_vertices_of_file(MeshFile& file) {
  std::erase_if(file.comments, says_vertices_of_file);
}

bool says_vertices_of_file(std::string_view comment) { return comment.starts_with(count_prefix); }

FileNumbers::FileNumbers(const MeshFile& file)
    : vertices_(static_cast<Vertex>(file.mesh.vertex_count())),
      numbers_(ids_in(file.find_vertex_property("source_vertex"))),
      face_numbers_(ids_in(file.find_face_property("source_face"))) {
  if (numbers_.empty()) return;
  by_number_.reserve(numbers_.size());
  for (Vertex v = 0; v < vertices_; ++v) {
    by_number_.emplace_back(numbers_[static_cast<size_t>(v)], v);
  }
  std::sort(by_number_.begin(), by_number_.end());
}

bool has_other_numbers(const MeshFile& file) {
  if (file.format == "ICQ") return false;
  const std::vector<double> numbers = ids_in(file.find_vertex_property("source_vertex"));
  for (size_t v = 0; v < numbers.size(); ++v)
    if (numbers[v] != static_cast<double>(v)) return true;
  return false;
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

long FileNumbers::face_number(Face face) const {
  return face_numbers_.empty() ? face : static_cast<long>(face_numbers_[static_cast<size_t>(face)]);
}

std::string FileNumbers::absence(long number) const {
  return "the mesh has no vertex " + std::to_string(number) +
         (numbers_.empty() ? "; they are 0 to " + std::to_string(vertices_ - 1)
                           : " (it was merged with another, or no face used it)");
}

std::vector<MeshDefect> by_file_numbers(std::vector<MeshDefect> defects,
                                        const FileNumbers& numbers) {
  for (MeshDefect& defect : defects)
    defect = renumbered(
        std::move(defect), [&](Vertex v) { return numbers.number(v); },
        [&](Face f) { return numbers.face_number(f); });
  return defects;
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
