#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sphparam/io/vertex_data.h"

namespace sphparam {

/// The label as any format can keep it: "gifti label KEY R G B A NAME", "gifti label KEY - NAME"
/// without a colour. Line ends in the name become blanks.
std::string comment_of(const Label& label);

/// The label that a comment holds; nothing where it holds none.
std::optional<Label> label_in(std::string_view comment);

/// What follows "gifti label " in such a comment, and back: "KEY R G B A NAME" or "KEY - NAME".
std::string label_text(const Label& label);
std::optional<Label> parse_label(std::string_view text);

}  // namespace sphparam
