#include "io/formats/vtk/xml_vtk_writer.h"

#include <cstdint>

#include "io/files/base64.h"
#include "io/files/byte_reader.h"
#include "io/files/gzip.h"
#include "io/formats/vtk/vtk_surface.h"

// Blocks have the size that VTK's own writers give them. Names and strings go into XML as text
// that cannot end their attribute or break the encoding.

namespace sphparam {
namespace {

constexpr std::size_t block_bytes = 32768;

const char* vtk_name(ScalarType type) {
  switch (type) {
    case ScalarType::Int8:
      return "Int8";
    case ScalarType::Uint8:
      return "UInt8";
    case ScalarType::Int16:
      return "Int16";
    case ScalarType::Uint16:
      return "UInt16";
    case ScalarType::Int32:
      return "Int32";
    case ScalarType::Uint32:
      return "UInt32";
    case ScalarType::Int64:
      return "Int64";
    case ScalarType::Float32:
      return "Float32";
    case ScalarType::Float64:
      break;
  }
  return "Float64";
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += byte < 0x20 || byte >= 0x7f ? '?' : c;
  }
  return result;
}

/// Header and blocks of compressed data, each in base64 of its own.
std::string encoded(std::string_view bytes) {
  std::string header, data;
  const std::size_t blocks = (bytes.size() + block_bytes - 1) / block_bytes;
  const auto put = [&](std::size_t number) {
    append_number(header, std::uint64_t{number}, std::endian::little);
  };
  put(blocks);
  put(block_bytes);
  put(bytes.size() % block_bytes);
  for (std::size_t i = 0; i < blocks; ++i) {
    const std::string block = packed_block(bytes.substr(i * block_bytes, block_bytes));
    put(block.size());
    data += block;
  }
  return to_base64(header) + to_base64(data);
}

void put_array(std::string& xml, const std::string& name, ScalarType type, std::int64_t width,
               const double* values, std::int64_t count) {
  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(count) * size_in_bytes(type));
  with_scalar(type, [&](auto scalar) {
    for (std::int64_t i = 0; i < count; ++i)
      append_number(bytes, static_cast<decltype(scalar)>(values[i]), std::endian::little);
  });
  xml += "<DataArray type=\"" + std::string(vtk_name(type)) + "\" Name=\"" + escaped(name) +
         "\" NumberOfComponents=\"" + std::to_string(width) + "\" format=\"binary\">\n" +
         encoded(bytes) + "\n</DataArray>\n";
}

void put_indices(std::string& xml, const std::string& name, const int* numbers,
                 std::int64_t count) {
  const std::vector<double> values(numbers, numbers + count);
  put_array(xml, name, ScalarType::Int32, 1, values.data(), count);
}

void put_arrays(std::string& xml, const std::string& element, const std::vector<VtkArray>& arrays) {
  xml += "<" + element;
  for (const VtkArray& array : arrays) {
    if (array.role == VtkRole::Normals) xml += " Normals=\"" + array.name + "\"";
    if (array.role == VtkRole::Texcoords) xml += " TCoords=\"" + array.name + "\"";
  }
  xml += ">\n";
  for (const VtkArray& array : arrays)
    put_array(xml, array.name, array.type, array.width, array.values.data(),
              std::ssize(array.values));
  xml += "</" + element + ">\n";
}

/// Bytes of the strings as numbers, a zero after each.
void put_strings(std::string& xml, const char* name, const std::vector<std::string>& texts) {
  if (texts.empty()) return;
  xml += "<Array type=\"String\" Name=\"" + std::string(name) + "\" NumberOfTuples=\"" +
         std::to_string(texts.size()) + "\" format=\"ascii\">\n";
  for (const std::string& text : texts) {
    for (const char c : one_line(text))
      xml += std::to_string(static_cast<int>(static_cast<unsigned char>(c))) + " ";
    xml += "0\n";
  }
  xml += "</Array>\n";
}

void put_field_data(std::string& xml, const MeshFile& file) {
  if (file.comments.empty() && file.materials.empty()) return;
  xml += "<FieldData>\n";
  put_strings(xml, "comments", file.comments);
  put_strings(xml, "materials", file.materials);
  xml += "</FieldData>\n";
}

}  // namespace

std::string serialise_xml_vtk(const MeshFile& file, const WriteOptions& options) {
  const VtkFaces faces = vtk_faces(file, options);
  const Points& positions = file.mesh.positions;
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\" "
      "compressor=\"vtkZLibDataCompressor\">\n<PolyData>\n";
  put_field_data(xml, file);
  xml += "<Piece NumberOfPoints=\"" + std::to_string(positions.rows()) +
         "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
         std::to_string(faces.polygons.count()) + "\">\n";
  put_arrays(xml, "PointData", vtk_arrays(file.vertex_properties));
  put_arrays(xml, "CellData", faces.arrays);
  xml += "<Points>\n";
  put_array(xml, "Points", point_type(file), 3, positions.data(), positions.size());
  xml += "</Points>\n<Polys>\n";
  const Polygons& polygons = faces.polygons;
  put_indices(xml, "connectivity", polygons.corners.data(), std::ssize(polygons.corners));
  put_indices(xml, "offsets", polygons.starts.data() + 1, polygons.count());
  xml += "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
  return xml;
}

}  // namespace sphparam
