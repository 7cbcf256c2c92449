// Sends meshes with hurt positions through every subcommand of the program, with options by chance;
// broken surfaces through `repair` in all formats, `survey`, kept holes and maps of all parts.
//
// Usage: command_campaign [--command NAME,… | all] [--seed 1] [--count 10000] [--first 0]
//                         [--jobs N] [--limit SECONDS] [--memory MIB] [--keep FOLDER]
//
// Seed, command and number name an errand for good; those that end as none should are kept in
// FOLDER with the script that repeats them. An errand may end with the documented codes 0 and 2 to
// 6; a signal, exit code 1 (an internal error), and what is beyond the limits of a run are
// failures. Exit code 0: none failed; 1 otherwise.
//
// The long one: build/release/tests/command_campaign --count 10000

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "crew.h"
#include "errands.h"
#include "image/open_module.h"
#include "program_run.h"
#include "sphparam/parallel.h"
#include "sphparam/stopwatch.h"

using namespace sphparam;
using namespace sphparam::campaign;

namespace {

namespace fs = std::filesystem;

constexpr int most_told = 50;       // failures of one command
constexpr double errand_runs = 4;   // at most
constexpr std::int64_t batch = 25;  // errands a child

struct Plan {
  std::vector<std::string> commands = {"all"};
  std::uint64_t seed = 1;
  std::int64_t count = 10000, first = 0;
  int jobs = 0;
  RunLimits limits;
  std::string keep = "command_campaign_failures";
};

/// What came of an errand: of its last run, with the most that any run took.
struct Outcome {
  int code = 0;
  double seconds = 0, mebibytes = 0;
  std::string messages, story, script;

