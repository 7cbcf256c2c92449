#include "batch/distribution.h"

#include <algorithm>
#include <cmath>

#include "elementary.h"
#include "number_text.h"
#include "report/svg.h"
#include "sphparam/parallel.h"

namespace sphparam {

namespace {

constexpr int width = 640, height = 220, left = 16, right = 16, top = 42, bottom = 42;
constexpr int bar_count = 40;
constexpr double far_out = 1.5;  // Tukey's fences, in distances of the quartiles

double quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

/// Of logarithms; shapes that are all alike have one of their own all the same.
double spread(const Distribution& d) {
  constexpr double least = 0.01;
  return std::max(elementary::log(d.upper_quartile / d.lower_quartile), least);
}

/// Where values stand, logarithmically.
class Axis {
 public:
  Axis(double low, double high) : low_(low), octaves_(elementary::log(high / low)) {}
  double at(double value) const {
    const double share = octaves_ > 0 ? elementary::log(value / low_) / octaves_ : 0.5;
    return left + share * (width - left - right);
  }

 private:
  double low_, octaves_;
};

std::string rectangle(double x, double y, double w, double h) {
  return "<rect class=\"bar\" x=\"" + decimal(x, 1) + "\" y=\"" + decimal(y, 1) + "\" width=\"" +
         decimal(w, 1) + "\" height=\"" + decimal(h, 1) + "\"/>\n";
}

std::string bars(const Distribution& d, const Axis& axis) {
  std::vector<int> counts(bar_count, 0);
  const double step = static_cast<double>(width - left - right) / bar_count;
  for (const double value : d.values) {
    const int bar = static_cast<int>((axis.at(value) - left) / step);
    ++counts[std::clamp(bar, 0, bar_count - 1)];
  }
  const double most = *std::ranges::max_element(counts);
  std::string svg;
  for (int i = 0; i < bar_count; ++i) {
    const double h = (height - top - bottom) * counts[i] / most;
    if (h > 0) svg += rectangle(left + i * step, height - bottom - h, step - 1, h);
  }
  return svg;
}

std::string mark(const Axis& axis, double value, const std::string& id) {
  return "<a href=\"#" + escaped(id) + "\"><circle class=\"outlier\" cx=\"" +
         decimal(axis.at(value), 1) + "\" cy=\"" + std::to_string(height - bottom) +
         "\" r=\"5\"><title>" + escaped(id) + ": " + significant(value) + "</title></circle></a>\n";
}

/// The numbers that people read: the ends and the quartiles, where there is room between.
std::string numbers(const Distribution& d, const Axis& axis, double low, double high) {
  std::string svg;
  std::vector<double> taken;
  for (const double value : {low, high, d.median, d.lower_quartile, d.upper_quartile}) {
    const double x = axis.at(value);
    constexpr double room = 48;
    const bool free = std::ranges::none_of(taken, [&](double t) { return std::abs(t - x) < room; });
    if (!free) continue;
    taken.push_back(x);
    const char* const anchor = x < left + room / 2            ? "start"
                               : x > width - right - room / 2 ? "end"
                                                              : "middle";
    svg += svg_text(x, height - bottom + 22, "label", anchor, significant(value));
  }
  return svg;
}

}  // namespace

Distribution distribution_of(const std::vector<std::optional<double>>& values) {
  Distribution d;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!values[i] || !std::isfinite(*values[i]) || *values[i] <= 0) continue;
    d.items.push_back(i);
    d.values.push_back(*values[i]);
  }
  if (d.values.empty()) return d;
  std::vector<double> sorted = d.values;
  std::ranges::sort(sorted);
  d.lower_quartile = quantile(sorted, 0.25);
  d.median = quantile(sorted, 0.5);
  d.upper_quartile = quantile(sorted, 0.75);
  d.outlier_from = d.upper_quartile * elementary::exp(far_out * spread(d));
  return d;
}

double outlyingness(const Distribution& d, double value) {
  if (d.values.empty() || !(value > 0)) return 0;
  return elementary::log(value / d.upper_quartile) / spread(d);
}

std::string distribution_plot(const Distribution& d, const std::string& title,
                              const std::vector<std::string>& names) {
  std::string svg = svg_begin(width, height, title);
  svg += svg_text(left, 20, "title", "start", title);
  if (d.values.empty()) return svg + svg_text(left, 60, "label", "start", "no values") + svg_end();
  const auto [low, high] = std::ranges::minmax(d.values);
  const Axis axis(low, high);
  svg += bars(d, axis);
  svg += svg_line(left, height - bottom, width - right, height - bottom, "axis");
  for (const double quartile : {d.lower_quartile, d.median, d.upper_quartile})
    svg += svg_line(axis.at(quartile), top, axis.at(quartile), height - bottom, "grid");
  svg += numbers(d, axis, low, high);
  std::vector<std::pair<double, std::string>> outliers;
  for (std::size_t i = 0; i < d.values.size(); ++i)
    if (d.values[i] > d.outlier_from) outliers.emplace_back(d.values[i], names[d.items[i]]);
  std::ranges::sort(outliers, std::ranges::greater{});
  for (const auto& [value, id] : outliers) svg += mark(axis, value, id);
  svg += svg_text(left, height - 4, "caption", "start",
                  counted(std::ssize(d.values), "shape") + ", median " + significant(d.median) +
                      "; " + counted(std::ssize(outliers), "outlier") + " beyond " +
                      significant(d.outlier_from));
  return svg + svg_end();
}

}  // namespace sphparam
