#pragma once

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

/// All triangulations of the sphere with a given number of vertices, one of each combinatorial type
/// (mirror images count as one): 1, 1, 2, 5, 14, 50, 233 for 4 to 10 vertices, OEIS A000109.
namespace sphparam::tests {

/// The neighbours of each vertex, counter-clockwise.
using Rotations = std::vector<std::vector<int>>;

inline int after(const std::vector<int>& ring, int v) {
  const auto at = std::find(ring.begin(), ring.end(), v);
  return at + 1 == ring.end() ? ring.front() : *(at + 1);
}

/// The names of all rings when vertices are numbered in the order they are met, starting from the
/// edge a → b and turning one way or the other.
inline std::vector<int> code_from(const Rotations& rotations, int a, int b, bool mirrored) {
  std::vector<int> name(rotations.size(), -1), reference(rotations.size(), -1), order{a, b}, code;
  name[static_cast<size_t>(a)] = 0;
  name[static_cast<size_t>(b)] = 1;
  reference[static_cast<size_t>(a)] = b;
  reference[static_cast<size_t>(b)] = a;
  for (size_t i = 0; i < order.size(); ++i) {
    const int v = order[i];
    std::vector<int> ring = rotations[static_cast<size_t>(v)];
    if (mirrored) std::reverse(ring.begin(), ring.end());
    std::rotate(ring.begin(),
                std::find(ring.begin(), ring.end(), reference[static_cast<size_t>(v)]), ring.end());
    for (const int w : ring) {
      if (name[static_cast<size_t>(w)] < 0) {
        name[static_cast<size_t>(w)] = static_cast<int>(order.size());
        reference[static_cast<size_t>(w)] = v;
        order.push_back(w);
      }
      code.push_back(name[static_cast<size_t>(w)]);
    }
    code.push_back(-1);
  }
  return code;
}

inline std::vector<int> canonical_code(const Rotations& rotations) {
  std::vector<int> best;
  for (size_t a = 0; a < rotations.size(); ++a) {
    for (const int b : rotations[a]) {
      for (const bool mirrored : {false, true}) {
        std::vector<int> code = code_from(rotations, static_cast<int>(a), b, mirrored);
        if (best.empty() || code < best) best = std::move(code);
      }
    }
  }
  return best;
}

/// Every triangulation that flipping one edge makes.
inline std::vector<Rotations> flips(const Rotations& rotations) {
  std::vector<Rotations> result;
  for (int a = 0; a < static_cast<int>(rotations.size()); ++a) {
    for (const int b : rotations[static_cast<size_t>(a)]) {
      if (a > b) continue;
      const int c = after(rotations[static_cast<size_t>(a)], b);  // face (a, b, c)
      const int d = after(rotations[static_cast<size_t>(b)], a);  // face (b, a, d)
      const std::vector<int>& ring_c = rotations[static_cast<size_t>(c)];
      if (std::find(ring_c.begin(), ring_c.end(), d) != ring_c.end()) continue;
      Rotations flipped = rotations;
      std::erase(flipped[static_cast<size_t>(a)], b);
      std::erase(flipped[static_cast<size_t>(b)], a);
      // Around c stand …, a, b, …: d comes between. Around d: …, b, a, …
      auto& at_c = flipped[static_cast<size_t>(c)];
      at_c.insert(std::find(at_c.begin(), at_c.end(), a) + 1, d);
      auto& at_d = flipped[static_cast<size_t>(d)];
      at_d.insert(std::find(at_d.begin(), at_d.end(), b) + 1, c);
      result.push_back(std::move(flipped));
    }
  }
  return result;
}

/// The double pyramid over a polygon: the triangulation to start from.
inline Rotations double_pyramid(int vertices) {
  if (vertices == 4) return {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  const int n = vertices - 2, top = n, bottom = n + 1;
  Rotations rotations(static_cast<size_t>(vertices));
  for (int i = 0; i < n; ++i) {
    rotations[static_cast<size_t>(i)] = {(i + 1) % n, top, (i + n - 1) % n, bottom};
    rotations[static_cast<size_t>(top)].push_back(i);
    rotations[static_cast<size_t>(bottom)].push_back(n - 1 - i);
  }
  return rotations;
}

inline std::vector<Rotations> all_triangulations(int vertices) {
  std::vector<Rotations> found{double_pyramid(vertices)};
  std::set<std::vector<int>> codes{canonical_code(found.front())};
  for (size_t i = 0; i < found.size(); ++i) {
    for (Rotations& next : flips(found[i])) {
      if (codes.insert(canonical_code(next)).second) found.push_back(std::move(next));
    }
  }
  return found;
}

/// A mesh of that connectivity with random positions.
inline TriangleMesh mesh_of(const Rotations& rotations, unsigned seed) {
  std::mt19937 random(seed);
  TriangleMesh mesh;
  mesh.positions.resize(static_cast<Eigen::Index>(rotations.size()), 3);
  for (Eigen::Index i = 0; i < mesh.positions.size(); ++i) {
    mesh.positions.data()[i] = static_cast<double>(random()) / 2147483648.0 - 1;
  }
  std::vector<int> corners;
  for (int a = 0; a < static_cast<int>(rotations.size()); ++a) {
    for (const int b : rotations[static_cast<size_t>(a)]) {
      const int c = after(rotations[static_cast<size_t>(a)], b);
      if (a < b && a < c) corners.insert(corners.end(), {a, b, c});
    }
  }
  mesh.triangles =
      Eigen::Map<Triangles>(corners.data(), static_cast<Eigen::Index>(corners.size()) / 3, 3);
  return mesh;
}

}  // namespace sphparam::tests
