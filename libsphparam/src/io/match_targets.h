#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "sphparam/io/losses.h"
#include "sphparam/io/mesh_file.h"

// Where each vertex lies on another surface, as `with_targets` says it: a face of it and weights of
// the corners. Neither has a mean: between two vertices they name points anywhere.

namespace sphparam {

inline constexpr std::array<std::string_view, 4> match_targets = {"target_face", "target_0",
                                                                  "target_1", "target_2"};

inline bool is_match_target(std::string_view property) {
  return std::ranges::find(match_targets, property) != match_targets.end();
}

/// Whether vertices have all of them: one alone is somebody's number.
inline bool has_match_targets(const MeshFile& file) {
  return std::ranges::all_of(match_targets, [&](std::string_view name) {
    return file.find_vertex_property(std::string(name)) != nullptr;
  });
}

/// What a mesh that is sampled anew leaves with its source.
inline void add_match_loss(std::vector<std::string>& notes, const MeshFile& source) {
  if (has_match_targets(source))
    add_loss(notes,
             "target_face and target_0 to target_2: points of another surface that a match has for "
             "the mesh's own vertices; match the new mesh to have those of its vertices");
}

}  // namespace sphparam
