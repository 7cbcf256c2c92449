#include <catch2/catch.hpp>

#include "paper_figures.h"
#include "paper_tables.h"
#include "paper_trial.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::samples;
using namespace sphparam::tests;
using namespace sphparam;
using Catch::Matchers::Contains;

namespace {

MeshFile small_mesh() {
  MeshFile file;
  file.mesh = random_sphere_mesh(500, 3);
  return file;
}

}  // namespace

TEST_CASE("paper: a trial has every method, and every stage of the paper's") {
  const Trial trial = try_mesh("cow", small_mesh(), true);
  CHECK(trial.entries.size() == all_methods().size());
  REQUIRE(trial.steps);
  REQUIRE(trial.steps->printed.size() == 5);  // initial, three iterations, smoothing
  REQUIRE(trial.steps->further.size() == 11);
  CHECK(trial.steps->printed.back().name == "smoothing");
  // Both runs are the same up to the third iteration.
  CHECK(trial.steps->printed[3].figures.mean_abs_ln_area ==
        trial.steps->further[3].figures.mean_abs_ln_area);
  // What the paper's method folds is what its last stage folds.
  CHECK(trial.steps->printed.back().folds == trial.by("paper").certificate.fold_count());
  CHECK_FALSE(trial.steps->patch.empty());
}

TEST_CASE("paper: the page has the figures of what is there and says what is not") {
  const std::vector<Trial> trials = {try_mesh("cow", small_mesh(), true)};
  Page page("t");
  FolderFiles files;
  add_timings(page, trials);
  add_findings(page, trials);
  add_figures(page, files, trials, 48);
  add_all_methods(page, trials);
  const std::string html = page.html();
  for (const auto& [name, bytes] : files) CHECK_THAT(html, Contains("src=\"" + name + "\""));
  for (const char* figure : {"Figure 2:", "Figure 5:", "Figures 6 and 10", "Figures 7 and 11",
                             "Figure 8:", "Figures 1, 3 and 9", "Is every map bijective?"}) {
    CHECK_THAT(html, Contains(figure));
  }
  CHECK_THAT(html, Contains("the paper shows skull, which is not here"));
}

TEST_CASE("paper: without maps a trial is small, its figures stay") {
  const Trial trial = try_mesh("x", small_mesh(), false);
  CHECK(trial.by("progressive").map.points.rows() == 1);
  CHECK(trial.by("progressive").figures);
  CHECK(trial.by("progressive").has_map());
}
