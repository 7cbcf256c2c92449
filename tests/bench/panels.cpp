#include "panels.h"

#include <algorithm>
#include <cmath>

#include "report/svg.h"

namespace sphparam::bench {

std::string PanelRow::title(double origin, const std::string& text) const {
  return svg_text(origin + width / 2, 30, "title", "middle", text);
}

std::string PanelRow::caption(double origin, const std::string& text) const {
  return svg_text(origin + width / 2, bottom() + 36, "label", "middle", text);
}

std::string PanelRow::column(double x, const std::string& label) const {
  return svg_line(x, top, x, bottom(), "grid") + column_label(x, label);
}

std::string PanelRow::column_label(double x, const std::string& label) const {
  return svg_text(x, bottom() + 17, "label", "middle", label);
}

std::string PanelRow::row(double origin, double y, const std::string& label) const {
  return svg_line(origin, y, origin + width, y, "grid") +
         svg_text(origin - 6, y + 4, "label", "end", label);
}

std::string PanelRow::plot(const std::string& title, const std::vector<std::string>& panels) const {
  std::string svg =
      svg_begin(static_cast<int>(origin(panels.size())), static_cast<int>(bottom()) + 50, title);
  for (const std::string& panel : panels) svg += panel;
  return svg + svg_end();
}

double log_share(double value, double least, double greatest) {
  return std::clamp(std::log(value / least) / std::log(greatest / least), 0.0, 1.0);
}

std::string svg_dot(double x, double y, double radius, const std::string& series) {
  return "<circle cx=\"" + decimal(x, 1) + "\" cy=\"" + decimal(y, 1) + "\" r=\"" +
         decimal(radius, 1) + "\" class=\"" + series + "\"/>\n";
}

std::string svg_path(const std::vector<std::array<double, 2>>& points, const std::string& series,
                     const std::string& style) {
  std::string path;
  for (const auto& [x, y] : points) {
    path.append(path.empty() ? "M" : "L").append(decimal(x, 1)).append(" ").append(decimal(y, 1));
  }
  return "<path d=\"" + path + "\" class=\"" + series + "\" style=\"fill:none" + style + "\"/>\n";
}

}  // namespace sphparam::bench
