#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "io/files/byte_reader.h"
#include "mesh/float32_size.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// Whether coordinates can be rounded to float32 numbers. `format`: for the message.
/// Throws: WriteError where one is beyond their range; UnmeasurableMesh where all are too near.
inline void require_float32(const Points& points, const char* format) {
  require_float32_least(points, format);
  for (Eigen::Index i = 0; i < points.size(); ++i)
    if (!std::isfinite(static_cast<float>(points.data()[i])))
      throw WriteError(format, "a coordinate of vertex " + std::to_string(i / 3) +
                                   " is beyond numbers of 32 bits; .ply, .obj, .off, .vtk and "
                                   ".vtp hold it");
}

/// Coordinates rounded to the nearest float32 numbers. Throws: as `require_float32`.
inline void append_points32(std::string& bytes, const Points& points, std::endian order,
                            const char* format) {
  require_float32(points, format);
  for (Eigen::Index i = 0; i < points.size(); ++i)
    append_number(bytes, static_cast<float>(points.data()[i]), order);
}

inline void append_triangles32(std::string& bytes, const Triangles& triangles, std::endian order) {
  for (Eigen::Index i = 0; i < triangles.size(); ++i)
    append_number(bytes, static_cast<std::int32_t>(triangles.data()[i]), order);
}

}  // namespace sphparam
