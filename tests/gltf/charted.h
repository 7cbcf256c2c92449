#pragma once

#include <random>

#include "../chart/maps.h"
#include "gltf/export_asset.h"
#include "support/test_meshes.h"

/// Small meshes on their way into a glTF file.
namespace sphparam::tests {

struct Charted {
  sphparam::MeshFile file;
  SphereMap map;
  sphparam::ExportChart chart;

  explicit Charted(const sphparam::ExportChartOptions& options = {}, int level = 3) {
    std::mt19937 random(4);
    file.mesh = icosphere(level);
    map = rotated({file.mesh.positions}, random_rotation(random));
    // An egg: no two axes alike.
    file.mesh.positions.col(0) *= 1.5;
    file.mesh.positions.col(2) *= 0.75;
    chart = sphparam::export_chart(file.mesh, Topology(file.mesh), map, options);
  }

  sphparam::ExportGeometry geometry(const sphparam::GeometryOptions& options = {}) const {
    return sphparam::export_geometry(chart, file, options);
  }

  sphparam::Asset asset(const sphparam::GeometryOptions& options = {}) const {
    return {.name = "egg",
            .levels = {geometry(options).surface},
            .images = {},
            .materials = {{.name = "plain"}},
            .extras = {}};
  }
};

}  // namespace sphparam::tests
