#pragma once

#include <string>

#include "sphparam/io/mesh_source.h"

namespace sphparam {

/// Several lines for people: what repair would do to the mesh of this file and what to type, or
/// that it cannot help and why.
std::string repair_advice(const RepairTrial& trial, const std::string& path);

/// The same of a mesh that was refused, and what had been done to it before.
std::string repair_advice(const MeshRefusal& refusal);

}  // namespace sphparam
