// A loop over files: what a record knows is taken from it, all else is tried, one after another,
// each on all cores.

#include "sphparam/survey/survey.h"

#include <algorithm>
#include <filesystem>

#include "batch/content_hash.h"
#include "batch/input_hash.h"
#include "batch/record.h"
#include "option_domain.h"
#include "sphparam/errors.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/mesh/mesh_repair.h"
#include "survey/isolated_trial.h"
#include "survey/mesh_files.h"
#include "survey/survey_record.h"
#include "survey/surveyor.h"

namespace sphparam {
namespace {

namespace fs = std::filesystem;

/// What decides besides the mesh whether its file is read.
std::string limits_line(const ReadOptions& read) {
  std::string line;
  for (const auto limit : {static_cast<std::int64_t>(read.max_file_bytes), read.max_vertices,
                           read.max_faces, read.max_polygon_degree, read.max_line_bytes,
                           read.max_ply_elements, read.max_ply_properties, read.max_json_bytes,
                           read.max_json_depth, read.max_json_values, read.max_json_objects})
    line += std::to_string(limit) + ' ';
  return line;
}

/// Ends that are the file's own.
bool is_lasting(SurveyEnd end) { return end != SurveyEnd::Unreadable && end != SurveyEnd::Stopped; }

/// What was found before, by a hash of all that it depends on.
class Records {
 public:
  Records(const std::string& folder, const SurveyOptions& options)
      : folder_(folder),
        records_(options.records),
        asked_(std::to_string(options.picture_size) + ' ' + limits_line(options.read)) {
    if (!records_.empty()) require_writable(records_ + "/record.json");
  }

  /// Empty: there are no records, or the file cannot be read.
  std::string path_of(const std::string& name) const {
    if (records_.empty()) return "";
    try {
      const std::string about = program_hash() + ' ' + asked_ + name + ' ' +
                                hash_of_input((fs::path(folder_) / name).string()).hash;
      return (fs::path(records_) / (content_hash(about) + ".json")).string();
    } catch (const ReadError&) {
      return "";
    }
  }

  static std::optional<SurveyedMesh> find(const std::string& path) {
    if (path.empty()) return std::nullopt;
    const auto bytes = small_file(path);
    return bytes ? surveyed_of(*bytes) : std::nullopt;
  }

  static void keep(const std::string& path, const SurveyedMesh& mesh) {
    if (!path.empty() && is_lasting(mesh.end)) write_file(path, record_of(mesh));
  }

 private:
  std::string folder_, records_, asked_;
};

}  // namespace

std::string name_of(SurveyEnd end) {
  switch (end) {
    case SurveyEnd::Maps:
      return "maps";
    case SurveyEnd::MapsMended:
      return "maps-mended";
    case SurveyEnd::MapsIfAsked:
      return "maps-if-asked";
    case SurveyEnd::CannotMap:
      return "cannot-map";
    case SurveyEnd::NotCertified:
      return "not-certified";
    case SurveyEnd::Unreadable:
      return "unreadable";
    case SurveyEnd::Stopped:
      return "stopped";
  }
  return "";
}

bool SurveyedWay::drops_much() const { return area_share < RepairOptions{}.least_kept; }

const SurveyedWay* SurveyedMesh::best_way() const {
  constexpr double equal = 1e-3;
  const SurveyedWay* best = nullptr;
  for (const SurveyedWay& way : ways)
    if (way.certified && (!best || way.area_share > best->area_share + equal)) best = &way;
  return best;
}

long Survey::count(SurveyEnd end) const {
  return std::count_if(meshes.begin(), meshes.end(),
                       [&](const SurveyedMesh& mesh) { return mesh.end == end; });
}

Survey survey_folder(const std::string& folder, const SurveyOptions& options) {
  if (options.picture_size != 0) require_between("picture_size", options.picture_size, 16, 4096);
  if (options.longest != 0) require_more_than("longest", options.longest, 0);
  const Records records(folder, options);
  Survey survey{folder, {}};
  const std::vector<std::string> names = mesh_files(folder);
  for (const std::string& name : names) {
    const double done =
        static_cast<double>(survey.meshes.size()) / static_cast<double>(names.size());
    report(options.progress, name, done);
    const std::string record = records.path_of(name);
    std::optional<SurveyedMesh> mesh = Records::find(record);
    if (!mesh) {
      mesh = options.isolated ? isolated_trial(folder, name, options, done)
                              : survey_mesh(folder, name, options);
      Records::keep(record, *mesh);
    }
    mesh->name = name;  // which need not be UTF-8, as records are
    survey.meshes.push_back(std::move(*mesh));
  }
  return survey;
}

}  // namespace sphparam
