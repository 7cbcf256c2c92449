#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "elementary.h"
#include "report/plots.h"
#include "report/svg.h"

// Paper, Section 6: "the values are placed using the distortion value as the radius and the
// triangle or angle index as the polar angle". A large mesh has more values than the picture has
// places: the disk is a grid of cells one dot wide, and a cell shows the first value that falls in
// it, darker the more there are. So nothing that stands alone is ever left out.

namespace sphparam {
namespace {

constexpr int full_width = 960, panel_width = 440;
constexpr double radius = 190, centre_y = 262;
constexpr double cell_size = 2.5;  // pixels, a little more than a dot
constexpr double rim_gap = 3;      // between the rim, the marks of the first series, of the second
constexpr double rim_mark = 5;     // how long such marks are
constexpr double rim_step = 0.5;   // degrees between them
constexpr double rim_band = 2 * (rim_gap + rim_mark);
constexpr double line_height = 17;
constexpr double caption_height = 3 * line_height + 9;  // of one series

struct Values {
  std::string label;
  std::vector<double> ratios;  // of triangles that have an area

  long count() const { return std::ssize(ratios); }
  double operator[](long i) const { return ratios[static_cast<size_t>(i)]; }
};

Values values_of(PlotMeasure measure, const PlotSeries& series) {
  return {series.label, plotted_ratios(measure, *series.distortion)};
}

/// The rim of the full chart: a round number that 99.8 % of the values of every series reach.
double rim_radius(const std::vector<Values>& all) {
  double reach = 0;
  for (const Values& values : all) {
    if (values.count() == 0) continue;
    std::vector<double> sorted = values.ratios;
    const auto rank = static_cast<long>(0.998 * static_cast<double>(values.count() - 1));
    std::nth_element(sorted.begin(), sorted.begin() + rank, sorted.end());
    reach = std::max(reach, sorted[static_cast<size_t>(rank)]);
  }
  for (double decade = 1; decade < 1e12; decade *= 10) {
    for (const double step : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0}) {
      if (step * decade >= 3 && step * decade >= reach) return step * decade;
    }
  }
  return 1e12;
}

/// The distance between grid circles: at most six of them.
double ring_step(double rim) {
  for (double decade = 0.1;; decade *= 10) {
    for (const double step : {1.0, 2.0, 5.0}) {
      if (rim / (step * decade) <= 6) return step * decade;
    }
  }
}

/// One disk: where it is and what its rim means.
struct Disk {
  double centre_x;
  double rim;

  double pixels(double ratio) const { return ratio / rim * radius; }
};

/// What was drawn of a series.
struct Shown {
  long inside = 0;
  long dots = 0;
  long beyond = 0;
};

std::string circle(const Disk& disk, double ratio, const char* css_class) {
  return "<circle cx=\"" + decimal(disk.centre_x, 1) + "\" cy=\"" + decimal(centre_y, 1) +
         "\" r=\"" + decimal(disk.pixels(ratio), 2) + "\" class=\"" + css_class + "\"/>\n";
}

/// Grid circles and the four quarters of the index.
std::string frame(const Disk& disk) {
  std::string svg;
  const double x = disk.centre_x, step = ring_step(disk.rim);
  svg += svg_line(x - radius, centre_y, x + radius, centre_y, "grid");
  svg += svg_line(x, centre_y - radius, x, centre_y + radius, "grid");
  for (int i = 1; i * step < disk.rim * (1 - 1e-9); ++i) svg += circle(disk, i * step, "grid");
  svg += circle(disk, disk.rim, "axis");
  const double out = radius + rim_band + 5;
  svg += svg_text(x + out, centre_y + 4, "label", "start", "0");
  svg += svg_text(x, centre_y - out, "label", "middle", "¼");
  svg += svg_text(x - out, centre_y + 4, "label", "end", "½");
  svg += svg_text(x, centre_y + out + 8, "label", "middle", "¾");
  return svg;
}

/// The optimum and the ratios of the circles, on top of the dots.
std::string scale(const Disk& disk) {
  std::string svg = circle(disk, 1, "optimum");
  const double diagonal = std::numbers::sqrt2 / 2;
  const auto label = [&](double ratio, double pixels) {
    const bool optimum = std::abs(ratio - 1) < 1e-9;
    svg += svg_text(disk.centre_x + pixels * diagonal + 2, centre_y - pixels * diagonal - 2,
                    optimum ? "label halo optimal" : "label halo", "start", decimal(ratio, 1));
  };
  const double step = ring_step(disk.rim);
  for (int i = 1; i * step < disk.rim * (1 - 1e-9); ++i) label(i * step, disk.pixels(i * step));
  label(disk.rim, radius + rim_band);
  return svg;
}

/// A path of zero-length strokes, which round caps turn into dots; coordinates in tenths.
void add_dot(std::string& path, double x, double y) {
  path +=
      'M' + std::to_string(std::lround(10 * x)) + ' ' + std::to_string(std::lround(10 * y)) + "h0";
}

struct Cell {
  long first = -1;  // index of the value that is drawn
  long count = 0;
};

class DotGrid {
 public:
  explicit DotGrid(const Disk& disk) : disk_(disk), cells_(static_cast<size_t>(side_ * side_)) {}

