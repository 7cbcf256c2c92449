// Writes the README's table of results: every OBJ, PLY and OFF mesh of a folder by every method.
//
// Usage: results FOLDER [--into README.md]   (replaces what stands between the two markers)

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "mesh_io/mesh_reader.h"
#include "mesh_io/welding.h"
#include "sphparam/parameterize.h"

using namespace sphparam;
using namespace sphparam::tools;

namespace {

constexpr char begin_marker[] = "<!-- results: written by tests/bench/results -->\n";
constexpr char end_marker[] = "<!-- end of results -->\n";

std::vector<std::filesystem::path> mesh_files(const std::string& folder) {
  const std::set<std::string> known{".obj", ".ply", ".off"};
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (known.contains(entry.path().extension().string())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

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

std::string row(const std::filesystem::path& path, const TriangleMesh& mesh, Method method,
                const char* name) {
  const auto start = std::chrono::steady_clock::now();
  const Parameterization map = parameterize(mesh, {.method = method});
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  char line[512];
  if (map.map.points.rows() == 0) {
    std::snprintf(line, sizeof line, "| %s | %ld | %s | – | – | no map | | | | | %.3f | |\n",
                  path.stem().c_str(), static_cast<long>(mesh.face_count()), name, seconds);
    return line;
  }
  const DistortionSummary d = summarise(measure_distortion(mesh, map.map));
  std::snprintf(line, sizeof line,
                "| %s | %ld | %s | %s | %ld | %s | %.3f | %.3f | %.3f | %.3g | %.3f | %s |\n",
                path.stem().c_str(), static_cast<long>(mesh.face_count()), name,
                map.made_by.c_str(), folds_before_repair(map),
                map.certificate.bijective() ? "yes" : "no", d.mean_abs_ln_angle, d.mean_abs_ln_area,
                d.weighted_abs_log2_area, d.symmetric_dirichlet, seconds,
                seconds_in_the_paper(path.stem(), method).c_str());
  return line;
}

std::string table(const std::string& folder) {
  std::string text =
      "| mesh | triangles | method | made by | folds before repair | certified | mean \\|ln "
      "angle\\| | "
      "mean \\|ln area\\| | weighted \\|log2 area\\| | symmetric Dirichlet | seconds | in 2006 |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const std::filesystem::path& path : mesh_files(folder)) {
    const TriangleMesh mesh = prepare_for_mapping(read_mesh(path.string())).mesh;
    for (const auto& [method, name] :
         {std::pair{Method::Progressive, "progressive"},
          std::pair{Method::Curvilinear, "curvilinear"}, std::pair{Method::Paper, "paper"}}) {
      text += row(path, mesh, method, name);
    }
    std::cerr << path.filename().string() << "\n";
  }
  return text;
}

void replace_between_markers(const std::string& path, const std::string& text) {
  std::ifstream in(path);
  std::ostringstream all;
  all << in.rdbuf();
  std::string page = all.str();
  const size_t begin = page.find(begin_marker), end = page.find(end_marker);
  if (begin == std::string::npos || end == std::string::npos) {
    throw std::runtime_error(path + ": the two markers are not there");
  }
  page.replace(begin + sizeof begin_marker - 1, end - begin - sizeof begin_marker + 1, text);
  std::ofstream(path) << page;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Maps every mesh of a folder by every method and prints a table.");
  std::string folder, page;
  app.add_option("FOLDER", folder)->required();
  app.add_option("--into", page, "a page with the two markers");
  CLI11_PARSE(app, argc, argv);
  const std::string text = table(folder);
  page.empty() ? void(std::cout << text) : replace_between_markers(page, text);
} catch (const std::exception& error) {
  std::cerr << "results: " << error.what() << "\n";
  return 1;
}
