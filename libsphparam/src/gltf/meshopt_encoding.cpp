#include "gltf/meshopt_encoding.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

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

namespace {

/// What readers make of a place in the grid of the filter OCTAHEDRAL, of 8 bits: whole numbers too.
Vector3 decoded_octahedral(int x, int y, int one) {
  const double below = std::min(0, one - std::abs(x) - std::abs(y));
  Vector3 p(x + (x >= 0 ? below : -below), y + (y >= 0 ? below : -below),
            one - std::abs(x) - std::abs(y));
  p *= 127 / p.norm();
  return {std::round(p.x()), std::round(p.y()), std::round(p.z())};
}

/// Moves a row to the neighbour in the grid that is decoded nearest. It is rounded twice, to the
/// grid and by who reads it: the grid's nearest is off by up to 1.2°, the best of its neighbours by
/// less than 1°.
void choose_nearest(const Vector3& wanted, signed char* row) {
  const int x = row[0], y = row[1], one = row[2];
  double most = -1;
  for (int k = 0; k < 9; ++k) {
    const int u = x + k % 3 - 1, v = y + k / 3 - 1;
    if (std::max(std::abs(u), std::abs(v)) > one) continue;
    const double cosine = decoded_octahedral(u, v, one).normalized().dot(wanted);
    if (cosine <= most) continue;
    most = cosine;
    row[0] = static_cast<signed char>(u);
    row[1] = static_cast<signed char>(v);
  }
}

}  // namespace

std::string octahedral(const std::vector<float>& rows) {
  constexpr int bits = 8;
  const std::size_t count = rows.size() / 4;
  std::string bytes(4 * count, '\0');
  meshopt_encodeFilterOct(bytes.data(), count, 4, bits, rows.data());
  auto* const at = reinterpret_cast<signed char*>(bytes.data());
  for (std::size_t i = 0; i < 4 * count; i += 4)
    choose_nearest(Vector3(rows[i], rows[i + 1], rows[i + 2]), at + i);
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