  void add(const Values& values, long i) {
    const auto [x, y] = place(values, i);
    const auto column = static_cast<long>((x - disk_.centre_x + radius) / cell_size);
    const auto row = static_cast<long>((y - centre_y + radius) / cell_size);
    Cell& cell = cells_[static_cast<size_t>(row * side_ + column)];
    if (cell.count++ == 0) cell.first = i;
  }

  /// Three paths by how many values share the dot.
  std::string draw(const Values& values, Shown& shown) const {
    std::array<std::string, 3> paths;
    for (const Cell& cell : cells_) {
      if (cell.count == 0) continue;
      ++shown.dots;
      const auto [x, y] = place(values, cell.first);
      add_dot(paths[cell.count >= 8 ? 2 : cell.count >= 2 ? 1 : 0], x, y);
    }
    std::string svg;
    constexpr std::array<const char*, 3> opacity{"0.45", "0.7", "1"};
    for (size_t k = 0; k < 3; ++k) {
      if (paths[k].empty()) continue;
      svg += std::string("<path stroke-opacity=\"") + opacity[k] + "\" d=\"" + paths[k] + "\"/>\n";
    }
    return svg;
  }

 private:
  /// (ratio, index) in polar coordinates; y of the picture points down.
  std::array<double, 2> place(const Values& values, long i) const {
    const double angle =
        2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(values.count());
    const double r = disk_.pixels(values[i]);
    return {disk_.centre_x + r * elementary::cos(angle), centre_y - r * elementary::sin(angle)};
  }

  static constexpr long side_ = static_cast<long>(2 * radius / cell_size) + 2;
  Disk disk_;
  std::vector<Cell> cells_;
};

/// Short strokes outside the rim, one a half degree at most; each series has its own band.
std::string rim_marks(const Disk& disk, const Values& values, size_t series) {
  const double inner = radius + rim_gap + static_cast<double>(series) * (rim_gap + rim_mark);
  std::vector<char> marked(static_cast<size_t>(360 / rim_step) + 1, 0);
  for (long i = 0; i < values.count(); ++i) {
    if (values[i] <= disk.rim) continue;
    const double turn = static_cast<double>(i) / static_cast<double>(values.count());
    marked[static_cast<size_t>(turn * 360 / rim_step)] = 1;
  }
  std::string path;
  for (size_t k = 0; k < marked.size(); ++k) {
    if (!marked[k]) continue;
    const double angle = (static_cast<double>(k) + 0.5) * rim_step * std::numbers::pi / 180;
    const auto point = [&](double r) {
      return std::to_string(std::lround(10 * (disk.centre_x + r * elementary::cos(angle)))) + ' ' +
             std::to_string(std::lround(10 * (centre_y - r * elementary::sin(angle))));
    };
    path += 'M' + point(inner) + 'L' + point(inner + rim_mark);
  }
  return path.empty() ? "" : "<path d=\"" + path + "\"/>\n";
}

std::string draw_series(const Disk& disk, const Values& values, size_t index, Shown& shown) {
  DotGrid grid(disk);
  for (long i = 0; i < values.count(); ++i) {
    if (!(values[i] <= disk.rim)) {
      ++shown.beyond;
      continue;
    }
    ++shown.inside;
    grid.add(values, i);
  }
  std::string svg = "<g class=\"series" + std::to_string(index) +
                    "\" transform=\"scale(0.1)\" stroke-width=\"19\" stroke-linecap=\"round\">\n";
  svg += grid.draw(values, shown);
  svg += rim_marks(disk, values, index);
  return svg + "</g>\n";
}

std::string key(size_t index, double y) {
  return "<circle cx=\"46\" cy=\"" + decimal(y - 4, 1) + "\" r=\"5\" class=\"series" +
         std::to_string(index) + "\"/>\n";
}

const char* noun_of(PlotMeasure measure) {
  return measure == PlotMeasure::Area ? "triangles" : "angles";
}

const char* title_of(PlotMeasure measure) {
  return measure == PlotMeasure::Area ? "Area distortion" : "Angle distortion";
}

/// What a reader must know to trust the picture: what is not to be seen.
std::string account(const char* noun, const Values& values, const Shown& shown, double reach) {
  return grouped(shown.dots) + " dots for the " + grouped(shown.inside) + " of " +
         grouped(values.count()) + " " + noun + " up to " + decimal(reach, 1) + "; " +
         grouped(shown.beyond) + " beyond, marked on the rim";
}

std::string caption(const char* noun, const Values& values, size_t index, double rim,
                    const Shown& full, const Shown& zoom, double y) {
  double sum = 0, smallest = INFINITY, largest = 0;
  long within = 0;
  for (long i = 0; i < values.count(); ++i) {
    sum += std::abs(elementary::log(values[i]));
    smallest = std::min(smallest, values[i]);
    largest = std::max(largest, values[i]);
    within += values[i] >= 0.5 && values[i] <= 2 ? 1 : 0;
  }
  const double count = static_cast<double>(std::max(values.count(), 1L));
  const std::string name = values.label.empty() ? "" : values.label + ": ";
  std::string svg = key(index, y);
  svg += svg_text(58, y, "caption", "start",
                  name + "mean |ln ratio| " + significant(sum / count) + ", " +
                      decimal(100 * static_cast<double>(within) / count, 1) +
                      " % within [½, 2], from " + significant(smallest) + " to " +
                      significant(largest));
  const auto note = [&](int line, const char* side, const Shown& shown, double reach) {
    svg += svg_text(58, y + line * line_height, "label", "start",
                    side + account(noun, values, shown, reach));
  };
  note(1, "Left: ", full, rim);
  note(2, "Right: ", zoom, 2);
  return svg;
}

}  // namespace

