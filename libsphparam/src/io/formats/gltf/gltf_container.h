#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sphparam {

/// Where in a glTF file, text or binary, its JSON is.
struct GltfContainer {
  std::string_view json = {};
  std::uint64_t json_offset = 0;
  bool is_binary = false;
  bool has_binary_chunk = false;
  std::string_view whole = {};  // without what follows its end
};

/// A binary glTF whose chunks lack the padding to multiples of 4 bytes, with it, as other readers
/// take it; empty where nothing is to be done, or can be.
std::string with_padded_chunks(std::string_view bytes, std::vector<std::string>& notes);

/// Checks the header of a GLB and those of all its chunks; what follows its end is noted.
/// Throws: ReadError.
GltfContainer open_gltf(std::string_view bytes, const std::string& name,
                        std::vector<std::string>& notes);

/// The whole file with other JSON in the place of its own.
/// Requires: fewer than 2³² bytes in all. Ensures: as the container is, text or binary.
std::string with_json(const GltfContainer& container, std::string json);

}  // namespace sphparam
