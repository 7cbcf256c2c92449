#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/measure/alignment.h"
#include "sphparam/measure/growth.h"
#include "sphparam/measure/surface_distance.h"

namespace sphparam {

/// A limit that was set, and what was measured.
struct DistanceLimit {
  std::string name;
  double limit = 0, measured = 0;

  bool exceeded() const { return !(measured <= limit); }
};

/// How far two surfaces are apart. References are to values that outlive the record.
struct DistanceRecord {
  std::string first, second;  // files
  const MeshFile& first_file;
  const MeshFile& second_file;
  const DistanceOptions& options;
  const SurfaceDistance& distance;
  bool upright = false;  // the second was turned as the first stands, by what their files say
  std::optional<Alignment> alignment = {};  // of the second, where that was asked for
  std::optional<Growth> growth = {};  // from the first to the second, where that was asked for
  /// What each encloses, whichever way it is wound, where it is closed and that is not next to
  /// nothing.
  std::optional<double> first_volume = {}, second_volume = {};
  std::vector<DistanceLimit> limits = {};
  std::vector<std::pair<std::string, std::string>> outputs = {};  // what it is, where it is
  double seconds = 0;
  /// Numbers of the first that have another name beside those measured: "error" is "error_a".
  std::vector<std::pair<std::string, std::string>> renamed = {};
};

/// As `sphparam measure --json` tells it. Keys of each direction as MeshLab has them: RMS, max,
/// mean, min, n_samples, diag_mesh_0 (of the mesh sampled) and diag_mesh_1; median, P95, P99 and SD
/// beside them; HD95, the larger P95, of both. `alignment`, with the matrix that brings (x, y, z,
/// 1) of the second there, where the second was put onto the first, else null. `signed` of
/// the first to the second where the side was asked for; `growth`, of areas and of the least and
/// the greatest of a triangle, where that was; `left_out`, a share, of each direction. `volume` of
/// each mesh, or null.
std::string to_json(const DistanceRecord& record);

/// A table for people.
std::string to_text(const DistanceRecord& record);

}  // namespace sphparam