std::string polar_plot(PlotMeasure measure, const std::vector<PlotSeries>& series) {
  if (series.empty() || series.size() > 2) {
    throw std::invalid_argument("polar_plot: one or two series");
  }
  std::vector<Values> all;
  for (const PlotSeries& one : series) all.push_back(values_of(measure, one));
  const bool area = measure == PlotMeasure::Area;
  const std::string title = title_of(measure);
  const double rim = rim_radius(all), first_line = centre_y + radius + 62;
  const std::array<Disk, 2> disks{Disk{245, rim}, Disk{715, 2}};

  const int height =
      static_cast<int>(first_line + caption_height * static_cast<double>(all.size())) + 14;
  std::string svg = svg_begin(full_width, height, title);
  svg += svg_text(disks[0].centre_x, 30, "title", "middle", title);
  svg += svg_text(disks[1].centre_x, 30, "title", "middle", "Zoom on the optimal region");
  std::array<std::vector<Shown>, 2> shown;
  for (size_t k = 0; k < 2; ++k) {
    svg += frame(disks[k]);
    shown[k].resize(all.size());
    // The first series on top: it is ours.
    for (size_t s = all.size(); s-- > 0;) svg += draw_series(disks[k], all[s], s, shown[k][s]);
    svg += scale(disks[k]);
  }
  for (size_t s = 0; s < all.size(); ++s) {
    svg += caption(noun_of(measure), all[s], s, rim, shown[0][s], shown[1][s],
                   first_line + caption_height * static_cast<double>(s));
  }
  svg +=
      svg_text(58, height - 14, "label", "start",
               std::string("Radius: result / input, 1 (green) is perfect. Polar angle: ") +
                   (area ? "triangle" : "angle") +
                   " index. A dot is one value, darker from 2 and from 8 on that fall together.");
  return svg + svg_end();
}

std::vector<PlotPanel> polar_panels(PlotMeasure measure, const PlotSeries& series,
                                    const std::vector<PlotSeries>& same_scale) {
  const Values values = values_of(measure, series);
  std::vector<Values> all = {values};
  for (const PlotSeries& other : same_scale) all.push_back(values_of(measure, other));
  const double centre = panel_width / 2.0, rim = rim_radius(all);
  const auto panel = [&](const std::string& title, const Disk& disk) {
    Shown shown;
    std::string svg =
        svg_begin(panel_width, static_cast<int>(centre_y + radius + rim_band) + 26, title);
    svg += svg_text(centre, 30, "title", "middle", title);
    svg += frame(disk) + draw_series(disk, values, 0, shown) + scale(disk) + svg_end();
    return PlotPanel{title, std::move(svg), account(noun_of(measure), values, shown, disk.rim)};
  };
  return {panel(title_of(measure), {centre, rim}),
          panel("Zoom on the optimal region", {centre, 2})};
}

}  // namespace sphparam
