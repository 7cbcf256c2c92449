#include <catch2/catch.hpp>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "batch/child.h"
#include "batch/content_hash.h"
#include "batch/item_run.h"
#include "batch/options_hash.h"
#include "batch/staging.h"
#include "sphparam/batch/results.h"
#include "sphparam/batch/status.h"
#include "support/folder.h"

/// What is left of an item whose process ends in one way or another.
namespace sphparam::tests {

namespace {

namespace fs = std::filesystem;

/// A batch of one shape, in a folder of its own.
class OneShape {
 public:
  OneShape() {
    for (const char* const name : {"results", "failed", "staging"})
      fs::create_directories(fs::path(folder_) / name);
    std::ofstream(folder_ + "/a.obj") << "v 0 0 0\n";
    plan_ = {.name = "0123456789abcdef", .steps = {{"map", "{input}", "-o", "{id}.ply"}}};
    plan_.items = {{.id = "a", .path = folder_ + "/a.obj", .size = 8}};
    plan_.items[0].input = hash_of_file(plan_.items[0].path);
    plan_.items[0].options = OptionsHash(plan_).of(plan_.items[0]);
  }

  ItemSetting setting() const { return {folder_, plan_, write_a_result}; }
  ItemSetting without_room() const { return {folder_, plan_, lacks_room}; }
  ItemSetting with_warnings() const { return {folder_, plan_, warns}; }
  /// A second step, which finds that a limit is exceeded and tells no error.
  ItemSetting with_limit() {
    plan_.steps.push_back({"measure", "{input}", "{id}.ply"});
    plan_.items[0].options = OptionsHash(plan_).of(plan_.items[0]);
    return {folder_, plan_, exceeds};
  }
  const std::string& folder() const { return folder_; }
  const BatchPlan& plan() const { return plan_; }
  const BatchItem& item() const { return plan_.items[0]; }
  std::string record() const { return small_file(folder_ + "/results/a/record.json").value_or(""); }
  bool has_failed() const { return fs::exists(folder_ + "/failed/a.json"); }
  std::string staged() const { return folder_ + "/staging/" + staging_name("a"); }

 private:
  static int write_result(const BatchStep&, const BatchStepSetting&) {
    std::ofstream("a.ply") << "ply\n";
    return 0;
  }

  static int find_no_room(const BatchStep&, const BatchStepSetting&) {
    std::fputs("sphparam: error: a.ply: cannot write: No space left on device\n", stderr);
    return step_has_no_room;
  }

  /// Of one thing aloud, by its file, and of another in its report alone.
  static int warn(const BatchStep& step, const BatchStepSetting& setting) {
    std::fputs("sphparam: warning: a.obj: flat\n", stderr);
    std::ofstream(setting.report) << R"({"warnings": ["flat", "inside out"]})";
    return write_result(step, setting);
  }

  static int exceed(const BatchStep& step, const BatchStepSetting& setting) {
    if (step.front() == "map") return write_result(step, setting);
    std::fputs("RMS 1 is more than 0.5\n", stderr);
    return 6;
  }

  const Folder own_;
  const std::string folder_ = own_.path.string();
  const std::function<int(const BatchStep&, const BatchStepSetting&)> write_a_result = write_result;
  const std::function<int(const BatchStep&, const BatchStepSetting&)> lacks_room = find_no_room;
  const std::function<int(const BatchStep&, const BatchStepSetting&)> warns = warn;
  const std::function<int(const BatchStep&, const BatchStepSetting&)> exceeds = exceed;
  BatchPlan plan_;
};

int run_in_a_process(const OneShape& shape) {
  return wait_for_child(start_child([&] { return run_item(shape.setting(), shape.item()); })).code;
}

}  // namespace

TEST_CASE("item run: who is killed before his results are out has failed") {
  const OneShape shape;
  CHECK(record_crash(shape.setting(), shape.item(), shape.staged(), 128 + SIGKILL, 0.5));
  CHECK(shape.has_failed());
  CHECK_FALSE(fs::exists(shape.staged()));
}

TEST_CASE("item run: who is killed when his results are out has done his work, and not twice") {
  const OneShape shape;
  REQUIRE(run_in_a_process(shape) == ItemDone);
  const std::string record = shape.record();
  REQUIRE_FALSE(record.empty());
  fs::create_directories(shape.staged());
  CHECK_FALSE(record_crash(shape.setting(), shape.item(), shape.staged(), 128 + SIGKILL, 0.5));
  CHECK_FALSE(shape.has_failed());
  CHECK_FALSE(fs::exists(shape.staged()));
  CHECK(run_in_a_process(shape) == ItemDoneElsewhere);
  CHECK(shape.record() == record);
}

TEST_CASE(
    "item run: what steps warn of counts once, and also where -q has them say it in reports") {
  const OneShape shape;
  const auto work = [&] { return run_item(shape.with_warnings(), shape.item()); };
  REQUIRE(wait_for_child(start_child(work)).code == ItemDone);
  const auto head = read_head(shape.record());
  REQUIRE(head);
  CHECK(head->warnings == std::vector<std::string>{"a.obj: flat", "inside out"});
}

TEST_CASE("item run: which of its steps failed is told by record, status and table") {
  OneShape shape;
  const ItemSetting setting = shape.with_limit();
  REQUIRE(wait_for_child(start_child([&] { return run_item(setting, shape.item()); })).code ==
          ItemFailed);
  const auto stored = record_about(shape.folder(), shape.item());
  REQUIRE(stored);
  CHECK(stored->head.step == "2 measure");
  CHECK(stored->head.reason == "RMS 1 is more than 0.5");
  const BatchStatus status = batch_status(shape.folder(), shape.plan(), 1);
  REQUIRE(status.failures.size() == 1);
  CHECK(status.failures[0].code == 6);
  CHECK(status.failures[0].step == "2 measure");
  CHECK(status.failures[0].reason == "step 2, measure: RMS 1 is more than 0.5");
  CHECK_THAT(to_json(status), Catch::Contains("\"step\": \"2 measure\""));
  const std::string table = batch_table(shape.folder(), shape.plan(), 1);
  CHECK_THAT(table, Catch::StartsWith("id,path,outcome,code,step,reason,"));
  CHECK_THAT(table, Catch::Contains(",failed,6,2 measure,RMS 1 is more than 0.5,1,"));
}

TEST_CASE("item run: a machine without room is no failure of the item") {
  const OneShape shape;
  const int code = wait_for_child(start_child([&] {
                     try {
                       return static_cast<int>(run_item(shape.without_room(), shape.item()));
                     } catch (const BatchMachineError& error) {
                       return std::strstr(error.what(), "No space left") ? 42 : 43;
                     }
                   })).code;
  CHECK(code == 42);
  CHECK_FALSE(shape.has_failed());
  CHECK_FALSE(fs::exists(shape.staged()));
}

}  // namespace sphparam::tests
