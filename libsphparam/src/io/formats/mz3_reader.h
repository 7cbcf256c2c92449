#pragma once

#include <string>
#include <string_view>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

/// True when the bytes open as an unpacked MZ3 does, with attributes that MZ3 has and the bytes
/// that these and the counts ask for.
bool looks_like_mz3(std::string_view bytes);

/// Reads an MZ3 mesh (Surf Ice, NiiVue): triangles, positions as float32, colours red green blue
/// alpha, and layers of numbers as properties scalar, scalar_2, …, Float32 or Float64; the first
/// one as ao where the file calls it ambient occlusion. Layers with a number that is not finite,
/// which is how MZ3 leaves a vertex out, and skipped bytes are told as not carried.
/// Refused by name: files without a mesh, of values alone. Throws: ReadError with the byte.
MeshFile read_mz3(std::string_view bytes, const std::string& name, const ReadOptions& options = {});

}  // namespace sphparam
