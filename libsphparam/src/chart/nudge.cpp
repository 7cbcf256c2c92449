#include "chart/nudge.h"

#include <algorithm>

// The (u, v) of a vertex is a rounding; one that is a few units in the last place away serves as
// well. For each corner of a folded face, the first step of a fixed list, short ones first, that
// leaves fewest faces around the vertex folded, is taken if these are fewer than before. So the
// number of folded faces falls with every step, and rounds end when one takes none.

namespace sphparam {
namespace {

constexpr int most_rounds = 16;
constexpr int most_doublings = 12;  // of one unit in the last place
constexpr int most_spokes = 64;

class Nudger {
 public:
  explicit Nudger(FlatMesh& flat) : flat_(flat) {}

  int run(std::vector<Face>& folded) {
    for (int round = 0; round < most_rounds && !folded.empty(); ++round) {
      const size_t before = moved_.size();
      for (const Face f : folded) {
        for (Halfedge h = 3 * f; h < 3 * f + 3 && !flat_.positive(f); ++h) try_to_move(h);
      }
      std::erase_if(folded, [&](Face f) { return flat_.positive(f); });
      if (moved_.size() == before) break;
    }
    std::sort(moved_.begin(), moved_.end());
    return static_cast<int>(std::unique(moved_.begin(), moved_.end()) - moved_.begin());
  }

 private:
  void try_to_move(Halfedge h) {
    const Vertex v = flat_.mesh.origin(h);
    if (flat_.is_pole(v)) return;
    const int before = folded_around(h);
    if (before < 0) return;
    ChartPoint& place = flat_.uv[static_cast<size_t>(v)];
    const ChartPoint start = place;
    ChartPoint best = start;
    int fewest = before;
    double step = 0x1p-52;
    for (int i = 0; i <= most_doublings && fewest > 0; ++i, step *= 2) {
      for (int du = -1; du <= 1; ++du) {
        for (int dv = -1; dv <= 1; ++dv) {
          const ChartPoint p{start.u * (1 + du * step), start.v * (1 + dv * step)};
          if ((start.u == 0 && du != 0) || p.u >= 1 || p.v >= 1) continue;
          place = p;
          const int folded = folded_around(h);
          if (folded >= fewest) continue;
          fewest = folded;
          best = p;
        }
      }
    }
    place = best;
    if (fewest < before) moved_.push_back(v);
  }

  /// Folded faces around the origin of h; −1: there are too many faces to look at.
  int folded_around(Halfedge h) const {
    int spokes = 0, folded = 0;
    Halfedge spoke = h;
    do {
      if (++spokes > most_spokes) return -1;
      folded += !flat_.positive(Topology::face(spoke));
      spoke = flat_.mesh.rotate_ccw(spoke);
    } while (spoke != h);
    return folded;
  }

  FlatMesh& flat_;
  std::vector<Vertex> moved_;  // some more than once
};

}  // namespace

int nudge(FlatMesh& flat, std::vector<Face>& folded) { return Nudger(flat).run(folded); }

}  // namespace sphparam