  bool failed() const { return !(code == 0 || (code >= 2 && code <= 6)); }
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Outcome, code, seconds, mebibytes, messages, story, script)

constexpr const char* any_mesh =
    "OFF\n4 4 0\n1 1 1\n1 -1 -1\n-1 1 -1\n-1 -1 1\n"
    "3 0 1 2\n3 0 3 1\n3 0 2 3\n3 1 3 2\n";

/// A test image, by the program itself: the threads of OpenImageIO would not come along into
/// children of a process that has used it.
std::string make_picture(const fs::path& folder) {
  fs::create_directories(folder);
  std::ofstream(folder / "mesh.off") << any_mesh;
  const RunEnd end =
      run_in_child(folder.string(),
                   {"bake", "mesh.off", "--map", "axes", "-o", "picture.png", "--size", "32"}, {});
  if (end.code != 0) throw std::runtime_error("no picture: " + end.messages);
  std::ifstream in(folder / "picture.png", std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  fs::remove_all(folder);
  return bytes;
}

fs::path scratch_folder() {
  return fs::temp_directory_path() / ("command_campaign." + std::to_string(getpid()));
}

std::string script_of(const Errand& errand) {
  std::string script = "# " + errand.story + "\n";
  for (const auto& words : errand.commands) {
    script += "sphparam";
    for (const std::string& word : words) script += ' ' + word;
    script += '\n';
  }
  return script;
}

Outcome run_errand(const Errand& errand, const fs::path& folder, const RunLimits& limits) {
  fs::remove_all(folder);
  fs::create_directories(folder);
  for (const auto& [name, content] : errand.files) {
    std::ofstream(folder / name, std::ios::binary) << content;
  }
  Outcome outcome;
  outcome.story = errand.story;
  outcome.script = script_of(errand);
  for (const auto& words : errand.commands) {
    const RunEnd end = run_in_child(folder.string(), words, limits);
    outcome.code = end.code;
    outcome.messages = end.messages;
    outcome.seconds = std::max(outcome.seconds, end.seconds);
    outcome.mebibytes = std::max(outcome.mebibytes, static_cast<double>(end.bytes) / (1 << 20));
    if (end.code != 0) break;
  }
  return outcome;
}

/// Text as JSON takes it: messages may name bytes that are no UTF-8.
std::string to_line(const Outcome& outcome) {
  return nlohmann::json(outcome).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

struct Tally {
  std::map<int, long> codes;
  long failures = 0;
  double seconds = 0, slowest = 0, largest = 0;  // slowest: seconds, largest: MiB of a run
  std::int64_t slowest_number = -1;

  void add(std::int64_t number, const Outcome& outcome) {
    ++codes[outcome.code];
    seconds += outcome.seconds;
    largest = std::max(largest, outcome.mebibytes);
    if (outcome.seconds > slowest) {
      slowest = outcome.seconds;
      slowest_number = number;
    }
  }

  std::string line(const std::string& command) const {
    char text[160];
    std::snprintf(text, sizeof text, "%-8s mean %.3f s, slowest %.1f s (%ld), at most %.0f MiB;",
                  command.c_str(), seconds / std::max(1.0, total()), slowest,
                  static_cast<long>(slowest_number), largest);
    std::string result = text;
    for (const auto& [code, count] : codes) {
      result += " " + std::to_string(count) + " × " +
                (code > 128 ? "signal " + std::to_string(code - 128) : std::to_string(code));
    }
    return result + "; " + std::to_string(failures) + " failed";
  }

 private:
  double total() const {
    double sum = 0;
    for (const auto& [code, count] : codes) sum += static_cast<double>(count);
    return sum;
  }
};

/// All errands of one subcommand. Returns how many failed.
long run_command(const std::string& command, const Plan& plan, const std::string& picture) {
  const fs::path scratch = scratch_folder();
  const fs::path keep = plan.keep;
  Tally tally;
  const auto fail = [&](std::int64_t number, const std::string& what, const std::string& story) {
    if (++tally.failures > most_told) return;
    std::cout << command << ' ' << number << ": " << what << " [" << story << "]" << std::endl;
  };
  run_crew(
      {plan.first, plan.first + plan.count, resolve_threads(plan.jobs),
       errand_runs * plan.limits.seconds, batch},
      [&](std::int64_t number) {
        const Errand errand =
            make_errand(command, plan.seed, static_cast<std::uint64_t>(number), picture);
        const std::string name = command + "-" + std::to_string(number);
        const Outcome outcome = run_errand(errand, scratch / name, plan.limits);
        if (outcome.failed()) {
          std::ofstream(scratch / name / "errand.sh") << outcome.script;
          fs::create_directories(keep);
          fs::remove_all(keep / name);
          fs::copy(scratch / name, keep / name, fs::copy_options::recursive);
        }
        fs::remove_all(scratch / name);
        return to_line(outcome);
      },
      [&](std::int64_t number, const std::string& line) {
        const auto outcome = nlohmann::json::parse(line).get<Outcome>();
        tally.add(number, outcome);
        if (!outcome.failed()) return;
        const std::string how = outcome.code > 128 ? "signal " + std::to_string(outcome.code - 128)
                                                   : "code " + std::to_string(outcome.code);
        const std::string told = outcome.messages.substr(0, 300);
        fail(number, how + ": " + told.substr(0, told.find_last_not_of('\n') + 1), outcome.story);
      },
      [&](std::int64_t number, const std::string& reason) { fail(number, reason, "lost"); });
  fs::remove_all(scratch);
  std::cout << tally.line(command) << std::endl;
  return tally.failures;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Sends meshes with hurt positions through every subcommand.");
  Plan plan;
  std::uint64_t mebibytes = plan.limits.bytes >> 20;
  app.add_option("--command", plan.commands, "subcommands, or all")->delimiter(',');
  app.add_option("--seed", plan.seed);
  app.add_option("--count", plan.count, "errands of each subcommand")->check(CLI::PositiveNumber);
  app.add_option("--first", plan.first, "number of the first errand")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--jobs", plan.jobs, "processes at a time; 0: one a core");
  app.add_option("--limit", plan.limits.seconds, "seconds of processor time a run")
      ->check(CLI::PositiveNumber);
  app.add_option("--memory", mebibytes, "MiB a run")->check(CLI::PositiveNumber);
  app.add_option("--keep", plan.keep, "where errands that fail are kept");
  CLI11_PARSE(app, argc, argv);
  plan.limits.bytes = mebibytes << 20;
  plan.keep = fs::absolute(plan.keep).string();
  if (plan.commands == std::vector<std::string>{"all"}) plan.commands = errand_names();
  sphparam::image_codecs();  // loads the image module, once for all runs
  const std::string picture = make_picture(scratch_folder());
  std::cout << "seed " << plan.seed << ", errands " << plan.first << " to "
            << plan.first + plan.count - 1 << ", limits of a run: " << plan.limits.seconds
            << " s of processor time, " << mebibytes << " MiB" << std::endl;
  long failures = 0;
  for (const std::string& command : plan.commands) failures += run_command(command, plan, picture);
  return failures == 0 ? 0 : 1;
}
