#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sphparam/io/mapped_mesh.h"
#include "sphparam/remesh/adaptation.h"
#include "sphparam/remesh/displacement.h"
#include "sphparam/remesh/levels_of_detail.h"

namespace sphparam {

/// Files that a remesh wrote; empty: it did not.
struct RemeshOutputs {
  std::string mesh = {}, limit_mesh = {}, displacement = {}, rebuilt = {};
  std::string geometry_image = {}, normals = {}, csv = {};
  std::vector<std::string> attribute_images = {};  // NAME=FILE
  std::vector<std::string> data = {};              // of --data, beside meshes or as they were named
  std::vector<std::string> levels = {};  // the file of each; needed where there are several levels
};

/// A mesh on grids of the sphere. References are to values that outlive the record.
struct RemeshRecord {
  std::string input;                         // the file of the source
  std::string grid;                          // of the finest level, as it was asked for
  const MappedMesh& source;                  // as it was sampled: adapted, where that was wanted
  const std::vector<LevelOfDetail>& levels;  // at least one, the finest first; measured, where
                                             // there are several
  SampleMode sample = SampleMode::Point;
  std::optional<GridWithin> within = {};  // where the grid was sought
  std::optional<Adaptation> adaptation = {};
  std::optional<TextureLayout> layout = {};  // of the finest level's texture coordinates
  std::optional<WrittenDisplacement> displacement = {};
  RemeshOutputs outputs = {};
  double grid_seconds = 0, seconds = 0;  // of making the grid; of all
};

/// What may be wrong with what was made, a line each: a grid that was sought in vain, levels that
/// lie over themselves in space.
std::vector<std::string> warnings_of(const RemeshRecord& record);

/// As `sphparam remesh --json` tells it, with its warnings.
std::string to_json(const RemeshRecord& record);

/// Several lines for people: how near fit, displacement and levels are, then what was made.
std::string to_text(const RemeshRecord& record);

}  // namespace sphparam
