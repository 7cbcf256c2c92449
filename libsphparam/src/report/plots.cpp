#include "report/plots.h"

namespace sphparam {

std::vector<ChartFile> write_comparison_charts(const std::string& directory,
                                               const std::string& name,
                                               const std::vector<ChartSeries>& series) {
  const std::string base =
      directory.empty() || directory.back() == '/' ? directory + name : directory + "/" + name;
  return {{base + "-area.svg", polar_chart(ChartMeasure::Area, series)},
          {base + "-angle.svg", polar_chart(ChartMeasure::Angle, series)},
          {base + "-histogram.svg", histogram_chart(series)}};
}

std::vector<ChartFile> write_charts(const std::string& directory, const std::string& name,
                                    const Distortion& distortion) {
  return write_comparison_charts(directory, name, {{name, &distortion}});
}

}  // namespace sphparam
