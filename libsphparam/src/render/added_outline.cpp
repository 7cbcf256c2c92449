#include "render/added_outline.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

namespace sphparam {
namespace {

std::uint64_t key(Vertex a, Vertex b) {
  return static_cast<std::uint64_t>(std::min(a, b)) << 32 |
         static_cast<std::uint64_t>(std::max(a, b));
}

}  // namespace

std::optional<Wireframe> added_outline(const MeshFile& surface) {
  const Property* const sources = surface.find_face_property("source_face");
  if (!sources) return std::nullopt;
  const auto is_added = [&](Eigen::Index f) { return sources->values[static_cast<size_t>(f)] < 0; };
  const Triangles& triangles = surface.mesh.triangles;
  std::unordered_map<std::uint64_t, unsigned> kinds;  // of an edge's faces: 1 own, 2 added
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    if (!is_added(f)) continue;
    for (int k = 0; k < 3; ++k) kinds[key(triangles(f, k), triangles(f, (k + 1) % 3))] |= 2U;
  }
  if (kinds.empty()) return std::nullopt;
  Wireframe outline{.width = 3, .opacity = 1, .colour = Rgb(0.86F, 0.07F, 0.10F), .fades = false};
  outline.hidden_sides.assign(static_cast<size_t>(triangles.rows()), 7);
  const auto for_each_side = [&](const auto& visit) {
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
      for (int k = 0; k < 3; ++k) {
        const auto found = kinds.find(key(triangles(f, (k + 1) % 3), triangles(f, (k + 2) % 3)));
        if (found != kinds.end()) visit(f, k, found->second);
      }
    }
  };
  for_each_side([&](Eigen::Index f, int, unsigned& kind) { kind |= is_added(f) ? 2U : 1U; });
  for_each_side([&](Eigen::Index f, int k, unsigned kind) {
    if (kind == 3)
      outline.hidden_sides[static_cast<size_t>(f)] &= static_cast<std::uint8_t>(~(1U << k));
  });
  return outline;
}

}  // namespace sphparam
