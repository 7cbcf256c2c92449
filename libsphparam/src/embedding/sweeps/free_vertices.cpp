#include "free_vertices.h"

#include <numeric>
#include <utility>

namespace sphparam {

std::vector<Vertex> free_vertices(int vertex_count,
                                  const std::optional<std::vector<Vertex>>& vertices,
                                  const std::vector<Vertex>& pinned) {
  std::vector<Vertex> free;
  if (vertices) {
    free = *vertices;
  } else {
    free.resize(static_cast<size_t>(vertex_count));
    std::iota(free.begin(), free.end(), 0);
  }
  std::vector<char> taken(static_cast<size_t>(vertex_count), 0);
  for (const Vertex v : pinned) taken[static_cast<size_t>(v)] = 1;
  std::erase_if(
      free, [&](Vertex v) { return std::exchange(taken[static_cast<size_t>(v)], char{1}) != 0; });
  return free;
}

}  // namespace sphparam
