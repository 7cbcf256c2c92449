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

/// What is read of the bytes before the decoder sees them. Beyond their end there are zeros.
class Peek {
 public:
  explicit Peek(std::span<const unsigned char> bytes) : bytes_(bytes) {}

  unsigned char byte() { return at_ < bytes_.size() ? bytes_[at_++] : 0; }

  void skip(std::uint64_t count) {
    at_ += static_cast<std::size_t>(std::min<std::uint64_t>(count, bytes_.size() - at_));
  }

  /// Seven bits a byte, lowest first.
  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 35; shift += 7) {
      const unsigned char next = byte();
      value |= static_cast<std::uint64_t>(next & 127) << shift;
      if (next < 128) break;
    }
    return value;
  }

  bool at_end() const { return at_ == bytes_.size(); }

 private:
  std::span<const unsigned char> bytes_;
  std::size_t at_ = 0;
};

/// Entries of names and values, then the same with names, within each other.
void skip_metadata(Peek& peek, int depth) {
  constexpr int deepest = 64;
  if (depth > deepest) fail("its metadata are nested too deep");
  for (std::uint64_t left = peek.varint(); left > 0 && !peek.at_end(); --left) {
    peek.skip(peek.byte());
    peek.skip(peek.varint());
  }
  for (std::uint64_t left = peek.varint(); left > 0 && !peek.at_end(); --left) {
    peek.skip(peek.byte());
    skip_metadata(peek, depth + 1);
  }
}

/// The faces that the bytes claim to hold. Source: the Draco bitstream specification, version 2.2,
/// which is that of the extension: magic, version, kind, method (0: sequential), flags; metadata of
/// attributes and of all, where a flag says so; sequential: faces, points; by edge breaker: a byte,
/// vertices, faces.
std::uint64_t claimed_faces(std::span<const unsigned char> bytes) {
  Peek peek(bytes);
  peek.skip(5);
  const int major = peek.byte(), minor = peek.byte();
  if (major != 2 || minor != 2)
    fail("is Draco " + std::to_string(major) + "." + std::to_string(minor) + ", not 2.2");
  peek.skip(1);
  const bool sequential = peek.byte() == 0;
  peek.skip(1);
  if ((peek.byte() & 128) != 0) {
    for (std::uint64_t left = peek.varint(); left > 0 && !peek.at_end(); --left) {
      peek.varint();
      skip_metadata(peek, 0);
    }
    skip_metadata(peek, 0);
  }
  if (!sequential) {
    peek.skip(1);
    peek.varint();
  }
  return peek.varint();
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
