#include "sphparam/survey/survey.h"

#include <algorithm>
#include <filesystem>

#include "option_domain.h"
#include "sphparam/errors.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/names.h"

// Every file goes the way of `map --repair`, one after another, each on all cores. What a strict
// reader refuses is read again for a repair, so that its defects can be seen.

namespace sphparam {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> mesh_files(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> names;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error)) {
    if (at->is_regular_file() && is_mesh_name(at->path().string()))
      names.push_back(at->path().lexically_relative(folder).string());
  }
  if (error) throw ReadError(folder, error.message());
  if (names.empty())
    throw ReadError(folder, "holds no mesh files; " + readable_formats("and") + " files are such");
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> messages(const std::vector<MeshDefect>& defects) {
  std::vector<std::string> texts;
  for (const MeshDefect& defect : defects)
    if (defect.fatal) texts.push_back(defect.message);
  return texts;
}

std::vector<std::string> messages(const std::vector<RepairAction>& actions) {
  std::vector<std::string> texts;
  for (const RepairAction& action : actions) texts.push_back(action.message);
  return texts;
}

/// One file, from its bytes to its end.
class Surveyor {
 public:
  Surveyor(const std::string& folder, const std::string& name, const SurveyOptions& options)
      : path_((fs::path(folder) / name).string()), options_(options) {
    mesh_.name = name;
  }

  SurveyedMesh run() {
    try {
      go();
    } catch (const Cancelled&) {
      throw;
    } catch (const NotCertifiedError& error) {
      end(SurveyEnd::NotCertified, error.what());
    } catch (const ReadError& error) {
      end(SurveyEnd::Unreadable, error.what());
    } catch (const std::exception& error) {  // of this file, not of the survey
      end(SurveyEnd::CannotMap, error.what());
    }
    return std::move(mesh_);
  }

 private:
  void go() {
    MeshSource source = read();
    mesh_.format = source.file.format;
    mesh_.inspection = source.inspection;
    for (std::string& message : messages(source.inspection.defects))
      mesh_.defects.push_back(std::move(message));
    if (source.inspection.is_sphere() && mesh_.defects.empty()) {
      certify(std::move(source));
      mesh_.end = SurveyEnd::Maps;
      return;
    }
    if (options_.picture_size > 0)
      mesh_.picture = picture_of_defects(source.file, source.inspection, options_.picture_size,
                                         options_.threads);
    mend(std::move(source));
  }

  /// As it is, or, where that is refused, as a repair wants it.
  MeshSource read() {
    try {
      return read_source(path_, options_.read);
    } catch (const ReadError& refusal) {
      ReadOptions lenient = options_.read;
      lenient.repeated_corners = lenient.non_finite = true;
      MeshSource source = read_source(path_, lenient);
      mesh_.defects.push_back(refusal.what());
      return source;
    }
  }

  void mend(MeshSource source) {
    const RepairTrial trial = try_repair(source);
    mesh_.repairs = messages(trial.actions);
    mesh_.reasons = messages(trial.remaining);
    if (trial.can_mend()) mesh_.advice = options_line(trial.options);
    if (!trial.can_mend()) {
      mesh_.end = SurveyEnd::CannotMap;
      return;
    }
    source = repaired(std::move(source), trial.options);
    std::vector<std::string> stale;  // a map of the mesh before
    source.file = written_as_mended(source, stale);
    certify(std::move(source));
    mesh_.end = trial.mends_unasked() ? SurveyEnd::MapsMended : SurveyEnd::MapsIfAsked;
  }

  void certify(MeshSource source) {
    LoadOptions load;
    load.map.threads = options_.threads;
    load.map.progress = options_.progress;
    mapped_mesh(std::move(source), load);
  }

  void end(SurveyEnd how, const std::string& why) {
    mesh_.end = how;
    mesh_.reasons = {why};
  }

  std::string path_;
  const SurveyOptions& options_;
  SurveyedMesh mesh_;
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
  }
  return "";
}

long Survey::count(SurveyEnd end) const {
  return std::count_if(meshes.begin(), meshes.end(),
                       [&](const SurveyedMesh& mesh) { return mesh.end == end; });
}

Survey survey_folder(const std::string& folder, const SurveyOptions& options) {
  if (options.picture_size != 0) require_between("picture_size", options.picture_size, 16, 4096);
  Survey survey{folder, {}};
  const std::vector<std::string> names = mesh_files(folder);
  for (const std::string& name : names) {
    const auto done = static_cast<double>(survey.meshes.size());
    report(options.progress, name, done / static_cast<double>(names.size()));
    survey.meshes.push_back(Surveyor(folder, name, options).run());
  }
  return survey;
}

}  // namespace sphparam
