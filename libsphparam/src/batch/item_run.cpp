// An item in its own folder: staging/NAME/files, where steps run and which becomes results/ID, and
// beside it the log and the reports.

#include "batch/item_run.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "batch/child.h"
#include "batch/input_hash.h"
#include "batch/options_hash.h"
#include "batch/publication.h"
#include "batch/staging.h"
#include "number_text.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/stopwatch.h"

namespace sphparam {

namespace {

namespace fs = std::filesystem;

constexpr int file_error = 3, interrupted = 130;  // of the program

double cpu_seconds_so_far() {
  double sum = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    ::getrusage(who, &usage);
    for (const timeval& time : {usage.ru_utime, usage.ru_stime})
      sum += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  return sum;
}

std::int64_t peak_of_children() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  return usage.ru_maxrss * 1024L;
}

void send_messages_to(const std::string& log) {
  const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file < 0) throw WriteError(log, std::strerror(errno));
  ::dup2(file, STDOUT_FILENO);
  ::dup2(file, STDERR_FILENO);
  ::close(file);
}

BatchRecord record_of(const ItemSetting& setting, const BatchItem& item) {
  BatchRecord record;
  record.id = item.id;
  record.path = item.path;
  record.plan = setting.plan.name;
  record.host = host_name();
  record.head.planned = record.head.input = item.input;
  record.head.options = item.options;
  record.head.program = program_hash();
  if (const auto before = record_about(setting.folder, item))
    record.head.attempt = before->head.attempt + 1;
  return record;
}

bool has_certificate(const nlohmann::json& map) {
  const auto certificate = map.find("certificate");
  return certificate != map.end() && certificate->is_object() &&
         certificate->value("one_to_one", false);
}

/// Is any of the maps that it tells of proved? Of the parts of one mesh, all.
bool tells_of_certificate(const std::string& report) {
  const auto json = nlohmann::json::parse(report, nullptr, false);
  const auto parts = json.find("parts");
  if (parts == json.end() || !parts->is_array()) return has_certificate(json);
  return !parts->empty() && std::ranges::all_of(*parts, has_certificate);
}

void count_repairs(const nlohmann::json& json, std::vector<std::pair<std::string, long>>& counts) {
  const auto repairs = json.find("repairs");
  if (repairs == json.end() || !repairs->is_array()) return;
  for (const auto& repair : *repairs) {
    const std::string kind = repair.value("kind", "repair");
    auto known = std::ranges::find(counts, kind, &std::pair<std::string, long>::first);
    if (known == counts.end()) known = counts.emplace(counts.end(), kind, 0);
    known->second += repair.value("count", 0L);
  }
}

/// "hole-filled 1; handle-cut 2", as a step that mends a mesh, or the parts of one, tells it.
std::string repairs_told(const std::string& report) {
  const auto json = nlohmann::json::parse(report, nullptr, false);
  std::vector<std::pair<std::string, long>> counts;
  count_repairs(json, counts);
  const auto parts = json.find("parts");
  if (parts != json.end() && parts->is_array())
    for (const auto& part : *parts) count_repairs(part, counts);
  std::vector<std::string> told;
  for (const auto& [kind, count] : counts) told.push_back(kind + " " + std::to_string(count));
  return joined(told, "; ");
}

/// Those of all steps; two that mend the same mesh alike count once.
std::string repairs_of(const std::vector<BatchStepRecord>& steps) {
  std::vector<std::string> told;
  for (const BatchStepRecord& step : steps) {
    const std::string repairs = repairs_told(step.report);
    if (!repairs.empty() && std::ranges::count(told, repairs) == 0) told.push_back(repairs);
  }
  return joined(told, "; ");
}

/// What its steps warned of, each once. With -q a step says so in its report alone.
std::vector<std::string> warnings_of(const BatchRecord& record) {
  std::vector<std::string> warnings = warnings_in(record.log);
  const auto is_known = [&](const std::string& said) {  // perhaps with its file before it
    return std::ranges::any_of(warnings, [&](const auto& line) { return line.ends_with(said); });
  };
  for (const BatchStepRecord& step : record.steps) {
    const auto json = nlohmann::json::parse(step.report, nullptr, false);
    const auto said = json.find("warnings");
    if (said == json.end() || !said->is_array()) continue;
    for (const auto& line : *said)
      if (line.is_string() && !is_known(line)) warnings.push_back(line);
  }
  return warnings;
}

/// Where a step says what it found: its own --json, or one that is added.
std::string report_path(const BatchStep& words, const std::string& added) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--json" && i + 1 < words.size()) return words[i + 1];
    if (words[i].starts_with("--json=")) return words[i].substr(7);
  }
  return added;
}

class ItemRun {
 public:
  ItemRun(const ItemSetting& setting, const BatchItem& item)
      : setting_(setting),
        item_(item),
        staged_(setting.folder + "/staging/" + staging_name(item.id)),
        record_(record_of(setting, item)) {}

