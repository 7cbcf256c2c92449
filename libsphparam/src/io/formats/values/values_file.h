#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/files/byte_reader.h"
#include "sphparam/io/vertex_data.h"

namespace sphparam {

// What the formats of numbers a vertex share.

/// Throws: ReadError where there is no vertex, more than the options allow, or more than ids count.
inline void require_vertex_count(const ByteReader& reader, std::int64_t count,
                                 const ReadOptions& options) {
  if (count <= 0) reader.fail(std::to_string(count) + " vertices: there must be one");
  if (count > options.max_vertices)
    reader.fail(std::to_string(count) + " vertices are over the limit of " +
                std::to_string(options.max_vertices));
}

/// Throws: WriteError unless there is one column, which is all that `format` has.
void require_one_column(const VertexData& data, const char* format);

/// Throws: WriteError unless these are labels, or measured, as `format` wants it.
void require_labels(const VertexData& data, const char* format);
void require_measures(const VertexData& data, const char* format);

/// The number as float32. Throws: WriteError where that has no room for it; NaN stays NaN.
float as_float32(double value, const char* format);

/// The key of a label. Throws: WriteError where it is no whole number that an int holds.
int as_key(double value, const char* format);

/// Texts of these files end in a NUL, or at their length; line ends become blanks.
std::string trimmed_text(std::string_view text);

}  // namespace sphparam
