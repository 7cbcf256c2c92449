#include "mapping/task_log.h"

#include <fcntl.h>
#include <sys/file.h>

#include <filesystem>
#include <stdexcept>
#include <utility>

namespace sphparam::campaign {

namespace fs = std::filesystem;

TaskLog::TaskLog(const std::string& path, bool read_only) {
  if (path.empty()) return;
  read(path);
  if (!settings_ && meshes_.empty() && fs::exists(path) && fs::file_size(path) > 0)
    throw std::runtime_error(path + " is no log of tasks");
  if (read_only) return;
  lock(path);
  // Meshes without the settings behind them are of a run that was cut off while it wrote them.
  if (!settings_) {
    meshes_.clear();
    fs::resize_file(path, 0);
  }
  file_.open(path, std::ios::app);
  if (settings_) file_ << std::endl;  // after half a line
}

/// Two runs would do everything twice. The lock goes with the process.
void TaskLog::lock(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file < 0 || ::flock(file, LOCK_EX | LOCK_NB) != 0)
    throw std::runtime_error(path + " cannot be written, or another run writes it");
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
