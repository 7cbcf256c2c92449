#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mapping/source_meshes.h"
#include "sphparam/parameterize.h"

namespace sphparam::campaign {

/// A method with its quality and its balance.
struct Way {
  std::string name;
  ParameterizeOptions options;
  double microseconds;  // a triangle, of processor time; the mean over many meshes
};
const std::vector<Way>& ways();

/// Which vertices go to the poles, or where else the finished map is turned.
enum class Placement { Automatic, None, Upright, Drawn, Aligned };
inline constexpr std::array<const char*, 5> placements{"auto", "none", "top and bottom", "drawn",
                                                       "aligned to the body"};

std::string name_of_size(int size);
std::string name_of_order(int order);

/// One mesh in one way. Numbers from 0; 0 is the mesh as it is, its order, the default way and
/// poles.
struct Task {
  int mesh, size, order, placement, way;
  bool is_default() const { return size == 0 && order == 0 && placement == 0 && way == 0; }
};

/// All tasks of some meshes; a number names one as long as meshes and orders are the same.
class TaskList {
 public:
  /// Borrows the meshes; refused ones have no tasks.
  TaskList(const std::vector<SourceMesh>& meshes, int orders) : meshes_(meshes), orders_(orders) {}

  /// Requires: 0 ≤ number < `end()`. Some numbers below that are no task: see `possible`.
  Task task(std::int64_t number) const;
  std::int64_t end() const;
  const SourceMesh& mesh_of(const Task& task) const;
  /// Of a mesh that maps, and a simplification that is one; nothing but default tasks is estimated
  /// to take longer than `longest_estimate`.
  bool possible(const Task& task) const;
  double estimate(const Task& task) const;  // seconds of the processor
  std::vector<std::int64_t> all() const;

  /// The default task of each mesh, then others until there are so many, or no more: the numbers,
  /// those of a mesh and a size one after the other, large meshes first. Those that are estimated
  /// to take more than `dear` seconds are drawn with weights dear / estimate, all others evenly.
  /// Ensures: a larger count draws the same and more.
  std::vector<std::int64_t> draw(std::int64_t count, std::uint64_t seed) const;

  static constexpr double longest_estimate = 5, dear = 0.5;

 private:
  long triangles(const Task& task) const;

  const std::vector<SourceMesh>& meshes_;
  int orders_;
};

/// Bits that depend on all bits of both.
std::uint64_t mixed(std::uint64_t seed, std::uint64_t number);

}  // namespace sphparam::campaign
