#include <catch2/catch.hpp>

#include "batch/engines.h"
#include "batch/manifest.h"
#include "batch/steps.h"
#include "sphparam/batch/plan.h"
#include "sphparam/batch/status.h"
#include "sphparam/io/read_options.h"

/// Steps, and the manifest that holds them.
namespace sphparam::tests {

namespace {

using Catch::Contains;
using Steps = std::vector<BatchStep>;

BatchPlan plan_of_two() {
  BatchPlan plan{.steps = {{"map", "{input}", "--lambda", "{lambda}", "-o", "{id}.sph.ply"}},
                 .columns = {"lambda"},
                 .items = {{.id = "a", .path = "/x/a\tb.ply", .size = 7, .values = {"1"}},
                           {.id = "b", .path = "/x/b.ply", .size = 8, .values = {"2"}}},
                 .chunk = 1};
  return with_chunk(plan, 1);
}

}  // namespace

TEST_CASE("steps: each takes the mesh that was left, and writes by its id") {
  CHECK(complete_steps({{"map", "--repair"},
                        {"remesh", "--grid", "ico:5"},
                        {"spharm"},
                        {"export", "--output=x.glb"}}) ==
        Steps{{"map", "{input}", "--repair", "-o", "{id}.sph.ply"},
              {"remesh", "{id}.sph.ply", "--grid", "ico:5", "-o", "{id}_remesh.sph.ply"},
              {"spharm", "{id}_remesh.sph.ply", "--csv", "{id}_spharm.csv"},
              {"export", "{id}_remesh.sph.ply", "--output=x.glb"}});
}

TEST_CASE("steps: a mesh without {id} in its name is taken by the next step, once") {
  const Steps steps = complete_steps({{"map", "-o", "m.sph.ply"}, {"remesh", "--grid", "ico:2"}});
  CHECK(steps == Steps{{"map", "{input}", "-o", "m.sph.ply"},
                       {"remesh", "m.sph.ply", "--grid", "ico:2", "-o", "{id}_remesh.sph.ply"}});
  CHECK(complete_steps(steps) == steps);
}

TEST_CASE("steps: a name that is glued to -o is the mesh that is left") {
  for (const BatchStep& map : {BatchStep{"map", "{input}", "--threads", "2", "-o{id}.sph.ply"},
                               BatchStep{"map", "{input}", "-o{id}.sph.ply", "--threads", "2"}})
    CHECK(complete_steps({map, {"export"}}) ==
          Steps{map, {"export", "{id}.sph.ply", "-o", "{id}.glb"}});
  CHECK(files_left_by({{"map", "a.ply", "-om=1.ply"}}) == std::vector<std::string>{"m=1.ply"});
}

TEST_CASE("steps: what wrap, match, unimage and paint leave is taken by the next step") {
  for (const char* const name : {"wrap", "match", "unimage", "paint"}) {
    const Steps steps = complete_steps({{name, "{input}", "-o", "{id}_a.ply"}, {"map"}});
    CHECK(steps.back() == BatchStep{"map", "{id}_a.ply", "-o", "{id}.sph.ply"});
  }
  const Steps atlas =
      complete_steps({{"map"}, {"paint", "--atlas", "64", "-o", "{id}.png"}, {"export"}});
  CHECK(atlas.back()[1] == "{id}.sph.ply");
}

TEST_CASE("steps: what leaves many files is told, unless the next step names one") {
  CHECK_THROWS_WITH(complete_steps({{"map", "--all-components"}, {"export"}}),
                    Contains("export: the step before it leaves a map of each component") &&
                        Contains("{id}_0001.sph.ply"));
  CHECK_THROWS_WITH(complete_steps({{"asset"}, {"map"}}), Contains("FOLDER/NAME.sph.ply"));
  CHECK_NOTHROW(complete_steps({{"asset"}, {"map", "{input}"}}));
  const Steps steps = complete_steps({{"map", "--all-components"}, {"info", "{id}_0001.sph.ply"}});
  CHECK(steps.back() == BatchStep{"info", "{id}_0001.sph.ply"});
}

TEST_CASE("steps: streams are refused") {
  for (const BatchStep& step :
       {BatchStep{"map", "-o", "-"}, BatchStep{"map", "-o-"}, BatchStep{"map", "--output=-"},
        BatchStep{"info", "--json", "-"}, BatchStep{"map", "-"}})
    CHECK_THROWS_WITH(complete_steps({step}), Contains("stands for a stream"));
}

TEST_CASE("steps: what names its files is left alone") {
  const Steps steps = {{"map", "-o", "m.sph.ply", "{input}"},
                       {"bake", "{id}.sph.ply", "-o", "{id}_{map}.png"}};
  CHECK(complete_steps(steps) == steps);
  CHECK(complete_steps({{"map", "-o", "{id}.ply", "--pin", "{pins}"}}) ==
        Steps{{"map", "{input}", "-o", "{id}.ply", "--pin", "{pins}"}});
  CHECK_THROWS_AS(complete_steps({}), BatchInputError);
  CHECK_THROWS_WITH(complete_steps({{"batch"}}), Contains("cannot be a step"));
}

TEST_CASE("steps: placeholders stand for the shape, an unknown one is told with those there are") {
  const BatchPlan plan = plan_of_two();
  CHECK(steps_of(plan, plan.items[1]).front() ==
        BatchStep{"map", "/x/b.ply", "--lambda", "2", "-o", "b.sph.ply"});
  CHECK(substituted("{id}_{map}_{n}", plan, plan.items[0], true) == "a_{map}_{n}");
  CHECK_THROWS_WITH(substituted("{lamda}", plan, plan.items[0], true),
                    Contains("no {lamda} among {input}, {id}, {lambda}"));
}

TEST_CASE("steps: words of a row's options, as a shell splits them") {
  CHECK(words_of(" --pin 'my file.txt'  --x=\"a b\" ") ==
        std::vector<std::string>{"--pin", "my file.txt", "--x=a b"});
  CHECK_THROWS_AS(words_of("'open"), BatchInputError);
}

TEST_CASE("manifest: what was planned comes back, and its name is that of its bytes") {
  const BatchPlan plan = plan_of_two();
  const std::string text = manifest_text(plan);
  const BatchPlan again = parse_manifest(text, "plan.tsv");
  CHECK(manifest_text(again) == text);
  CHECK(again.items[0].path == plan.items[0].path);
  CHECK(with_chunk(plan, 1).name == plan.name);
  CHECK(with_chunk(plan, 2).name != plan.name);
  CHECK(with_chunk(plan, 2).tasks() == 1);
  CHECK_THROWS_AS(with_chunk(plan, 0), std::invalid_argument);
}

TEST_CASE("manifest: one that is cut off or another file is refused with the line") {
  const std::string text = manifest_text(plan_of_two());
  for (const char* const other : {"ply\n", "", "\n"})
    CHECK_THROWS_WITH(parse_manifest(other, "plan.tsv"),
                      Contains("plan.tsv:1: this is no manifest of `sphparam batch plan`"));
  CHECK_THROWS_WITH(parse_manifest(text.substr(0, text.size() - 4), "plan.tsv"),
                    Contains("plan.tsv:6: an item that is not whole"));
  CHECK_THROWS_WITH(parse_manifest("#sphparam-batch\t1\n#colour\tred\n", "plan.tsv"),
                    Contains("plan.tsv:2"));
}

TEST_CASE("script: a folder of any name is quoted as sbatch reads it") {
  const auto output = [](const std::string& folder) {
    const std::string script = slurm_script(folder, plan_of_two(), "sphparam");
    const std::size_t at = script.find("#SBATCH --output=");
    return script.substr(at, script.find('\n', at) - at);
  };
  CHECK(output("/a b") == "#SBATCH --output=\"/a b/logs/%A_%a.log\"");
  CHECK(output("/it's \"100 %\"") == "#SBATCH --output=\"/it's \\\"100 %%\\\"/logs/%A_%a.log\"");
  CHECK(output("/a\\b") == "#SBATCH --output=\"/a\\\\b/logs/%A_%a.log\"");
}

TEST_CASE("tasks: as sbatch takes them") {
  CHECK(ranges_of({1, 2, 3, 7, 9, 10}) == "1-3,7,9-10");
  CHECK(ranges_of({}).empty());
}

}  // namespace sphparam::tests
