#pragma once

#include <utility>

#include "sphparam/io/components.h"
#include "sphparam/io/mesh_source.h"

namespace sphparam {

/// The refusal of a mesh of several components, of which a repair keeps one.
class PartsRefusal : public MeshRefusal {
 public:
  PartsRefusal(const MeshSource& source, RepairTrial trial, PartsTrial parts)
      : MeshRefusal(source, std::move(trial)), parts_(std::move(parts)) {}
  const PartsTrial& parts() const { return parts_; }

 private:
  PartsTrial parts_;
};

/// Throws: PartsRefusal; another MeshRefusal.
[[noreturn]] void refuse(const MeshSource& source);

}  // namespace sphparam
