#pragma once

#include <cstdint>
#include <string>

#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::campaign {

/// A shape that hurts the quality of maps: slivers, elongated features, fans, mazes, orders. Unlike
/// specimens they are shapes that people have, with areas and angles that a map can keep.
struct HurtingShape {
  std::string family;
  TriangleMesh mesh;
};

/// The shape with a given number. Ensures: the same for the same two numbers; closed, genus 0; some
/// 200 to 5,000 triangles, few more.
HurtingShape make_hurting_shape(std::uint64_t seed, std::uint64_t number);

}  // namespace sphparam::campaign
