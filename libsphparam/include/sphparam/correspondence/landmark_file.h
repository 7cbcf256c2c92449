#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sphparam/correspondence/match.h"
#include "sphparam/io/file_numbers.h"

namespace sphparam {

/// Landmarks of `match --landmarks FILE`, a pair a line: the vertex of the first mesh and that of
/// the second, by their numbers in the meshes' files. `#` starts a comment; empty lines are
/// skipped.
///
/// Ensures: vertices of the meshes, none twice on either side.
/// Throws: ReadError with the line; also for a vertex that a mesh has not.
std::vector<LandmarkPair> read_landmarks(const std::string& path, const FileNumbers& from,
                                         const FileNumbers& to);
/// The same from text in memory; `name` is for messages.
std::vector<LandmarkPair> parse_landmarks(std::string_view text, const std::string& name,
                                          const FileNumbers& from, const FileNumbers& to);

}  // namespace sphparam
