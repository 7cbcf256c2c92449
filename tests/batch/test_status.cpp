#include <catch2/catch.hpp>
#include <ctime>
#include <filesystem>
#include <fstream>

#include "batch/record.h"
#include "sphparam/batch/inputs.h"
#include "sphparam/batch/results.h"
#include "sphparam/batch/status.h"
#include "support/folder.h"

/// What is told of a batch from its records, also on its page, and which of them are tried again.
namespace sphparam::tests {

namespace {

namespace fs = std::filesystem;
using Catch::Contains;

/// A batch of one step whose records are written by hand.
struct Written {
  Folder folder;
  BatchPlan plan{.steps = {{"map", "{input}"}}, .chunk = 2};

  void add_open(const std::string& id, std::uint64_t size) {
    plan.items.push_back(
        {.id = id, .path = "/" + id + ".ply", .size = size, .input = "x", .options = "y"});
  }
  void add(const std::string& id, std::uint64_t size, BatchRecord record) {
    add_open(id, size);
    record.id = id;
    record.head.planned = record.head.input = "x";
    record.head.options = "y";
    const fs::path place = record.head.failed()
                               ? fs::path(failure_path(root(), id))
                               : fs::path(result_folder(root(), id)) / "record.json";
    fs::create_directories(place.parent_path());
    std::ofstream(place) << to_json(record);
  }
  void add_failure(const std::string& id, int code, const std::string& reason) {
    BatchRecord record;
    record.head.code = code;
    record.head.reason = reason;
    add(id, 1, record);
  }
  std::string root() const { return folder.path.string(); }
};

BatchRecord done(double cpu_seconds, std::int64_t ended) {
  BatchRecord record;
  record.head.outcome = BatchOutcome::Done;
  record.head.cpu_seconds = cpu_seconds;
  record.head.ended = ended;
  return record;
}

}  // namespace

TEST_CASE("status: durations as people say them") {
  for (const auto& [seconds, text] : {std::pair(17.0, "17 s"),
                                      {89.0, "89 s"},
                                      {90.0, "2 min"},
                                      {5399.0, "90 min"},
                                      {5400.0, "1.5 h"},
                                      {11200.0, "3.1 h"},
                                      {172800.0, "2 days"},
                                      {1e6, "12 days"}})
    CHECK(duration(seconds) == text);
}

TEST_CASE("status: what is left is estimated by the bytes of what is open") {
  Written batch;
  const std::int64_t now = std::time(nullptr);
  batch.add("a", 100, done(4, now - 10));
  CHECK_FALSE(batch_status(batch.root(), batch.plan).seconds_left);
  batch.add_open("b", 600);
  CHECK_FALSE(batch_status(batch.root(), batch.plan).seconds_left);  // one end has no pace
  batch.add("c", 300, done(8, now - 2));
  const BatchStatus status = batch_status(batch.root(), batch.plan);
  CHECK(status.items == 3);
  CHECK(status.done == 2);
  CHECK(status.open() == 1);
  CHECK(status.cpu_seconds_an_item == 6);
  CHECK(status.cpu_seconds_left == 18);  // 12 s for 400 bytes
  CHECK(status.seconds_left == 16);      // 300 bytes in 8 s
  CHECK_THAT(to_text(status), Contains("  left: 18 s of one core; 16 s at the pace of the last"));
}

TEST_CASE("status: failures are marked to be tried again by their codes and ids") {
  Written batch;
  batch.add("a", 1, done(1, 1));
  batch.add_failure("b", 4, "a hölle");
  batch.add_failure("c", 5, "no room");
  batch.add_failure("d", 4, "a hölle");
  CHECK_THROWS_WITH(retry_batch(batch.root(), batch.plan, {.ids = {"a", "b", "z"}}),
                    "a, z: no items that failed; `sphparam batch status` names those");
  CHECK(batch_status(batch.root(), batch.plan).to_retry == 0);
  const BatchRetry retry = retry_batch(batch.root(), batch.plan, {.codes = {4}});
  CHECK(retry.items == 2);
  CHECK(retry.tasks == std::vector<int>{1, 2});
  const BatchStatus status = batch_status(batch.root(), batch.plan);
  CHECK(status.failed == 3);
  CHECK(status.to_retry == 2);
  CHECK(status.cpu_seconds_an_item == 0.5);  // of what is settled: a and c
  CHECK_THAT(*small_file(failure_path(batch.root(), "b")), Contains("a hölle"));
  CHECK(retry_batch(batch.root(), batch.plan, {.ids = {"c"}}).tasks == std::vector<int>{2});
  CHECK(batch_status(batch.root(), batch.plan).to_retry == 3);
}

TEST_CASE("page: shapes with how far out they are, outliers by name, and who has no figure") {
  Written batch;
  for (const auto& [id, area] :
       {std::pair("a", "1"), {"b", "2"}, {"c", "2"}, {"d", "4"}, {"far<out", "400"}}) {
    BatchRecord record = done(1, 1);
    record.steps.push_back(
        {{"map"}, 0, 1, R"({"distortion":{"mean_abs_ln_area":)" + std::string(area) + "}}"});
    batch.add(id, 1, record);
  }
  batch.add_open("open", 1);
  const std::string page = batch_page(batch.root(), batch.plan, {.title = "All of them"});
  CHECK_THAT(page, Contains("Outliers: <a href=\"#far&lt;out\">far&lt;out</a> (400)</figcaption>"));
  CHECK_THAT(page, Contains("5 shapes, median 2; 1 outlier beyond"));
  CHECK_THAT(page, Contains(R"(["d","done",null,4,null,null,1,0,"","",0,"",1,"",[]])"));
  CHECK_THAT(page, Contains(R"(["far<out","done",null,400,null,null,1,6.644,"","",0,"",1,"",[]])"));
  CHECK_THAT(page, Contains(R"(["open","open",null,null,null,null,null,0,"","",0,"",0,"",[]])"));
}

}  // namespace sphparam::tests
