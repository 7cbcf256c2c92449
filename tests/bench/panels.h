#pragma once

#include <array>
#include <string>
#include <vector>

namespace sphparam::bench {

/// Panels of one size in a row, in pixels: the frame of the studies' plots. Panels are SVG.
struct PanelRow {
  double width, height;  // of a panel's axes
  double left, gap;      // before the first panel, and after each
  double top = 48;

  double origin(size_t panel) const { return left + static_cast<double>(panel) * (width + gap); }
  double bottom() const { return top + height; }
  /// `share` of the way up an axis, which is as far as it goes.
  double height_at(double share) const { return top + height * (1 - share); }

  /// What stands over the axes, and below them.
  std::string title(double origin, const std::string& text) const;
  std::string caption(double origin, const std::string& text) const;
  /// A value on an axis, and its line of the grid.
  std::string column(double x, const std::string& label) const;
  std::string row(double origin, double y, const std::string& label) const;
  /// A value alone.
  std::string column_label(double x, const std::string& label) const;

  std::string plot(const std::string& title, const std::vector<std::string>& panels) const;
};

/// Where a value is between two on a logarithmic axis: 0 to 1.
double log_share(double value, double least, double greatest);

/// `series` is a class of `svg_begin`'s; `style` is added to that of the line.
std::string svg_dot(double x, double y, double radius, const std::string& series);
std::string svg_path(const std::vector<std::array<double, 2>>& points, const std::string& series,
                     const std::string& style = "");

}  // namespace sphparam::bench
