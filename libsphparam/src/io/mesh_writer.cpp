#include "sphparam/io/mesh_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "io/formats/ply_reader.h"
#include "io/files/text_buffer.h"

// PLY: the size of every record is known beforehand, so the buffer is made once and filled column
// by column. OFF: one line a vertex, one a face. OBJ is in obj_writer.cpp.

namespace sphparam {
namespace {

constexpr int kCorners = 3;

// --- PLY ---

/// Numbers of one record that stand in a row, in their type on disk; lists have a count in front.
struct PlyColumn {
  std::string declaration;  // "property float x"
  ScalarType type;
  const double* values = nullptr;
  Eigen::Index width = 1;   // numbers a record
  Eigen::Index stride = 1;  // from record to record in `values`
  bool is_list = false;     // with a count of one byte

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
      for (Eigen::Index k = 0; k < column.width; ++k, to += sizeof(T))
        store_little_endian(to, static_cast<T>(values[i * column.stride + k]));
    }
  });
}

PlyColumn scalar_column(const Property& property) {
  const auto count = static_cast<Eigen::Index>(property.values.size());
  const ScalarType type = lossless_type(property.type, property.values.data(), count);
  return {"property " + std::string(ply_name(type)) + " " + one_line(property.name), type,
          property.values.data()};
}

std::vector<PlyColumn> vertex_columns(const MeshFile& file) {
  const Points& positions = file.mesh.positions;
  const ScalarType type = lossless_type(file.position_type, positions.data(), positions.size());
  std::vector<PlyColumn> columns;
  for (int axis = 0; axis < 3; ++axis)
    columns.push_back({"property " + std::string(ply_name(type)) + " " + "xyz"[axis], type,
                       positions.size() > 0 ? positions.data() + axis : nullptr, 1, 3});
  for (const Property& property : file.vertex_properties)
    columns.push_back(scalar_column(property));
  return columns;
}

template <class Table>
PlyColumn corner_column(const char* name, ScalarType declared, const Table& table) {
  const ScalarType type = lossless_type(declared, table.data(), table.size());
  const Eigen::Index width = kCorners * table.cols();
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
                                     nullptr, kCorners, kCorners, true}};
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

std::string ply_header(const MeshFile& file, const std::vector<PlyColumn>& vertices,
                       const std::vector<PlyColumn>& faces) {
  std::string header = "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& comment : file.comments) {
    // A comment of another format that looks like the name of a material must not become one.
    header += comment.starts_with(kMaterialComment) ? "comment  " : "comment ";
    header += one_line(comment) + "\n";
  }
  for (const std::string& material : file.materials)
    header += "comment " + std::string(kMaterialComment) + one_line(material) + "\n";
  const auto declare = [&](const char* name, Eigen::Index count,
                           const std::vector<PlyColumn>& columns) {
    header += std::string("element ") + name + " " + std::to_string(count) + "\n";
    for (const PlyColumn& column : columns) header += column.declaration + "\n";
  };
  declare("vertex", file.mesh.vertex_count(), vertices);
  declare("face", file.mesh.face_count(), faces);
  return header + "end_header\n";
}

// --- OFF ---

std::vector<const Property*> find_colours(const std::vector<Property>& properties) {
  std::vector<const Property*> colours =
      find_all(properties, std::array{"red", "green", "blue", "alpha"});
  return colours.empty() ? find_all(properties, std::array{"red", "green", "blue"}) : colours;
}

/// Bytes stay whole numbers; fractions get a point, which is what tells them apart in OFF.
void put_off_colour(TextBuffer& text, const Property& colour, Eigen::Index row) {
  const double value = colour.values[row];
  if (colour.type == ScalarType::Uint8 && value == std::rint(value)) {
    text << ' ' << static_cast<int>(value);
    return;
  }
  char digits[32];
  const auto [stop, error] =
      std::to_chars(digits, digits + sizeof digits, static_cast<float>(value));
  const std::string_view number(digits, static_cast<std::size_t>(stop - digits));
  text << ' ' << number;
  if (number.find_first_of(".e") == std::string_view::npos) text << ".0";
}

}  // namespace

ScalarType lossless_type(ScalarType declared, const double* values, Eigen::Index count) {
  if (declared == ScalarType::Float64) return declared;
  const bool exact = std::all_of(values, values + count,
                                 [=](double value) { return holds_exactly(declared, value); });
  return exact ? declared : ScalarType::Float64;
}

std::string serialise_ply(const MeshFile& file) {
  const std::vector<PlyColumn> vertices = vertex_columns(file);
  const std::vector<PlyColumn> faces = face_columns(file);
  const Eigen::Index vertex_count = file.mesh.vertex_count();
  const Eigen::Index face_count = file.mesh.face_count();
  std::string bytes = ply_header(file, vertices, faces);
  const std::size_t header_bytes = bytes.size();
  const std::size_t vertex_bytes = record_bytes(vertices), face_bytes = record_bytes(faces);
  bytes.resize(header_bytes + vertex_bytes * static_cast<std::size_t>(vertex_count) +
               face_bytes * static_cast<std::size_t>(face_count));

  char* at = bytes.data() + header_bytes;
  for (const PlyColumn& column : vertices) {
    fill(at, vertex_bytes, vertex_count, column, column.values);
    at += column.bytes();
  }
  at = bytes.data() + header_bytes + vertex_bytes * static_cast<std::size_t>(vertex_count);
  fill(at, face_bytes, face_count, faces.front(), file.mesh.triangles.data());
  at += faces.front().bytes();
  for (std::size_t i = 1; i < faces.size(); ++i) {
    fill(at, face_bytes, face_count, faces[i], faces[i].values);
    at += faces[i].bytes();
  }
  return bytes;
}

std::string serialise_off(const MeshFile& file) {
  const auto normals = find_all(file.vertex_properties, std::array{"nx", "ny", "nz"});
  const auto texcoords = find_all(file.vertex_properties, std::array{"s", "t"});
  const auto colours = find_colours(file.vertex_properties);
  const auto face_colours = find_colours(file.face_properties);

  TextBuffer text(expected_text_bytes(file));
  text << (texcoords.empty() ? "" : "ST") << (colours.empty() ? "" : "C")
       << (normals.empty() ? "" : "N") << "OFF\n";
  put_comments(text, file);
  text << file.mesh.vertex_count() << ' ' << file.mesh.face_count() << " 0\n";
  for (Eigen::Index v = 0; v < file.mesh.vertex_count(); ++v) {
    for (int axis = 0; axis < 3; ++axis) text << (axis ? " " : "") << file.mesh.positions(v, axis);
    for (const Property* normal : normals) text << ' ' << normal->values[v];
    for (const Property* colour : colours) put_off_colour(text, *colour, v);
    for (const Property* texcoord : texcoords) text << ' ' << texcoord->values[v];
    text << '\n';
  }
  for (Eigen::Index f = 0; f < file.mesh.face_count(); ++f) {
    text << '3';
    for (int k = 0; k < kCorners; ++k) text << ' ' << file.mesh.triangles(f, k);
    for (const Property* colour : face_colours) put_off_colour(text, *colour, f);
    text << '\n';
  }
  return text.take();
}

}  // namespace sphparam
