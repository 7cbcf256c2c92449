#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "io/formats/gltf/gltf_document.h"

namespace sphparam {

/// What a glTF file says of its compressed parts: views by EXT_meshopt_compression, primitives by
/// KHR_draco_mesh_compression. Nothing in it is promised but the types.
struct GltfCompression {
  struct View {
    int buffer = -1;
    std::uint64_t offset = 0, length = 0, stride = 0, count = 0;
    std::string mode, filter;
  };
  struct Primitive {
    int view = -1;
    std::map<std::string, std::uint32_t> attributes;  // Draco's number of each
  };
  std::map<int, View> views;
  std::map<std::pair<int, int>, Primitive> primitives;  // by mesh and place in it

  /// The JSON as a library loads it that knows no compression: three bytes in the place of buffers
  /// that exist in decoded form only, some view for accessors of what Draco has packed. Empty where
  /// it is as it is.
  std::string loadable_json;
};

/// Reads it. Requires: JSON that check_gltf_json let through. Throws: ReadError where a member is
/// missing or of the wrong type.
GltfCompression compression_of(std::string_view json, const std::string& name);

/// Replaces what is compressed by what it decodes to: views get buffers of their own, primitives
/// views and accessors of their own (32-bit indices of triangles, attributes of their accessors'
/// types). Throws: ReadError that names the view or primitive.
void decompress(GltfDocument& document, const GltfCompression& compression,
                const std::string& name);

}  // namespace sphparam
