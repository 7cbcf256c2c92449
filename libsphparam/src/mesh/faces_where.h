#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sphparam/mesh/triangle_mesh.h"
#include "sphparam/parallel.h"

namespace sphparam {

/// Of `faces` faces those that `holds` is true of, ascending; asked on up to `threads` threads.
template <class Holds>
std::vector<Face> faces_where(Face faces, int threads, const Holds& holds) {
  constexpr std::int64_t grain = 8192;
  std::vector<std::vector<Face>> found(static_cast<std::size_t>((faces + grain - 1) / grain));
  parallel_for(faces, grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto f = static_cast<Face>(first); f < static_cast<Face>(last); ++f)
      if (holds(f)) found[static_cast<std::size_t>(first / grain)].push_back(f);
  });
  std::vector<Face> all;
  for (const std::vector<Face>& chunk : found) all.insert(all.end(), chunk.begin(), chunk.end());
  return all;
}

}  // namespace sphparam
