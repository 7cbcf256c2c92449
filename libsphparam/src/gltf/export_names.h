#pragma once

#include <string>

#include "sphparam/gltf/export.h"

namespace sphparam {

/// What extras and warnings call the mesh of an export.
inline std::string source_name(const MappedMesh& mapped, const ExportOptions& options) {
  return options.source.empty() ? mapped.name() : options.source;
}

}  // namespace sphparam
