#include "io/formats/gltf/gltf_columns.h"

#include <algorithm>
#include <utility>

namespace sphparam {
namespace {

/// What has no COLOR_0 is white and opaque: its material is not tinted.
bool is_colour(const std::string& property) {
  return property == "red" || property == "green" || property == "blue" || property == "alpha";
}

}  // namespace

const std::string GltfColumns::second_texcoord[] = {"second s", "second t"};
const std::string GltfColumns::tangent[] = {"tangent x", "tangent y", "tangent z", "tangent w"};

void GltfColumns::append(const std::string& property, ScalarType type, std::size_t before,
                         const std::vector<double>& values) {
  const auto [found, is_new] = columns_.try_emplace(property);
  Column& column = found->second;
  if (is_new) {
    order_.push_back(property);
    column = {.type = type, .gap = is_colour(property) ? 1.0 : 0.0};
  } else if (column.type != type) {
    column.type = ScalarType::Float64;
  }
  column.values.resize(before, column.gap);
  column.values.insert(column.values.end(), values.begin(), values.end());
  column.written += values.size();
}

void GltfColumns::finish(MeshFile& file) {
  for (const std::string& name : order_) finish_column(name, file);
  fill(file.second_texcoords, second_texcoord, file);
  fill(file.corner_tangents, tangent, file);
}

void GltfColumns::finish_column(const std::string& name, MeshFile& file) {
  Column& column = columns_.at(name);
  const auto count = static_cast<std::size_t>(file.mesh.vertex_count());
  const bool of_corners =
      std::ranges::count(second_texcoord, name) + std::ranges::count(tangent, name) > 0;
  if (!of_corners && column.written < count && !is_colour(name))
    file.notes.push_back(std::to_string(count - column.written) + " vertices have no '" + name +
                         "': set to zero");
  column.values.resize(count, column.gap);
  if (!of_corners) file.vertex_properties.push_back({name, column.type, std::move(column.values)});
}

template <class Table>
void GltfColumns::fill(Table& table, const std::string* names, const MeshFile& file) const {
  if (!columns_.contains(names[0])) return;
  auto& rows = table.emplace();
  rows.resize(file.mesh.triangles.size(), rows.cols());
  for (Eigen::Index k = 0; k < rows.cols(); ++k) {
    const std::vector<double>& values = columns_.at(names[k]).values;
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
      rows(i, k) = values[static_cast<std::size_t>(file.mesh.triangles.data()[i])];
  }
}

}  // namespace sphparam
