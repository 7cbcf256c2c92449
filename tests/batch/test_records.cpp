#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "batch/content_hash.h"
#include "batch/distribution.h"
#include "batch/record.h"
#include "batch/staging.h"

/// What is written of an item, and what is told from it.
namespace sphparam::tests {

using Catch::Contains;

TEST_CASE("record: its head is read back, and nothing behind it is looked at") {
  BatchRecord record;
  record.id = "sub \"1\"";
  record.head = {.outcome = BatchOutcome::Certified,
                 .code = 0,
                 .step = "2 measure",
                 .attempt = 3,
                 .retry = true,
                 .planned = "",
                 .input = "i",
                 .options = "o",
                 .program = "p",
                 .stamp = {1, -2, 3, 18446744073709551615ULL},
                 .seconds = 1.5,
                 .cpu_seconds = 2,
                 .ended = 1795390320,
                 .reason = "why, \\ and \"where\"",
                 .repairs = "hole-filled 1",
                 .warnings = {"one: \"a\"", "two"},
                 .files = {{"a/b.ply", 12, "h1"}, {"c", 0, "h2"}}};
  const std::string json = to_json(record);
  const BatchRecordHead head = read_head(json.substr(0, json.find("\"path\""))).value();
  CHECK(head.outcome == BatchOutcome::Certified);
  CHECK(head.step == "2 measure");
  CHECK(head.attempt == 3);
  CHECK(head.retry);
  CHECK(head.input + head.options + head.program == "iop");
  CHECK(head.stamp == record.head.stamp);
  CHECK(head.seconds == 1.5);
  CHECK(head.cpu_seconds == 2);
  CHECK(head.ended == 1795390320);
  CHECK(head.reason == record.head.reason);
  CHECK(head.repairs == "hole-filled 1");
  CHECK(head.warnings == std::vector<std::string>{"one: \"a\"", "two"});
  REQUIRE(head.files.size() == 2);
  CHECK(head.files[0].name == "a/b.ply");
  CHECK(head.files[0].size == 12);
  CHECK(head.files[1].hash == "h2");
  CHECK_FALSE(read_head(json.substr(0, 40)));
}

TEST_CASE("record: what stands in the lists of another key is no file") {
  const BatchRecordHead head =
      read_head(R"({"stamp":[[{"files":3,"files":"a"}]],"id":"x"})").value();
  CHECK(head.files.empty());
}

TEST_CASE("record: long lists of reports are left out, all else stays") {
  BatchRecord record;
  record.steps.push_back(
      {{"map"},
       0,
       0.5,
       R"({"a":[1,2],"b":)" + nlohmann::json(std::vector<int>(33, 1)).dump() + "}"});
  const auto report = nlohmann::json::parse(to_json(record))["steps"][0]["report"];
  CHECK(report["a"] == nlohmann::json({1, 2}));
  CHECK(report["b"].is_null());
}

TEST_CASE("record: the reason is the last error of a log, with what follows a colon") {
  CHECK(reason_in("sphparam: warning: w\nsphparam: error: not this:\n  a hole\n    hint: fill\n") ==
        "not this: a hole");
  CHECK(reason_in("sphparam: error: one\nsphparam: error: two\n") == "two");
  CHECK(reason_in("something else\n") == "something else");
  CHECK(reason_in("sphparam: error: --fail-on-warnings: 1 warning; all outputs are written\n") ==
        "--fail-on-warnings: 1 warning");  // nothing of a failure is kept
  CHECK(reason_in(
            "  1 hole filled\na.obj: still open → b.ply\nsphparam: warning: w\n  a hint\n}\n") ==
        "a.obj: still open");
  CHECK(reason_in("  a detail\n") == "  a detail");
  CHECK(reason_in("").empty());
}

TEST_CASE("record: warnings are those of all steps, each once, and no other lines") {
  CHECK(warnings_in("sphparam: warning: b\n  x → y\nsphparam: error: warning: no\n"
                    "sphparam: warning: a\nsphparam: warning: b\n") ==
        std::vector<std::string>{"b", "a"});
  CHECK(warnings_in("").empty());
}

TEST_CASE("record: a step is named where there are several, also one that somebody else wrote") {
  BatchPlan plan;
  plan.steps = {{"map", "{input}"}};
  CHECK(words_of_step("1 map", plan).empty());
  plan.steps.push_back({"measure", "{input}"});
  CHECK(words_of_step("2 measure", plan) == "step 2, measure: ");
  CHECK(words_of_step("", plan).empty());
  CHECK(words_of_step("2", plan) == "step 2: ");
}

TEST_CASE("hash: what xxh128sum prints") {
  CHECK(content_hash("") == "99aa06d3014798d86001c324468d497f");
}

TEST_CASE("staging: a process is known while it lives, and known to be gone after") {
  const std::string own = staging_name("x");
  CHECK(owner_of_staging(own) == StagingOwner::Lives);
  const pid_t child = fork();
  if (child == 0) {
    pause();
    _exit(0);
  }
  const std::string name = staging_name("x", child);
  CHECK(owner_of_staging(name) == StagingOwner::Lives);
  kill(child, SIGKILL);
  siginfo_t ended;
  waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT);
  CHECK(owner_of_staging(name) == StagingOwner::IsGone);  // nobody has asked how it ended
  CHECK(staging_name("x", child) == name);
  waitpid(child, nullptr, 0);
  CHECK(owner_of_staging(name) == StagingOwner::IsGone);
  CHECK(owner_of_staging("x~" + host_name() + ".~12345678~1~2~3") == StagingOwner::Unknown);
  CHECK(owner_of_staging("x~" + host_name() + ".1234~12345678~1~2~3") == StagingOwner::Unknown);
  const std::string machine = name.substr(0, name.find('~', 2));
  CHECK(owner_of_staging(machine + "~12345678~1~2~3") ==
        (machine.ends_with('.') ? StagingOwner::Unknown : StagingOwner::IsGone));
  CHECK(owner_of_staging("x~elsewhere~12345678~1~2~3") == StagingOwner::Unknown);
  CHECK(owner_of_staging("x") == StagingOwner::Unknown);
}

