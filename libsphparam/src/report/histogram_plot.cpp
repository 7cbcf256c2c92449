#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "elementary.h"
#include "report/plots.h"
#include "report/svg.h"

// Fixed bins, so that charts of different maps compare at a glance.

namespace sphparam {
namespace {

constexpr int full_width = 960;
constexpr double top = 48, full_height = 220, panel_width = 400;
constexpr int bins = 34;  // 32 of equal width and one at each end for everything beyond

using Shares = std::array<double, bins>;

struct Panel {
  double left;
  int reach;  // bins cover ratios from 2^−reach to 2^reach, evenly in the logarithm
  int step;   // between ticks, powers of two
  const char* title;
};

/// Shares of the ratios by bin; the ends hold what is beyond, infinities included.
Shares shares(const std::vector<double>& ratios, int reach) {
  std::array<long, bins> counts{};
  for (const double ratio : ratios) {
    const double place = (elementary::log2(ratio) + reach) / (2 * reach) * (bins - 2) + 1;
    const auto bin = static_cast<size_t>(std::clamp(place, 0.0, bins - 1.0));
    ++counts[bin];
  }
  Shares result{};
  for (size_t b = 0; b < bins; ++b) {
    result[b] =
        static_cast<double>(counts[b]) / static_cast<double>(std::max<size_t>(ratios.size(), 1));
  }
  return result;
}

double bin_x(const Panel& panel, double bin) { return panel.left + bin * panel_width / bins; }

std::string bars(const Panel& panel, const Shares& values, double highest, size_t series) {
  std::string svg = "<g class=\"series" + std::to_string(series) +
                    "\" fill-opacity=\"0.4\" stroke-width=\"1\">\n";
  for (size_t b = 0; b < bins; ++b) {
    if (values[b] == 0) continue;
    const double height = values[b] / highest * full_height;
    const double x = bin_x(panel, static_cast<double>(b));
    svg += "<rect x=\"" + decimal(x + 0.5, 1) + "\" y=\"" + decimal(top + full_height - height, 1) +
           "\" width=\"" + decimal(panel_width / bins - 1, 1) + "\" height=\"" +
           decimal(height, 1) + "\"/>\n";
  }
  return svg + "</g>\n";
}

std::string axes(const Panel& panel, double highest) {
  const double right = panel.left + panel_width, bottom = top + full_height;
  std::string svg = svg_text(panel.left + panel_width / 2, 30, "title", "middle", panel.title);
  for (const double part : {0.5, 1.0}) {
    svg += svg_line(panel.left, bottom - part * full_height, right, bottom - part * full_height,
                    "grid");
    svg += svg_text(panel.left - 6, bottom - part * full_height + 4, "label", "end",
                    decimal(100 * part * highest, 1) + " %");
  }
  svg += svg_line(panel.left, bottom, right, bottom, "axis");
  for (int power = -panel.reach; power <= panel.reach; power += panel.step) {
    const double x = bin_x(panel, 1 + (bins - 2) * (power + panel.reach) / (2.0 * panel.reach));
    const std::string ratio = std::to_string(1 << std::abs(power));
    svg += svg_line(x, bottom, x, bottom + 4, "axis");
    svg += svg_text(x, bottom + 17, "label", "middle", power < 0 ? "1/" + ratio : ratio);
  }
  return svg + svg_text(panel.left + panel_width / 2, bottom + 34, "label", "middle",
                        "ratio, logarithmic; the outer bars hold everything beyond");
}

/// The top of the scale: the next 2 % above all bars.
double highest_of(const std::vector<Shares>& all) {
  double highest = 0;
  for (const Shares& one : all)
    highest = std::max(highest, *std::max_element(one.begin(), one.end()));
  return std::max(std::ceil(highest * 50) / 50, 0.02);
}

std::string draw_panel(const Panel& panel, const std::vector<Shares>& all, double highest) {
  std::string svg = axes(panel, highest);
  for (size_t s = all.size(); s-- > 0;) svg += bars(panel, all[s], highest, s);
  const double optimum = panel.left + panel_width / 2;
  return svg + svg_line(optimum, top, optimum, top + full_height, "optimum");
}

Shares shares(PlotMeasure measure, const PlotSeries& series, const Panel& panel) {
  return shares(plotted_ratios(measure, *series.distortion), panel.reach);
}

constexpr Panel area{64, 4, 1, "Area"}, angle{544, 3, 1, "Angle"};

}  // namespace

std::string histogram_plot(const std::vector<PlotSeries>& series) {
  if (series.empty() || series.size() > 2) {
    throw std::invalid_argument("histogram_plot: one or two series");
  }
  std::vector<Shares> areas, angles;
  for (const PlotSeries& one : series) {
    areas.push_back(shares(PlotMeasure::Area, one, area));
    angles.push_back(shares(PlotMeasure::Angle, one, angle));
  }
  const bool legend = series.size() > 1 || !series[0].label.empty();
  const int below = static_cast<int>(top + full_height) + 52;
  std::string svg = svg_begin(full_width, below + (legend ? 16 : 0), "Distortion histograms");
  svg += draw_panel(area, areas, highest_of(areas)) + draw_panel(angle, angles, highest_of(angles));
  for (size_t s = 0; legend && s < series.size(); ++s) {
    const double x = 64 + 480 * static_cast<double>(s);
    svg += "<circle cx=\"" + decimal(x + 5, 1) + "\" cy=\"" + decimal(below - 2, 1) +
           "\" r=\"5\" class=\"series" + std::to_string(s) + "\"/>\n";
    svg += svg_text(x + 18, below + 2, "caption", "start", series[s].label);
  }
  return svg + svg_end();
}

PlotPanel histogram_panel(PlotMeasure measure, const PlotSeries& series,
                          const std::vector<PlotSeries>& same_scale) {
  Panel panel = measure == PlotMeasure::Area ? area : angle;
  panel.left = 56;
  const Shares own = shares(measure, series, panel);
  std::vector<Shares> all = {own};
  for (const PlotSeries& other : same_scale) all.push_back(shares(measure, other, panel));
  const std::string title =
      std::string("Histogram of ") + (measure == PlotMeasure::Area ? "areas" : "angles");
  panel.title = title.c_str();
  const int width = static_cast<int>(panel.left + panel_width) + 24;
  return {title,
          svg_begin(width, static_cast<int>(top + full_height) + 44, title) +
              draw_panel(panel, {own}, highest_of(all)) + svg_end(),
          ""};
}

}  // namespace sphparam
