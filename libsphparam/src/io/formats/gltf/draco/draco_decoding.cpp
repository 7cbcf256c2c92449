#include "io/formats/gltf/draco/draco_decoding.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Woverloaded-virtual"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <draco/compression/decode.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>

// The only file that knows Draco. Its decoder is made for bytes of strangers, but asks for memory
// by the number of faces that they claim; so that number is looked at first.

namespace sphparam {
namespace {

[[noreturn]] void fail(const std::string& message) { throw std::runtime_error(message); }

/// Connectivity of the most regular meshes takes a hundredth of a bit a face.
constexpr std::uint64_t most_faces_per_byte = 1024;

/// The whole number at `at`, seven bits a byte, lowest first; 0 where it does not end.
std::uint64_t varint(std::span<const unsigned char> bytes, std::size_t& at) {
  std::uint64_t value = 0;
  for (int shift = 0; shift < 35 && at < bytes.size(); shift += 7) {
    const unsigned char byte = bytes[at++];
    value |= static_cast<std::uint64_t>(byte & 127) << shift;
    if (byte < 128) return value;
  }
  return 0;
}

/// The faces that the header claims. Source: the Draco bitstream specification, version 2.2: eleven
/// bytes, of which the ninth is the method; sequential: faces, points; by edge breaker: a byte,
/// vertices, faces. Metadata, and versions before 2.2, are left to the decoder.
std::uint64_t claimed_faces(std::span<const unsigned char> bytes) {
  constexpr std::size_t header = 11;
  if (bytes.size() < header || bytes[5] < 2 || bytes[6] < 2 || (bytes[10] & 128) != 0) return 0;
  std::size_t at = header;
  if (bytes[8] == 0) return varint(bytes, at);
  ++at;
  varint(bytes, at);
  return varint(bytes, at);
}

template <class T>
void put(T number, unsigned char* at) {
  std::memcpy(at, &number, sizeof number);
  if constexpr (std::endian::native != std::endian::little) std::reverse(at, at + sizeof number);
}

template <class T>
void copy_rows(const draco::PointAttribute& attribute, std::uint32_t points,
               DracoAttribute& wanted) {
  const auto width = static_cast<std::size_t>(wanted.components);
  wanted.rows.resize(points * width * sizeof(T));
  std::vector<T> row(width);
  for (std::uint32_t p = 0; p < points; ++p) {
    const draco::AttributeValueIndex at = attribute.mapped_index(draco::PointIndex(p));
    if (at.value() >= attribute.size() ||
        !attribute.ConvertValue<T>(at, static_cast<std::int8_t>(width), row.data()))
      fail("a value of attribute " + std::to_string(wanted.id) + " is not there");
    for (std::size_t k = 0; k < width; ++k)
      put(row[k], wanted.rows.data() + (p * width + k) * sizeof(T));
  }
}

void decode_attribute(const draco::Mesh& mesh, DracoAttribute& wanted) {
  const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(wanted.id);
  if (attribute == nullptr) fail("there is no attribute " + std::to_string(wanted.id));
  if (attribute->num_components() != wanted.components)
    fail("attribute " + std::to_string(wanted.id) + " has " +
         std::to_string(attribute->num_components()) + " components");
  with_scalar(wanted.type, [&](auto scalar) {
    copy_rows<decltype(scalar)>(*attribute, mesh.num_points(), wanted);
  });
}

}  // namespace

DracoMesh decode_draco(std::span<const unsigned char> bytes, std::vector<DracoAttribute> wanted) {
  if (claimed_faces(bytes) > most_faces_per_byte * bytes.size())
    fail("it claims more triangles than its bytes can hold");
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) fail("Draco says: " + decoded.status().error_msg_string());
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();

  DracoMesh result{.points = mesh->num_points(), .corners = {}, .attributes = std::move(wanted)};
  result.corners.reserve(3 * static_cast<std::size_t>(mesh->num_faces()));
  for (draco::FaceIndex f(0); f < mesh->num_faces(); ++f)
    for (const draco::PointIndex& corner : mesh->face(f)) {
      if (corner.value() >= mesh->num_points()) fail("a triangle names a point that is not there");
      result.corners.push_back(corner.value());
    }
  for (DracoAttribute& attribute : result.attributes) decode_attribute(*mesh, attribute);
  return result;
}

}  // namespace sphparam
