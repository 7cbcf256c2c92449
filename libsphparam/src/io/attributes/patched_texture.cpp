#include "io/attributes/patched_texture.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "mesh/face_sides.h"
#include "mesh/union_find.h"

// The rim of what was put in are the sides of old faces. Rim sides that meet with one texture
// coordinate are one run of the atlas. Each new face belongs to the rim side from which it is
// reached first; with its run's coordinates at hand, new corners lie between them (the mean of
// their neighbours, over and over), or, where a run meets itself at a seam, beside the rim side.

namespace sphparam {
namespace {

using Texcoord = Eigen::RowVector2d;

/// What lies beside the side a b shows, there, what the side shows nearest to it.
Texcoord along_side(const Vector3& a, const Vector3& b, const Texcoord& at_a, const Texcoord& at_b,
                    const Vector3& point) {
  const Vector3 side = b - a;
  const double length = side.squaredNorm();
  const double share = length > 0 ? std::clamp((point - a).dot(side) / length, 0.0, 1.0) : 0;
  return (1 - share) * at_a + share * at_b;
}

class PatchTexture {
 public:
  PatchTexture(MeshFile& mended, const RepairedMesh& repaired)
      : file_(mended),
        repaired_(repaired),
        uv_(*mended.corner_texcoords),
        place_(static_cast<std::size_t>(mended.mesh.face_count()), -1) {
    for (Face f = 0; f < static_cast<Face>(place_.size()); ++f) {
      if (!is_put_in(f)) continue;
      place_[at(f)] = static_cast<int>(patch_.size());
      patch_.push_back(f);
    }
    for (Property& property : mended.face_properties)
      if (property.name == "material") material_ = &property;
  }

  void run() {
    if (patch_.empty()) return;
    find_neighbours();
    reach_from_rim();
    join_runs();
    place_free_corners();
    write();
  }

 private:
  using Node = std::pair<int, Vertex>;  // a vertex, in the texture of a run

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  static Halfedge next(Halfedge h) { return h % 3 == 2 ? h - 2 : h + 1; }
  Vertex corner(Halfedge h) const { return file_.mesh.triangles(h / 3, h % 3); }
  Vector3 point(Halfedge h) const { return file_.mesh.positions.row(corner(h)); }
  double material(Face f) const { return material_ ? material_->values[at(f)] : 0; }

  bool is_put_in(Face f) const {
    const FillerMarks& fillers = repaired_.fillers;
    return repaired_.face_origin[at(f)] < 0 && (fillers.empty() || !fillers[at(f)]);
  }

  /// Of faces that touch what was put in, the other side of each of its sides.
  void find_neighbours() {
    std::vector<char> touched(static_cast<std::size_t>(file_.mesh.vertex_count()), 0);
    for (const Face f : patch_)
      for (int k = 0; k < 3; ++k) touched[at(file_.mesh.triangles(f, k))] = 1;
    const auto sides = sorted_sides(file_.mesh.triangles, [&](Face f) {
      int count = 0;
      for (int k = 0; k < 3; ++k) count += touched[at(file_.mesh.triangles(f, k))];
      return count >= 2;
    });
    beside_.assign(3 * patch_.size(), -1);
    for_each_edge(sides, [&](std::size_t i, std::size_t j) {
      if (j - i != 2) return;
      note(sides[i].halfedge, sides[i + 1].halfedge);
      note(sides[i + 1].halfedge, sides[i].halfedge);
    });
  }
  void note(Halfedge h, Halfedge other) {
    if (const int p = place_[at(h / 3)]; p >= 0) beside_[at(3 * p + h % 3)] = other;
  }

  /// Breadth first, all rim sides at once.
  void reach_from_rim() {
    rim_of_.assign(patch_.size(), -1);
    std::vector<int> reached;
    const auto reach = [&](int p, Halfedge rim) {
      if (rim_of_[at(p)] >= 0) return;
      rim_of_[at(p)] = rim;
      reached.push_back(p);
    };
    for (int i = 0; i < static_cast<int>(beside_.size()); ++i) {
      const Halfedge h = beside_[at(i)];
      if (h >= 0 && place_[at(h / 3)] < 0) reach(i / 3, h);
    }
    for (std::size_t i = 0; i < reached.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        const Halfedge h = beside_[at(3 * reached[i] + k)];
        if (h >= 0 && place_[at(h / 3)] >= 0) reach(place_[at(h / 3)], rim_of_[at(reached[i])]);
      }
    }
  }

  int end_at(Halfedge h, Face f) {
    const auto key = std::tuple{corner(h), material(f), uv_(h, 0), uv_(h, 1)};
    return ends_.try_emplace(key, static_cast<int>(ends_.size())).first->second;
  }

  void join_runs() {
    std::vector<std::array<int, 2>> sides;
    for (const Halfedge h : beside_) {
      if (h < 0 || place_[at(h / 3)] >= 0) continue;
      sides.push_back({end_at(h, h / 3), end_at(next(h), h / 3)});
      run_of_.emplace(h, sides.back()[0]);
    }
    UnionFind runs(ends_.size());
    for (const auto& [one, other] : sides) runs.unite(one, other);
    for (auto& [h, run] : run_of_) run = runs.find(run);
    for (const auto& [key, end] : ends_) {
      const Node node{runs.find(end), std::get<0>(key)};
      const Texcoord texcoord(std::get<2>(key), std::get<3>(key));
      if (!placed_.emplace(node, texcoord).second) folded_.insert(node.first);
    }
  }

  int run_at(int p) const { return run_of_.at(rim_of_[at(p)]); }
  bool runs_on(int p) const { return rim_of_[at(p)] >= 0 && !folded_.contains(run_at(p)); }

