#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gltf/export_asset.h"

namespace sphparam::cli {

/// What `export --json` tells.
struct ExportReport {
  struct Level {
    long triangles = 0, vertices = 0, splits = 0;
    bool chart_certified = false, stored_certified = false;
    std::vector<Face> folded, around_pole;  // of (u, v) as stored; of the mesh with --keep-topology
    long sphere_folds = -1;                 // see ExportGeometry
  };

  std::string input;
  std::string options;
  std::vector<Level> levels;
  std::vector<std::pair<std::string, std::size_t>> outputs;  // with their bytes
  double seconds = 0;

  void add_level(const ExportChart& chart, const ExportGeometry& geometry);
};

std::string to_json(const ExportReport& report);

}  // namespace sphparam::cli
