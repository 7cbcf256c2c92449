#include "chart/settle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "chart/ease.h"
#include "chart/longitude.h"
#include "chart/sheet.h"
#include "chart/spread.h"
#include "chart/unbend.h"

// 1. Where folds are deep, as chords of long edges are far from their geodesics, all around them
// moves with the chords (unbend), in regions that grow.  2. Everything is rounded to the grid.
// 3. What folds and stands alone unfolds by easing.  4. Of the other low faces, vertices are taken
// out, by their shortest edges, until none is left.  5. They come back in the opposite order, each
// beside the vertex that had its faces, where there always is a place, however narrow; easing
// widens it.  6. Faces that are still low are spread with all around them, in regions that grow.
// 7. What is high enough lands on the grid, decided exactly.

namespace sphparam {
namespace {

constexpr int eases_a_fold = 2, eases_a_vertex = 64, some_eases = 100;
constexpr double cell = std::numbers::pi / Sheet::cells;  // on the sphere, radians
constexpr double longest_taken_out = 4096;  // cells: an edge on the sphere, a thousandth of it
constexpr double deepest = -64;             // cells: deeper folds are no rounding
constexpr double narrow = 0x1p-6;           // cells: what easing leaves lower is spread at once
constexpr int rings_to_unbend[] = {4, 8, 16};
constexpr size_t most_at_once = 3000;  // vertices: more take too long, and hardly ever find room
constexpr size_t vertices_an_answer = 256;  // that are put back before the caller is asked again
constexpr int fewest_rings = 8, most_rings = 128;
constexpr int landing_cells = 3;

class Settling {
 public:
  Settling(const SphericalChart& chart, int threads, const std::function<void()>& ask)
      : points_(chart.points), ask_(ask), sheet_(chart, threads), easing_(sheet_) {}

  void run() {
    if (is_deep()) unbend_folds();
    if (is_deep()) return;
    round_all();
    ease_folds();
    take_out_low();
    put_all_back();
    spread_low();
    for (Vertex v = 0; v < sheet_.vertex_count(); ++v) land(v);
  }

  const Sheet& sheet() const { return sheet_; }

 private:
  void ask() const {
    if (ask_) ask_();
  }

  bool is_deep() const {
    for (Face f = 0; f < sheet_.face_count(); ++f) {
      if (sheet_.height(f) < deepest) return true;
    }
    return false;
  }

  void unbend_folds() {
    for (const int rings : rings_to_unbend) {
      const std::vector<Face> folded = folded_faces();
      if (folded.empty()) return;
      for (const auto& region : regions_around(folded, rings)) {
        if (region.size() > most_at_once) return;
        ask();
        unbend(sheet_, region, Easing::wanted);
      }
    }
  }

  std::vector<Face> folded_faces() const {
    std::vector<Face> folded;
    for (Face f = 0; f < sheet_.face_count(); ++f) {
      if (!sheet_.positive(f)) folded.push_back(f);
    }
    return folded;
  }

  void round_all() {
    const auto rounded = [](double x) { return std::clamp(std::round(x), 1.0, Sheet::cells - 1); };
    for (Vertex v = 0; v < sheet_.vertex_count(); ++v) {
      const SheetPoint& p = sheet_.place(v);
      if (!sheet_.is_pole(v)) sheet_.move(v, {rounded(p.x), sheet_.on_seam(v) ? 0 : rounded(p.y)});
    }
  }

  void ease_folds() {
    const std::vector<Face> folded = low_faces();
    for (const Face f : folded) easing_.add_corners(f);
    easing_.run(eases_a_fold * std::ssize(folded) + some_eases);
  }

  /// Is a face so low that rounding may fold it, or folded? What is on the grid is rounded.
  bool is_low(Face f) const {
    if (sheet_.is_out(f) || sheet_.height(f) >= Easing::enough) return false;
    const bool lies = on_grid(sheet_.origin(3 * f)) && on_grid(sheet_.origin(3 * f + 1)) &&
                      on_grid(sheet_.origin(3 * f + 2));
    return !lies || !sheet_.positive(f);
  }

  bool on_grid(Vertex v) const {
    const SheetPoint& p = sheet_.place(v);
    return p.x == std::floor(p.x) && p.y == std::floor(p.y);
  }

  std::vector<Face> low_faces() const {
    std::vector<Face> low;
    for (Face f = 0; f < sheet_.face_count(); ++f) {
      if (is_low(f)) low.push_back(f);
    }
    return low;
  }

  // --- out and back ---------------------------------------------------------------------------

