#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "mapping/task_list.h"
#include "sphparam/io/up_axis.h"

namespace sphparam::campaign {

/// How a task ended.
inline constexpr char certified[] = "certified", not_certified[] = "not certified",
                      thrown[] = "thrown", lost[] = "lost";

/// A task and what came of it: a line of the log.
struct TaskRecord {
  std::int64_t task = 0;
  std::string mesh, folder, size, order, poles, way;  // what it was, in words
  std::uint32_t order_seed = 0;                       // of the permutation
  std::string end = lost;
  std::string reason = {};               // of an end that is not `certified`
  std::string made_by = {};              // the stage that made the map
  std::vector<std::string> stages = {};  // all that ran: repairs are among them
  bool placed = false;                   // poles, or the alignment, are as asked for
  long triangles = 0;
  double seconds = 0;  // of the map, of processor time
  double mean_abs_ln_angle = 0, mean_abs_ln_area = 0;
  std::uint64_t digest = 0;  // of the map
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TaskRecord, task, mesh, folder, size, order, poles, way,
                                   order_seed, end, reason, made_by, stages, placed, triangles,
                                   seconds, mean_abs_ln_angle, mean_abs_ln_area, digest)

/// By number; of a task that was done again, the last.
using TaskRecords = std::map<std::int64_t, TaskRecord>;

/// Does tasks, and keeps the mesh of the last one with its simplifications.
class TaskTrial {
 public:
  TaskTrial(const TaskList& tasks, std::uint64_t seed) : tasks_(tasks), seed_(seed) {}

  /// With what the task is, lost so far.
  TaskRecord blank(std::int64_t number) const;
  TaskRecord run(std::int64_t number);

 private:
  void prepare(const SourceMesh& mesh);
  const TriangleMesh& shape(int size);
  void map(const Task& task, TaskRecord& record);

  const TaskList& tasks_;
  std::uint64_t seed_;
  std::string path_;  // of the mesh that is kept
  UprightAxes axes_ = {};
  std::map<int, TriangleMesh> shapes_;  // by size
};

}  // namespace sphparam::campaign
