// Writes the tables of docs/results.md: every mesh of a folder by every method, and by the default
// method in its qualities and balances.
//
// Each time is of the run with the median ratio to the yardstick (see benchmark.cpp), of a few.
//
// Usage: results FOLDER [--into docs/results.md]   (replaces what stands between the markers)

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/polygons/welding.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/parameterize.h"
#include "yardstick.h"

using namespace sphparam;

namespace {

struct Markers {
  const char *begin, *end;
};
constexpr Markers method_markers = {"<!-- results: written by tests/bench/results -->\n",
                                    "<!-- end of results -->\n"};
constexpr Markers quality_markers = {"<!-- qualities: written by tests/bench/results -->\n",
                                     "<!-- end of qualities -->\n"};

struct Subject {
  std::string name;
  TriangleMesh mesh;
};

/// Folds of the method's own map: of its first certificate, before anything was repaired.
long folds_before_repair(const Parameterization& map) {
  for (const StageRecord& stage : map.stages) {
    if (stage.name == "certificate") return stage.folds;
  }
  return -1;
}

/// Seconds that the paper reports (captions of figures 1, 3 and 6; a 3.2 GHz laptop of 2006).
std::string seconds_in_the_paper(const std::string& mesh, Method method) {
  static const std::map<std::string, std::string> reported{
      {"mannequin", "3"}, {"gargoyle", "7"}, {"skull", "5"}};
  const auto found = reported.find(mesh);
  return method == Method::Paper && found != reported.end() ? found->second : "";
}

struct Timed {
  Parameterization map;
  double seconds;
  double ratio;  // to the yardstick, measured right before: others use the machine too
};

/// The run with the median ratio.
Timed timed(const TriangleMesh& mesh, const ParameterizeOptions& options,
            const bench::Yardstick& yardstick) {
  constexpr int most_runs = 5;
  constexpr double long_run = 1;  // seconds: what comes and goes evens out
  std::vector<Timed> runs;
  while (runs.size() < most_runs && (runs.empty() || runs.back().seconds < long_run)) {
    const double unit = yardstick.measure() * static_cast<double>(mesh.face_count());
    const double start = bench::now();
    Parameterization map = parameterize(mesh, options);
    const double seconds = bench::now() - start;
    runs.push_back({std::move(map), seconds, seconds / unit});
  }
  const auto median = runs.begin() + std::ssize(runs) / 2;
  std::nth_element(runs.begin(), median, runs.end(),
                   [](const Timed& a, const Timed& b) { return a.ratio < b.ratio; });
  return std::move(*median);
}

template <class... Values>
std::string formatted(const char* format, Values... values) {
  char line[512];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

std::string method_row(const Subject& subject, Method method, const char* name,
                       const bench::Yardstick& yardstick) {
  const auto [map, seconds, ratio] = timed(subject.mesh, {.method = method}, yardstick);
  const long triangles = static_cast<long>(subject.mesh.face_count());
  if (map.map.points.rows() == 0) {
    return formatted("| %s | %ld | %s | – | – | no map | | | | | %.3f | | |\n",
                     subject.name.c_str(), triangles, name, seconds);
  }
  const DistortionSummary d = summarise(measure_distortion(subject.mesh, map.map));
  return formatted(
      "| %s | %ld | %s | %s | %ld | %s | %.3f | %.3f | %.3f | %.3g | %.3f | %.2f | %s |\n",
      subject.name.c_str(), triangles, name, map.made_by.c_str(), folds_before_repair(map),
      map.certificate.bijective() ? "yes" : "no", d.mean_abs_ln_angle, d.mean_abs_ln_area,
      d.weighted_abs_log2_area, d.symmetric_dirichlet, seconds, ratio,
      seconds_in_the_paper(subject.name, method).c_str());
}

std::string method_table(const std::vector<Subject>& subjects, const bench::Yardstick& yardstick) {
  std::string text =
      "| mesh | triangles | method | made by | folds before repair | certified | mean \\|ln "
      "angle\\| | mean \\|ln area\\| | weighted \\|log2 area\\| | symmetric Dirichlet | seconds | "
      "in Y | in 2006 |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const Subject& subject : subjects) {
    for (const auto& [method, name] :
         {std::pair{Method::Progressive, "progressive"},
          std::pair{Method::Curvilinear, "curvilinear"}, std::pair{Method::Paper, "paper"}}) {
      text += method_row(subject, method, name, yardstick);
    }
    std::cerr << subject.name << " by method\n";
  }
  return text;
}

/// Σ A f of a map, over that of the converged one.
double energy(const Subject& subject, const SphereMap& map) {
  return distortion_energy(Topology(subject.mesh), measure_source(subject.mesh), map, {});
}

std::string quality_rows(const Subject& subject, const bench::Yardstick& yardstick) {
  const std::pair<const char*, ParameterizeOptions> runs[] = {
      {"best", {.quality = Quality::Best}},
      {"normal", {}},
      {"draft", {.quality = Quality::Draft}},
      {"conformal", {.balance = Balance::Conformal}},
      {"equal-area", {.balance = Balance::EqualArea}}};
  double least = 0;
  std::string text;
  for (const auto& [name, options] : runs) {
    const auto [map, seconds, ratio] = timed(subject.mesh, options, yardstick);
    const DistortionSummary d = summarise(measure_distortion(subject.mesh, map.map));
    const double e = energy(subject, map.map);
    if (least == 0) least = e;  // of `best`, the first
    const bool same_energy = options.balance == Balance::Lambda;
    text += formatted("| %s | %s | %s | %s | %.4f | %.4f | %.4g | %.3f | %.2f |\n",
                      subject.name.c_str(), name, map.certificate.bijective() ? "yes" : "no",
                      same_energy ? formatted("%+.2f %%", 100 * (e / least - 1)).c_str() : "",
                      d.mean_abs_ln_angle, d.weighted_abs_log2_area, d.symmetric_dirichlet, seconds,
                      ratio);
  }
  return text;
}

std::string quality_table(const std::vector<Subject>& subjects, const bench::Yardstick& yardstick) {
  std::string text =
      "| mesh | quality or balance | certified | energy above best | mean \\|ln angle\\| | "
      "weighted "
      "\\|log2 area\\| | symmetric Dirichlet | seconds | in Y |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  for (const Subject& subject : subjects) {
    text += quality_rows(subject, yardstick);
    std::cerr << subject.name << " by quality\n";
  }
  return text;
}

