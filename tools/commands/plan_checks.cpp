// What is wrong with a batch can be known before thousands of jobs find out.

#include "commands/plan_checks.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <string_view>

#include "batch/child.h"
#include "batch/record.h"
#include "batch/steps.h"
#include "commands/batch.h"
#include "console/program.h"
#include "io/shell_word.h"
#include "number_text.h"
#include "sphparam/batch/plan.h"

namespace sphparam::cli {

namespace {

namespace fs = std::filesystem;

/// What the step of a shape writes that is none of its results.
std::vector<std::string> written_outside(const BatchPlan& plan, std::size_t step,
                                         const BatchInput& shape) {
  const BatchItem item{.id = shape.id, .path = shape.path, .values = shape.values};
  std::vector<std::string> files = files_written_by(steps_of(plan, item)[step]);
  std::erase_if(files, [](const std::string& path) {
    return !path.starts_with('/') && !path.starts_with("../");
  });
  return files;
}

bool is_for_several(const std::string& path) {  // {map}, {n}: as many files as there are
  return std::ranges::any_of(placeholders_in(path), is_foreign, &Placeholder::name);
}

/// A folder that is gone when this is.
class PassingFolder {
 public:
  PassingFolder() {
    std::string name = (fs::temp_directory_path() / "sphparam-plan-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw WriteError(name, std::strerror(errno));
    path_ = name;
  }
  ~PassingFolder() {
    std::error_code hidden;
    fs::remove_all(path_, hidden);
  }
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// In a process of its own.
int try_step(const BatchStep& words, const fs::path& folder) {
  fs::current_path(folder);
  const int log = ::open("log", O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (log < 0) return Ok;
  ::dup2(log, STDOUT_FILENO);
  ::dup2(log, STDERR_FILENO);
  return run_batch_step(words, "report.json", 1);
}

/// Files that people write by hand, and no step; those of a single shape are its run's business.
/// Throws: UsageMistake where one is not there.
void require_written_files(const BatchStep& words) {
  constexpr std::array<std::string_view, 2> options = {"--pin", "--landmarks"};
  for (std::size_t i = 0; i < words.size(); ++i) {
    for (const std::string_view option : options) {
      std::string file;
      if (words[i] == option && i + 1 < words.size()) file = words[i + 1];
      if (words[i].starts_with(std::string(option) + "="))
        file = words[i].substr(option.size() + 1);
      std::error_code hidden;
      if (file.empty() || !placeholders_in(file).empty() || fs::exists(file, hidden)) continue;
      throw UsageMistake(words.front() + " " + std::string(option) + ": " + file +
                         ": no such file; files of options are found where `batch plan` is typed");
    }
  }
}

}  // namespace

void require_outputs_apart(const std::vector<BatchStep>& steps, const BatchInputs& inputs) {
  if (inputs.shapes.size() < 2) return;
  const BatchPlan plan{.steps = steps, .columns = inputs.columns};
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const std::vector<std::string> others = written_outside(plan, k, inputs.shapes.back());
    for (const std::string& path : written_outside(plan, k, inputs.shapes.front())) {
      if (std::ranges::count(others, path) == 0) continue;
      throw UsageMistake("every shape would write " + path +
                         ": without a folder it is one of its results, and {id} in it tells "
                         "shapes apart");
    }
  }
}

void require_results_apart(const std::vector<BatchStep>& steps, const BatchInputs& inputs) {
  const BatchPlan plan{.steps = steps, .columns = inputs.columns};
  const BatchInput& shape = inputs.shapes.front();
  const BatchItem item{.id = shape.id, .path = shape.path, .values = shape.values};
  std::map<fs::path, const BatchStep*> written;
  const std::vector<BatchStep> words = steps_of(plan, item);
  for (std::size_t k = 0; k < words.size(); ++k) {
    for (const std::string& path : files_written_by(words[k])) {
      if (path == "/dev/null" || is_for_several(path)) continue;
      const auto [before, is_first] = written.emplace(fs::path(path).lexically_normal(), &steps[k]);
      if (is_first || before->second == &steps[k]) continue;
      throw UsageMistake("`" + joined(steps[k], " ") + "` would replace " + path + " of `" +
                         joined(*before->second, " ") +
                         "`: name what one of them writes otherwise, as in {id}_" +
                         std::to_string(k + 1) + fs::path(path).extension().string());
    }
  }
}

void require_sense(const std::vector<BatchStep>& steps, const BatchInputs& inputs) {
  const PassingFolder folder;
  const BatchInput& shape = inputs.shapes.front();
  const fs::path nowhere = folder.path() / "nowhere" / fs::path(shape.path).filename();
  const BatchPlan plan{.steps = steps, .columns = inputs.columns};
  const BatchItem item{.id = "no_such_shape", .path = nowhere.string(), .values = shape.values};
  for (const BatchStep& step : steps) require_written_files(step);
  for (const BatchStep& words : steps_of(plan, item)) {
    const pid_t child = start_child([&] { return try_step(words, folder.path()); });
    if (wait_for_child(child).code != UsageError) continue;
    const auto log = small_file((folder.path() / "log").string());
    throw UsageMistake("the steps make no sense: " + reason_in(log.value_or("")));
  }
}

void require_own_scripts(const std::string& folder) {
  for (const char* const name : {"Snakefile", "array.sbatch"}) {
    const fs::path path = fs::path(folder) / name;
    const auto text = small_file(path.string());
    if (!text || text->find("made by `sphparam batch plan`") != std::string::npos) continue;
    throw UsageMistake("-o: " + path.string() +
                       " is none that `sphparam batch plan` made, and would be replaced: move it, "
                       "or give the batch a folder of its own, as in -o " +
                       shell_word((fs::path(folder) / "work").lexically_normal().string()));
  }
}

}  // namespace sphparam::cli
