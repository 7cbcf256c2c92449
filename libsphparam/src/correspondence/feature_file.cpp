#include "sphparam/correspondence/feature_file.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "correspondence/feature_scales.h"
#include "number_text.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/vertex_data.h"

namespace sphparam {
namespace {

const Property* property_of(const MeshFile& mesh, const std::string& name) {
  const auto found = std::ranges::find(mesh.vertex_properties, name, &Property::name);
  return found == mesh.vertex_properties.end() ? nullptr : &*found;
}

/// What is neither a file nor a property, beside the properties that there are.
[[noreturn]] void refuse(const std::string& name, const MeshFile& mesh) {
  std::vector<std::string> names;
  for (const Property& property : mesh.vertex_properties) names.push_back(property.name);
  throw ReadError(name, "is no file, and no property of the mesh's vertices, which have " +
                            (names.empty() ? "none" : joined(names)));
}

Functions columns_of(const MeshFile& mesh, const std::vector<std::string>& names) {
  Functions columns(mesh.mesh.vertex_count(), std::ssize(names));
  for (Eigen::Index c = 0; c < columns.cols(); ++c) {
    const std::vector<double>& values = property_of(mesh, names[static_cast<size_t>(c)])->values;
    columns.col(c) = Eigen::Map<const VectorX>(values.data(), std::ssize(values));
  }
  return columns;
}

/// Whole numbers are keys, which are carried by the nearest and never averaged.
void require_measure(const Property& property) {
  if (is_floating(property.type)) return;
  throw ReadError(property.name, "is of whole numbers (" + std::string(ply_name(property.type)) +
                                     "), which are labels and no measure that could agree");
}

void require_varying(const std::string& name, const Functions& columns) {
  for (Eigen::Index c = 0; c < columns.cols(); ++c) {
    if (varies(columns.col(c))) continue;
    throw ReadError(name, (columns.cols() > 1 ? "column " + std::to_string(c + 1) + " " : "") +
                              "has no two different numbers: there is nothing that could agree");
  }
}

Functions beside(const Functions& left, const Functions& right) {
  if (left.size() == 0) return right;
  Functions both(left.rows(), left.cols() + right.cols());
  both << left, right;
  return both;
}

}  // namespace

Functions read_features(const std::string& file_or_property, const MeshFile& mesh,
                        const ReadOptions& options) {
  std::error_code error;  // a name that is too long is no file's
  if (!std::filesystem::exists(file_or_property, error)) {
    if (const Property* const property = property_of(mesh, file_or_property)) {
      require_measure(*property);
      return columns_of(mesh, {file_or_property});
    }
    if (!error && !is_stream(file_or_property)) refuse(file_or_property, mesh);
  }
  const VertexData data = read_vertex_data(file_or_property, vertices_of_file(mesh), options);
  if (data.kind == DataKind::Labels)
    throw ReadError(file_or_property, "labels are no measure that could agree: numbers are needed");
  MeshFile with_data = mesh;
  try {
    return columns_of(with_data, attach_data(with_data, data));
  } catch (const std::invalid_argument& error) {
    throw ReadError(file_or_property, error.what());
  }
}

MatchFeatures read_features(const std::vector<std::string>& pairs, const MeshFile& from,
                            const MeshFile& to, const ReadOptions& options) {
  if (pairs.size() % 2 != 0)
    throw std::invalid_argument("features: pairs of names are needed, of one mesh and the other");
  MatchFeatures features;
  for (size_t i = 0; i < pairs.size(); i += 2) {
    const Functions one = read_features(pairs[i], from, options);
    const Functions other = read_features(pairs[i + 1], to, options);
    require_varying(pairs[i], one);
    require_varying(pairs[i + 1], other);
    if (one.cols() != other.cols())
      throw ReadError(pairs[i + 1], "has " + counted(other.cols(), "column", "columns") + ", and " +
                                        pairs[i] + " has " + std::to_string(one.cols()));
    features.from = beside(features.from, one);
    features.to = beside(features.to, other);
  }
  return features;
}

}  // namespace sphparam
