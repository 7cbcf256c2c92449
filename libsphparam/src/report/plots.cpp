#include "report/plots.h"

namespace sphparam {

std::vector<PlotFile> write_comparison_plots(const std::string& directory, const std::string& name,
                                             const std::vector<PlotSeries>& series) {
  const std::string base =
      directory.empty() || directory.back() == '/' ? directory + name : directory + "/" + name;
  return {{base + "-area.svg", polar_plot(PlotMeasure::Area, series)},
          {base + "-angle.svg", polar_plot(PlotMeasure::Angle, series)},
          {base + "-histogram.svg", histogram_plot(series)}};
}

std::vector<PlotFile> write_plots(const std::string& directory, const std::string& name,
                                  const Distortion& distortion) {
  return write_comparison_plots(directory, name, {{name, &distortion}});
}

}  // namespace sphparam
