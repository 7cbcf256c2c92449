#include "gltf/meshopt_encoding.h"

#include <meshoptimizer.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

// The only file that knows meshoptimizer's encoders. Versions of its encoding that decoders of the
// extension have: 0 for vertices, 1 for indices. Vertices are decoded again and compared, indices
// decoded.

namespace sphparam {
namespace {

constexpr int vertex_version = 0, index_version = 1;

std::string shortened(std::string bytes, std::size_t size) {
  if (size == 0) throw std::runtime_error("meshoptimizer: the bound of its own encoder is too low");
  bytes.resize(size);
  return bytes;
}

const unsigned char* data_of(const std::string& bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

void require(bool as_it_was) {
  if (!as_it_was) throw std::runtime_error("meshoptimizer: decoding gives something else");
}

/// The same but for which corner is first.
template <class Index>
bool same_triangles(const std::vector<Index>& one, const std::vector<Index>& other) {
  for (std::size_t f = 0; f < one.size(); f += 3) {
    bool same = false;
    for (std::size_t k = 0; k < 3; ++k) {
      same |= one[f] == other[f + k] && one[f + 1] == other[f + (k + 1) % 3] &&
              one[f + 2] == other[f + (k + 2) % 3];
    }
    if (!same) return false;
  }
  return true;
}

template <class Index>
std::string encode(const std::string& bytes, std::size_t count) {
  std::vector<Index> indices(count);
  std::memcpy(indices.data(), bytes.data(), count * sizeof(Index));
  std::size_t vertices = 0;
  for (const Index i : indices) vertices = std::max<std::size_t>(vertices, i + std::size_t{1});
  std::string out(meshopt_encodeIndexBufferBound(count, vertices), '\0');
  const std::size_t size = meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(out.data()),
                                                     out.size(), indices.data(), count);
  out = shortened(std::move(out), size);
  std::vector<Index> decoded(count);
  require(meshopt_decodeIndexBuffer(decoded.data(), count, sizeof(Index), data_of(out), size) ==
              0 &&
          same_triangles(decoded, indices));
  return out;
}

}  // namespace

std::string encode_vertices(const std::string& bytes, std::size_t count, std::size_t stride) {
  meshopt_encodeVertexVersion(vertex_version);
  std::string out(meshopt_encodeVertexBufferBound(count, stride), '\0');
  const std::size_t size = meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(out.data()),
                                                      out.size(), bytes.data(), count, stride);
  out = shortened(std::move(out), size);
  std::string decoded(bytes.size(), '\0');
  require(meshopt_decodeVertexBuffer(decoded.data(), count, stride, data_of(out), size) == 0 &&
          decoded == bytes);
  return out;
}

std::string octahedral(const std::vector<float>& rows) {
  constexpr int bits = 8;
  const std::size_t count = rows.size() / 4;
  std::string bytes(4 * count, '\0');
  meshopt_encodeFilterOct(bytes.data(), count, 4, bits, rows.data());
  return bytes;
}

std::vector<std::uint32_t> strip_order(const std::vector<std::uint32_t>& indices,
                                       std::size_t vertex_count) {
  std::vector<std::uint32_t> ordered(indices.size());
  meshopt_optimizeVertexCacheStrip(ordered.data(), indices.data(), indices.size(), vertex_count);
  return ordered;
}

std::string encode_triangles(const std::string& bytes, std::size_t count, std::size_t stride) {
  meshopt_encodeIndexVersion(index_version);
  return stride == 2 ? encode<std::uint16_t>(bytes, count) : encode<std::uint32_t>(bytes, count);
}

}  // namespace sphparam
