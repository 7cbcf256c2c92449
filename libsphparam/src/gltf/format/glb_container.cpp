#include "gltf/format/glb_container.h"

#include <cstdint>
#include <limits>
#include <stdexcept>

namespace sphparam {

std::string glb_container(std::string json, const std::string& bytes) {
  constexpr std::uint32_t magic = 0x46546C67, json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::size_t size = 12 + 8 + json.size() + 8 + bytes.size();
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw std::length_error("more than the 4 GiB of a .glb: choose .gltf");
  std::string file;
  file.reserve(size);
  const auto word = [&](std::size_t value) {
    for (int shift = 0; shift < 32; shift += 8) file += static_cast<char>(value >> shift & 0xFF);
  };
  for (const std::size_t value : {std::size_t{magic}, std::size_t{2}, size}) word(value);
  word(json.size());
  word(json_chunk);
  file += json;
  word(bytes.size());
  word(binary_chunk);
  file += bytes;
  return file;
}

}  // namespace sphparam
