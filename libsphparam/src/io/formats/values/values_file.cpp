#include "io/formats/values/values_file.h"

#include <cmath>

#include "number_text.h"
#include "sphparam/io/safe_file.h"

namespace sphparam {

void require_one_column(const VertexData& data, const char* format) {
  if (data.columns.size() != 1)
    throw WriteError(format, "has one number a vertex, and " + data.name + " has " +
                                 std::to_string(data.columns.size()) +
                                 "; .gii holds them, and .mgh what is measured");
}

void require_labels(const VertexData& data, const char* format) {
  if (data.kind != DataKind::Labels)
    throw WriteError(format, "holds labels, and " + data.name +
                                 " is measured; .shape.gii, .mgh and lh.NAME hold that");
}

void require_measures(const VertexData& data, const char* format) {
  if (data.kind == DataKind::Labels)
    throw WriteError(format, "holds what is measured, and " + data.name +
                                 " has labels; .label.gii and .annot hold these");
}

float as_float32(double value, const char* format) {
  const auto rounded = static_cast<float>(value);
  if (std::isinf(rounded) && !std::isinf(value))
    throw WriteError(format, "a value is beyond numbers of 32 bits");
  return rounded;
}

int as_key(double value, const char* format) {
  if (holds_exactly(ScalarType::Int32, value)) return static_cast<int>(value);
  throw WriteError(format, "holds labels, whose keys are whole numbers of 32 bits, and one is " +
                               short_number(value));
}

std::string trimmed_text(std::string_view text) {
  return one_line(text.substr(0, text.find('\0')));
}

}  // namespace sphparam
