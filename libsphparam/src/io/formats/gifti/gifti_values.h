#pragma once

#include <string>
#include <string_view>

#include "sphparam/io/vertex_data.h"

namespace sphparam {

/// Reads a GIFTI file without a surface: arrays of one number a vertex, or of one row a vertex,
/// each of whose columns is one. Where all intents are NIFTI_INTENT_LABEL these are keys of the
/// label table, where all are NIFTI_INTENT_TIME_SERIES moments, else measured.
/// Refused: surfaces, sparse arrays (NIFTI_INTENT_NODE_INDEX), labels beside something else, keys
/// that are no whole numbers. Throws: ReadError with the line.
VertexData read_gifti_values(std::string_view bytes, const std::string& name,
                             const ReadOptions& options);

/// A GIFTI file of one array a column: labels as INT32, all else as FLOAT32. A table of labels
/// without the key 0 gets it, as "???", transparent.
/// Throws: WriteError for labels beyond 32 bits, and when libgiftiio fails.
std::string serialise_gifti_values(const VertexData& data);

}  // namespace sphparam
