#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>

#include "report/plots.h"
#include "report/svg.h"

using namespace sphparam;
using Catch::Matchers::Contains;

namespace {

Distortion constant_distortion(int faces) {
  Distortion d;
  d.area_ratio.setOnes(faces);
  d.angle_ratio.setOnes(faces, 3);
  d.sigma_max.setOnes(faces);
  d.sigma_min.setOnes(faces);
  d.source_area.setConstant(faces, 1.0 / faces);
  return d;
}

/// Ratios all over the disk, so that every place of the chart is taken.
Distortion scattered_distortion(int faces) {
  Distortion d = constant_distortion(faces);
  for (int f = 0; f < faces; ++f) {
    d.area_ratio[f] = std::sqrt(std::fmod(f * 0.6180339887, 1.0)) * 3;
    for (int k = 0; k < 3; ++k)
      d.angle_ratio(f, k) = std::sqrt(std::fmod((3 * f + k) * 0.618, 1.0)) * 3;
  }
  return d;
}

long count(const std::string& text, const std::string& what) {
  long n = 0;
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

long dots(const std::string& svg) { return count(svg, "h0"); }

/// Every element opened is closed, in order.
bool balanced(const std::string& svg) {
  std::vector<std::string> open;
  for (size_t at = svg.find('<'); at != std::string::npos; at = svg.find('<', at + 1)) {
    const size_t end = svg.find('>', at);
    if (end == std::string::npos) return false;
    if (svg[end - 1] == '/') continue;
    const bool closes = svg[at + 1] == '/';
    const size_t from = at + (closes ? 2 : 1);
    const std::string name = svg.substr(from, svg.find_first_of(" >", from) - from);
    if (!closes) {
      open.push_back(name);
    } else if (open.empty() || open.back() != name) {
      return false;
    } else {
      open.pop_back();
    }
  }
  return open.empty();
}

}  // namespace

TEST_CASE("polar_plot: few values are all drawn, once in the chart and once in the zoom") {
  Distortion d = constant_distortion(100);  // 100 directions of a circle: no two dots meet
  const std::string svg = polar_plot(PlotMeasure::Area, {{"m", &d}});
  CHECK(dots(svg) == 200);
  CHECK(balanced(svg));
  CHECK_THAT(svg, Contains("mean |ln ratio| 0") && Contains("class=\"optimum\""));
}

TEST_CASE("polar_plot: an outlier is never lost, it is marked on the rim and counted") {
  Distortion d = constant_distortion(5000);
  CHECK_THAT(polar_plot(PlotMeasure::Area, {{"m", &d}}), Contains("; 0 beyond"));
  d.area_ratio[1234] = 1e6;
  CHECK_THAT(polar_plot(PlotMeasure::Area, {{"m", &d}}),
             Contains("; 1 beyond") && Contains("to 1e+06"));
  d.area_ratio[1234] = std::numeric_limits<double>::infinity();
  CHECK_THAT(polar_plot(PlotMeasure::Area, {{"m", &d}}), Contains("; 1 beyond") && Contains("∞"));
  d.area_ratio[1234] = 0.001;  // alone at the centre: a dot in each disk
  const long before = dots(polar_plot(PlotMeasure::Area, {{"m", &d}}));
  d.area_ratio[1234] = 1;
  CHECK(dots(polar_plot(PlotMeasure::Area, {{"m", &d}})) <= before - 2);
}

TEST_CASE(
    "polar_plot: any number of triangles gives a file of at most 1 MB that says what it shows") {
  const Distortion a = scattered_distortion(300000), b = scattered_distortion(200000);
  for (const PlotMeasure measure : {PlotMeasure::Area, PlotMeasure::Angle}) {
    const std::string svg = polar_plot(measure, {{"a", &a}, {"b", &b}});
    CHECK(svg.size() < 1'050'000);
    CHECK(dots(svg) > 20000);
    CHECK(balanced(svg));
  }
  CHECK_THAT(polar_plot(PlotMeasure::Angle, {{"a", &a}}), Contains("900\u202f000 angles"));
}

TEST_CASE("polar_plot: the radius is the ratio, the polar angle the index") {
  Distortion d = constant_distortion(4);
  d.area_ratio << 1, 0.5, 1, 1;
  const std::string svg = polar_plot(PlotMeasure::Area, {{"m", &d}});
  // The zoom is centred at (715, 262), radius 190 for ratio 2, in tenths of pixels; the second of
  // four values points up at half the optimum.
  CHECK_THAT(svg, Contains("M8100 2620h0") && Contains("M7150 2145h0") &&
                      Contains("M6200 2620h0") && Contains("M7150 3570h0"));
}

TEST_CASE("plots: two series have two colours, one or two are asked for") {
  const Distortion d = constant_distortion(10);
  const std::string one = polar_plot(PlotMeasure::Area, {{"m", &d}});
  const std::string two = polar_plot(PlotMeasure::Area, {{"m", &d}, {"n", &d}});
  CHECK(count(one, "class=\"series1\"") == 0);
  CHECK(count(two, "class=\"series1\"") > 0);
  CHECK_THROWS_AS(polar_plot(PlotMeasure::Area, {}), std::invalid_argument);
  CHECK_THROWS_AS(histogram_plot({{"", &d}, {"", &d}, {"", &d}}), std::invalid_argument);
}

TEST_CASE("plots: names are escaped, and control characters left out") {
  const Distortion d = constant_distortion(10);
  for (const PlotFile& file : write_plots("dir", "a<b>&\"c\"\x01", d)) {
    CHECK(balanced(file.svg));
    CHECK_THAT(file.svg, !Contains("a<b>") && !Contains("\x01"));
  }
}

TEST_CASE("histogram_plot: shares sum to one, infinities in the outer bars") {
  Distortion d = constant_distortion(8);
  d.area_ratio << 0, 1e-9, 1, 1, 1, 1, 1e9, std::numeric_limits<double>::infinity();
  const std::string svg = histogram_plot({{"m", &d}});
  CHECK(balanced(svg));
  // 25 % low end, 50 % in the middle, 25 % high end: with the angle panel's one bar, four bars.
  CHECK(count(svg, "<rect x=") == 4);
  CHECK_THAT(svg, Contains("50 %") && Contains(">1/16<") && Contains(">16<") && Contains(">1/8<"));
}

TEST_CASE("plots: triangles without area are not in them, nor in their means") {
  Distortion d = constant_distortion(4);
  d.source_area[2] = 0;
  d.area_ratio[1] = 5;
  d.area_ratio[2] = d.angle_ratio(2, 0) = 1e9;
  CHECK(plotted_ratios(PlotMeasure::Area, d) == std::vector<double>{1, 5, 1});
  CHECK(plotted_ratios(PlotMeasure::Angle, d) == std::vector<double>(9, 1.0));
  CHECK_THAT(polar_plot(PlotMeasure::Angle, {{"", &d}}), Contains("mean |ln ratio| 0,"));
}

TEST_CASE("write_plots: paths are made of directory and name, the same bytes each time") {
  const Distortion d = scattered_distortion(1000);
  const auto files = write_plots("out", "bunny", d);
  REQUIRE(files.size() == 3);
  CHECK(files[0].path == "out/bunny-area.svg");
  CHECK(files[1].path == "out/bunny-angle.svg");
  CHECK(files[2].path == "out/bunny-histogram.svg");
  CHECK(write_plots("out/", "bunny", d)[0].path == "out/bunny-area.svg");
  for (size_t i = 0; i < 3; ++i) CHECK((files[i].svg == write_plots("out", "bunny", d)[i].svg));
}

TEST_CASE("svg: numbers are short and independent of the locale") {
  CHECK(decimal(1.50, 2) == "1.5");
  CHECK(decimal(-0.001, 2) == "0");
  CHECK(decimal(100, 2) == "100");
  CHECK(significant(0.00012345) == "0.000123");
  CHECK(grouped(1234567) == "1\u202f234\u202f567");
  CHECK(grouped(999) == "999");
}

TEST_CASE("polar_panels: the dots of the chart, in pieces, with what is not to be seen") {
  Distortion d = constant_distortion(100);
  d.area_ratio[7] = 1e6;
  const std::vector<PlotPanel> panels = polar_panels(PlotMeasure::Area, {"m", &d});
  REQUIRE(panels.size() == 2);
  for (const PlotPanel& panel : panels) {
    CHECK(balanced(panel.svg));
    CHECK(dots(panel.svg) == 99);
    CHECK_THAT(panel.note, Contains("99 dots for the 99 of 100 triangles") && Contains("1 beyond"));
  }
}

TEST_CASE("polar_panels: with the maps they are compared with they have one rim") {
  const Distortion flat = constant_distortion(100);
  Distortion wild = constant_distortion(100);
  wild.area_ratio *= 70;
  const auto rim = [](const PlotPanel& panel) { return panel.note.substr(panel.note.find("up")); };
  const PlotSeries one{"one", &flat}, two{"two", &wild};
  const auto alone = polar_panels(PlotMeasure::Area, one);
  const auto first = polar_panels(PlotMeasure::Area, one, {one, two});
  const auto second = polar_panels(PlotMeasure::Area, two, {one, two});
  CHECK(rim(first[0]) == rim(second[0]));
  CHECK(rim(first[0]) != rim(alone[0]));
}

TEST_CASE("histogram_panel: bars have the scale of the highest of all maps") {
  const Distortion flat = constant_distortion(100), scattered = scattered_distortion(100);
  const PlotSeries one{"one", &flat}, two{"two", &scattered};
  CHECK_THAT(histogram_panel(PlotMeasure::Area, two, {one}).svg, Contains(">100 %<"));
  CHECK_THAT(histogram_panel(PlotMeasure::Area, two).svg, !Contains(">100 %<"));
  CHECK(balanced(histogram_panel(PlotMeasure::Angle, two).svg));
}
