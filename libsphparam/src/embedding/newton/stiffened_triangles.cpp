#include "embedding/newton/stiffened_triangles.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "sphparam/parallel.h"

// On a straight way the determinant is a cubic in t. What a triangle allows is looked for by
// halving. Were the forces on it the same next time, 1/t times the stiffness would make t = 1.

namespace sphparam {
namespace {

constexpr double least_kept = 0.1;      // of the determinant
constexpr double allowed_part = 0.5;    // of a step: no triangle that allows it is stiffened
constexpr double shortest_part = 1e-5;  // that is told from none
constexpr double margin = 2;            // more than 1/t
constexpr float greatest = 1e6;         // beyond it the system is no longer solved
constexpr double few = 0.02;            // of all triangles …
constexpr double always_few = 8;        // … and of however many

size_t at(int i) { return static_cast<size_t>(i); }

/// What part of the step a triangle allows, by halving.
double allowed(const TrianglePack& pack, int lane, const std::vector<ImagePoint>& image,
               const std::vector<Vector3>& motion) {
  const auto corner = [&](int k) { return at(pack.corner[k][lane]); };
  const Vector3 x = image[corner(0)].vector(), dx = motion[corner(0)];
  const Vector3 a = image[corner(1)].vector() - x, da = motion[corner(1)] - dx;
  const Vector3 b = image[corner(2)].vector() - x, db = motion[corner(2)] - dx;
  const double least = least_kept * x.dot(a.cross(b));
  double t = 1;
  while (t > shortest_part && !((x + t * dx).dot((a + t * da).cross(b + t * db)) > least)) t /= 2;
  return t;
}

/// A triangle that blocks a step.
struct Blocking {
  size_t pack, lane;
  float factor;
};

std::vector<Blocking> blocking_triangles(const TriangleBlocks& blocks, int block,
                                         const std::vector<ImagePoint>& image,
                                         const std::vector<Vector3>& motion) {
  std::vector<Blocking> found;
  const TrianglePack* const packs = blocks.packs_of(block);
  const auto first = static_cast<size_t>(packs - blocks.packs_of(0));
  for (int p = 0; p < blocks.pack_count(block); ++p) {
    for (int lane = 0; lane < pack_width; ++lane) {
      const double t = allowed(packs[p], lane, image, motion);
      if (t >= allowed_part) continue;
      found.push_back({first + at(p), at(lane), static_cast<float>(margin / t)});
    }
  }
  return found;
}

}  // namespace

bool StiffenedTriangles::stiffen(const TriangleBlocks& blocks, const std::vector<ImagePoint>& image,
                                 const std::vector<Vector3>& motion, int threads) {
  std::vector<std::vector<Blocking>> found(at(blocks.count()));
  parallel_for(blocks.count(), TriangleBlocks::grain, threads,
               [&](std::int64_t first, std::int64_t last) {
                 for (int b = static_cast<int>(first); b < static_cast<int>(last); ++b) {
                   found[at(b)] = blocking_triangles(blocks, b, image, motion);
                 }
               });
  size_t count = 0;
  for (const std::vector<Blocking>& of_block : found) count += of_block.size();
  const double all = pack_width * blocks.pack_count();
  if (count == 0 || static_cast<double>(count) > std::max(always_few, few * all)) return false;
  Factors all_once;
  all_once.fill(1);
  for (const std::vector<Blocking>& of_block : found) {
    for (const Blocking& triangle : of_block) {
      if (factors_.empty()) factors_.assign(at(blocks.pack_count()), all_once);
      float& factor = factors_[triangle.pack][triangle.lane];
      factor = std::min(greatest, factor * triangle.factor);
    }
  }
  return true;
}

void StiffenedTriangles::apply(const TriangleBlocks& blocks, int block,
                               TriangleTerms* terms) const {
  if (factors_.empty()) return;
  const Factors* factors = factors_.data() + (blocks.packs_of(block) - blocks.packs_of(0));
  for (int p = 0; p < blocks.pack_count(block); ++p) {
    for (int k = 0; k < 3; ++k) {
      for (int lane = 0; lane < pack_width; ++lane) {
        const double factor = factors[p][at(lane)];
        for (auto& entry : terms[p].diagonal[k]) entry[lane] *= factor;
        for (auto& entry : terms[p].off[k]) entry[lane] *= factor;
      }
    }
  }
}

}  // namespace sphparam
