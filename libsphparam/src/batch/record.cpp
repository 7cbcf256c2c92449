// The head comes first in the file, and the reader stops where it ends: status looks at a hundred
// thousand of them.

#include "batch/record.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "batch/tables.h"
#include "sphparam/version.h"

namespace sphparam {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t longest_list = 32;
constexpr std::string_view wrap_words = "wrapped 1";
constexpr std::string_view last_of_record = "}\n";

const char* name_of(BatchOutcome outcome) {
  switch (outcome) {
    case BatchOutcome::Certified:
      return "certified";
    case BatchOutcome::Done:
      return "done";
    case BatchOutcome::Failed:
      return "failed";
  }
  return "";
}

Json stamp_json(const FileStamp& stamp) {
  return {stamp.size, stamp.modified, stamp.changed, stamp.number};
}

Json files_json(const std::vector<BatchFile>& files) {
  Json result = Json::array();
  for (const BatchFile& file : files) result.push_back({file.name, file.size, file.hash});
  return result;
}

void drop_long_lists(Json& json) {
  if (json.is_array() && json.size() > longest_list) json = nullptr;
  if (json.is_structured())
    for (Json& part : json) drop_long_lists(part);
}

Json report_json(const std::string& text) {
  if (text.empty()) return nullptr;
  Json report = Json::parse(text, nullptr, false);
  if (report.is_discarded()) return nullptr;
  drop_long_lists(report);
  return report;
}

Json steps_json(const std::vector<BatchStepRecord>& steps) {
  Json result = Json::array();
  for (const BatchStepRecord& step : steps)
    result.push_back({{"command", step.words},
                      {"code", step.code},
                      {"seconds", step.seconds},
                      {"report", report_json(step.report)}});
  return result;
}

/// Takes what it knows, key by key, and ends at the key behind the head.
class HeadReader : public nlohmann::json_sax<nlohmann::json> {
 public:
  BatchRecordHead head;
  bool whole = false;

  bool null() override { return true; }
  bool boolean(bool value) override {
    if (key_ == "retry") head.retry = value;
    return true;
  }
  bool number_integer(number_integer_t value) override { return number(value); }
  bool number_unsigned(number_unsigned_t value) override {
    if (list_ == 1 && key_ == "stamp") return stamp(static_cast<std::int64_t>(value));
    if (in_file()) head.files.back().size = value;
    return number(static_cast<std::int64_t>(value));
  }
  bool number_float(number_float_t value, const string_t&) override {
    if (key_ == "seconds") head.seconds = value;
    if (key_ == "cpu_seconds") head.cpu_seconds = value;
    return true;
  }
  bool string(string_t& value) override {
    if (key_ == "outcome") return outcome(value);
    if (key_ == "planned") head.planned = value;
    if (key_ == "input") head.input = value;
    if (key_ == "options") head.options = value;
    if (key_ == "program") head.program = value;
    if (key_ == "step") head.step = value;
    if (key_ == "reason") head.reason = value;
    if (key_ == "repairs") head.repairs = value;
    if (key_ == "warnings" && list_ == 1) head.warnings.push_back(value);
    if (in_file()) {
      BatchFile& file = head.files.back();
      (file.name.empty() ? file.name : file.hash) = value;
    }
    return true;
  }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool end_object() override { return true; }
  bool key(string_t& value) override {
    key_ = value;
    whole = value == "id";
    return !whole;
  }
  bool start_array(std::size_t) override {
    if (++list_ == 2 && key_ == "files") head.files.emplace_back();
    return true;
  }
  bool end_array() override {
    --list_;
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    return false;
  }

 private:
  /// Also of a broken record, where "files" may stand in the lists of another key.
  bool in_file() const { return list_ == 2 && key_ == "files" && !head.files.empty(); }
  bool number(std::int64_t value) {
    if (list_ == 1 && key_ == "stamp") return stamp(value);
    if (list_ > 0) return true;
    if (key_ == "code") head.code = static_cast<int>(value);
    if (key_ == "attempt") head.attempt = static_cast<int>(value);
    if (key_ == "ended") head.ended = value;
    if (key_ == "seconds") head.seconds = static_cast<double>(value);
    if (key_ == "cpu_seconds") head.cpu_seconds = static_cast<double>(value);
    return true;
  }
  bool stamp(std::int64_t value) {
    switch (stamped_++) {
      case 0:
        head.stamp.size = static_cast<std::uint64_t>(value);
        break;
      case 1:
        head.stamp.modified = value;
        break;
      case 2:
        head.stamp.changed = value;
        break;
      default:
        head.stamp.number = static_cast<std::uint64_t>(value);
    }
    return true;
  }
  bool outcome(const std::string& name) {
    for (const BatchOutcome one :
         {BatchOutcome::Certified, BatchOutcome::Done, BatchOutcome::Failed}) {
      if (name != name_of(one)) continue;
      head.outcome = one;
      return true;
    }
    return false;
  }

  std::string key_;
  int list_ = 0, stamped_ = 0;
};

}  // namespace

