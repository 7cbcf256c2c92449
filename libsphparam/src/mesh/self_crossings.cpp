#include "sphparam/mesh/self_crossings.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "mesh/box.h"
#include "mesh/face_boxes.h"
#include "mesh/triangle_crossing.h"
#include "sphparam/parallel.h"

// Leaves of the tree are looked at by the chunk, chunks by the round, rounds one after the other:
// where it is cut short does not depend on threads.

namespace sphparam {
namespace {

constexpr std::int64_t leaves_a_chunk = 64, chunks_a_round = 16;
constexpr std::int64_t any_number = std::numeric_limits<std::int64_t>::max();
constexpr std::array<Face, 2> no_pair = {std::numeric_limits<Face>::max(), 0};
constexpr int harmless = 60;  // binary orders of magnitude

std::vector<Face> sound_faces(const TriangleMesh& mesh) {
  std::vector<Face> faces;
  faces.reserve(static_cast<size_t>(mesh.face_count()));
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const bool is_sound = std::ranges::all_of(std::array{0, 1, 2}, [&](int k) {
      const Vertex v = mesh.triangles(f, k);
      return v >= 0 && v < mesh.vertex_count() && mesh.position(v).allFinite();
    });
    if (is_sound) faces.push_back(f);
  }
  return faces;
}

/// Of the largest coordinate, in powers of two; 0 where that is no matter for signs.
int size_of(const TriangleMesh& mesh, const std::vector<Face>& faces) {
  double largest = 0;
  for (const Face f : faces) {
    for (int k = 0; k < 3; ++k)
      largest = std::max(largest, mesh.position(mesh.triangles(f, k)).cwiseAbs().maxCoeff());
  }
  const int exponent = largest > 0 ? std::ilogb(largest) : 0;
  return std::abs(exponent) > harmless ? exponent : 0;
}

TriangleMesh times_power_of_two(TriangleMesh mesh, int exponent) {
  for (double& x : mesh.positions.reshaped()) x = std::ldexp(x, exponent);
  return mesh;
}

class Count {
 public:
  Count(const TriangleMesh& mesh, std::vector<Face> faces, const SelfCrossingOptions& options)
      : mesh_(mesh),
        options_(options),
        boxes_(mesh, std::move(faces)),
        marks_(static_cast<size_t>(mesh.face_count())) {}

  SelfCrossings run() {
    const std::int64_t leaves = boxes_.leaf_count(), round = leaves_a_chunk * chunks_a_round;
    for (std::int64_t first = 0; first < leaves && found_.all; first += round) {
      report(options_.progress, "crossings",
             static_cast<double>(first) / static_cast<double>(leaves));
      look_at(first, std::min(first + round, leaves));
    }
    finish();
    return std::move(found_);
  }

 private:
  struct Part {
    std::int64_t looks = 0, pairs = 0;
    bool all = true;
    std::array<Face, 2> first = no_pair;
  };

  TriangleCorners corners(Face f) const {
    return {mesh_.position(mesh_.triangles(f, 0)), mesh_.position(mesh_.triangles(f, 1)),
            mesh_.position(mesh_.triangles(f, 2))};
  }

  std::int64_t most() const {
    return options_.most_looks > 0 ? options_.most_looks * std::int64_t{mesh_.face_count()}
                                   : any_number;
  }

  /// A few times what it has of all, and no more than its round can afford.
  std::int64_t most_of_chunk() const {
    if (options_.most_looks == 0) return any_number;
    constexpr std::int64_t times = 4;
    return most() / (chunks_a_round / 2) +
           times * leaves_a_chunk * FaceBoxes::most_in_leaf * options_.most_looks;
  }

  void mark(Face f) {
    std::atomic_ref(marks_[static_cast<size_t>(f)]).store(1, std::memory_order_relaxed);
  }

  void look_at(std::int64_t begin, std::int64_t end) {
    std::vector<Part> parts(static_cast<size_t>((end - begin - 1) / leaves_a_chunk + 1));
    parallel_for(
        end - begin, leaves_a_chunk, options_.threads, [&](std::int64_t first, std::int64_t last) {
          parts[static_cast<size_t>(first / leaves_a_chunk)] = part(begin + first, begin + last);
        });
    for (const Part& part : parts) add(part);
  }

  /// Of the leaves of one chunk.
  Part part(std::int64_t begin, std::int64_t end) {
    Part part;
    const std::int64_t most_here = most_of_chunk();
    const auto visit = [&](Face f, Face g) {
      if (!triangles_cross(corners(f), corners(g))) return;
      ++part.pairs;
      mark(f);
      mark(g);
      part.first = std::min(part.first, {std::min(f, g), std::max(f, g)});
    };
    for (std::int64_t leaf = begin; leaf < end && part.all; ++leaf) {
      part.looks += boxes_.visit_pairs(leaf, most_here - part.looks, visit);
      part.all = part.looks < most_here;
    }
    return part;
  }

  void add(const Part& part) {
    looks_ += part.looks;
    found_.pairs += part.pairs;
    found_.all &= part.all && looks_ < most();
    first_ = std::min(first_, part.first);
  }

  void finish() {
    if (found_.pairs == 0) return;
    found_.faces = std::ranges::count(marks_, 1);
    found_.marks = std::move(marks_);
    found_.first = first_;
    Box shared[2];
    for (size_t i = 0; i < 2; ++i)
      for (const Vector3& corner : corners(first_[i])) shared[i].add(corner);
    found_.place = shared[0].lower.cwiseMax(shared[1].lower) / 2 +
                   shared[0].upper.cwiseMin(shared[1].upper) / 2;
  }

  const TriangleMesh& mesh_;
  const SelfCrossingOptions& options_;
  const FaceBoxes boxes_;
  FillerMarks marks_;
  std::int64_t looks_ = 0;
  std::array<Face, 2> first_ = no_pair;
  SelfCrossings found_;
};

}  // namespace

SelfCrossings find_self_crossings(const TriangleMesh& mesh, const SelfCrossingOptions& options) {
  if (options.most_looks < 0) throw std::invalid_argument("most_looks is less than 0");
  std::vector<Face> faces = sound_faces(mesh);
  const int exponent = size_of(mesh, faces);
  if (exponent == 0) return Count(mesh, std::move(faces), options).run();
  const TriangleMesh scaled = times_power_of_two(mesh, -exponent);
  SelfCrossings found = Count(scaled, std::move(faces), options).run();
  for (double& x : found.place) x = std::ldexp(x, exponent);
  return found;
}

}  // namespace sphparam
