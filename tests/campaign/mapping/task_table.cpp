#include "mapping/task_table.h"

#include <algorithm>
#include <cctype>
#include <iomanip>
#include <map>
#include <string>

namespace sphparam::campaign {
namespace {

struct Row {
  std::map<std::string, long> ends;
  std::vector<double> seconds;  // of what ended with a map

  void add(const TaskRecord& record) {
    ++ends[record.end];
    if (!record.made_by.empty()) seconds.push_back(record.seconds);
  }

  void print(const std::string& name, std::ostream& out) {
    long tasks = 0;
    for (const auto& [end, count] : ends) tasks += count;
    out << "| " << name << " | " << tasks;
    for (const char* end : {certified, not_certified, lost, thrown}) out << " | " << ends[end];
    std::ranges::sort(seconds);
    const double median = seconds.empty() ? 0 : seconds[seconds.size() / 2];
    out << " | " << median << " | " << (seconds.empty() ? 0 : seconds.back()) << " |\n";
  }
};

template <class Key>
void print_rows(const std::string& title, const TaskRecords& records, const Key& key,
                std::ostream& out) {
  out << "\n| " << title
      << " | tasks | certified | not certified | lost | thrown | median (s) | slowest "
         "(s) |\n|---|---|---|---|---|---|---|---|\n";
  std::map<std::string, Row> rows;
  for (const auto& [number, record] : records) rows[key(record)].add(record);
  for (auto& [name, row] : rows) row.print(name, out);
}

void print_folders(const std::vector<SourceMesh>& meshes, const TaskRecords& records,
                   std::ostream& out) {
  struct Counts {
    long files = 0, meshes = 0, mended = 0, tasks = 0, certified = 0;
  };
  std::map<std::string, Counts> folders;
  for (const SourceMesh& mesh : meshes) {
    Counts& counts = folders[mesh.folder];
    ++counts.files;
    counts.meshes += mesh.refusal.empty();
    counts.mended += mesh.mended;
  }
  for (const auto& [number, record] : records) {
    ++folders[record.folder].tasks;
    folders[record.folder].certified += record.end == certified;
  }
  out << "\n| folder | files | meshes that map | of them mended | tasks | certified |\n"
         "|---|---|---|---|---|---|\n";
  for (const auto& [name, c] : folders) {
    out << "| " << name << " | " << c.files << " | " << c.meshes << " | " << c.mended << " | "
        << c.tasks << " | " << c.certified << " |\n";
  }
}

/// What many refusals have in common: no file, no places, N for numbers.
std::string kind_of(const SourceMesh& mesh) {
  std::string text = mesh.refusal;
  if (text.starts_with(mesh.path)) text.erase(0, mesh.path.size());
  text.erase(0, text.find_first_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"));
  std::string kind;
  for (const char c : text.substr(0, text.find(": "))) {
    const bool digit = std::isdigit(static_cast<unsigned char>(c)) && !kind.ends_with('-');
    if (!digit || !kind.ends_with('N')) kind += digit ? 'N' : c;
  }
  return kind;
}

void print_refusals(const std::vector<SourceMesh>& meshes, std::ostream& out) {
  std::map<std::string, long> kinds;
  long none = 0;
  for (const SourceMesh& mesh : meshes) {
    if (!mesh.refusal.empty()) ++kinds[kind_of(mesh)];
    if (mesh.lost) out << "\nlost while being read: " << mesh.path << ": " << mesh.refusal << '\n';
  }
  for (const SourceMesh& mesh : meshes) {
    for (size_t size = 1; size < sizes.size(); ++size)
      none +=
          mesh.refusal.empty() && mesh.triangles[0] > 2 * sizes[size] && mesh.triangles[size] == 0;
  }
  out << "\nSimplifications to half the triangles and less that are no task, for they stop early "
         "or are no closed mesh of genus 0: "
      << none << ".\n";
  if (kinds.empty()) return;
  out << "\n| no mesh to map, since | files |\n|---|---|\n";
  for (const auto& [kind, count] : kinds) out << "| " << kind << " | " << count << " |\n";
}

void print_failures(const TaskRecords& records, std::ostream& out) {
  for (const auto& [number, r] : records) {
    if (r.end == certified) continue;
    out << "\n`--task " << r.task << "`: " << r.end << " (" << r.reason << "): " << r.mesh << ", "
        << r.size << "; order " << r.order << "; poles " << r.poles << "; " << r.way << '\n';
  }
}

}  // namespace

void print_tables(const std::vector<SourceMesh>& meshes, const TaskRecords& records,
                  std::ostream& out) {
  out << std::setprecision(3);
  print_rows(
      "method", records, [](const TaskRecord& r) { return r.way; }, out);
  print_rows(
      "simplified to", records, [](const TaskRecord& r) { return r.size; }, out);
  print_rows(
      "order", records, [](const TaskRecord& r) { return r.order; }, out);
  print_rows(
      "poles", records, [](const TaskRecord& r) { return r.poles; }, out);
  print_rows(
      "made by", records,
      [](const TaskRecord& r) {
        return r.way.substr(0, r.way.find(',')) + ": " + (r.made_by.empty() ? "none" : r.made_by);
      },
      out);
  print_rows(
      "all", records, [](const TaskRecord&) { return "all"; }, out);
  print_folders(meshes, records, out);
  print_refusals(meshes, out);
  const auto elsewhere = std::ranges::count_if(
      records, [](const auto& r) { return r.second.end == certified && !r.second.placed; });
  double seconds = 0;
  for (const auto& [number, record] : records) seconds += record.seconds;
  out << "\nCertified without the poles that were asked for, which a warning tells: " << elsewhere
      << ". Processor time of all maps: " << seconds / 60 << " minutes.\n";
  print_failures(records, out);
}

bool all_well(const std::vector<SourceMesh>& meshes, const TaskRecords& records) {
  return !records.empty() && std::ranges::none_of(meshes, &SourceMesh::lost) &&
         std::ranges::all_of(records,
                             [](const auto& record) { return record.second.end == certified; });
}

}  // namespace sphparam::campaign
