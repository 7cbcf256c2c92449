#pragma once

#include <string>

#include "sphparam/io/mesh_source.h"

namespace sphparam::cli {

/// Several lines for people: what repair would do and what to type, or that it cannot help and why.
std::string words_of(const RepairTrial& trial, const std::string& path);

/// " --component 1 --max-hole 1055": what they need beside --repair; empty: nothing.
std::string further_options(const RepairOptions& options);

/// `words_of` a mesh that was refused, and what had been done to it before.
std::string advice_of(const MeshRefusal& refusal);

/// "kept 99.7 % of the area and 98 % of the faces, lost 0.3 % and 2 %"; empty where no component
/// was dropped.
std::string line_of(const KeptParts& parts);

}  // namespace sphparam::cli
