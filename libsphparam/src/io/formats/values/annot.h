#pragma once

#include <string>
#include <string_view>

#include "sphparam/io/vertex_data.h"

namespace sphparam {

/// Reads a FreeSurfer annotation (lh.aparc.annot): a number a vertex that is the colour of its
/// label, R + 256·G + 65536·B, and the table of these colours, of either version.
///
/// The key of a label is its number in the table. Vertices whose colour is none of the table's get
/// that of "???", 0 where the table leaves that free, else −1; those that have a colour all the
/// same are told as not carried. Throws: ReadError with the byte, also where there is no table.
VertexData read_annot(std::string_view bytes, const std::string& name, const ReadOptions& options);

/// The same file, with a table of version 2. Colours are rounded to bytes, alpha is written as
/// transparency. A negative key is no label.
/// Throws: WriteError for what is measured, several columns, keys that the table lacks or that are
/// over a million, and labels without a colour or of the same one, as colours are what tells them
/// apart.
std::string serialise_annot(const VertexData& data);

}  // namespace sphparam
