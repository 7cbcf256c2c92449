#include "report/svg.h"

#include <array>
#include <charconv>
#include <cmath>

#include "embedded/plot.css.h"

namespace sphparam {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        // XML has no way to write the other control characters.
        if (static_cast<unsigned char>(c) >= 0x20) out += c;
    }
  }
  return out;
}

std::string svg_begin(int width, int height, std::string_view title) {
  const std::string w = std::to_string(width), h = std::to_string(height);
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h +
         "\" viewBox=\"0 0 " + w + " " + h + "\" role=\"img\">\n<title>" + escaped(title) +
         "</title>\n" + "<style>\n" + std::string(embedded::plot_css) + "</style>\n" +
         "<rect class=\"page\" width=\"" + w + "\" height=\"" + h + "\"/>\n";
}

std::string svg_end() { return "</svg>\n"; }

std::string decimal(double value, int decimals) {
  if (std::isinf(value)) return value > 0 ? "∞" : "−∞";
  std::array<char, 400> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::fixed, decimals);
  std::string text(buffer.data(), end.ptr);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string significant(double value) {
  if (std::isinf(value)) return decimal(value, 0);
  std::array<char, 40> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::general, 3);
  return {buffer.data(), end.ptr};
}

std::string grouped(long count) {
  std::string text = std::to_string(count);
  for (auto i = static_cast<long>(text.size()) - 3; i > 0; i -= 3) {
    text.insert(static_cast<size_t>(i), "\u202f");
  }
  return text;
}

std::string svg_text(double x, double y, std::string_view css_class, std::string_view anchor,
                     std::string_view text) {
  return "<text x=\"" + decimal(x, 1) + "\" y=\"" + decimal(y, 1) + "\" class=\"" +
         std::string(css_class) + "\" text-anchor=\"" + std::string(anchor) + "\">" +
         escaped(text) + "</text>\n";
}

std::string svg_line(double x1, double y1, double x2, double y2, std::string_view css_class) {
  return "<line x1=\"" + decimal(x1, 1) + "\" y1=\"" + decimal(y1, 1) + "\" x2=\"" +
         decimal(x2, 1) + "\" y2=\"" + decimal(y2, 1) + "\" class=\"" + std::string(css_class) +
         "\"/>\n";
}

}  // namespace sphparam
