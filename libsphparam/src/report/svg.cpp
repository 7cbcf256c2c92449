#include "report/svg.h"

#include <array>
#include <charconv>
#include <cmath>

namespace sphparam {
namespace {

// Blue and red are the paper's; the dark page's are their lighter sisters.
constexpr std::string_view kStyle = R"(<style>
text{font-family:system-ui,"DejaVu Sans",Helvetica,Arial,sans-serif;fill:#1f2328}
.title{font-size:17px;font-weight:600}
.label{font-size:11px;fill:#59636e}
.caption{font-size:12.5px}
.page{fill:#ffffff}
.grid{fill:none;stroke:#d1d9e0;stroke-width:1}
.axis{fill:none;stroke:#818b98;stroke-width:1}
.optimum{fill:none;stroke:#12963f;stroke-width:2}
.optimal{fill:#12963f}
.halo{stroke:#ffffff;stroke-width:3px;stroke-linejoin:round;paint-order:stroke}
.series0{fill:#1f5fd0;stroke:#1f5fd0}
.series1{fill:#d1242f;stroke:#d1242f}
@media (prefers-color-scheme:dark){
text{fill:#e6edf3}
.label{fill:#9198a1}
.page{fill:#0d1117}
.grid{stroke:#3d444d}
.axis{stroke:#656c76}
.optimum{stroke:#3fb950}
.optimal{fill:#3fb950}
.halo{stroke:#0d1117}
.series0{fill:#6cb0ff;stroke:#6cb0ff}
.series1{fill:#ff7b72;stroke:#ff7b72}
}
</style>
)";

}  // namespace

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
         "</title>\n" + std::string(kStyle) + "<rect class=\"page\" width=\"" + w + "\" height=\"" +
         h + "\"/>\n";
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
