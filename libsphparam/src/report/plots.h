#pragma once

#include <string>
#include <vector>

#include "sphparam/sphere/distortion.h"

namespace sphparam {

/// One map in a plot.
struct PlotSeries {
  std::string label;             // shown in the legend and in captions
  const Distortion* distortion;  // never null; not owned
};

/// A plot as text: where it belongs and what to put there.
struct PlotFile {
  std::string path;
  std::string svg;  // self-contained SVG 1.1, UTF-8
};

enum class PlotMeasure { Area, Angle };

/// The ratios that a plot shows: triangle by triangle or corner by corner, of triangles that have
/// an area.
std::vector<double> plotted_ratios(PlotMeasure measure, const Distortion& distortion);

/// The polar plot of the paper (its "polar chart"): the ratio is the radius, the triangle or corner
/// index the polar angle, the optimum 1 a green circle; beside it a zoom on the optimal region [0,
/// 2].
///
/// One or two series (blue, red). A value is left out only where its dot would cover another one's;
/// values beyond the rim are marked on it and counted in the caption. Readable on light and dark
/// pages. Same bytes for the same input; at most about 1 MB at any number of triangles.
/// Paper: Section 6, Figures 10 and 11.
std::string polar_plot(PlotMeasure measure, const std::vector<PlotSeries>& series);

/// Shares of triangles by area ratio (1/16 to 16) and of corners by angle ratio (1/8 to 8), side by
/// side, logarithmic; the end bars hold everything beyond. One or two series.
std::string histogram_plot(const std::vector<PlotSeries>& series);

/// A part of a plot with a place of its own on a page, so that it can be read on a phone.
struct PlotPanel {
  std::string title;
  std::string svg;   // as of a plot
  std::string note;  // what a reader must know to trust it; may be empty
};

/// The two disks of a polar plot of one map: all values, and the zoom. The rim of the first is
/// that of a plot with the maps of `same_scale` in it, so that their disks compare.
std::vector<PlotPanel> polar_panels(PlotMeasure measure, const PlotSeries& series,
                                    const std::vector<PlotSeries>& same_scale = {});

/// One half of a histogram, of one map; its bars have the scale of the highest of all.
PlotPanel histogram_panel(PlotMeasure measure, const PlotSeries& series,
                          const std::vector<PlotSeries>& same_scale = {});

/// The three plots of a map as NAME-area.svg, NAME-angle.svg and NAME-histogram.svg in
/// `directory`; only their paths are made: nothing touches the disk.
std::vector<PlotFile> write_plots(const std::string& directory, const std::string& name,
                                  const Distortion& distortion);
/// The same, of one or two maps in the same plots.
std::vector<PlotFile> write_comparison_plots(const std::string& directory, const std::string& name,
                                             const std::vector<PlotSeries>& series);

}  // namespace sphparam
