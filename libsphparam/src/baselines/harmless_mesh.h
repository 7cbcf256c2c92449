#pragma once

#include <optional>

#include "mesh/unit_size.h"

namespace sphparam {

/// What a method works on: the mesh, or the same at about unit size where squares of its positions
/// could overflow or vanish, as areas and weights do long before lengths. Borrows it.
class HarmlessMesh {
  const std::optional<Rescaled> rescaled_;

 public:
  explicit HarmlessMesh(const TriangleMesh& given)
      : rescaled_(at_unit_size(given)), mesh(rescaled_ ? rescaled_->mesh : given) {}
  HarmlessMesh(const HarmlessMesh&) = delete;  // it may borrow from itself
  HarmlessMesh& operator=(const HarmlessMesh&) = delete;

  const TriangleMesh& mesh;
};

}  // namespace sphparam
