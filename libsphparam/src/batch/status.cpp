#include "sphparam/batch/status.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "batch/alike_reasons.h"
#include "batch/each_item.h"
#include "batch/engines.h"
#include "batch/publication.h"
#include "batch/record.h"
#include "batch/staging.h"
#include "number_text.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/version.h"

namespace sphparam {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t told_ids = 10;
constexpr std::size_t last_items = 200;  // whose pace is that of the batch
constexpr std::int64_t lately = 3600;    // seconds

using Heads = std::vector<std::optional<BatchRecordHead>>;

Heads heads_of(const std::string& folder, const BatchPlan& plan, int threads) {
  constexpr std::int64_t grain = 256;
  return of_each_item(plan, grain, threads, [&](const BatchItem& item) {
    auto record = record_about(folder, item);
    return record ? std::optional(std::move(record->head)) : std::nullopt;
  });
}

std::vector<BatchFailures> grouped(const BatchPlan& plan, const Heads& heads) {
  struct Group {
    BatchFailures failures;
    AlikeReasons reasons;
  };
  std::map<std::tuple<int, std::string, std::string>, Group> groups;
  for (std::size_t i = 0; i < heads.size(); ++i) {
    if (!heads[i] || !heads[i]->failed()) continue;
    const BatchRecordHead& head = *heads[i];
    const ReasonWording wording = wording_of(head.reason, plan.items[i]);
    auto& [group, reasons] = groups[{head.code, head.step, wording.kind}];
    reasons.add(head.reason, plan.items[i], wording);
    ++group.count;
    group.code = head.code;
    group.step = head.step;
    if (group.ids.size() < told_ids) group.ids.push_back(plan.items[i].id);
  }
  std::vector<BatchFailures> failures;
  for (auto& [key, group] : groups) {
    group.failures.reason = words_of_step(group.failures.step, plan) + group.reasons.text();
    failures.push_back(std::move(group.failures));
  }
  std::ranges::stable_sort(failures, std::ranges::greater{}, &BatchFailures::count);
  return failures;
}

/// By the bytes of inputs, as large meshes take longer.
void estimate_time(BatchStatus& status, const BatchPlan& plan, const Heads& heads) {
  double settled_bytes = 0, open_bytes = 0, cpu = 0;
  std::vector<std::pair<std::int64_t, double>> ends;  // when, how many bytes
  for (std::size_t i = 0; i < heads.size(); ++i) {
    const auto bytes = static_cast<double>(plan.items[i].size);
    if (!heads[i] || heads[i]->retry) {
      open_bytes += bytes;
      continue;
    }
    settled_bytes += bytes;
    cpu += heads[i]->cpu_seconds;
    ends.emplace_back(heads[i]->ended, bytes);
  }
  if (!ends.empty()) status.cpu_seconds_an_item = cpu / static_cast<double>(ends.size());
  if (settled_bytes > 0) status.cpu_seconds_left = cpu / settled_bytes * open_bytes;
  if (ends.size() < 2 || open_bytes == 0) return;
  std::ranges::sort(ends);
  const std::size_t count = std::min(ends.size(), last_items);
  const auto first = ends.end() - static_cast<std::ptrdiff_t>(count);
  const double took = static_cast<double>(ends.back().first - first->first);
  double done = 0;
  for (auto end = first + 1; end != ends.end(); ++end) done += end->second;
  if (took > 0 && done > 0 && std::time(nullptr) - ends.back().first < lately)
    status.seconds_left = open_bytes * took / done;
}

/// What "done" stands for.
std::string done_text(const BatchStatus& status) {
  std::vector<std::string> told;
  if (status.certified > 0)
    told.push_back(std::to_string(status.certified) + " certified one-to-one");
  if (status.repaired > 0) told.push_back(std::to_string(status.repaired) + " repaired");
  if (status.wrapped > 0) told.push_back(std::to_string(status.wrapped) + " wrapped");
  if (status.warned > 0) told.push_back(std::to_string(status.warned) + " with warnings");
  return told.empty() ? "" : "  of the done: " + joined(told) + "\n";
}

/// Rewrites a record of failure as one that is to be tried again.
void mark_for_retry(const std::string& folder, const BatchItem& item, const StoredRecord& record) {
  auto json = nlohmann::ordered_json::parse(record.bytes);
  json["retry"] = true;
  const std::string staged = folder + "/staging/" + staging_name(item.id);
  std::error_code error;
  fs::create_directories(staged, error);
  if (error) throw WriteError(staged, error.message());
  publish_failure_bytes(folder, staged, item.id,
                        json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
  fs::remove_all(staged, error);  // what stays is removed by the next run
}

bool is_wanted(const BatchRetryOptions& options, const BatchItem& item,
               const BatchRecordHead& head) {
  const bool code = options.codes.empty() || std::ranges::count(options.codes, head.code) > 0;
  const bool id = options.ids.empty() || std::ranges::count(options.ids, item.id) > 0;
  return code && id;
}

}  // namespace

BatchStatus batch_status(const std::string& folder, const BatchPlan& plan, int threads) {
  const Heads heads = heads_of(folder, plan, threads);
  BatchStatus status{.plan = plan.name, .items = plan.items.size()};
  for (const std::optional<BatchRecordHead>& head : heads) {
    if (!head) continue;
    ++(head->failed() ? status.failed : status.done);
    status.certified += head->outcome == BatchOutcome::Certified;
    status.repaired += !head->failed() && is_repaired(head->repairs);
    status.wrapped += !head->failed() && is_wrapped(head->repairs);
    status.warned += !head->failed() && !head->warnings.empty();
    status.to_retry += head->retry;
  }
  status.marked_open = tasks_marked_open(folder, plan).size();
  status.running = static_cast<std::size_t>(count_staging(folder));
  status.failures = grouped(plan, heads);
  estimate_time(status, plan, heads);
  return status;
}

std::string duration(double seconds) {
  if (seconds < 90) return short_number(seconds, 2) + " s";
  if (seconds < 5400) return std::to_string(std::lround(seconds / 60)) + " min";
  if (seconds < 48 * 3600.0) return short_number(seconds / 3600, 2) + " h";
  return short_number(seconds / 86400, 2) + " days";
}

std::string to_text(const BatchStatus& status) {
  const double all = static_cast<double>(std::max<std::size_t>(status.items, 1));
  std::string text = counted(static_cast<long>(status.items), "item") + ": " +
                     std::to_string(status.done) + " done (" +
                     percent(static_cast<double>(status.done) / all) + "), " +
                     std::to_string(status.failed) + " failed, " + std::to_string(status.open()) +
                     " open, " + std::to_string(status.running) + " being worked on\n";
  text += done_text(status);
  if (status.to_retry > 0)
    text += "  to be tried again: " + std::to_string(status.to_retry) + " of the failed\n";
  if (status.marked_open > 0)
    text += "  Snakemake has " + counted(static_cast<long>(status.marked_open), "task") +
            " for done with open items, by marks in the folder tasks: `batch plan` again, or " +
            "without that folder, it runs them\n";
  if (status.cpu_seconds_left > 0)
    text += "  left: " + duration(status.cpu_seconds_left) + " of one core";
  if (status.cpu_seconds_left > 0 && status.seconds_left)
    text += "; " + duration(*status.seconds_left) + " at the pace of the last items";
  if (status.cpu_seconds_left > 0) text += "\n";
  for (const BatchFailures& group : status.failures) {
    text += "  " + std::to_string(group.count) + " × code " + std::to_string(group.code) + ": " +
            group.reason + "\n      " + joined(group.ids) +
            (group.count > group.ids.size() ? ", …" : "") + "\n";
  }
  return text;
}

std::string to_json(const BatchStatus& status) {
  nlohmann::ordered_json failures = nlohmann::ordered_json::array();
  for (const BatchFailures& group : status.failures)
    failures.push_back({{"code", group.code},
                        {"step", group.step},
                        {"reason", group.reason},
                        {"count", group.count},
                        {"ids", group.ids}});
  const nlohmann::ordered_json json = {
      {"sphparam", version},
      {"command", "batch status"},
      {"plan", status.plan},
      {"items", status.items},
      {"done", status.done},
      {"certified", status.certified},
      {"repaired", status.repaired},
      {"wrapped", status.wrapped},
      {"warned", status.warned},
      {"failed", status.failed},
      {"to_retry", status.to_retry},
      {"open", status.open()},
      {"running", status.running},
      {"marked_open", status.marked_open},
      {"cpu_seconds_left", status.cpu_seconds_left},
      {"seconds_left", status.seconds_left ? nlohmann::ordered_json(*status.seconds_left)
                                           : nlohmann::ordered_json()},
      {"failures", failures}};
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

BatchRetry retry_batch(const std::string& folder, const BatchPlan& plan,
                       const BatchRetryOptions& options) {
  BatchRetry retry;
  std::set<std::string> unknown(options.ids.begin(), options.ids.end());
  std::vector<std::pair<std::size_t, StoredRecord>> wanted;  // by the number of the item
  for (std::size_t i = 0; i < plan.items.size(); ++i) {
    const BatchItem& item = plan.items[i];
    auto record = record_about(folder, item);
    if (!record || !record->head.failed()) continue;
    unknown.erase(item.id);
    if (is_wanted(options, item, record->head)) wanted.emplace_back(i, std::move(*record));
  }
  if (!unknown.empty())  // before anything is marked
    throw BatchInputError(
        joined({unknown.begin(), unknown.end()}) +
        (unknown.size() == 1 ? ": no item that failed" : ": no items that failed") +
        "; `sphparam batch status` names those");
  for (const auto& [i, record] : wanted) {
    if (!record.head.retry) mark_for_retry(folder, plan.items[i], record);
    ++retry.items;
    const int task = static_cast<int>(i) / plan.chunk + 1;
    if (retry.tasks.empty() || retry.tasks.back() != task) retry.tasks.push_back(task);
  }
  for (const int task : retry.tasks) {
    std::error_code hidden;  // without Snakemake there is no mark
    fs::remove(task_mark(folder, plan, task), hidden);
  }
  return retry;
}

std::string ranges_of(const std::vector<int>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t end = i + 1;
    while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1) ++end;
    if (!text.empty()) text += ",";
    text += std::to_string(numbers[i]);
    if (end - i > 1) text += "-" + std::to_string(numbers[end - 1]);
    i = end;
  }
  return text;
}

}  // namespace sphparam
