#pragma once

#include <string>
#include <string_view>

#include "sphparam/io/vertex_data.h"

namespace sphparam {

/// True for the first line of a FreeSurfer label.
bool looks_like_label_file(std::string_view bytes);

/// Reads a FreeSurfer label (lh.cortex.label): a line of text, a count, and a line
/// "VERTEX X Y Z NUMBER" for each vertex in it. These get the key 1, named as the file is, all
/// others 0. Coordinates are those of the surface, and not kept; numbers other than 0 and 1 are
/// told as not carried. Requires: `vertices` > 0, which the file does not say; else a ReadError.
VertexData read_label_file(std::string_view bytes, const std::string& name, Eigen::Index vertices,
                           const ReadOptions& options);

/// The same file: the vertices of the one key that is not 0. `surface`: their coordinates, null for
/// zeros. Throws: WriteError for what is measured, several columns or several such keys.
std::string serialise_label_file(const VertexData& data, const Points* surface);

}  // namespace sphparam
