#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace sphparam {

/// One line of a GIFTI label table: what a whole number in an array of labels stands for.
struct GiftiLabel {
  int key = 0;
  std::optional<std::array<float, 4>> colour = {};  // red, green, blue, alpha in [0, 1]
  std::string name = {};
};

/// The label as any format can keep it: "gifti label KEY R G B A NAME", "gifti label KEY - NAME"
/// without a colour. Line ends in the name become blanks.
std::string comment_of(const GiftiLabel& label);

/// The label that a comment holds; nothing where it holds none.
std::optional<GiftiLabel> label_in(std::string_view comment);

}  // namespace sphparam
