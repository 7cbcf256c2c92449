#include "io/formats/gltf/meshopt_decoding.h"

#include <meshoptimizer.h>

#include <stdexcept>
#include <string>

// The only file that knows meshoptimizer's decoders. They are made for bytes of strangers; what
// they require of their arguments is checked here, and so is that a few bytes do not ask for
// gigabytes.

namespace sphparam {
namespace {

/// Equal rows of vertices take one part in 64 at least; indices half a byte a corner.
constexpr std::uint64_t most_growth = 256, always_allowed = 1 << 16;

void require(bool good, const std::string& otherwise) {
  if (!good) throw std::runtime_error(otherwise);
}

void check_filter(std::string_view filter, std::string_view mode, std::uint64_t stride) {
  if (filter.empty() || filter == "NONE") return;
  const bool known = filter == "OCTAHEDRAL" || filter == "QUATERNION" || filter == "EXPONENTIAL";
  require(known, "its filter '" + std::string(filter) + "' is unknown");
  require(mode == "ATTRIBUTES", "only attributes may have a filter");
  const bool fits = filter == "OCTAHEDRAL"   ? stride == 4 || stride == 8
                    : filter == "QUATERNION" ? stride == 8
                                             : stride % 4 == 0;
  require(fits, "its filter does not go with rows of " + std::to_string(stride) + " bytes");
}

void apply_filter(std::vector<unsigned char>& rows, std::uint64_t count, std::uint64_t stride,
                  std::string_view filter) {
  if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(rows.data(), count, stride);
  if (filter == "QUATERNION") meshopt_decodeFilterQuat(rows.data(), count, stride);
  if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(rows.data(), count, stride);
}

}  // namespace

std::vector<unsigned char> decode_meshopt(std::span<const unsigned char> bytes, std::uint64_t count,
                                          std::uint64_t stride, std::string_view mode,
                                          std::string_view filter) {
  const bool vertices = mode == "ATTRIBUTES", triangles = mode == "TRIANGLES";
  require(vertices || triangles || mode == "INDICES",
          "its mode '" + std::string(mode) + "' is unknown");
  require(vertices ? stride >= 4 && stride <= 256 && stride % 4 == 0 : stride == 2 || stride == 4,
          "rows of " + std::to_string(stride) + " bytes are not allowed");
  require(!triangles || count % 3 == 0, "its indices make no whole triangles");
  check_filter(filter, mode, stride);
  require(count > 0 && count <= (most_growth * bytes.size() + always_allowed) / stride,
          "it claims more rows than its bytes can hold");

  std::vector<unsigned char> rows(count * stride);
  const int failed =
      vertices ? meshopt_decodeVertexBuffer(rows.data(), count, stride, bytes.data(), bytes.size())
      : triangles
          ? meshopt_decodeIndexBuffer(rows.data(), count, stride, bytes.data(), bytes.size())
          : meshopt_decodeIndexSequence(rows.data(), count, stride, bytes.data(), bytes.size());
  require(failed == 0, "its bytes are damaged, or of a version that is not supported");
  apply_filter(rows, count, stride, filter);
  return rows;
}

}  // namespace sphparam