TEST_CASE("record: whole seconds are seconds too") {
  const BatchRecordHead head =
      read_head(R"({"seconds":3,"cpu_seconds":4,"ended":5,"id":"x"})").value();
  CHECK(head.seconds == 3);
  CHECK(head.cpu_seconds == 4);
  CHECK(head.ended == 5);
}

TEST_CASE("staging: a folder names the space that its process is numbered in") {
  struct stat space {};
  REQUIRE(::stat("/proc/self/ns/pid", &space) == 0);
  const std::string numbered = "~" + std::to_string(space.st_ino) + "~" + std::to_string(getpid());
  CHECK_THAT(staging_name("x"), Contains(numbered + "~"));
}

TEST_CASE("distribution: a plot has the ends, and quartiles where there is room between") {
  const auto texts = [](const std::vector<std::optional<double>>& values) {
    const std::string plot = distribution_plot(distribution_of(values), "title",
                                               std::vector<std::string>(values.size(), "shape"));
    std::vector<std::string> lines;
    std::istringstream in(plot);
    for (std::string line; std::getline(in, line);)
      if (line.starts_with("<text ")) lines.push_back(line);
    return lines;
  };
  const auto label = [](int x, const std::string& anchor, const std::string& text) {
    return "<text x=\"" + std::to_string(x) + "\" y=\"200\" class=\"label\" text-anchor=\"" +
           anchor + "\">" + text + "</text>";
  };
  const auto title = R"(<text x="16" y="20" class="title" text-anchor="start">title</text>)",
             caption = R"(<text x="16" y="216" class="caption" text-anchor="start">5 shapes, )";
  CHECK(texts({1, 2, 4, 8, 16}) ==
        std::vector<std::string>{title, label(16, "start", "1"), label(624, "end", "16"),
                                 label(320, "middle", "4"), label(168, "middle", "2"),
                                 label(472, "middle", "8"),
                                 std::string(caption) + "median 4; 0 outliers beyond 64</text>"});
  CHECK(texts({1, 15.9, 16, 16.1, 256}) ==
        std::vector<std::string>{title, label(16, "start", "1"), label(624, "end", "256"),
                                 label(320, "middle", "16"),
                                 std::string(caption) + "median 16; 1 outlier beyond 16.4</text>"});
}

TEST_CASE("distribution: quartiles, and what is far out of them") {
  std::vector<std::optional<double>> values;
  for (int i = 0; i < 99; ++i) values.emplace_back(1 + 0.01 * i);
  values.emplace_back(40);
  values.emplace_back(std::nullopt);
  const Distribution d = distribution_of(values);
  CHECK(d.values.size() == 100);
  CHECK(d.median == Approx(1.495));
  CHECK(d.outlier_from < 40);
  CHECK(d.outlier_from > 1.98);
  CHECK(outlyingness(d, 40) > 1.5);
  CHECK(outlyingness(d, 1.9) < 1.5);
  std::vector<std::string> names(values.size(), "shape");
  names[99] = "far<out";
  CHECK_THAT(distribution_plot(d, "title", names),
             Contains("href=\"#far&lt;out\"") && Contains("1 outlier beyond"));
  CHECK_THAT(distribution_plot(distribution_of({}), "title", {}), Contains("no values"));
}

}  // namespace sphparam::tests