  void take_out_low() {
    std::vector<Face> waiting = low_faces();
    for (size_t i = 0; i < waiting.size(); ++i) {
      if (!is_low(waiting[i])) continue;
      const Halfedge h = best_to_take_out(waiting[i]);
      if (h < 0) continue;
      const Vertex to = sheet_.target(h);
      sheet_.take_out(h);
      sheet_.for_each_spoke(to, [&](Halfedge spoke) {
        if (is_low(Topology::face(spoke))) waiting.push_back(Topology::face(spoke));
      });
    }
  }

  /// Of the edges of a face, both ways, a short one that leaves few faces low; −1: there is none.
  Halfedge best_to_take_out(Face f) {
    Halfedge best = -1;
    double least = HUGE_VAL;
    for (Halfedge side = 3 * f; side < 3 * f + 3; ++side) {
      for (const Halfedge h : {side, sheet_.twin(side)}) {
        if (!sheet_.may_take_out(h)) continue;
        const double length =
            (points_.row(sheet_.origin(h)) - points_.row(sheet_.target(h))).norm() / cell;
        if (length > longest_taken_out) continue;
        const double score = (length + 1) * (1 + low_without(h));
        if (score >= least) continue;
        least = score;
        best = h;
      }
    }
    return best;
  }

  /// How many faces would be low if the origin of h were taken out; infinite: one would be folded
  /// by more than its size.
  double low_without(Halfedge h) {
    const Vertex v = sheet_.origin(h);
    const SheetPoint there =
        sheet_.on_seam(v) ? sheet_.place(sheet_.target(h)) : sheet_.corner(Topology::next(h));
    const SheetPoint before = sheet_.place(v);
    sheet_.move(v, there);
    int low = 0;
    bool deep = false;
    sheet_.for_each_spoke(v, [&](Halfedge spoke) {
      const Face f = Topology::face(spoke);
      if (f == Topology::face(h) || f == Topology::face(sheet_.twin(h))) return;
      const double height = sheet_.height(f);
      low += height < Easing::enough;
      deep = deep || height < deepest;
    });
    sheet_.move(v, before);
    return deep ? HUGE_VAL : low;
  }

  void put_all_back() {
    for (size_t i = 0; sheet_.any_out(); ++i) {
      if (i % vertices_an_answer == 0) ask();
      const Halfedge h = sheet_.put_back();
      const Vertex v = sheet_.origin(h);
      easing_.slide(v, way_in(h));
      easing_.add(v);
      sheet_.for_each_spoke(v, [&](Halfedge spoke) { easing_.add(sheet_.target(spoke)); });
      easing_.run(eases_a_vertex);
      if (sheet_.lowest_around(v) >= narrow) continue;
      for (const auto& region : regions_around({Topology::face(h)}, fewest_rings))
        spread_if_positive(region);
    }
  }

  /// The direction, from the target of h, in which its origin unfolds all its faces: the middle
  /// between the edges to the two apexes. Along the seam there is one way.
  SheetPoint way_in(Halfedge h) const {
    const Halfedge g = sheet_.twin(h);
    const SheetPoint a = unit(sheet_.towards(Topology::next(h)));
    if (sheet_.on_seam(sheet_.origin(h))) return {a.y < 0 ? 1.0 : -1.0, 0};
    SheetPoint b;
    if (sheet_.is_pole(sheet_.apex(g))) {
      b = sheet_.towards(sheet_.twin(Topology::previous(g)));
    } else {
      const SheetPoint back = unit(sheet_.towards(Topology::previous(g)));
      b = {-back.x, -back.y};
    }
    const SheetPoint sum{a.x + b.x, a.y + b.y};
    constexpr double opposite = 1e-12;
    if (square(sum) < opposite) return {-a.y, a.x};
    const SheetPoint middle = unit(sum);
    return cross(a, b) > 0 ? middle : SheetPoint{-middle.x, -middle.y};
  }

  static SheetPoint unit(const SheetPoint& p) {
    const double length = std::sqrt(square(p));
    return length > 0 ? SheetPoint{p.x / length, p.y / length} : p;
  }

  // --- regions --------------------------------------------------------------------------------

  void spread_low() {
    for (int rings = fewest_rings; rings <= most_rings; rings *= 2) {
      const std::vector<Face> low = low_faces();
      if (low.empty()) return;
      for (const auto& region : regions_around(low, rings)) {
        if (region.size() > most_at_once) continue;
        ask();
        if (!is_positive(region)) unbend(sheet_, region, Easing::wanted);
        spread_if_positive(region);
      }
    }
  }

  void spread_if_positive(const std::vector<Vertex>& region) {
    if (is_positive(region)) spread(sheet_, region, Easing::wanted);
  }

  bool is_positive(const std::vector<Vertex>& region) const {
    return std::ranges::all_of(region, [&](Vertex v) { return sheet_.lowest_around(v) > 0; });
  }

