#include "io/polygons/doublets.h"

#include <algorithm>
#include <array>

// One pass over all corners counts them by vertex and compares their two neighbours.

namespace sphparam {

std::vector<int> find_doublets(const Polygons& polygons, std::int64_t vertex_count) {
  struct Star {
    int corners = 0;
    std::array<int, 2> neighbours = {};  // of the corner before
    bool same = false;
  };
  std::vector<Star> stars(static_cast<std::size_t>(vertex_count));
  for (std::int64_t p = 0; p < polygons.count(); ++p) {
    if (polygons.repeats(p)) continue;
    const std::span<const int> polygon = polygons.polygon(p);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const int before = polygon[(i + polygon.size() - 1) % polygon.size()];
      const int after = polygon[(i + 1) % polygon.size()];
      const std::array neighbours{std::min(before, after), std::max(before, after)};
      Star& star = stars[polygon[i]];
      ++star.corners;
      star.same = star.corners == 2 && star.neighbours == neighbours;
      star.neighbours = neighbours;
    }
  }
  std::vector<int> doublets;
  for (std::size_t v = 0; v < stars.size(); ++v)
    if (stars[v].same) doublets.push_back(static_cast<int>(v));
  return doublets;
}

std::string doublet_note(const std::vector<int>& doublets) {
  constexpr std::size_t most_listed = 10;
  std::string text = "two polygons share two edges in a row about vertices ";
  for (std::size_t i = 0; i < std::min(doublets.size(), most_listed); ++i)
    text += (i ? ", " : "") + std::to_string(doublets[i]);
  return text + (doublets.size() > most_listed ? ", …" : "") +
         ": the triangles between these edges are there twice";
}

}  // namespace sphparam
