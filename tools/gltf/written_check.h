#pragma once

#include <string>
#include <string_view>

#include "gltf/gltf_writer.h"

namespace sphparam::tools {

/// Reads a .glb back by the reader of strangers' files and compares its first level with the asset:
/// the same triangles, positions and (u, v), number by number; quantised ones within half a step.
/// So what was certified of the asset holds for the file. Compressed files are not for that reader:
/// `encode_vertices` and `encode_triangles` decode what they made.
/// Throws: std::runtime_error that names what differs; ReadError.
void check_written(std::string_view glb, const std::string& name, const Asset& asset,
                   const GltfOptions& options);

}  // namespace sphparam::tools
