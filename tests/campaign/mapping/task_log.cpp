#include "mapping/task_log.h"

#include <stdexcept>
#include <utility>

namespace sphparam::campaign {

TaskLog::TaskLog(const std::string& path) {
  if (path.empty()) return;
  read(path);
  // Meshes without the settings behind them are of a run that ended while it was still reading.
  if (!settings_) meshes_.clear();
  file_.open(path, settings_ ? std::ios::app : std::ios::trunc);
  if (!file_) throw std::runtime_error(path + ": cannot be written");
  if (settings_) file_ << std::endl;  // after half a line
}

void TaskLog::read(const std::string& path) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const nlohmann::json json = nlohmann::json::parse(line, nullptr, false);
    if (json.contains("task")) {
      TaskRecord record = json;
      records_[record.task] = std::move(record);
    } else if (json.contains("seed")) {
      settings_ = json.get<LogSettings>();
    } else if (json.contains("path")) {
      meshes_.push_back(json);
    }
  }
}

void TaskLog::begin(const LogSettings& settings, std::vector<SourceMesh> meshes) {
  for (const SourceMesh& mesh : meshes) file_ << line_of(mesh) << '\n';
  file_ << line_of(settings) << std::endl;
  settings_ = settings;
  meshes_ = std::move(meshes);
}

// Far shorter than a stream's buffer, and so written by one call, which nothing interrupts.
void TaskLog::add(TaskRecord record) {
  if (file_.is_open()) file_ << line_of(record) << std::endl;
  records_[record.task] = std::move(record);
}

std::string line_of(const nlohmann::json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace sphparam::campaign
