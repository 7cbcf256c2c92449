#include "report/plots.h"

namespace sphparam {

std::vector<double> plotted_ratios(PlotMeasure measure, const Distortion& distortion) {
  std::vector<double> ratios;
  for (Eigen::Index f = 0; f < distortion.source_area.size(); ++f) {
    if (distortion.source_area[f] == 0) continue;
    if (measure == PlotMeasure::Area) {
      ratios.push_back(distortion.area_ratio[f]);
    } else {
      for (int k = 0; k < 3; ++k) ratios.push_back(distortion.angle_ratio(f, k));
    }
  }
  return ratios;
}

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
