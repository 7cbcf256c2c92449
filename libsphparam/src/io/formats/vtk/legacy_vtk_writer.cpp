#include "io/formats/vtk/legacy_vtk_writer.h"

#include <cctype>
#include <cstdint>

#include "io/files/byte_reader.h"
#include "io/formats/vtk/vtk_surface.h"

// Numbers are big-endian. Normals and texture coordinates have keywords of their own, by which
// viewers know them; arrays between them go into blocks FIELD, so that all keep their order.

namespace sphparam {
namespace {

const char* vtk_name(ScalarType type) {
  switch (type) {
    case ScalarType::Int8:
      return "char";
    case ScalarType::Uint8:
      return "unsigned_char";
    case ScalarType::Int16:
      return "short";
    case ScalarType::Uint16:
      return "unsigned_short";
    case ScalarType::Int32:
      return "int";
    case ScalarType::Uint32:
      return "unsigned_int";
    case ScalarType::Int64:
      return "vtktypeint64";
    case ScalarType::Float32:
      return "float";
    case ScalarType::Float64:
      break;
  }
  return "double";
}

/// A name as one word: what could end it or mean something else is written in hexadecimal.
std::string encoded(const std::string& name) {
  constexpr char hexadecimal[] = "0123456789ABCDEF";
  std::string text;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80 && std::isgraph(byte) && c != '%' && c != '"') {
      text += c;
    } else {
      text += {'%', hexadecimal[byte >> 4], hexadecimal[byte & 15]};
    }
  }
  return text;
}

void put_number(std::string& bytes, ScalarType type, double value) {
  with_scalar(type, [&](auto scalar) {
    append_number(bytes, static_cast<decltype(scalar)>(value), std::endian::big);
  });
}

void put_values(std::string& bytes, const VtkArray& array) {
  bytes.reserve(bytes.size() + array.values.size() * size_in_bytes(array.type) + 1);
  for (const double value : array.values) put_number(bytes, array.type, value);
  bytes += '\n';
}

/// The length in front of a string, in as few bytes as hold it; the top bits say how many.
void put_string(std::string& bytes, const std::string& text) {
  const std::size_t length = text.size();
  if (length < 64)
    append_number(bytes, static_cast<std::uint8_t>(3u << 6 | length), std::endian::big);
  else if (length < 16384)
    append_number(bytes, static_cast<std::uint16_t>(2u << 14 | length), std::endian::big);
  else
    append_number(bytes, static_cast<std::uint32_t>(1u << 30 | length), std::endian::big);
  bytes += text;
}

void put_strings(std::string& bytes, const char* name, const std::vector<std::string>& texts) {
  bytes += std::string(name) + " 1 " + std::to_string(texts.size()) + " string\n";
  for (const std::string& text : texts) put_string(bytes, one_line(text));
  bytes += '\n';
}

void put_field_data(std::string& bytes, const MeshFile& file) {
  const int arrays = !file.comments.empty() + !file.materials.empty();
  if (arrays == 0) return;
  bytes += "FIELD FieldData " + std::to_string(arrays) + "\n";
  if (!file.comments.empty()) put_strings(bytes, "comments", file.comments);
  if (!file.materials.empty()) put_strings(bytes, "materials", file.materials);
}

void put_points(std::string& bytes, const MeshFile& file) {
  const ScalarType type = point_type(file);
  bytes += "POINTS " + std::to_string(file.mesh.vertex_count()) + " " + vtk_name(type) + "\n";
  for (Eigen::Index i = 0; i < file.mesh.positions.size(); ++i)
    put_number(bytes, type, file.mesh.positions.data()[i]);
  bytes += '\n';
}

void put_polygons(std::string& bytes, const Polygons& polygons) {
  const std::int64_t numbers = polygons.count() + std::ssize(polygons.corners);
  bytes += "POLYGONS " + std::to_string(polygons.count()) + " " + std::to_string(numbers) + "\n";
  for (std::int64_t p = 0; p < polygons.count(); ++p) {
    append_number(bytes, std::int32_t{polygons.degree(p)}, std::endian::big);
    for (const int v : polygons.polygon(p)) append_number(bytes, std::int32_t{v}, std::endian::big);
  }
  bytes += '\n';
}

bool goes_into_field(const VtkArray& array) {
  return array.role == VtkRole::Plain || array.role == VtkRole::Colours;
}

void put_arrays(std::string& bytes, const char* keyword, std::int64_t count,
                const std::vector<VtkArray>& arrays) {
  if (arrays.empty()) return;
  bytes += std::string(keyword) + " " + std::to_string(count) + "\n";
  for (std::size_t i = 0; i < arrays.size();) {
    const VtkArray& array = arrays[i];
    if (!goes_into_field(array)) {
      const bool normals = array.role == VtkRole::Normals;
      bytes += (normals ? "NORMALS " : "TEXTURE_COORDINATES ") + encoded(array.name) + " " +
               (normals ? "" : std::to_string(array.width) + " ") + vtk_name(array.type) + "\n";
      put_values(bytes, array);
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < arrays.size() && goes_into_field(arrays[end])) ++end;
    bytes += "FIELD FieldData " + std::to_string(end - i) + "\n";
    for (; i < end; ++i) {
      bytes += encoded(arrays[i].name) + " " + std::to_string(arrays[i].width) + " " +
               std::to_string(count) + " " + vtk_name(arrays[i].type) + "\n";
      put_values(bytes, arrays[i]);
    }
  }
}

}  // namespace

std::string serialise_legacy_vtk(const MeshFile& file, const WriteOptions& options) {
  std::string bytes = "# vtk DataFile Version 4.2\nwritten by sphparam\nBINARY\nDATASET POLYDATA\n";
  put_field_data(bytes, file);
  put_points(bytes, file);
  const VtkFaces faces = vtk_faces(file, options);
  put_polygons(bytes, faces.polygons);
  put_arrays(bytes, "POINT_DATA", file.mesh.vertex_count(), vtk_arrays(file.vertex_properties));
  put_arrays(bytes, "CELL_DATA", faces.polygons.count(), faces.arrays);
  return bytes;
}

}  // namespace sphparam
