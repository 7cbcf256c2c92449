#pragma once

#include <string>
#include <string_view>

namespace sphparam {

/// The first and last lines of every chart: size, title for screen readers, styles for light and
/// dark pages. Classes: `title`, `label`, `caption` for text, `grid`, `axis`, `optimum` for lines,
/// `series0` and `series1` for the colours of the data.
std::string svg_begin(int width, int height, std::string_view title);
std::string svg_end();

/// Text as it can stand in XML and HTML, in attributes too; control characters are left out.
std::string escaped(std::string_view text);

/// A number with at most `decimals` places, without trailing zeros; "∞" where it is.
std::string decimal(double value, int decimals);

/// A number with three significant digits: 0.00213, 31.4, 1.2e-09.
std::string significant(double value);

/// 70000 → "70 000", with thin spaces.
std::string grouped(long count);

/// One line of text. `anchor` is start, middle or end.
std::string svg_text(double x, double y, std::string_view css_class, std::string_view anchor,
                     std::string_view text);

/// A straight line.
std::string svg_line(double x1, double y1, double x2, double y2, std::string_view css_class);

}  // namespace sphparam