  /// Where a run has no coordinates of its own: the mean of its neighbours in it.
  void place_free_corners() {
    constexpr int rounds = 40;  // of means: what closes a hole is few vertices deep
    std::map<Node, std::vector<Node>> free;
    for (int p = 0; p < static_cast<int>(patch_.size()); ++p) {
      if (!runs_on(p)) continue;
      for (int k = 0; k < 3; ++k) {
        const Node node{run_at(p), file_.mesh.triangles(patch_[at(p)], k)};
        if (placed_.contains(node)) continue;
        for (const int other : {(k + 1) % 3, (k + 2) % 3})
          free[node].emplace_back(node.first, file_.mesh.triangles(patch_[at(p)], other));
      }
    }
    for (const auto& [node, neighbours] : free) placed_.emplace(node, mean_of_run(node.first));
    for (int round = 0; round < rounds; ++round)
      for (const auto& [node, neighbours] : free) placed_[node] = mean_of(neighbours);
  }

  Texcoord mean_of(const std::vector<Node>& nodes) const {
    Texcoord sum = Texcoord::Zero();
    for (const Node& node : nodes) sum += placed_.at(node);
    return sum / static_cast<double>(nodes.size());
  }

  /// Of the ends of its sides on the rim.
  Texcoord mean_of_run(int run) {
    const auto [known, is_new] = means_.try_emplace(run, Texcoord::Zero());
    if (!is_new) return known->second;
    long count = 0;
    for (auto it = placed_.lower_bound({run, 0}); it != placed_.end() && it->first.first == run;
         ++it, ++count)
      known->second += it->second;
    return known->second /= static_cast<double>(std::max(count, 1L));
  }

  Texcoord texcoord_at(int p, Halfedge h) const {
    const Halfedge rim = rim_of_[at(p)];
    for (const Halfedge end : {rim, next(rim)})
      if (corner(h) == corner(end)) return uv_.row(end);
    if (runs_on(p)) return placed_.at({run_at(p), corner(h)});
    return along_side(point(rim), point(next(rim)), uv_.row(rim), uv_.row(next(rim)), point(h));
  }

  void write() {
    for (int p = 0; p < static_cast<int>(patch_.size()); ++p) {
      const Face f = patch_[at(p)];
      if (rim_of_[at(p)] < 0) continue;
      for (int k = 0; k < 3; ++k) uv_.row(3 * f + k) = texcoord_at(p, 3 * f + k);
      if (material_) material_->values[at(f)] = material(rim_of_[at(p)] / 3);
    }
  }

  MeshFile& file_;
  const RepairedMesh& repaired_;
  CornerTexcoords& uv_;
  Property* material_ = nullptr;
  std::vector<int> place_;        // of each face among those put in; −1: an old one
  std::vector<Face> patch_;       // what was put in
  std::vector<Halfedge> beside_;  // of each of its sides, the other side of the edge; −1: none
  std::vector<Halfedge> rim_of_;  // of each, the old side that it belongs to
  // Of rim sides, by what is there.
  std::map<std::tuple<Vertex, double, double, double>, int> ends_;
  std::map<Halfedge, int> run_of_;  // of rim sides
  std::map<Node, Texcoord> placed_;
  std::map<int, Texcoord> means_;
  std::set<int> folded_;  // runs that have a vertex at two places of the image
};

/// Faces whose corners come of several faces of the input: turned diagonals.
class TurnedFaces {
 public:
  TurnedFaces(MeshFile& mended, const MeshFile& before, const CornerTexcoords& input,
              const RepairedMesh& repaired)
      : mended_(mended), before_(before), input_(input), repaired_(repaired) {}

  void run() {
    for (Face f = 0; f < static_cast<Face>(mended_.mesh.face_count()); ++f) {
      if (repaired_.face_origin[static_cast<std::size_t>(f)] < 0) continue;
      for (int k = 0; k < 3; ++k) {
        const Face own = origin(f, k), other = origin(f, (k + 1) % 3);
        if (other == own || own != origin(f, (k + 2) % 3)) continue;
        if (!is_one_piece(own, other)) keep_to_side(f, (k + 2) % 3);
      }
    }
  }

 private:
  Face origin(Face f, int k) const {
    return repaired_.corner_origin[static_cast<std::size_t>(3 * f + k)] / 3;
  }

  /// Whether the texture runs on over the edge that two faces of the input share.
  bool is_one_piece(Face f, Face g) const {
    int alike = 0;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        alike += before_.mesh.triangles(f, i) == before_.mesh.triangles(g, k) &&
                 input_.row(3 * f + i) == input_.row(3 * g + k);
    return alike >= 2;
  }

  /// The corner opposite the side that begins at corner k comes of another piece of the atlas.
  void keep_to_side(Face f, int k) {
    CornerTexcoords& uv = *mended_.corner_texcoords;
    const int a = 3 * f + k, b = 3 * f + (k + 1) % 3, c = 3 * f + (k + 2) % 3;
    const auto point = [&](int i) -> Vector3 {
      return mended_.mesh.positions.row(mended_.mesh.triangles(i / 3, i % 3));
    };
    uv.row(c) = along_side(point(a), point(b), uv.row(a), uv.row(b), point(c));
  }

  MeshFile& mended_;
  const MeshFile& before_;
  const CornerTexcoords& input_;
  const RepairedMesh& repaired_;
};

}  // namespace

void texture_patches(MeshFile& mended, const MeshFile& before, const CornerTexcoords& input,
                     const RepairedMesh& repaired) {
  TurnedFaces(mended, before, input, repaired).run();
  PatchTexture(mended, repaired).run();
}

}  // namespace sphparam
