#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sphparam/io/file_numbers.h"
#include "sphparam/io/read_options.h"
#include "sphparam/parameterize.h"

namespace sphparam {

/// Landmarks of `--pin FILE`, one a line: the vertex by its number in the mesh's file, then θ and ϕ
/// in radians. `#` starts a comment; empty lines are skipped.
///
/// Ensures: vertices of the mesh, none twice; θ finite, ϕ in [0, π].
/// Throws: ReadError with the line; also for a vertex that the mesh has not.
std::vector<Landmark> read_pins(const std::string& path, const FileNumbers& numbers);
/// The same from text in memory; `name` is for messages.
std::vector<Landmark> parse_pins(std::string_view text, const std::string& name,
                                 const FileNumbers& numbers);

}  // namespace sphparam
