#include "gltf/format/packing.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "gltf/meshopt_encoding.h"

// glTF is little-endian, and so are all machines that this is built for.

namespace sphparam {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr double most_unsigned = 65535, most_signed = 32767;

template <class T>
PackedRows allocate(ComponentType type, Eigen::Index rows, Eigen::Index components) {
  PackedRows packed;
  packed.type = type;
  packed.components = static_cast<int>(components);
  packed.count = static_cast<std::size_t>(rows);
  packed.stride = (static_cast<std::size_t>(components) * sizeof(T) + 3) / 4 * 4;
  packed.bytes.assign(packed.count * packed.stride, '\0');
  return packed;
}

/// Stores number(row, column) as T.
template <class T, class Number>
PackedRows pack(ComponentType type, Eigen::Index rows, Eigen::Index components, Number&& number) {
  PackedRows packed = allocate<T>(type, rows, components);
  char* at = packed.bytes.data();
  for (Eigen::Index i = 0; i < rows; ++i, at += packed.stride) {
    for (Eigen::Index k = 0; k < components; ++k) {
      const T value = number(i, k);
      std::memcpy(at + static_cast<std::size_t>(k) * sizeof(T), &value, sizeof(T));
    }
  }
  return packed;
}

template <class Matrix>
void store_bounds(PackedRows& packed, const Matrix& rows) {
  for (Eigen::Index k = 0; k < rows.cols(); ++k) {
    packed.least.push_back(static_cast<double>(rows.col(k).minCoeff()));
    packed.greatest.push_back(static_cast<double>(rows.col(k).maxCoeff()));
  }
}

}  // namespace

bool fits_integers(const FloatRows& uv) {
  return uv.size() == 0 || (uv.minCoeff() >= 0 && uv.maxCoeff() <= 1);
}

std::uint16_t to_unsigned16(double value) {
  return static_cast<std::uint16_t>(
      std::clamp(std::round(value * most_unsigned), 0.0, most_unsigned));
}

PackedRows pack_floats(const FloatRows& rows, Bounds bounds) {
  PackedRows packed = allocate<float>(ComponentType::Float32, rows.rows(), rows.cols());
  std::memcpy(packed.bytes.data(), rows.data(), packed.bytes.size());
  if (bounds == Bounds::Store) store_bounds(packed, rows);
  return packed;
}

PackedRows pack_signed(const FloatRows& rows) {
  PackedRows packed = pack<std::int16_t>(
      ComponentType::Int16, rows.rows(), rows.cols(), [&](Eigen::Index i, Eigen::Index k) {
        const double value = std::clamp(static_cast<double>(rows(i, k)), -1.0, 1.0);
        return static_cast<std::int16_t>(std::round(value * most_signed));
      });
  packed.normalised = true;
  return packed;
}

PackedRows pack_octahedral(const FloatRows& rows) {
  std::vector<float> padded(4 * static_cast<std::size_t>(rows.rows()), 0.0F);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    for (Eigen::Index k = 0; k < rows.cols(); ++k)
      padded[static_cast<std::size_t>(4 * i + k)] = rows(i, k);
  }
  PackedRows packed;
  packed.type = ComponentType::Int8;
  packed.components = static_cast<int>(rows.cols());
  packed.count = static_cast<std::size_t>(rows.rows());
  packed.stride = 4;
  packed.normalised = packed.octahedral = true;
  packed.bytes = octahedral(padded);
  return packed;
}

PackedRows pack_unsigned(const FloatRows& rows) {
  PackedRows packed = pack<std::uint16_t>(
      ComponentType::Uint16, rows.rows(), rows.cols(),
      [&](Eigen::Index i, Eigen::Index k) { return to_unsigned16(rows(i, k)); });
  packed.normalised = true;
  return packed;
}

PackedRows pack_colours(std::span<const std::array<std::uint16_t, 4>> colours) {
  PackedRows packed = pack<std::uint16_t>(
      ComponentType::Uint16, static_cast<Eigen::Index>(colours.size()), 4,
      [&](Eigen::Index i, Eigen::Index k) {
        return colours[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)];
      });
  packed.normalised = true;
  return packed;
}

PackedRows pack_indices(std::span<const std::uint32_t> indices, std::size_t vertex_count) {
  // 65,535 is the index that restarts a primitive.
  const bool is_short = vertex_count <= std::numeric_limits<std::uint16_t>::max();
  PackedRows packed;
  packed.type = is_short ? ComponentType::Uint16 : ComponentType::Uint32;
  packed.count = indices.size();
  packed.stride = is_short ? 2 : 4;
  packed.bytes.resize(packed.count * packed.stride);
  char* at = packed.bytes.data();
  for (const std::uint32_t index : indices) {
    std::memcpy(at, &index, packed.stride);
    at += packed.stride;
  }
  return packed;
}

Quantisation quantisation_of(const FloatRows& positions) {
  const Eigen::RowVectorXd least = positions.colwise().minCoeff().cast<double>(),
                           greatest = positions.colwise().maxCoeff().cast<double>();
  const double extent = (greatest - least).maxCoeff();
  return {least, extent > 0 ? extent / most_unsigned : 1};
}

PackedRows pack_quantised(const FloatRows& positions, const Quantisation& quantisation) {
  Eigen::Matrix<std::uint16_t, Eigen::Dynamic, 3, Eigen::RowMajor> integers(positions.rows(), 3);
  for (Eigen::Index i = 0; i < positions.rows(); ++i) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double steps =
          (static_cast<double>(positions(i, k)) - quantisation.offset[k]) / quantisation.scale;
      integers(i, k) =
          static_cast<std::uint16_t>(std::clamp(std::round(steps), 0.0, most_unsigned));
    }
  }
  PackedRows packed =
      pack<std::uint16_t>(ComponentType::Uint16, integers.rows(), 3,
                          [&](Eigen::Index i, Eigen::Index k) { return integers(i, k); });
  store_bounds(packed, integers);
  return packed;
}

}  // namespace sphparam
