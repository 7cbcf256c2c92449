#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sphparam/io/read_options.h"

namespace sphparam {

/// What a glTF file says of itself that has to be known before a library may read it.
struct GltfSummary {
  std::vector<std::string> external_buffers;  // URIs of files, in the order of the buffers
  std::int64_t primitives = 0;
  bool compressed = false;  // some part is (gltf_compression)
};

/// Checks the JSON of a glTF 2.0 file as text, without building anything from it.
///
/// Refused: what is no JSON; more bytes, depth, values or objects than the limits; versions other
/// than 2; required extensions that are not supported, by name; indices that are no whole number or
/// do not fit 31 bits (tinygltf would cut them short); more than one buffer without a URI, or any
/// where there is no binary chunk, but for those that compressed views are decoded to; data URIs of
/// other types than buffers have. `json_offset` is the place of the JSON in the file. Throws:
/// ReadError.
GltfSummary check_gltf_json(std::string_view json, std::uint64_t json_offset, bool has_binary_chunk,
                            const std::string& name, const ReadOptions& options);

}  // namespace sphparam
