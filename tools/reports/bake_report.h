#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sphparam::cli {

/// What `sphparam bake --json` tells.
struct BakeReport {
  struct Image {
    std::string map, about, path, sample_type;
    int channels;
    std::optional<std::pair<double, double>> range;  // what 0 and 1 of integers stand for
  };
  std::string input, target;
  int width, height, samples;
  std::optional<double> target_distance;  // see `disagreement`; with --for
  std::string convention;
  int refine_poles;
  long triangles;
  std::vector<Image> images;
  double seconds;
};

std::string to_json(const BakeReport& report);

}  // namespace sphparam::cli
