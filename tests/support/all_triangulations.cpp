#include "support/all_triangulations.h"

#include <algorithm>
#include <random>
#include <string>
#include <unordered_set>

// Wagner's theorem: flips connect all triangulations with the same number of vertices. Types are
// told apart by a canonical code: vertices are numbered in the order they are met on a walk around
// the rings, from some edge in some sense; the code is the least of all such walks. Walks start
// only at vertices of the rarest valence, and stop where they become greater than the least so far.

namespace sphparam::tests {
namespace {

size_t at(int i) { return static_cast<size_t>(i); }

int after(const std::vector<int>& ring, int v) {
  const auto place = std::find(ring.begin(), ring.end(), v);
  return place + 1 == ring.end() ? ring.front() : *(place + 1);
}

class Coder {
 public:
  explicit Coder(const Rotations& rotations) : rotations_(rotations), name_(rotations.size()) {}

  std::string canonical_code() {
    const size_t valence = rarest_valence();
    for (int a = 0; a < static_cast<int>(rotations_.size()); ++a) {
      if (rotations_[at(a)].size() != valence) continue;
      for (const int b : rotations_[at(a)]) {
        walk(a, b, true);
        walk(a, b, false);
      }
    }
    return best_;
  }

 private:
  size_t rarest_valence() const {
    std::vector<int> count(rotations_.size(), 0);
    for (const auto& ring : rotations_) ++count[ring.size()];
    size_t rarest = 0;
    for (size_t k = 0; k < count.size(); ++k) {
      if (count[k] > 0 && (count[rarest] == 0 || count[k] < count[rarest])) rarest = k;
    }
    return rarest;
  }

  /// Replaces the best code if this walk's is less.
  void walk(int a, int b, bool forwards) {
    std::fill(name_.begin(), name_.end(), -1);
    order_ = {{a, b}, {b, a}};
    name_[at(a)] = 0;
    name_[at(b)] = 1;
    code_.clear();
    bool less = best_.empty();
    for (size_t i = 0; i < order_.size(); ++i) {
      const auto [v, reference] = order_[i];
      const std::vector<int>& ring = rotations_[at(v)];
      size_t k = static_cast<size_t>(std::find(ring.begin(), ring.end(), reference) - ring.begin());
      for (size_t n = 0; n <= ring.size(); ++n) {
        const bool end = n == ring.size();
        if (!end && name_[at(ring[k])] < 0) {
          name_[at(ring[k])] = static_cast<int>(order_.size());
          order_.push_back({ring[k], v});
        }
        code_.push_back(static_cast<char>(end ? 0 : 1 + name_[at(ring[k])]));
        if (!less) {
          const char best = best_[code_.size() - 1];
          if (code_.back() > best) return;
          less = code_.back() < best;
        }
        k = forwards ? (k + 1 == ring.size() ? 0 : k + 1) : (k == 0 ? ring.size() - 1 : k - 1);
      }
    }
    best_ = code_;
  }

  struct Visit {
    int vertex, reference;  // where its ring starts
  };

  const Rotations& rotations_;
  std::vector<int> name_;
  std::vector<Visit> order_;
  std::string code_, best_;
};

/// Every triangulation that flipping one edge makes.
std::vector<Rotations> flips(const Rotations& rotations) {
  std::vector<Rotations> result;
  for (int a = 0; a < static_cast<int>(rotations.size()); ++a) {
    for (const int b : rotations[at(a)]) {
      if (a > b) continue;
      const int c = after(rotations[at(a)], b);  // face (a, b, c)
      const int d = after(rotations[at(b)], a);  // face (b, a, d)
      const std::vector<int>& ring_c = rotations[at(c)];
      if (std::find(ring_c.begin(), ring_c.end(), d) != ring_c.end()) continue;
      Rotations flipped = rotations;
      std::erase(flipped[at(a)], b);
      std::erase(flipped[at(b)], a);
      // Around c stand …, a, b, …: d comes between. Around d: …, b, a, …
      auto& at_c = flipped[at(c)];
      at_c.insert(std::find(at_c.begin(), at_c.end(), a) + 1, d);
      auto& at_d = flipped[at(d)];
      at_d.insert(std::find(at_d.begin(), at_d.end(), b) + 1, c);
      result.push_back(std::move(flipped));
    }
  }
  return result;
}

/// The double pyramid over a polygon: the triangulation to start from.
Rotations double_pyramid(int vertices) {
  if (vertices == 4) return {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  const int n = vertices - 2, top = n, bottom = n + 1;
  Rotations rotations(at(vertices));
  for (int i = 0; i < n; ++i) {
    rotations[at(i)] = {(i + 1) % n, top, (i + n - 1) % n, bottom};
    rotations[at(top)].push_back(i);
    rotations[at(bottom)].push_back(n - 1 - i);
  }
  return rotations;
}

}  // namespace

std::vector<Rotations> all_triangulations(int vertices) {
  std::vector<Rotations> found{double_pyramid(vertices)};
  std::unordered_set<std::string> codes{Coder(found.front()).canonical_code()};
  for (size_t i = 0; i < found.size(); ++i) {
    for (Rotations& next : flips(found[i])) {
      if (codes.insert(Coder(next).canonical_code()).second) found.push_back(std::move(next));
    }
  }
  return found;
}

TriangleMesh mesh_of(const Rotations& rotations, unsigned seed) {
  std::mt19937 random(seed);
  TriangleMesh mesh;
  mesh.positions.resize(static_cast<Eigen::Index>(rotations.size()), 3);
  for (Eigen::Index i = 0; i < mesh.positions.size(); ++i) {
    mesh.positions.data()[i] = static_cast<double>(random()) / 2147483648.0 - 1;
  }
  std::vector<int> corners;
  for (int a = 0; a < static_cast<int>(rotations.size()); ++a) {
    for (const int b : rotations[at(a)]) {
      const int c = after(rotations[at(a)], b);
      if (a < b && a < c) corners.insert(corners.end(), {a, b, c});
    }
  }
  mesh.triangles =
      Eigen::Map<Triangles>(corners.data(), static_cast<Eigen::Index>(corners.size()) / 3, 3);
  return mesh;
}

}  // namespace sphparam::tests