std::string to_json(const BatchRecord& record) {
  const BatchRecordHead& head = record.head;
  Json json = {{"batch_record", 1},
               {"outcome", name_of(head.outcome)},
               {"code", head.code},
               {"step", head.step},
               {"attempt", head.attempt},
               {"retry", head.retry},
               {"planned", head.planned},
               {"input", head.input},
               {"options", head.options},
               {"program", head.program},
               {"stamp", stamp_json(head.stamp)},
               {"seconds", head.seconds},
               {"cpu_seconds", head.cpu_seconds},
               {"ended", head.ended},
               {"reason", head.reason},
               {"repairs", head.repairs},
               {"warnings", head.warnings},
               {"files", files_json(head.files)},
               {"id", record.id},
               {"path", record.path},
               {"plan", record.plan},
               {"sphparam", version},
               {"host", record.host},
               {"peak_bytes", record.peak_bytes},
               {"steps", steps_json(record.steps)},
               {"log", record.log}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<BatchRecordHead> read_head(std::string_view json) {
  HeadReader reader;
  nlohmann::json::sax_parse(json.begin(), json.end(), &reader);
  if (!reader.whole) return std::nullopt;
  return std::move(reader.head);
}

std::optional<std::string> small_file(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0 && (errno == ENOENT || errno == ENOTDIR)) return std::nullopt;
  if (file < 0) throw ReadError(path, std::strerror(errno));
  std::string bytes(4096, '\0');
  std::size_t size = 0;
  for (;;) {
    const ssize_t count = ::read(file, bytes.data() + size, bytes.size() - size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    size += static_cast<std::size_t>(count);
    if (size == bytes.size()) bytes.resize(2 * size);
  }
  ::close(file);
  bytes.resize(size);
  return bytes;
}

std::string result_folder(const std::string& folder, const std::string& id) {
  return folder + "/results/" + id;
}
std::string failure_path(const std::string& folder, const std::string& id) {
  return folder + "/failed/" + id + ".json";
}

std::optional<StoredRecord> record_about(const std::string& folder, const BatchItem& item) {
  std::optional<StoredRecord> latest;
  for (std::string path :
       {result_folder(folder, item.id) + "/record.json", failure_path(folder, item.id)}) {
    std::optional<std::string> bytes = small_file(path);
    if (!bytes || !bytes->ends_with(last_of_record)) continue;
    std::optional<BatchRecordHead> head = read_head(*bytes);
    if (!head || head->options != item.options || head->planned != item.input) continue;
    if (!latest || head->attempt > latest->head.attempt)
      latest = StoredRecord{std::move(*head), std::move(*bytes), std::move(path)};
  }
  return latest;
}

bool is_wrapped(const std::string& repairs) {
  return repairs.find(wrap_words) != std::string::npos;
}

bool is_repaired(const std::string& repairs) { return !repairs.empty() && repairs != wrap_words; }

std::string words_of_step(const std::string& step, const BatchPlan& plan) {
  if (step.empty() || plan.steps.size() < 2) return "";
  const std::size_t blank = std::min(step.find(' '), step.size());
  const std::string command = blank < step.size() ? "," + step.substr(blank) : "";
  return "step " + step.substr(0, blank) + command + ": ";
}

std::string without_folders(std::string reason, const BatchItem& item) {
  const std::string name = fs::path(item.path).filename().string();
  for (std::size_t at = reason.find(item.path); at != std::string::npos;
       at = reason.find(item.path, at + name.size()))
    reason.replace(at, item.path.size(), name);
  return reason;
}

namespace {

/// Of steps that tell what they found and no error: the last line that is neither a detail of
/// another nor a warning.
std::string verdict_in(const std::vector<std::string>& lines) {
  for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
    const bool is_detail = line->empty() || line->find_first_of(" \t{}[]\"") == 0;
    if (!is_detail && !line->starts_with("sphparam: "))
      return line->substr(0, line->find(" → "));  // nothing of it is kept
  }
  return lines.empty() ? "" : lines.back();
}

}  // namespace

std::string reason_in(std::string_view log) {
  constexpr std::string_view mark = "sphparam: error: ";
  constexpr std::string_view kept = "; all outputs are written";  // of a failure nothing is kept
  std::string reason;
  const std::vector<std::string> lines = lines_of(log);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!lines[i].starts_with(mark)) continue;
    reason = lines[i].substr(mark.size());
    if (reason.ends_with(':') && i + 1 < lines.size())  // a list follows
      reason += " " + lines[i + 1].substr(
                          std::min(lines[i + 1].find_first_not_of(' '), lines[i + 1].size()));
  }
  if (reason.ends_with(kept)) reason.resize(reason.size() - kept.size());
  return reason.empty() ? verdict_in(lines) : reason;
}

std::vector<std::string> warnings_in(std::string_view log) {
  constexpr std::string_view mark = "sphparam: warning: ";
  std::vector<std::string> warnings;
  for (const std::string& line : lines_of(log)) {
    if (!line.starts_with(mark)) continue;
    std::string warning = line.substr(mark.size());
    if (std::ranges::count(warnings, warning) == 0) warnings.push_back(std::move(warning));
  }
  return warnings;
}

}  // namespace sphparam
