// Maps every closed mesh of given folders in many ways, and counts what became of it: is there a
// mesh, a method, an order of its vertices that ends without a certified map?
//
//     mapping_tasks --count 36001 --log tasks.jsonl FOLDER…
//
// (The largest campaign that was published has 36,000 tasks, of the Advancing Front Mapping.)
// A task is a mesh (as it is, or simplified by quadrics to about 20,000, 5,000, 1,000 or 200
// triangles, each made of the one before), an order of its vertices and triangles (its own, or
// permuted), a method with its quality and balance, and where the poles go. Each mesh is mapped as
// it is, in its order, by the default; the other tasks are drawn from all there are, evenly but for
// those estimated at more than 0.5 s, whose share falls with the estimate: large meshes, `best` and
// equal areas. Beyond 5 s nothing but defaults is drawn. Seed and count name the tasks of a set of
// meshes for good; a larger count has the same and more.
//
// `--method paper` is no task: as printed it folds, and promises no certificate. Nor are files that
// are no closed mesh of genus 0, or the mesh of another file once more; they are counted, with why.
// `--repair` takes what a repair makes of them.
//
// A task runs in a process of a crew: what crashes or takes too long costs its own task. The log is
// written as tasks end; started again with it, the program goes on, and needs no folders. `--task`
// runs one of its tasks alone, here; `--table` prints its tables. Exit code 0: all certified.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "crew.h"
#include "mapping/task_list.h"
#include "mapping/task_log.h"
#include "mapping/task_table.h"
#include "mapping/task_trial.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/parallel.h"
#include "sphparam/stopwatch.h"
#include "support/hard_shapes.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::campaign;

