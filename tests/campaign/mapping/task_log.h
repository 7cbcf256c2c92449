#pragma once

#include <cstdint>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mapping/source_meshes.h"
#include "mapping/task_trial.h"

namespace sphparam::campaign {

/// What numbers of tasks mean besides the meshes.
struct LogSettings {
  std::uint64_t seed = 1;
  int orders = 5;
  bool repair = false;
  bool operator==(const LogSettings&) const = default;
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LogSettings, seed, orders, repair)

/// A file of JSON, a line a mesh, then one of the settings, then a line a task as it ends. It may
/// be cut off anywhere and gone on with: half a line counts for nothing.
class TaskLog {
 public:
  /// Reads what is there; an empty path is a log that is not kept. Throws: std::runtime_error, if
  /// it is something else, cannot be written, or another run writes it.
  TaskLog(const std::string& path, bool read_only);

  const std::optional<LogSettings>& settings() const { return settings_; }
  const std::vector<SourceMesh>& meshes() const { return meshes_; }
  const TaskRecords& records() const { return records_; }

  /// Once, before all tasks.
  void begin(const LogSettings& settings, std::vector<SourceMesh> meshes);
  void add(TaskRecord record);

 private:
  void read(const std::string& path);
  static void lock(const std::string& path);

  std::optional<LogSettings> settings_;
  std::vector<SourceMesh> meshes_;
  TaskRecords records_;
  std::ofstream file_;
};

/// In one line, whatever bytes its texts are of.
std::string line_of(const nlohmann::json& json);

}  // namespace sphparam::campaign
