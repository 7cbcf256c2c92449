// Maps random and adversarial meshes by the default method and counts what became of them.
//
// Usage: campaign [--seed 1] [--count 100000] [--first 0] [--jobs N] [--limit SECONDS]
//                 [--json FILE] [--mesh FILE.off]
// The specimens are numbered from --first on; number and seed name one for good, and --mesh writes
// the first of them to a file instead. Exit code 0: all certified, none lost (crashed, over the
// limit), none thrown, none with other bytes for another number of threads; 1 otherwise.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <iostream>

#include "crew.h"
#include "sphparam/parallel.h"
#include "sphparam/stopwatch.h"
#include "tally.h"

using namespace sphparam;
using namespace sphparam::campaign;

namespace {

constexpr int compare_threads_every = 20;  // specimens
constexpr double progress_interval = 60;   // seconds

void write_off(const TriangleMesh& mesh, const std::string& path) {
  std::ofstream out(path);
  out << "OFF\n" << mesh.vertex_count() << ' ' << mesh.face_count() << " 0\n";
  out << std::setprecision(17);
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
    out << mesh.positions(v, 0) << ' ' << mesh.positions(v, 1) << ' ' << mesh.positions(v, 2)
        << '\n';
  }
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    out << "3 " << mesh.triangles(f, 0) << ' ' << mesh.triangles(f, 1) << ' '
        << mesh.triangles(f, 2) << '\n';
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Maps random and adversarial meshes.");
  std::uint64_t seed = 1;
  std::int64_t count = 100000, first = 0;
  int jobs = 0;
  double limit = 60;
  std::string json_path, mesh_path;
  app.add_option("--seed", seed);
  app.add_option("--count", count)->check(CLI::PositiveNumber);
  app.add_option("--first", first, "number of the first specimen")->check(CLI::NonNegativeNumber);
  app.add_option("--jobs", jobs, "processes at a time; 0: one a core");
  app.add_option("--limit", limit, "seconds of processor time a mesh")->check(CLI::PositiveNumber);
  app.add_option("--json", json_path, "everything counted");
  app.add_option("--mesh", mesh_path, "write the first specimen to this file, and stop");
  CLI11_PARSE(app, argc, argv);
  if (!mesh_path.empty()) {
    write_off(make_specimen(seed, static_cast<std::uint64_t>(first)).mesh, mesh_path);
    return 0;
  }

  const auto compares = [](std::int64_t number) { return number % compare_threads_every == 0; };
  const Stopwatch stopwatch;
  Tally tally;
  std::int64_t done = 0;
  double next_word = progress_interval;
  const auto count_one = [&] {
    ++done;
    if (stopwatch.seconds() < next_word) return;
    next_word = stopwatch.seconds() + progress_interval;
    std::cerr << done << " of " << count << std::endl;
  };
  run_crew(
      {first, first + count, resolve_threads(jobs), limit},
      [&](std::int64_t number) {
        const Specimen specimen = make_specimen(seed, static_cast<std::uint64_t>(number));
        return nlohmann::json(try_specimen(specimen, compares(number))).dump();
      },
      [&](std::int64_t number, const std::string& line) {
        tally.add(number, nlohmann::json::parse(line).get<Outcome>(), compares(number));
        count_one();
      },
      [&](std::int64_t number, const std::string& reason) {
        std::cerr << "specimen " << number << ": " << reason << std::endl;
        tally.add_loss(number, reason);
        count_one();
      });

  nlohmann::json report = tally.json();
  report["seed"] = seed;
  report["first"] = first;
  report["count"] = count;
  report["seconds"] = stopwatch.seconds();
  if (!json_path.empty()) std::ofstream(json_path) << report.dump(2) << '\n';
  std::cout << tally.table();
  for (const char* list : {"uncertified", "lost", "thrown", "thread dependent"}) {
    std::cout << list << ": " << report[list].size() << '\n';
    for (const nlohmann::json& item : report[list]) std::cout << "  " << item.dump() << '\n';
  }
  return tally.all_well() ? 0 : 1;
}
