#include "paper_tables.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "report/svg.h"

namespace sphparam::samples {

namespace {

using Row = std::vector<std::string>;

std::string number(double value, bool known = true) { return known ? significant(value) : "–"; }

std::string of(long part, size_t all) {
  return std::to_string(part) + " of " + std::to_string(all);
}

std::string meshes(size_t count) {
  return std::to_string(count) + (count == 1 ? " mesh" : " meshes");
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double microseconds(double seconds, double triangles) { return 1e6 * seconds / triangles; }

Row timing_row(const PaperModel& model, const Trial& trial) {
  const double then = 1000 * model.thousand_triangles;
  const auto now = static_cast<double>(trial.file.mesh.face_count());
  const bool told = model.seconds > 0;
  const double printed = *trial.by("paper").seconds, ours = *trial.by("progressive").seconds;
  return {model.name,
          model.figures,
          then > 0 ? grouped(std::lround(then)) : "–",
          number(model.seconds, told),
          number(microseconds(model.seconds, then), told),
          number(model.seconds_hemispheres, model.seconds_hemispheres > 0),
          grouped(trial.file.mesh.face_count()),
          number(printed),
          number(microseconds(printed, now)),
          number(ours),
          number(microseconds(ours, now)),
          number(*trial.by("hemispheres").seconds)};
}

// --- findings ----------------------------------------------------------------------------------

std::vector<const Trial*> with_steps(const std::vector<Trial>& trials) {
  std::vector<const Trial*> result;
  for (const Trial& trial : trials) {
    if (trial.steps) result.push_back(&trial);
  }
  return result;
}

void add_folds(Page& page, const std::vector<const Trial*>& trials) {
  PageTable table = {
      "Folds of the method as printed: triangles that are not positive, in the (θ, ϕ) "
      "plane after the last iteration, and on the sphere after every stage.",
      {"mesh", "triangles", "plane", "initial", "iteration 1", "iteration 2", "iteration 3",
       "smoothing"},
      {}};
  long sound_planes = 0, sound_spheres = 0, added = 0;
  for (const Trial* trial : trials) {
    const std::vector<PaperStep>& steps = trial->steps->printed;
    Row row = {trial->name, grouped(trial->file.mesh.face_count()),
               grouped(steps.back().planar_folds)};
    for (const PaperStep& step : steps) row.push_back(grouped(step.folds));
    table.rows.push_back(row);
    sound_planes += steps.back().planar_folds == 0;
    sound_spheres += steps.back().folds == 0;
    added += steps.back().folds > steps[steps.size() - 2].folds;
  }
  page.subheading("Is every map bijective?");
  page.paragraph(
      "Claimed (Sections 1 and 6): yes, and the intermediate maps too, because all weights are "
      "positive and the smoothing is local. Found: the map in the plane has no folds on " +
      of(sound_planes, trials.size()) + " meshes, the map on the sphere none on " +
      of(sound_spheres, trials.size()) +
      ". Positive weights make the planar map sound; what they do not reach is the lift: a "
      "straight "
      "edge in (θ, ϕ) is no arc of a great circle, so that large or long triangles may turn over. "
      "The poles here are chosen automatically, the paper's were chosen by hand and are not "
      "known; other poles give other numbers.");
  page.table(table);
}

void add_iterations(Page& page, const std::vector<const Trial*>& trials) {
  PageTable table = {"Mean |ln area ratio| after k iterations, without smoothing.", {"mesh"}, {}};
  const size_t count = trials.front()->steps->further.size();
  for (size_t k = 0; k < count; ++k) table.header.push_back(std::to_string(k));
  long first_is_best = 0, rises = 0, ends_worse = 0;
  for (const Trial* trial : trials) {
    Row row = {trial->name};
    std::vector<double> area;
    for (const PaperStep& step : trial->steps->further)
      area.push_back(step.figures.mean_abs_ln_area);
    for (const double a : area) row.push_back(number(a));
    table.rows.push_back(row);
    first_is_best += area[1] <= std::min(area[2], area[3]);
    rises += area[2] > area[1] || area[3] > area[2];
    ends_worse += area.back() > *std::min_element(area.begin(), area.end() - 1);
  }
  page.subheading("How many iterations?");
  page.paragraph(
      "Claimed (Section 4): the iteration can go on until it converges, and two to three are "
      "enough. "
      "Found: it does not converge but swings. From one of the first three iterations to the next "
      "the area distortion rises on " +
      of(rises, trials.size()) +
      " meshes, the first alone is better than the second and the third on " +
      of(first_is_best, trials.size()) + ", and after ten it is worse than it has been before on " +
      of(ends_worse, trials.size()) +
      ". In one dimension the step overshoots by exactly as much as it corrects: the weights "
      "should "
      "be multiplied up, by the root of the new factor, as the method `curvilinear` does.");
  page.table(table);
}

void add_smoothing(Page& page, const std::vector<const Trial*>& trials) {
  PageTable table = {
      "Before and after three sweeps of smoothing: folds on the sphere, and means of "
      "|ln ratio| over the triangles of the five-ring patch.",
      {"mesh", "folds before", "after", "patch angle before", "after", "patch area before",
       "after"},
      {}};
  long more_folds = 0, fewer_folds = 0, better_angles = 0, better_areas = 0;
  for (const Trial* trial : trials) {
    const std::vector<PaperStep>& steps = trial->steps->printed;
    const PaperStep &before = steps[steps.size() - 2], &after = steps.back();
    table.rows.push_back({trial->name, grouped(before.folds), grouped(after.folds),
                          number(before.patch_angle), number(after.patch_angle),
                          number(before.patch_area), number(after.patch_area)});
    more_folds += after.folds > before.folds;
    fewer_folds += after.folds < before.folds;
    better_angles += after.patch_angle < before.patch_angle;
    better_areas += after.patch_area < before.patch_area;
  }
  page.subheading("What does the smoothing do?");
  page.paragraph(
      "Claimed (Sections 5 and 6): it lowers the distortion around the date line, and because the "
      "boundary of the patch is fixed nothing can fold. Found: it adds folds on " +
      of(more_folds, trials.size()) + " meshes and removes some on " + std::to_string(fewer_folds) +
      "; around the date line angles are better after it on " + of(better_angles, trials.size()) +
      ", areas on " + of(better_areas, trials.size()) +
      ". A fixed boundary keeps the patch from slipping away, not its triangles from turning over: "
      "that would need a convex region of a plane.");
  page.table(table);
}

// --- all methods × all meshes ------------------------------------------------------------------

void add_matrix(Page& page, const std::vector<Trial>& trials, const std::string& caption,
                const std::function<std::string(const Entry&)>& cell) {
  PageTable table = {caption, {"mesh", "triangles"}, {}};
  for (const MethodInfo& info : all_methods()) table.header.emplace_back(info.name);
  for (const Trial& trial : trials) {
    Row row = {trial.name, grouped(trial.file.mesh.face_count())};
    for (const Entry& c : trial.entries) row.push_back(c.has_map() ? cell(c) : "no map");
    table.rows.push_back(row);
  }
  page.table(table);
}

void add_matrices(Page& page, const std::vector<Trial>& trials) {
  const auto figure = [](double DistortionSummary::*value) {
    return [=](const Entry& c) {
      return number(c.figures ? (*c.figures).*value : 0, c.figures.has_value());
    };
  };
  add_matrix(page, trials, "Folds; “yes” where the map is certified one-to-one.",
             [](const Entry& c) { return c.certificate.bijective() ? "yes" : short_verdict(c); });
  add_matrix(page, trials, "Mean |ln area ratio|.", figure(&DistortionSummary::mean_abs_ln_area));
  add_matrix(page, trials, "Mean |ln angle ratio|.", figure(&DistortionSummary::mean_abs_ln_angle));
  add_matrix(page, trials, "Weighted |log2 area ratio|.",
             figure(&DistortionSummary::weighted_abs_log2_area));
  add_matrix(page, trials, "Symmetric Dirichlet energy; 4 is an isometry.",
             figure(&DistortionSummary::symmetric_dirichlet));
  add_matrix(page, trials, "Seconds.", [](const Entry& c) { return number(*c.seconds); });
}

struct Duel {
  size_t count = 0;
  long lower_area = 0, lower_angle = 0, faster = 0, folded = 0;
  std::vector<double> area_ratios, angle_ratios, time_ratios;  // of the other's to ours
};

Duel duel(const std::vector<Trial>& trials, const std::string& ours, const std::string& other) {
  Duel result;
  for (const Trial& trial : trials) {
    const Entry &a = trial.by(ours), &b = trial.by(other);
    if (!a.figures || !b.figures) continue;
    const double areas = b.figures->mean_abs_ln_area / a.figures->mean_abs_ln_area;
    const double angles = b.figures->mean_abs_ln_angle / a.figures->mean_abs_ln_angle;
    const double times = *b.seconds / *a.seconds;
    ++result.count;
    result.lower_area += areas > 1;
    result.lower_angle += angles > 1;
    result.faster += times > 1;
    result.folded += !b.certificate.bijective();
    result.area_ratios.push_back(areas);
    result.angle_ratios.push_back(angles);
    result.time_ratios.push_back(times);
  }
  return result;
}

std::string verdict_of(const Duel& d) {
  const auto all = static_cast<long>(d.count);
  const auto word = [&](long part) {
    return part == all ? "confirmed" : 2 * part > all ? "confirmed mostly" : "refuted";
  };
  return std::string("area ") + word(d.lower_area) + ", angle " + word(d.lower_angle) + ", speed " +
         word(d.faster);
}

void add_order(Page& page, const std::vector<Trial>& trials) {
  PageTable table = {
      "Ours against the two methods that the paper compares itself with. Ratios are "
      "theirs to ours, the median over the meshes.",
      {"ours", "theirs", "meshes", "lower area distortion", "area ratio", "lower angle distortion",
       "angle ratio", "faster", "time ratio", "theirs folded", "the paper's order"},
      {}};
  for (const char* ours : {"paper", "progressive"}) {
    for (const char* theirs : {"tangential", "hemispheres"}) {
      const Duel d = duel(trials, ours, theirs);
      if (d.count == 0) continue;
      table.rows.push_back({ours, theirs, std::to_string(d.count), of(d.lower_area, d.count),
                            number(median(d.area_ratios)), of(d.lower_angle, d.count),
                            number(median(d.angle_ratios)), of(d.faster, d.count),
                            number(median(d.time_ratios)), of(d.folded, d.count), verdict_of(d)});
    }
  }
  page.subheading("The order that the paper claims");
  page.paragraph(
      "Claimed (figures 6, 7, 10, 11): less area distortion than tangential smoothing and than the "
      "two hemispheres, angles closer to the optimum too, and much less time than the latter. "
      "Methods "
      "that are nearly conformal have better angles by their nature, at the price of the areas.");
  page.table(table);
}

}  // namespace

void add_timings(Page& page, const std::vector<Trial>& trials) {
  PageTable table = {
      "The paper's times are those of its captions, on a laptop with a 3.2 GHz Pentium "
      "4; the meshes here have the names of its models, not always their numbers of "
      "triangles: compare microseconds a triangle.",
      {"model", "figure", "triangles then", "seconds then", "µs/triangle then", "[17] then, s",
       "triangles here", "paper's method, s", "µs/triangle", "progressive, s", "µs/triangle",
       "hemispheres, s"},
      {}};
  for (const PaperModel& model : paper_models()) {
    for (const Trial& trial : trials) {
      if (trial.name == model.name) table.rows.push_back(timing_row(model, trial));
    }
  }
  page.heading("Times");
  if (table.rows.empty()) {
    page.paragraph(
        "None of the paper's models is here; times of all meshes are in the last table.");
    return;
  }
  page.table(table);
}

void add_findings(Page& page, const std::vector<Trial>& trials) {
  const std::vector<const Trial*> applicable = with_steps(trials);
  page.heading("Where we find otherwise");
  if (applicable.empty()) {
    page.paragraph("The paper's method applies to none of the meshes: no usable pair of poles.");
    return;
  }
  page.paragraph("The method as printed on " + meshes(applicable.size()) + ", stage by stage.");
  add_folds(page, applicable);
  add_iterations(page, applicable);
  add_smoothing(page, applicable);
}

void add_all_methods(Page& page, const std::vector<Trial>& trials) {
  page.heading("All methods, all meshes");
  page.paragraph("Methods of others as their authors describe them, nothing repaired.");
  add_order(page, trials);
  page.subheading("Every map");
  add_matrices(page, trials);
}

}  // namespace sphparam::samples