  /// The vertices within so many rings of faces that may move, each connected part for itself.
  std::vector<std::vector<Vertex>> regions_around(const std::vector<Face>& faces, int rings) {
    std::vector<Vertex> all;
    const auto add = [&](Vertex v) {
      if (sheet_.is_pole(v) || is_near(v) || sheet_.is_hub(v)) return;
      near_[static_cast<size_t>(v)] = 1;
      all.push_back(v);
    };
    for (const Face f : faces) {
      for (Halfedge h = 3 * f; h < 3 * f + 3; ++h) add(sheet_.origin(h));
    }
    size_t first = 0;
    for (int ring = 0; ring < rings; ++ring) {
      for (const size_t last = all.size(); first < last; ++first)
        sheet_.for_each_spoke(all[first], [&](Halfedge h) { add(sheet_.target(h)); });
    }
    std::vector<std::vector<Vertex>> parts;
    for (const Vertex v : all) {
      if (is_near(v)) parts.push_back(part_with(v));
    }
    return parts;
  }

  bool is_near(Vertex v) const { return near_[static_cast<size_t>(v)] != 0; }

  std::vector<Vertex> part_with(Vertex v) {
    std::vector<Vertex> part;
    const auto join = [&](Vertex w) {
      if (is_near(w)) part.push_back(w);
      near_[static_cast<size_t>(w)] = 0;
    };
    join(v);
    for (size_t i = 0; i < part.size(); ++i)
      sheet_.for_each_spoke(part[i], [&](Halfedge h) { join(sheet_.target(h)); });
    return part;
  }

  // --- landing --------------------------------------------------------------------------------

  /// Moves a vertex to the nearest place on the grid that leaves its faces positive.
  void land(Vertex v) {
    if (sheet_.is_pole(v) || on_grid(v) || sheet_.is_hub(v)) return;
    const SheetPoint at = sheet_.place(v);
    std::vector<std::pair<double, SheetPoint>> near;
    for (int dx = -landing_cells; dx <= landing_cells; ++dx) {
      for (int dy = -landing_cells; dy <= landing_cells; ++dy) {
        const SheetPoint p{std::round(at.x) + dx, std::round(at.y) + dy};
        if (sheet_.allows(v, p)) near.emplace_back(square(p - at), p);
      }
    }
    std::ranges::stable_sort(near, {}, [](const auto& place) { return place.first; });
    for (const auto& [distance, p] : near) {
      sheet_.move(v, p);
      if (is_positive_around(v)) return;
    }
    sheet_.move(v, at);
  }

  bool is_positive_around(Vertex v) const {
    bool positive = true;
    sheet_.for_each_spoke(v, [&](Halfedge h) { positive &= sheet_.positive(Topology::face(h)); });
    return positive;
  }

  const Points& points_;
  const std::function<void()>& ask_;
  Sheet sheet_;
  Easing easing_;
  std::vector<char> near_ = std::vector<char>(static_cast<size_t>(sheet_.vertex_count()), 0);
};

/// Further from where the map has it than rounding to the grid goes.
bool has_moved(const SheetPoint& now, const ChartPoint& mapped) {
  return std::abs(now.x - Sheet::cells * mapped.v) > 1 ||
         std::abs(now.y - Sheet::cells * mapped.u) > 1;
}

void write(const Sheet& sheet, SphericalChart& chart) {
  chart.counts.nudged_vertices = 0;
  for (Vertex v = 0; v < sheet.vertex_count(); ++v) {
    if (!sheet.is_pole(v))
      chart.counts.nudged_vertices += has_moved(sheet.place(v), chart_point(chart.points.row(v)));
  }
  for (Eigen::Index w = 0; w < chart.wedge_count(); ++w) {
    const Vertex v = chart.wedge_vertices[static_cast<size_t>(w)];
    if (sheet.is_pole(v)) continue;
    chart.uv(w, 1) = sheet.place(v).x / Sheet::cells;
    if (!sheet.on_seam(v)) chart.uv(w, 0) = sheet.place(v).y / Sheet::cells;
  }
  for (Face f = 0; f < sheet.face_count(); ++f) {
    const int pole = chart.pole_corner(f);
    if (pole < 0) continue;
    const auto u = [&](int k) -> double& { return chart.uv(chart.wedges(f, (pole + k) % 3), 0); };
    u(0) = 0.5 * (u(1) + u(2));
  }
}

}  // namespace

SphericalChart settled(SphericalChart chart, int threads, const std::function<void()>& ask) {
  if (!chart.certificate.closed || chart.north < 0 || chart.south < 0) return chart;
  Settling settling(chart, threads, ask);
  settling.run();
  SphericalChart result = chart;
  write(settling.sheet(), result);
  result.certificate = certify_chart(result, threads);
  if (result.certificate.one_to_one()) return result;
  return chart;
}

}  // namespace sphparam
