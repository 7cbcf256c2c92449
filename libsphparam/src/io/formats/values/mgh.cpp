#include "io/formats/values/mgh.h"

#include <array>
#include <cstdint>

#include "io/formats/values/values_file.h"
#include "number_text.h"
#include "sphparam/io/losses.h"

// A header of 284 bytes: version, four sizes, type, degrees of freedom, whether the place in space
// that follows is good. Then the numbers, frame by frame; then times of the scanner, and tags. An
// overlay has its vertices along the first axis and no place; its transform is no matter of ours.

namespace sphparam {
namespace {

constexpr char format[] = "MGH";
constexpr std::int32_t version = 1;
constexpr std::size_t header_bytes = 284, used_bytes = 30;
constexpr std::int64_t most_frames = 100000;

enum MghType : std::int32_t { Bytes = 0, Int32 = 1, Float32 = 3, Int16 = 4 };

std::size_t size_of(std::int32_t type) {
  switch (type) {
    case Bytes:
      return 1;
    case Int16:
      return 2;
    case Int32:
    case Float32:
      return 4;
    default:
      return 0;
  }
}

double read_value(ByteReader& reader, std::int32_t type) {
  constexpr char what[] = "the values";
  switch (type) {
    case Bytes:
      return reader.number<std::uint8_t>(what);
    case Int16:
      return reader.number<std::int16_t>(what);
    case Int32:
      return reader.number<std::int32_t>(what);
    default:
      return static_cast<double>(reader.number<float>(what));
  }
}

ScalarType scalar_of(std::int32_t type) {
  switch (type) {
    case Bytes:
      return ScalarType::Uint8;
    case Int16:
      return ScalarType::Int16;
    case Int32:
      return ScalarType::Int32;
    default:
      return ScalarType::Float32;
  }
}

struct MghHeader {
  std::array<std::int32_t, 4> sizes{};
  std::int32_t type = 0;

  explicit MghHeader(ByteReader& reader) {
    if (reader.number<std::int32_t>("its header") != version) reader.fail("is no MGH of version 1");
    for (std::int32_t& size : sizes) size = reader.number<std::int32_t>("its header");
    type = reader.number<std::int32_t>("its header");
    reader.take(header_bytes - 6 * sizeof(std::int32_t), "its header");
  }
};

/// Of an overlay, the one size of the first three that is not 1.
std::int64_t vertices_of(const MghHeader& header, const ByteReader& reader) {
  std::int64_t vertices = 1;
  int axes = 0;
  for (int i = 0; i < 3; ++i) {
    const std::int32_t size = header.sizes[static_cast<std::size_t>(i)];
    if (size <= 0) reader.fail("has a size of " + std::to_string(size));
    vertices = std::max<std::int64_t>(vertices, size);
    axes += size > 1;
  }
  if (axes > 1)
    reader.fail("is a volume of " + std::to_string(header.sizes[0]) + " × " +
                std::to_string(header.sizes[1]) + " × " + std::to_string(header.sizes[2]) +
                "; an overlay, one number a vertex, is wanted (mri_vol2surf makes one)");
  return vertices;
}

/// The time between frames, in milliseconds, which stands behind the numbers; 0: none.
float time_step(ByteReader& reader) {
  return reader.remaining() < sizeof(float) ? 0.0F : reader.number<float>("its times");
}

}  // namespace

bool looks_like_mgh(std::string_view bytes) {
  if (bytes.size() < used_bytes) return false;
  const std::string nameless;
  ByteReader reader(bytes, nameless, std::endian::big);
  if (reader.number<std::int32_t>("") != version) return false;
  for (int i = 0; i < 4; ++i)
    if (reader.number<std::int32_t>("") <= 0) return false;
  const auto type = reader.number<std::int32_t>("");
  return type >= 0 && type <= 20;
}

VertexData read_mgh(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  ByteReader reader(bytes, name, std::endian::big);
  const MghHeader header(reader);
  const std::int64_t vertices = vertices_of(header, reader), frames = header.sizes[3];
  require_vertex_count(reader, vertices, options);
  if (frames <= 0 || frames > most_frames) reader.fail("has " + std::to_string(frames) + " frames");
  const std::size_t size = size_of(header.type);
  if (size == 0)
    reader.fail("has numbers of type " + std::to_string(header.type) +
                ", which is not supported; bytes, 16 and 32 bits and floats are");
  reader.require(size * static_cast<std::uint64_t>(vertices) * static_cast<std::uint64_t>(frames),
                 "the values");
  VertexData data;
  data.format = "FreeSurfer MGH";
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    DataColumn& column = data.columns.emplace_back();
    column.type = scalar_of(header.type);
    column.values.reserve(static_cast<std::size_t>(vertices));
    for (std::int64_t v = 0; v < vertices; ++v)
      column.values.push_back(read_value(reader, header.type));
  }
  const float step = time_step(reader);
  if (frames > 1 && step > 0) {
    constexpr int digits = 6;  // of a float
    data.kind = DataKind::TimeSeries;
    add_loss(data.notes,
             "the time between frames, " + short_number(static_cast<double>(step), digits) + " ms");
  }
  constexpr std::size_t times_bytes = 4 * sizeof(float);
  if (reader.remaining() > times_bytes)
    add_loss(data.notes, std::to_string(reader.remaining() - times_bytes) +
                             " bytes after the values (how the file was made)");
  return data;
}

std::string serialise_mgh(const VertexData& data) {
  require_measures(data, format);
  std::string bytes;
  const auto count = static_cast<std::size_t>(data.vertex_count());
  bytes.reserve(header_bytes + sizeof(float) * count * data.columns.size());
  for (const std::int64_t word : {std::int64_t{version}, data.vertex_count(), std::int64_t{1},
                                  std::int64_t{1}, std::ssize(data.columns), std::int64_t{Float32}})
    append_number(bytes, static_cast<std::int32_t>(word), std::endian::big);
  bytes.resize(header_bytes, '\0');  // no place in space
  for (const DataColumn& column : data.columns)
    for (const double value : column.values)
      append_number(bytes, as_float32(value, format), std::endian::big);
  return bytes;
}

}  // namespace sphparam
