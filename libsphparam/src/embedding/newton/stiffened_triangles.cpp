#include "embedding/newton/stiffened_triangles.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>

#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/parallel.h"

// On a straight way the determinant is a cubic in t. What a triangle allows is looked for by
// halving. Were the forces on it the same next time, 1/t times the stiffness would make t = 1.
// What it has against a change of its area is not only its own: its neighbours hold its vertices.
// Of that the diagonal blocks D of the Hessian tell enough: a unit force along g = ∇log|T| changes
// log|T| by Σ gᵀD⁻¹g, were its vertices to move one at a time.

namespace sphparam {
namespace {

constexpr double least_kept = 0.1;         // of the determinant
constexpr double allowed_part = 0.5;       // of a step: no triangle that allows it is stiffened
constexpr double worthwhile_part = 0.125;  // where a step is cut to it, or shorter
constexpr double shortest_part = 1e-5;     // that is told from none
constexpr double margin = 2;               // more than 1/t
constexpr double greatest = 1e6;           // factor: beyond it the system is no longer solved

std::array<Vector3, 3> corners(const TrianglePack& pack, int lane,
                               const std::vector<ImagePoint>& image) {
  const auto corner = [&](int k) { return image[at(pack.corner[k][lane])].vector(); };
  return {corner(0), corner(1), corner(2)};
}

/// What part of the step a triangle allows, by halving.
double allowed(const TrianglePack& pack, int lane, const std::vector<ImagePoint>& image,
               const std::vector<Vector3>& motion) {
  const auto [x, y, z] = corners(pack, lane, image);
  const auto moves = [&](int k) { return motion[at(pack.corner[k][lane])]; };
  const Vector3 dx = moves(0), a = y - x, da = moves(1) - dx, b = z - x, db = moves(2) - dx;
  const double least = least_kept * x.dot(a.cross(b));
  double t = 1;
  while (t > shortest_part && !((x + t * dx).dot((a + t * da).cross(b + t * db)) > least)) t /= 2;
  return t;
}

/// The gradient of the logarithm of its determinant, in the tangent coordinates of each corner.
using Slopes = std::array<std::array<double, 2>, 3>;

Slopes area_slopes(const TrianglePack& pack, int lane, const std::vector<ImagePoint>& image) {
  const std::array<Vector3, 3> x = corners(pack, lane, image);
  const double determinant = x[0].dot((x[1] - x[0]).cross(x[2] - x[0]));
  Slopes slopes;
  for (size_t k = 0; k < 3; ++k) {
    const Vector3 &next = x[(k + 1) % 3], &previous = x[(k + 2) % 3];
    const Vector3 slope = next.cross(previous - next) / determinant;
    const TangentFrame frame = tangent_frame(x[k]);
    slopes[k] = {slope.dot(frame.u), slope.dot(frame.v)};
  }
  return slopes;
}

double compliance_of_area(const TrianglePack& pack, int lane, const std::vector<ImagePoint>& image,
                          const VertexStiffness& vertices) {
  const Slopes slopes = area_slopes(pack, lane, image);
  double sum = 0;
  for (size_t k = 0; k < 3; ++k) sum += vertices.compliance(pack.corner[k][lane], slopes[k]);
  return sum;
}

void scale_hessian(double factor, int lane, TriangleTerms& terms) {
  for (int k = 0; k < 3; ++k) {
    for (auto& entry : terms.diagonal[k]) entry[lane] *= factor;
    for (auto& entry : terms.off[k]) entry[lane] *= factor;
  }
}

/// c ggᵀ
void add_square(double c, const Slopes& g, int lane, TriangleTerms& terms) {
  for (size_t k = 0; k < 3; ++k) {
    const std::array<double, 2>&own = g[k], &next = g[(k + 1) % 3];
    for (size_t i = 0; i < 3; ++i) terms.diagonal[k][i][lane] += c * own[i / 2] * own[(i + 1) / 2];
    for (size_t i = 0; i < 4; ++i) terms.off[k][i][lane] += c * own[i / 2] * next[i % 2];
  }
}

}  // namespace

double VertexStiffness::compliance(Vertex v, const std::array<double, 2>& g) const {
  if (pinned[at(v)]) return 0;
  const Block<2>& d = diagonal[at(v)];
  const double a = unit[at(v)] * g[0], b = unit[at(v)] * g[1];
  return (d(1, 1) * a * a - 2 * d(0, 1) * a * b + d(0, 0) * b * b) /
         (d(0, 0) * d(1, 1) - d(0, 1) * d(0, 1));
}

StiffenedTriangles::OfBlock StiffenedTriangles::blocking(const TriangleBlocks& blocks, int block,
                                                         const std::vector<ImagePoint>& image,
                                                         const std::vector<Vector3>& motion,
                                                         const VertexStiffness& vertices) {
  OfBlock found;
  const TrianglePack* const packs = blocks.packs_of(block);
  for (int p = 0; p < blocks.pack_count(block); ++p) {
    for (int lane = 0; lane < pack_width; ++lane) {
      const double t = allowed(packs[p], lane, image, motion);
      if (t >= allowed_part) continue;
      const double compliance = compliance_of_area(packs[p], lane, image, vertices);
      if (!(compliance > 0)) continue;
      found.triangles.push_back({p, lane, margin / t / compliance, margin / t});
      found.allowed = std::min(found.allowed, t);
    }
  }
  return found;
}

void StiffenedTriangles::add(OfBlock&& more, OfBlock& to) {
  const auto place = [](const Stiffened& s) { return std::pair(s.pack, s.lane); };
  for (Stiffened& s : more.triangles) {
    const auto before = std::ranges::lower_bound(to.triangles, place(s), {}, place);
    const bool again = before != to.triangles.end() && place(*before) == place(s);
    s.of_area += again ? before->of_area : 0;
    s.of_all = again ? std::min(greatest, before->of_all * s.of_all) : 1;
  }
  std::vector<Stiffened> all;  // of two the first's
  std::ranges::set_union(more.triangles, to.triangles, std::back_inserter(all), {}, place, place);
  to.triangles = std::move(all);
}

bool StiffenedTriangles::stiffen(const TriangleBlocks& blocks, const std::vector<ImagePoint>& image,
                                 const std::vector<Vector3>& motion,
                                 const VertexStiffness& vertices, int threads) {
  std::vector<OfBlock> found(at(blocks.count()));
  parallel_for(blocks.count(), TriangleBlocks::grain, threads,
               [&](std::int64_t first, std::int64_t last) {
                 for (int b = static_cast<int>(first); b < static_cast<int>(last); ++b) {
                   found[at(b)] = blocking(blocks, b, image, motion, vertices);
                 }
               });
  const double allowed = std::ranges::min(found, {}, &OfBlock::allowed).allowed;
  if (allowed > worthwhile_part) return false;
  stiffened_.resize(found.size());
  for (size_t b = 0; b < found.size(); ++b) add(std::move(found[b]), stiffened_[b]);
  return true;
}

void StiffenedTriangles::apply(const TriangleBlocks& blocks, int block,
                               const std::vector<ImagePoint>& image, TriangleTerms* terms) const {
  if (stiffened_.empty()) return;
  for (const Stiffened& s : stiffened_[at(block)].triangles) {
    scale_hessian(s.of_all, s.lane, terms[s.pack]);
    add_square(s.of_area, area_slopes(blocks.packs_of(block)[s.pack], s.lane, image), s.lane,
               terms[s.pack]);
  }
}

}  // namespace sphparam
