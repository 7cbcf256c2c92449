#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/formats/three_mf/three_mf_model.h"

namespace sphparam {

/// PrusaSlicer keeps modifiers, negative volumes and places for supports within the triangles of
/// the object that they change, and says in a file of its own, `xml`, which they are. Takes them
/// out, with their vertices. Returns how many volumes. Throws: ReadError with the line.
std::int64_t take_out_volumes_of_slicer(ThreeMfModel& model, std::string_view xml,
                                        const std::string& name);

}  // namespace sphparam
