#include "io/formats/mz3_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "io/attributes/appearance.h"
#include "io/files/byte_reader.h"
#include "io/files/text_buffer.h"
#include "io/formats/float32_points.h"
#include "io/formats/lossless_type.h"
#include "io/formats/mz3_attributes.h"

namespace sphparam {
namespace {

using Has = Mz3Attributes;
constexpr std::array colour_names = {"red", "green", "blue"};

/// Red, green, blue and, where the mesh has it, alpha.
std::vector<const Property*> colours_of(const MeshFile& file) {
  std::vector<const Property*> colours = find_all(file.vertex_properties, colour_names);
  const Property* const alpha = file.find_vertex_property("alpha");
  if (!colours.empty() && alpha) colours.push_back(alpha);
  return colours;
}

std::vector<const Property*> layers_of(const MeshFile& file,
                                       const std::vector<const Property*>& colours) {
  std::vector<const Property*> layers;
  for (const Property& property : file.vertex_properties)
    if (std::find(colours.begin(), colours.end(), &property) == colours.end())
      layers.push_back(&property);
  return layers;
}

bool is_float32(const Property& property) {
  const auto count = static_cast<Eigen::Index>(property.values.size());
  return lossless_type(ScalarType::Float32, property.values.data(), count) == ScalarType::Float32;
}

std::uint8_t as_byte(const Property& channel, std::size_t v) {
  constexpr double most = 255;
  const double share = channel.values[v] / brightest(channel.type);
  return static_cast<std::uint8_t>(std::clamp(std::round(most * share), 0.0, most));
}

void append_colours(std::string& bytes, const std::vector<const Property*>& colours,
                    std::size_t count) {
  constexpr std::size_t channels = 4;
  constexpr std::uint8_t opaque = 255;
  for (std::size_t v = 0; v < count; ++v)
    for (std::size_t i = 0; i < channels; ++i)
      append_number(bytes, i < colours.size() ? as_byte(*colours[i], v) : opaque,
                    std::endian::little);
}

void append_layers(std::string& bytes, const std::vector<const Property*>& layers, bool doubles) {
  for (const Property* layer : layers) {
    for (const double value : layer->values) {
      if (doubles)
        append_number(bytes, value, std::endian::little);
      else
        append_number(bytes, static_cast<float>(value), std::endian::little);
    }
  }
}

}  // namespace

std::string serialise_mz3(const MeshFile& file) {
  const TriangleMesh& mesh = file.mesh;
  const std::vector<const Property*> colours = colours_of(file), layers = layers_of(file, colours);
  const bool doubles = !std::all_of(layers.begin(), layers.end(),
                                    [](const Property* layer) { return is_float32(*layer); });
  const int attributes = Has::faces | Has::vertices | (colours.empty() ? 0 : Has::colours) |
                         (layers.empty() ? 0
                          : doubles      ? Has::doubles
                                         : Has::floats);
  std::string bytes = mz3_magic;
  append_number(bytes, static_cast<std::uint16_t>(attributes), std::endian::little);
  append_number(bytes, static_cast<std::uint32_t>(mesh.face_count()), std::endian::little);
  append_number(bytes, static_cast<std::uint32_t>(mesh.vertex_count()), std::endian::little);
  append_number(bytes, std::uint32_t{0}, std::endian::little);
  append_triangles32(bytes, mesh.triangles, std::endian::little);
  append_points32(bytes, mesh.positions, std::endian::little, "an MZ3 file");
  if (!colours.empty())
    append_colours(bytes, colours, static_cast<std::size_t>(mesh.vertex_count()));
  append_layers(bytes, layers, doubles);
  return bytes;
}

}  // namespace sphparam
