#pragma once

#include <optional>
#include <string>

#include "sphparam/io/mesh_source.h"

namespace sphparam {

/// What repairs that put faces in (caps of handles, over holes) made of the shape of a mesh, apart
/// from what they dropped.
struct ShapeChange {
  /// What was there and is there still, its faces as they run now: what it encloses where that is
  /// closed by itself, as before a handle was cut.
  std::optional<double> volume_before;
  std::optional<double> volume;  // now; nothing where it is not closed
  Vector3 lower_before = Vector3::Zero(), upper_before = Vector3::Zero();  // of the box about it
  Vector3 lower = Vector3::Zero(), upper = Vector3::Zero();                // of the box now
};

/// Nothing where repairs put no faces in, or fillers, which are no surface. Requires: a mesh as
/// `repaired` and `mended` leave it. Cost: O(#V + #F log #F).
std::optional<ShapeChange> shape_change(const MeshSource& mended);

/// "the volume is 76684 and was 76422 (0.343 % more); what was put in leaves the bounding box: z
/// was from 0 to 8 and is from -0.39 to 8.39"; empty where neither changed.
std::string shape_line(const MeshSource& mended);

/// What it means that a closed mesh encloses nothing, and what to type; empty where it encloses
/// something, or is not closed.
std::string hollow_line(const MeshSource& source);

}  // namespace sphparam
