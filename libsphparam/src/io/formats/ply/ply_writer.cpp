#include "io/formats/ply/ply_writer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "io/formats/lossless_type.h"
#include "io/formats/ply/ply_reader.h"

// The size of every record is known beforehand, so the buffer is made once and filled column by
// column.

namespace sphparam {
namespace {

constexpr int corner_count = 3;

/// Numbers of one record that stand in a row, in their type on disk; lists have a count in front.
struct PlyColumn {
  std::string declaration;  // "property float x"
  ScalarType type;
  const double* values = nullptr;
  Eigen::Index width = 1;   // numbers a record
  Eigen::Index stride = 1;  // from record to record in `values`
  bool is_list = false;     // with a count of one byte
  double scale = 1;         // else what values are multiplied by, and rounded

  std::size_t bytes() const {
    return (is_list ? 1 : 0) + static_cast<std::size_t>(width) * size_in_bytes(type);
  }
};

template <class T>
void store_little_endian(char* at, T value) {
  std::memcpy(at, &value, sizeof(T));
  if constexpr (std::endian::native != std::endian::little) std::reverse(at, at + sizeof(T));
}

template <class Source>
void fill(char* at, std::size_t record_bytes, Eigen::Index records, const PlyColumn& column,
          const Source* values) {
  with_scalar(column.type, [&](auto scalar) {
    using T = decltype(scalar);
    for (Eigen::Index i = 0; i < records; ++i, at += record_bytes) {
      char* to = at;
      if (column.is_list) *to++ = static_cast<char>(column.width);
      for (Eigen::Index k = 0; k < column.width; ++k, to += sizeof(T)) {
        const Source value = values[i * column.stride + k];
        if constexpr (std::is_floating_point_v<Source>)
          store_little_endian(
              to, static_cast<T>(column.scale == 1 ? value : std::nearbyint(value * column.scale)));
        else
          store_little_endian(to, static_cast<T>(value));
      }
    }
  });
}

PlyColumn scalar_column(const Property& property) {
  const auto count = static_cast<Eigen::Index>(property.values.size());
  const ScalarType type = narrow_lossless_type(property.type, property.values.data(), count);
  return {"property " + std::string(ply_name(type)) + " " + one_line(property.name), type,
          property.values.data()};
}

bool is_fraction(const Property& property) {
  return is_floating(property.type) && std::ranges::all_of(property.values, [](double value) {
           return value >= 0 && value <= 1;
         });
}

/// Colours from 0 to 1, as an OBJ has them. Other programs take floats of a PLY for 0 to 255.
bool has_fractions_for_colours(const MeshFile& file) {
  for (const char* channel : {"red", "green", "blue"}) {
    const Property* const colour = file.find_vertex_property(channel);
    if (!colour || !is_fraction(*colour)) return false;
  }
  const Property* const alpha = file.find_vertex_property("alpha");
  return !alpha || is_fraction(*alpha);
}

PlyColumn byte_column(const Property& colour) {
  constexpr double brightest = 255;
  PlyColumn column{"property uchar " + colour.name, ScalarType::Uint8, colour.values.data()};
  column.scale = brightest;
  return column;
}

bool is_colour(const std::string& name) {
  return name == "red" || name == "green" || name == "blue" || name == "alpha";
}

std::vector<PlyColumn> vertex_columns(const MeshFile& file) {
  const Points& positions = file.mesh.positions;
  const ScalarType type =
      narrow_lossless_type(file.position_type, positions.data(), positions.size());
  std::vector<PlyColumn> columns;
  for (int axis = 0; axis < 3; ++axis)
    columns.push_back({"property " + std::string(ply_name(type)) + " " + "xyz"[axis], type,
                       positions.size() > 0 ? positions.data() + axis : nullptr, 1, 3});
  const bool fractions = has_fractions_for_colours(file);
  for (const Property& property : file.vertex_properties)
    columns.push_back(fractions && is_colour(property.name) ? byte_column(property)
                                                            : scalar_column(property));
  return columns;
}

template <class Table>
PlyColumn corner_column(const char* name, ScalarType declared, const Table& table) {
  const ScalarType type = narrow_lossless_type(declared, table.data(), table.size());
  const Eigen::Index width = corner_count * table.cols();
  return {"property list uchar " + std::string(ply_name(type)) + " " + name,
          type,
          table.data(),
          width,
          width,
          true};
}

/// The columns of a face; the first one, of indices, has its values in the triangles.
std::vector<PlyColumn> face_columns(const MeshFile& file) {
  std::vector<PlyColumn> columns = {{"property list uchar int vertex_indices", ScalarType::Int32,
                                     nullptr, corner_count, corner_count, true}};
  if (file.corner_texcoords)
    columns.push_back(corner_column("texcoord", file.corner_texcoord_type, *file.corner_texcoords));
  if (file.corner_normals)
    columns.push_back(corner_column("normal", file.corner_normal_type, *file.corner_normals));
  for (const Property& property : file.face_properties) columns.push_back(scalar_column(property));
  return columns;
}

std::size_t record_bytes(const std::vector<PlyColumn>& columns) {
  std::size_t bytes = 0;
  for (const PlyColumn& column : columns) bytes += column.bytes();
  return bytes;
}

std::string declarations(const char* element, Eigen::Index count,
                         const std::vector<PlyColumn>& columns) {
  std::string text = std::string("element ") + element + " " + std::to_string(count) + "\n";
  for (const PlyColumn& column : columns) text += column.declaration + "\n";
  return text;
}

std::string comment_lines(const MeshFile& file) {
  std::string lines;
  for (const std::string& comment : file.comments) {
    // A comment of another format that looks like the name of a material must not become one.
    lines += comment.starts_with(material_comment) ? "comment  " : "comment ";
    lines += one_line(comment) + "\n";
  }
  for (const std::string& material : file.materials)
    lines += "comment " + std::string(material_comment) + one_line(material) + "\n";
  return lines;
}

}  // namespace

std::string ply_up_to_faces(const MeshFile& file, const std::string& face_declarations,
                            std::size_t face_bytes) {
  const std::vector<PlyColumn> vertices = vertex_columns(file);
  const Eigen::Index count = file.mesh.vertex_count();
  std::string bytes = "ply\nformat binary_little_endian 1.0\n" + comment_lines(file) +
                      declarations("vertex", count, vertices) + face_declarations + "end_header\n";
  const std::size_t header_bytes = bytes.size(), record = record_bytes(vertices);
  const std::size_t size = header_bytes + record * static_cast<std::size_t>(count);
  bytes.reserve(size + face_bytes);
  bytes.resize(size);
  char* at = bytes.data() + header_bytes;
  for (const PlyColumn& column : vertices) {
    fill(at, record, count, column, column.values);
    at += column.bytes();
  }
  return bytes;
}

std::string serialise_ply(const MeshFile& file) {
  const std::vector<PlyColumn> faces = face_columns(file);
  const Eigen::Index count = file.mesh.face_count();
  const std::size_t record = record_bytes(faces), size = record * static_cast<std::size_t>(count);
  std::string bytes = ply_up_to_faces(file, declarations("face", count, faces), size);
  const std::size_t start = bytes.size();
  bytes.resize(start + size);
  char* at = bytes.data() + start;
  fill(at, record, count, faces.front(), file.mesh.triangles.data());
  at += faces.front().bytes();
  for (std::size_t i = 1; i < faces.size(); ++i) {
    fill(at, record, count, faces[i], faces[i].values);
    at += faces[i].bytes();
  }
  return bytes;
}

}  // namespace sphparam
