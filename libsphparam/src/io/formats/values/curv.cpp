#include "io/formats/values/curv.h"

#include <cstdint>

#include "io/formats/values/values_file.h"
#include "sphparam/io/losses.h"

namespace sphparam {
namespace {

constexpr std::string_view magic = "\xff\xff\xff";

}  // namespace

bool looks_like_curv(std::string_view bytes) {
  // A count follows, whose first byte is small; bytes that are all ones are no file.
  constexpr unsigned char first_of_count = 0x80;
  return bytes.starts_with(magic) && bytes.size() > magic.size() &&
         static_cast<unsigned char>(bytes[magic.size()]) < first_of_count;
}

VertexData read_curv(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  ByteReader reader(bytes, name, std::endian::big);
  if (reader.take(magic.size(), "its magic number") != magic)
    throw ReadError(name, "is no FreeSurfer file of values: it does not start with FF FF FF");
  const auto vertices = reader.number<std::int32_t>("its counts");
  const auto triangles = reader.number<std::int32_t>("its counts");
  const auto each = reader.number<std::int32_t>("its counts");
  require_vertex_count(reader, vertices, options);
  if (each != 1)
    reader.fail(std::to_string(each) + " values a vertex, which is not supported; one is");
  reader.require(sizeof(float) * static_cast<std::uint64_t>(vertices), "the values");
  VertexData data;
  data.format = "FreeSurfer curv";
  data.triangles = std::max(triangles, 0);
  DataColumn& column = data.columns.emplace_back();
  column.values.reserve(static_cast<std::size_t>(vertices));
  for (std::int32_t v = 0; v < vertices; ++v)
    column.values.push_back(static_cast<double>(reader.number<float>("the values")));
  if (reader.remaining() > 0)
    add_loss(data.notes, std::to_string(reader.remaining()) + " bytes after the values");
  return data;
}

std::string serialise_curv(const VertexData& data) {
  require_one_column(data, "FreeSurfer's curv");
  require_measures(data, "FreeSurfer's curv");
  std::string bytes(magic);
  bytes.reserve(bytes.size() + sizeof(float) * (3 + data.columns.front().values.size()));
  append_number(bytes, static_cast<std::int32_t>(data.vertex_count()), std::endian::big);
  append_number(bytes, static_cast<std::int32_t>(data.triangles), std::endian::big);
  append_number(bytes, std::int32_t{1}, std::endian::big);
  for (const double value : data.columns.front().values)
    append_number(bytes, as_float32(value, "FreeSurfer's curv"), std::endian::big);
  return bytes;
}

}  // namespace sphparam