void replace_between(const Markers& markers, const std::string& path, const std::string& text) {
  std::ifstream in(path);
  std::ostringstream all;
  all << in.rdbuf();
  std::string page = all.str();
  const size_t begin = page.find(markers.begin), end = page.find(markers.end);
  if (begin == std::string::npos || end == std::string::npos) {
    throw std::runtime_error(path + ": the markers are not there");
  }
  const size_t first = begin + std::strlen(markers.begin);
  page.replace(first, end - first, text);
  std::ofstream(path) << page;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Maps every mesh of a folder by every method and quality and prints two tables.");
  std::string folder, page;
  app.add_option("FOLDER", folder)->required();
  app.add_option("--into", page, "a page with the markers");
  CLI11_PARSE(app, argc, argv);
  std::vector<Subject> subjects;
  for (const std::filesystem::path& path : bench::mesh_files(folder)) {
    subjects.push_back({path.stem(), prepare_for_mapping(read_mesh(path.string())).mesh});
  }
  const bench::Yardstick yardstick(bench::yardstick_mesh(folder + "/"));
  const std::string methods = method_table(subjects, yardstick);
  const std::string qualities = quality_table(subjects, yardstick);
  if (page.empty()) {
    std::cout << methods << "\n" << qualities;
  } else {
    replace_between(method_markers, page, methods);
    replace_between(quality_markers, page, qualities);
  }
} catch (const std::exception& error) {
  std::cerr << "results: " << error.what() << "\n";
  return 1;
}