  ItemEnd run() {
    fs::create_directories(staged_ + "/files");
    send_messages_to(staged_ + "/log");
    fs::current_path(staged_ + "/files");
    std::string complaint = complaint_of_input();
    if (!complaint.empty()) return fail(file_error, complaint);
    const std::vector<BatchStep> steps = steps_of(setting_.plan, item_);
    for (const BatchStep& step : steps) {
      const int code = run_step(step);
      if (code == interrupted) return end(ItemInterrupted);
      if (code == step_has_no_room) give_up();
      if (code != 0) {
        record_.head.step = std::to_string(record_.steps.size()) + " " + step.front();
        return fail(code, "");
      }
    }
    return succeed();
  }

 private:
  /// Empty: input and options are those that were planned.
  std::string complaint_of_input() try {
    const FileStamp stamp = stamp_of(item_.path);
    const InputHash input = hash_of_input(item_.path);
    record_.head.input = input.hash;
    if (input.alone && !is_fresh(stamp)) record_.head.stamp = stamp;
    if (record_.head.input != item_.input)
      return "the input has changed since the plan, or a file that it names; `sphparam batch plan` "
             "plans it as it is";
    if (OptionsHash(setting_.plan).of(item_) != item_.options)
      return "a file that the options name has changed since the plan; `sphparam batch plan` plans "
             "it as it is";
    return "";
  } catch (const ReadError& error) {
    record_.head.input.clear();
    return error.what();
  }

  int run_step(const BatchStep& words) {
    const std::string number = std::to_string(record_.steps.size() + 1);
    BatchStepRecord& step = record_.steps.emplace_back();
    step.words = words;
    const BatchStepSetting setting{"../report-" + number + ".json", setting_.threads};
    const Stopwatch stopwatch;
    const pid_t child = start_child([&] { return setting_.run_step(words, setting); });
    step.code = wait_for_child(child).code;
    step.seconds = stopwatch.seconds();
    step.report = small_file(report_path(words, setting.report)).value_or("");
    return step.code;
  }

  ItemEnd succeed() {
    const bool certified =
        std::ranges::any_of(record_.steps, tells_of_certificate, &BatchStepRecord::report);
    record_.head.outcome = certified ? BatchOutcome::Certified : BatchOutcome::Done;
    complete();
    record_.head.files = files_below(".");
    write_file("record.json", to_json(record_));
    fs::current_path(setting_.folder);
    const bool first = publish_results(setting_.folder, staged_ + "/files", item_);
    return end(first ? ItemDone : ItemDoneElsewhere);
  }

  ItemEnd fail(int code, const std::string& reason) {
    record_.head.outcome = BatchOutcome::Failed;
    record_.head.code = code;
    complete();
    record_.head.reason = !reason.empty() ? reason : reason_of_end(code, record_.log);
    fs::current_path(setting_.folder);
    publish_failure(setting_.folder, staged_, record_);
    return end(ItemFailed);
  }

  void complete() {
    record_.log = small_file(staged_ + "/log").value_or("");
    record_.head.repairs = repairs_of(record_.steps);
    record_.head.warnings = warnings_of(record_);
    record_.head.seconds = stopwatch_.seconds();
    record_.head.cpu_seconds = cpu_seconds_so_far();
    record_.head.ended = std::time(nullptr);
    record_.peak_bytes = peak_of_children();
  }

  [[noreturn]] void give_up() {
    const std::string reason = reason_in(small_file(staged_ + "/log").value_or(""));
    end(ItemMachineError);
    throw BatchMachineError(reason);
  }

  ItemEnd end(ItemEnd how) {
    fs::current_path(setting_.folder);
    std::error_code hidden;  // what stays is removed by the next run
    fs::remove_all(staged_, hidden);
    return how;
  }

  const ItemSetting& setting_;
  const BatchItem& item_;
  const std::string staged_;
  const Stopwatch stopwatch_;
  BatchRecord record_;
};

}  // namespace

ItemEnd run_item(const ItemSetting& setting, const BatchItem& item) {
  return ItemRun(setting, item).run();
}

bool record_crash(const ItemSetting& setting, const BatchItem& item, const std::string& staged,
                  int code, double cpu_seconds) {
  if (has_results(setting.folder, item)) {
    fs::remove_all(staged);
    return false;
  }
  BatchRecord record = record_of(setting, item);
  std::error_code error;
  fs::create_directories(staged, error);
  if (error) throw BatchMachineError(staged + ": " + error.message());
  record.log = small_file(staged + "/log").value_or("");
  record.head.code = code;
  record.head.reason = reason_of_end(code, record.log);
  record.head.warnings = warnings_in(record.log);
  record.head.cpu_seconds = record.head.seconds = cpu_seconds;
  record.head.ended = std::time(nullptr);
  publish_failure(setting.folder, staged, record);
  fs::remove_all(staged);
  return true;
}

}  // namespace sphparam
