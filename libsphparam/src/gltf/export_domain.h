#pragma once

#include "sphparam/gltf/export.h"

namespace sphparam {

// Options of exports are asked for their domains before any work. Both throw std::invalid_argument,
// which names the option.

/// Of what `make_look` makes.
void require_look_domain(const ExportOptions& options);

/// Of what becomes of a look and a mesh.
void require_export_domain(const ExportOptions& options);

}  // namespace sphparam
