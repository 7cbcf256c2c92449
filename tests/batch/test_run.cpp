#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "sphparam/batch/inputs.h"
#include "sphparam/batch/plan.h"
#include "sphparam/batch/run.h"
#include "support/folder.h"

/// A run as a call of the library.
namespace sphparam::tests {

namespace fs = std::filesystem;

namespace {

/// Three meshes in the folder, an item a task.
BatchPlan plan_of_three(const Folder& folder) {
  fs::create_directories(folder / "in");
  for (const char* const name : {"a", "b", "c"})
    std::ofstream(folder / "in" + "/" + name + ".obj") << "v 0 0 0\n";
  return make_plan(find_batch_inputs({folder / "in"}), {.steps = {{"map"}}, .chunk = 1});
}

}  // namespace

TEST_CASE("run: a task does its own items, and leaves no file open") {
  const Folder folder;
  const BatchPlan plan = plan_of_three(folder);
  const auto open_files = [] {
    return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
  };
  const auto before = open_files();
  for (int task = 1; task <= 3; ++task) {
    const BatchRunSummary summary = run_batch(
        folder.path.string(), plan,
        {.run_step = [](const BatchStep&, const BatchStepSetting&) { return 4; }, .task = task});
    CHECK(summary.items == 1);
    CHECK(summary.failed == 1);
    CHECK(summary.first_failure == 4);
  }
  CHECK(open_files() == before);
}

TEST_CASE("run: where it ends with an error, nothing of it goes on unattended") {
  const Folder folder;
  const BatchPlan plan = plan_of_three(folder);
  BatchRunOptions options{.run_step = [](const BatchStep&, const BatchStepSetting&) {
    ::pause();
    return 0;
  }};
  options.workers = 3;
  int asked = 0;
  options.progress = [&](std::size_t, std::size_t) -> bool {
    if (++asked == 3) throw std::runtime_error("of the caller's own");
    return true;
  };
  const auto handler = std::signal(SIGTERM, SIG_DFL);  // that of Catch is none for forks
  CHECK_THROWS_WITH(run_batch(folder.path.string(), plan, options), "of the caller's own");
  std::signal(SIGTERM, handler);
  CHECK(asked == 3);
  CHECK(::waitpid(-1, nullptr, WNOHANG) == -1);
  CHECK(errno == ECHILD);
}

}  // namespace sphparam::tests
