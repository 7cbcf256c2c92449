// paper_page OUT [FOLDER]: the paper's evaluation made again, as OUT/index.html.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

#include "io/polygons/welding.h"
#include "paper_figures.h"
#include "paper_tables.h"
#include "paper_trial.h"
#include "sample_meshes.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/version.h"

namespace {

namespace fs = std::filesystem;
using namespace sphparam;
using namespace sphparam::samples;

constexpr char usage[] =
    "The evaluation of \"Curvilinear Spherical Parameterization\" made again, as one page.\n"
    "\n"
    "  paper_page OUT           on the sample meshes\n"
    "  paper_page OUT FOLDER    on FOLDER's meshes, with figures of mannequin, gargoyle, skull,\n"
    "                           turtle, camel, homer and cow, those that are there\n";

bool is_model(const std::string& name) {
  const auto& models = paper_models();
  return std::any_of(models.begin(), models.end(),
                     [&](const PaperModel& m) { return m.name == name; });
}

/// What the page is about: figures are of the models, tables of everything.
struct Collection {
  std::vector<Trial> shown, measured;
};

void add(Collection& collection, const std::string& name, MeshFile file, bool shown) {
  std::cerr << name << ": " << file.mesh.face_count() << " triangles" << std::endl;
  (shown ? collection.shown : collection.measured)
      .push_back(try_mesh(name, std::move(file), shown));
}

/// The mesh files of a folder; a folder with a `genus0` folder stands for that one.
std::vector<fs::path> mesh_files(fs::path folder) {
  if (fs::is_directory(folder / "genus0")) folder /= "genus0";
  const std::set<std::string> known{".obj", ".ply", ".off", ".stl", ".glb", ".gii"};
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (known.contains(entry.path().extension().string())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

Collection collect(const std::string& folder) {
  Collection collection;
  for (const fs::path& path : mesh_files(folder)) {
    const std::string name = path.stem().string();
    try {
      add(collection, name, prepare_for_mapping(read_mesh(path.string())), is_model(name));
    } catch (const MeshError&) {
      std::cerr << name << ": skipped, no closed genus-0 mesh\n";
    } catch (const ReadError& error) {
      std::cerr << name << ": skipped, " << error.what() << "\n";
    }
  }
  return collection;
}

Collection samples_only() {
  Collection collection;
  add(collection, "creature", make_creature(), true);  // has limbs, as most of the models
  add(collection, "body", make_body(), true);
  add(collection, "cortex", make_cortex(), true);
  return collection;
}

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

std::string absent_models(const std::vector<Trial>& trials) {
  std::string names;
  std::set<std::string> said;
  for (const PaperModel& model : paper_models()) {
    const bool here = std::any_of(trials.begin(), trials.end(),
                                  [&](const Trial& trial) { return trial.name == model.name; });
    if (here || !said.insert(model.name).second) continue;
    names += (names.empty() ? "" : ", ") + std::string(model.name);
  }
  return names;
}

void write(const fs::path& folder, FolderFiles files) {
  fs::create_directories(folder);
  PendingFiles pending;
  for (auto& [name, bytes] : files) pending.add((folder / name).string(), std::move(bytes));
  pending.publish();
}

FolderFiles make_page(const Collection& collection) {
  std::vector<Trial> all = collection.shown;
  all.insert(all.end(), collection.measured.begin(), collection.measured.end());
  FolderFiles files;
  Page page("Curvilinear Spherical Parameterization: its evaluation made again");
  page.paragraph("By sphparam " + std::string(version) + " on " + processor() + ", " +
                 std::to_string(std::thread::hardware_concurrency()) +
                 " threads. Every figure and number here is made by the program; statements about "
                 "the paper name their section or figure. Angle and area are means of |ln (result "
                 "/ input)|, as in the paper's charts; folds are decided with exact signs.");
  const std::string absent = absent_models(all);
  if (!absent.empty())
    page.paragraph("Skipped, because they are not in the folder: " + absent + ".");
  add_timings(page, all);
  add_findings(page, all);
  add_figures(page, files, collection.shown);
  add_all_methods(page, all);
  files.emplace_back("index.html", page.html());
  return files;
}

void run(const fs::path& out, const std::string& folder) {
  Collection collection = folder.empty() ? Collection{} : collect(folder);
  if (collection.shown.empty()) {  // figures want a mesh
    const Collection samples = samples_only();
    collection.shown = samples.shown;
  }
  const std::string absent = absent_models(collection.shown);
  if (!absent.empty()) std::cerr << "skipped, not in the folder: " << absent << "\n";
  write(out, make_page(collection));
  std::cout << (out / "index.html").string() << "\n";
}

}  // namespace

int main(int count, char** values) try {
  const std::string first = count > 1 ? values[1] : "";
  if (first == "--help") {
    std::cout << usage;
    return 0;
  }
  if (count < 2 || count > 3 || first.empty() || first[0] == '-')
    throw std::invalid_argument("where to?");
  run(first, count == 3 ? values[2] : "");
  return 0;
} catch (const std::invalid_argument& e) {
  std::cerr << "paper_page: " << e.what() << "\n\n" << usage;
  return 2;
} catch (const std::exception& e) {
  std::cerr << "paper_page: " << e.what() << '\n';
  return 1;
}
