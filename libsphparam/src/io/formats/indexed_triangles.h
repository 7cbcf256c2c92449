#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "io/files/byte_reader.h"
#include "io/files/non_finite_advice.h"
#include "sphparam/io/mesh_file.h"

namespace sphparam {

// What the binary formats of triangles by three indices share: numbers of vertices and faces, then
// coordinates of 32 bits and indices of 32 bits, in one or the other order.

/// Throws: ReadError where there are more than the options allow, or than ids can count.
inline void check_counts(const ByteReader& reader, std::int64_t vertices, std::int64_t faces,
                         const ReadOptions& options) {
  constexpr std::int64_t hard_limit = std::numeric_limits<int>::max() / 3;  // ids are ints
  const auto check = [&](std::int64_t count, std::int64_t limit, const char* what) {
    if (count < 0) reader.fail(std::string("negative number of ") + what);
    if (count > std::min(limit, hard_limit))
      reader.fail(std::to_string(count) + " " + what + " are over the limit of " +
                  std::to_string(std::min(limit, hard_limit)));
  };
  check(vertices, options.max_vertices, "vertices");
  check(faces, options.max_faces, "triangles");
}

/// Requires: the bytes are there. Throws: ReadError for numbers that are not finite, where options
/// do not let them pass.
inline Points read_points32(ByteReader& reader, std::int64_t count, const ReadOptions& options) {
  Points points(count, 3);
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    const auto value = reader.number<float>("the coordinates");
    if (!std::isfinite(value) && !options.non_finite)
      reader.fail("a coordinate of vertex " + std::to_string(i / 3) + " is not finite" +
                  non_finite_advice());
    points.data()[i] = static_cast<double>(value);
  }
  return points;
}

/// Requires: the bytes are there. Throws: ReadError for a vertex that is not there, or that a
/// triangle names twice where options do not let that pass.
inline Triangles read_triangles32(ByteReader& reader, std::int64_t count, std::int64_t vertices,
                                  const ReadOptions& options) {
  Triangles triangles(count, 3);
  for (Eigen::Index f = 0; f < count; ++f) {
    for (int k = 0; k < 3; ++k) {
      const auto v = reader.number<std::int32_t>("the triangles");
      if (v < 0 || v >= vertices)
        reader.fail("triangle " + std::to_string(f) + " names vertex " + std::to_string(v) +
                    " of " + std::to_string(vertices) + " (counted from 0)");
      triangles(f, k) = v;
    }
    const int a = triangles(f, 0), b = triangles(f, 1), c = triangles(f, 2);
    if ((a == b || b == c || c == a) && !options.repeated_corners)
      reader.fail("triangle " + std::to_string(f) + " names a vertex twice" +
                  repeated_corners_advice());
  }
  return triangles;
}

}  // namespace sphparam