namespace {

constexpr double progress_interval = 60;  // seconds
constexpr int tasks_at_once = 25;         // of a process, mostly of one mesh
constexpr char interrupted[] = "signal 2";

struct Settings {
  LogSettings log;
  std::vector<std::string> places, lists;
  std::string log_path, made;
  std::int64_t count = 36001, task = -1;
  int jobs = 0;
  double limit = 60;
  bool table = false, again = false;
};

/// Shapes for who has no meshes: three that map, and two that do not.
void write_shapes(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const auto write = [&](const char* name, TriangleMesh mesh) {
    MeshFile file;
    file.mesh = std::move(mesh);
    write_mesh((folder / name).string(), file);
  };
  write("slivers.ply", tests::with_slivers(tests::icosphere(4), 0.2, 0.01, 1));
  write("tube.off", tests::tube(60, 12));
  write("crumpled.obj", tests::random_sphere_mesh(800, 1));
  TriangleMesh open = tests::icosphere(2);
  open.triangles.conservativeResize(open.face_count() - 1, 3);
  write("open.off", open);
  write("copy.ply", tests::tube(60, 12));
}

std::vector<SourceMesh> read_meshes(const Settings& settings) {
  const std::vector<SourceMesh> found = find_meshes(settings.places, settings.lists);
  std::vector<SourceMesh> meshes = found;
  const auto of = [](std::int64_t item) { return static_cast<size_t>(item); };
  run_crew(
      {0, std::ssize(found), resolve_threads(settings.jobs), settings.limit, 10},
      [&](std::int64_t i) { return line_of(inspected(found[of(i)], settings.log.repair)); },
      [&](std::int64_t i, const std::string& line) {
        meshes[of(i)] = nlohmann::json::parse(line).get<SourceMesh>();
      },
      [&](std::int64_t i, const std::string& why) {
        meshes[of(i)].refusal = why;
        meshes[of(i)].lost = true;
      });
  refuse_copies(meshes);
  return meshes;
}

/// Throws unless the log, if it has begun, is of these settings and of the meshes that are there.
void open(TaskLog& log, const Settings& settings) {
  if (!log.settings()) return log.begin(settings.log, read_meshes(settings));
  if (*log.settings() != settings.log)
    throw std::runtime_error("the log is of another --seed, --orders or --repair");
  if (settings.places.empty() && settings.lists.empty()) return;
  if (!std::ranges::equal(find_meshes(settings.places, settings.lists), log.meshes(), {},
                          &SourceMesh::path, &SourceMesh::path))
    throw std::runtime_error("the log is of other meshes");
}

/// Those of the draw that are not in the log.
std::vector<std::int64_t> left_to_do(const TaskList& tasks, const TaskLog& log,
                                     const Settings& settings) {
  std::vector<std::int64_t> numbers = tasks.draw(settings.count, settings.log.seed);
  if (std::ssize(numbers) < settings.count)
    std::cerr << "there are no more than " << numbers.size() << " tasks: more --orders make more\n";
  double seconds = 0;
  for (const std::int64_t number : numbers) seconds += tasks.estimate(tasks.task(number));
  std::set<std::int64_t> done;
  for (const auto& [number, record] : log.records()) {
    if (record.end == certified || !settings.again) done.insert(number);
  }
  std::cerr << numbers.size() << " of " << tasks.all().size() << " tasks, at about " << seconds / 60
            << " minutes of processor time" << std::endl;
  std::erase_if(numbers, [&](std::int64_t number) { return done.contains(number); });
  return numbers;
}

void run(const TaskList& tasks, TaskLog& log, const Settings& settings) {
  const std::vector<std::int64_t> numbers = left_to_do(tasks, log, settings);
  std::cerr << numbers.size() << " to do" << std::endl;
  TaskTrial trial(tasks, settings.log.seed);
  const Stopwatch stopwatch;
  double next_word = progress_interval;
  long done = 0, failed = 0;
  const auto enter = [&](const TaskRecord& record) {
    failed += record.end != certified;
    log.add(record);
    ++done;
    if (stopwatch.seconds() < next_word) return;
    next_word = stopwatch.seconds() + progress_interval;
    std::cerr << done << " of " << numbers.size() << ", " << failed << " without a certificate"
              << std::endl;
  };
  const auto number = [&](std::int64_t item) { return numbers[static_cast<size_t>(item)]; };
  run_crew(
      {0, std::ssize(numbers), resolve_threads(settings.jobs), settings.limit, tasks_at_once},
      [&](std::int64_t i) { return line_of(trial.run(number(i))); },
      [&](std::int64_t, const std::string& line) { enter(nlohmann::json::parse(line)); },
      [&](std::int64_t i, const std::string& why) {
        if (why == interrupted) return;  // by Ctrl-C, which reached the child first
        TaskRecord record = trial.blank(number(i));
        record.reason = why;
        enter(record);
      });
}

int run_alone(const TaskList& tasks, const Settings& settings) {
  if (settings.task >= tasks.end() || !tasks.possible(tasks.task(settings.task)))
    throw std::runtime_error("there is no such task");
  const TaskRecord record = TaskTrial(tasks, settings.log.seed).run(settings.task);
  std::cout << nlohmann::json(record).dump(2) << '\n';
  return record.end == certified ? 0 : 1;
}

int main_of(Settings settings) {
  if (!settings.made.empty()) {
    write_shapes(settings.made);
    settings.places.push_back(settings.made);
  }
  TaskLog log(settings.log_path, settings.table || settings.task >= 0);
  if (!settings.table) open(log, settings);
  const TaskList tasks(log.meshes(), settings.log.orders);
  if (settings.task >= 0) return run_alone(tasks, settings);
  if (!settings.table) run(tasks, log, settings);
  print_tables(log.meshes(), log.records(), std::cout);
  return all_well(log.meshes(), log.records()) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Maps meshes in many ways.");
  Settings settings;
  app.add_option("PLACE", settings.places, "Folders of meshes, or meshes");
  app.add_option("--list", settings.lists, "Files with the path of a mesh a line, before a tab");
  app.add_option("--made", settings.made, "A folder for a few made shapes, which are mapped too");
  app.add_option("--count", settings.count)->check(CLI::PositiveNumber);
  app.add_option("--seed", settings.log.seed);
  app.add_option("--orders", settings.log.orders, "Of vertices and triangles; the first is the own")
      ->check(CLI::PositiveNumber);
  app.add_flag("--repair", settings.log.repair, "Mend what does not map as it is");
  app.add_option("--log", settings.log_path, "A line a mesh and a task; what is in it is done");
  app.add_option("--jobs", settings.jobs, "Processes at a time; 0: one a core");
  app.add_option("--limit", settings.limit, "Seconds of processor time a task")
      ->check(CLI::PositiveNumber);
  app.add_option("--task", settings.task, "Only this one, in this process")
      ->check(CLI::NonNegativeNumber);
  app.add_flag("--again", settings.again, "Do those of the log without a certificate once more");
  app.add_flag("--table", settings.table, "Only print the tables of the log");
  CLI11_PARSE(app, argc, argv);
  try {
    return main_of(std::move(settings));
  } catch (const std::exception& error) {
    std::cerr << error.what() << std::endl;
    return 2;
  }
}
