#pragma once

#include <string>
#include <string_view>

#include "sphparam/io/vertex_data.h"

namespace sphparam {

/// True for the first words of an MGH file.
bool looks_like_mgh(std::string_view bytes);

/// Reads an overlay in FreeSurfer's MGH (unpacked MGZ): one number a vertex, along one axis, a
/// frame a column; bytes, 16 or 32 bits, float32. Several frames are a time series, unless the file
/// gives them no time between; then they are measures.
/// Refused: volumes, and other types. Throws: ReadError with the byte.
VertexData read_mgh(std::string_view bytes, const std::string& name, const ReadOptions& options);

/// The same file, all as float32, without a place in space. Throws: WriteError for labels and
/// numbers beyond float32.
std::string serialise_mgh(const VertexData& data);

}  // namespace sphparam
