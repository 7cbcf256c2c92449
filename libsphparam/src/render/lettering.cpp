#include "render/lettering.h"

#include <algorithm>
#include <array>

// Letters of 5 × 9 dots, a row a number, the leftmost dot the highest bit; two rows hang below the
// line. Our own, so that pictures need no font and are the same everywhere. '<' and '>' are drawn
// as "at most" and "at least".

namespace sphparam {
namespace {

constexpr int column_count = 5, row_count = 9, advance = 6;

struct Glyph {
  char letter;
  std::array<unsigned char, row_count> rows;
};

constexpr std::array<Glyph, 73> glyphs{{
    {'0', {14, 17, 19, 21, 25, 17, 14, 0, 0}}, {'1', {4, 12, 4, 4, 4, 4, 14, 0, 0}},
    {'2', {14, 17, 1, 2, 4, 8, 31, 0, 0}},     {'3', {14, 17, 1, 6, 1, 17, 14, 0, 0}},
    {'4', {2, 6, 10, 18, 31, 2, 2, 0, 0}},     {'5', {31, 16, 30, 1, 1, 17, 14, 0, 0}},
    {'6', {6, 8, 16, 30, 17, 17, 14, 0, 0}},   {'7', {31, 1, 2, 4, 8, 8, 8, 0, 0}},
    {'8', {14, 17, 17, 14, 17, 17, 14, 0, 0}}, {'9', {14, 17, 17, 15, 1, 2, 12, 0, 0}},
    {'/', {1, 1, 2, 4, 8, 16, 16, 0, 0}},      {'+', {0, 4, 4, 31, 4, 4, 0, 0, 0}},
    {'-', {0, 0, 0, 31, 0, 0, 0, 0, 0}},       {'.', {0, 0, 0, 0, 0, 12, 12, 0, 0}},
    {':', {0, 12, 12, 0, 12, 12, 0, 0, 0}},    {'a', {0, 0, 14, 1, 15, 17, 15, 0, 0}},
    {'b', {16, 16, 30, 17, 17, 17, 30, 0, 0}}, {'c', {0, 0, 14, 16, 16, 17, 14, 0, 0}},
    {'d', {1, 1, 15, 17, 17, 17, 15, 0, 0}},   {'e', {0, 0, 14, 17, 31, 16, 14, 0, 0}},
    {'f', {6, 9, 8, 28, 8, 8, 8, 0, 0}},       {'g', {0, 0, 15, 17, 17, 15, 1, 14, 0}},
    {'h', {16, 16, 22, 25, 17, 17, 17, 0, 0}}, {'i', {4, 0, 12, 4, 4, 4, 14, 0, 0}},
    {'j', {2, 0, 6, 2, 2, 2, 2, 18, 12}},      {'k', {16, 16, 18, 20, 24, 20, 18, 0, 0}},
    {'l', {12, 4, 4, 4, 4, 4, 14, 0, 0}},      {'m', {0, 0, 26, 21, 21, 21, 21, 0, 0}},
    {'n', {0, 0, 22, 25, 17, 17, 17, 0, 0}},   {'o', {0, 0, 14, 17, 17, 17, 14, 0, 0}},
    {'p', {0, 0, 30, 17, 17, 17, 30, 16, 16}}, {'q', {0, 0, 15, 17, 17, 17, 15, 1, 1}},
    {'r', {0, 0, 22, 25, 16, 16, 16, 0, 0}},   {'s', {0, 0, 14, 16, 14, 1, 30, 0, 0}},
    {'t', {8, 8, 28, 8, 8, 9, 6, 0, 0}},       {'u', {0, 0, 17, 17, 17, 19, 13, 0, 0}},
    {'v', {0, 0, 17, 17, 17, 10, 4, 0, 0}},    {'w', {0, 0, 17, 17, 21, 21, 10, 0, 0}},
    {'x', {0, 0, 17, 10, 4, 10, 17, 0, 0}},    {'y', {0, 0, 17, 17, 17, 17, 15, 1, 14}},
    {'z', {0, 0, 31, 2, 4, 8, 31, 0, 0}},      {'<', {3, 12, 16, 12, 3, 0, 31, 0, 0}},
    {'>', {24, 6, 1, 6, 24, 0, 31, 0, 0}},     {'A', {14, 17, 17, 31, 17, 17, 17, 0, 0}},
    {'B', {30, 17, 17, 30, 17, 17, 30, 0, 0}}, {'C', {14, 17, 16, 16, 16, 17, 14, 0, 0}},
    {'D', {28, 18, 17, 17, 17, 18, 28, 0, 0}}, {'E', {31, 16, 16, 30, 16, 16, 31, 0, 0}},
    {'F', {31, 16, 16, 30, 16, 16, 16, 0, 0}}, {'G', {14, 17, 16, 23, 17, 17, 15, 0, 0}},
    {'H', {17, 17, 17, 31, 17, 17, 17, 0, 0}}, {'I', {14, 4, 4, 4, 4, 4, 14, 0, 0}},
    {'J', {7, 2, 2, 2, 2, 18, 12, 0, 0}},      {'K', {17, 18, 20, 24, 20, 18, 17, 0, 0}},
    {'L', {16, 16, 16, 16, 16, 16, 31, 0, 0}}, {'M', {17, 27, 21, 21, 17, 17, 17, 0, 0}},
    {'N', {17, 17, 25, 21, 19, 17, 17, 0, 0}}, {'O', {14, 17, 17, 17, 17, 17, 14, 0, 0}},
    {'P', {30, 17, 17, 30, 16, 16, 16, 0, 0}}, {'Q', {14, 17, 17, 17, 21, 18, 13, 0, 0}},
    {'R', {30, 17, 17, 30, 20, 18, 17, 0, 0}}, {'S', {15, 16, 16, 14, 1, 1, 30, 0, 0}},
    {'T', {31, 4, 4, 4, 4, 4, 4, 0, 0}},       {'U', {17, 17, 17, 17, 17, 17, 14, 0, 0}},
    {'V', {17, 17, 17, 17, 17, 10, 4, 0, 0}},  {'W', {17, 17, 17, 21, 21, 21, 10, 0, 0}},
    {'X', {17, 17, 10, 4, 10, 17, 17, 0, 0}},  {'Y', {17, 17, 17, 10, 4, 4, 4, 0, 0}},
    {'Z', {31, 1, 2, 4, 8, 16, 31, 0, 0}},     {'_', {0, 0, 0, 0, 0, 0, 0, 31, 0}},
    {'(', {2, 4, 8, 8, 8, 4, 2, 0, 0}},        {')', {8, 4, 2, 2, 2, 4, 8, 0, 0}},
    {'%', {24, 25, 2, 4, 8, 19, 3, 0, 0}},
}};

void fill(Image& image, int x0, int y0, int size, const Rgb& colour) {
  for (int y = std::max(0, y0); y < std::min(image.height, y0 + size); ++y) {
    for (int x = std::max(0, x0); x < std::min(image.width, x0 + size); ++x) {
      std::copy_n(colour.data(), 3, image.pixel(x, y));
    }
  }
}

}  // namespace

int text_width(std::string_view text, int scale) {
  return static_cast<int>(text.size()) * advance * scale - (advance - column_count) * scale;
}

int text_height(int scale) { return row_count * scale; }

void draw_text(Image& image, std::string_view text, int x, int y, int scale, const Rgb& colour) {
  for (const char letter : text) {
    const auto glyph = std::find_if(glyphs.begin(), glyphs.end(),
                                    [&](const Glyph& g) { return g.letter == letter; });
    for (int dot = 0; glyph != glyphs.end() && dot < row_count * column_count; ++dot) {
      const int row = dot / column_count, column = dot % column_count;
      if (glyph->rows[static_cast<size_t>(row)] >> (column_count - 1 - column) & 1) {
        fill(image, x + column * scale, y + row * scale, scale, colour);
      }
    }
    x += advance * scale;
  }
}

}  // namespace sphparam
