#pragma once

#include <optional>
#include <string>

#include "compare/methods.h"
#include "sphparam/correspondence/likeness.h"
#include "sphparam/frame_check.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/names.h"
#include "sphparam/records/map_record.h"
#include "sphparam/sphere/distortion.h"

namespace sphparam::cli {

/// What one run found. The certificate is of the map in memory; what is written must have the same
/// verdict when it is read back.
struct MapOutcome {
  MeshSource source;
  InputNames input = {};  // of its file, before it gets its map
  AnyMethod method = Method::Progressive;
  ParameterizeOptions options = {};  // with vertices of the mesh
  Parameterization result = {};
  std::optional<BaselineAccount> account = std::nullopt;  // of a method of others
  FrameCheck frame = {};
  std::string upright = {};                             // `upright_words`
  std::optional<Likeness> likeness = std::nullopt;      // of a map that follows another mesh's, …
  std::string other = {};                               // … which has this name
  std::optional<Distortion> distortion = std::nullopt;  // where it is to be drawn
  std::optional<DistortionSummary> figures = std::nullopt;

  /// The paper's method makes none where no pair of poles is usable.
  bool has_map() const { return result.map.points.rows() > 0; }
  bool bijective() const { return result.certificate.bijective(); }
  /// What the program is for: exit code 0.
  bool succeeded() const { return bijective() && frame.holds(); }
  const Topology& topology() const { return source.topology.value(); }
  std::string verdict() const {
    return has_map() ? sphparam::verdict(result.certificate) : "no map";
  }
};

}  // namespace sphparam::cli
