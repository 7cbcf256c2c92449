// A file goes the ways that `map` has: as it is; with --repair, and what that must be asked for;
// with holes that stay holes; each component for itself. What a strict reader refuses is read again
// for a repair, so that its defects can be seen.

#include "survey/surveyor.h"

#include <algorithm>
#include <filesystem>
#include <new>
#include <optional>

#include "number_text.h"
#include "sphparam/errors.h"
#include "sphparam/io/components.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/io/repair_advice.h"
#include "sphparam/names.h"
#include "sphparam/words.h"
#include "survey/defect_picture.h"

namespace sphparam {
namespace {

constexpr const char* unasked_way = "--repair";
constexpr const char* components_way = "--repair --all-components";
constexpr const char* no_memory = "there is not enough memory for it";

/// Of those that stand in the way of a map, or of the others.
std::vector<std::string> messages(const std::vector<MeshDefect>& defects, bool fatal = true) {
  std::vector<std::string> texts;
  for (const MeshDefect& defect : defects)
    if (defect.fatal == fatal) texts.push_back(defect.message);
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
      : path_((std::filesystem::path(folder) / name).string()), options_(options) {
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
    } catch (const std::bad_alloc&) {
      end(SurveyEnd::Stopped, no_memory);
    } catch (const PictureError& error) {
      end(SurveyEnd::Stopped,
          std::string("its pictures cannot be made (`--size 0` makes none): ") + error.what());
    } catch (const std::exception& error) {  // of this file, not of the survey
      end(SurveyEnd::CannotMap, error.what());
    }
    for (auto* texts : {&mesh_.defects, &mesh_.oddities, &mesh_.repairs, &mesh_.reasons})
      for (std::string& text : *texts) text = by_name(std::move(text));
    for (SurveyedWay& way : mesh_.ways) way.told = by_name(std::move(way.told));
    return std::move(mesh_);
  }

 private:
  void go() {
    const MeshSource source = read();
    const MeshInspection& found = source.inspection;
    mesh_.format = source.file.format;
    mesh_.vertices = found.vertices;
    mesh_.triangles = found.faces;
    mesh_.components = found.components;
    mesh_.boundaries = found.boundary_loops;
    mesh_.genus = found.genus;
    for (std::string& message : messages(found.defects))
      mesh_.defects.push_back(std::move(message));
    mesh_.oddities = messages(found.defects, false);
    if (found.is_sphere() && mesh_.defects.empty()) {
      certify(source);
      mesh_.end = SurveyEnd::Maps;
      return;
    }
    const RepairTrial trial = try_repair(source);
    draw_defects(source, trial);
    mesh_.repairs = messages(trial.actions);
    if (trial.can_mend()) {
      try_way(source, trial);
      if (!trial.mends_unasked() && mends_unasked(source, trial))
        try_besides(unasked_way, [&] { try_way(source, try_repair_unasked(source).trial); });
    } else {
      mesh_.reasons = messages(trial.remaining);
    }
    if (found.boundary_loops > 0)
      try_besides("--repair --keep-holes", [&] { try_kept_holes(source); });
    if (trial.parts.refused) try_besides(components_way, [&] { try_components(source); });
    conclude(trial);
  }

  /// A way that nobody has to go: what goes wrong on it takes nothing from the others.
  template <typename Way>
  void try_besides(const std::string& options, Way way) {
    const auto failed = [&](const std::string& why) {
      mesh_.ways.push_back({options, false, why, 0});
    };
    try {
      way();
    } catch (const Cancelled&) {
      throw;
    } catch (const PictureError&) {
      throw;
    } catch (const std::bad_alloc&) {
      failed(no_memory);
    } catch (const std::exception& error) {
      failed(error.what());
    }
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

  void try_way(const MeshSource& source, const RepairTrial& trial) {
    SurveyedWay way{options_line(trial.options), false, "", 1};
    MeshSource mended = repaired(source, trial.options);
    std::vector<std::string> stale;  // a map of the mesh before
    mended.file = written_as_mended(mended, stale);
    way.told = kept_line(mended.parts, mended.repairs);
    if (!way.told.empty()) way.area_share = mended.parts.area_share;
    if (mesh_.ways.empty()) draw_mended(mended.file, way.options);
    try {
      certify(std::move(mended));
      way.certified = true;
    } catch (const NotCertifiedError& error) {
      way.told = error.what();
    }
    mesh_.ways.push_back(std::move(way));
  }

  void try_kept_holes(const MeshSource& source) {
    const RepairTrial trial = try_repair(source, true);
    if (trial.can_mend()) try_way(source, trial);
  }

  /// With what all take that can be mapped. Parts that cannot are left out as `map` leaves them
  /// out: specks.
  void try_components(const MeshSource& source) {
    const RepairOptions repairs = try_parts(source).options;
    std::vector<MeshPart> parts = connected_parts(source, repairs);
    const std::size_t all = parts.size();
    std::size_t mapped = 0;
    bool folds = false;
    double lost = 0;
    std::string left_out;
    for (std::size_t i = 0; i < all; ++i) {
      const std::string name = "component " + std::to_string(i + 1) + " (" +
                               percent(parts[i].area_share) + " of the area)";
      std::string why = why_not(std::move(parts[i]), repairs, folds);
      if (why.empty()) {
        ++mapped;
      } else {
        lost += parts[i].area_share;
        left_out += "; left out: " + name + ": " + std::move(why);
      }
    }
    const std::string kept =
        mapped < all ? ", with " + percent(1 - lost, 5) + " of the area" : std::string();
    const bool enough = mapped == all || (mapped > 0 && 1 - lost >= repairs.least_kept);
    mesh_.ways.push_back({all_components_line(repairs), enough && !folds,
                          std::to_string(mapped) + " of " + std::to_string(all) +
                              " components map" + kept + left_out,
                          mapped == all ? 1 : 1 - lost});
  }

  /// Empty: it maps. `folds`: a map was not certified, which ends `map` with an error.
  std::string why_not(MeshPart part, const RepairOptions& repairs, bool& folds) {
    try {
      certify(repaired_part(std::move(part), repairs));
      return "";
    } catch (const MeshError& error) {
      return joined(messages(error.defects()), "; ");
    } catch (const UnmeasurableMesh& error) {  // a speck without area
      return error.what();
    } catch (const NotCertifiedError& error) {
      folds = true;
      return error.what();
    }
  }

  /// Throws: NotCertifiedError.
  void certify(MeshSource source) {
    LoadOptions load;
    load.map.threads = options_.threads;
    mapped_mesh(std::move(source), load);
  }

  void conclude(const RepairTrial& trial) {
    const auto is_certified = [](const SurveyedWay& way) { return way.certified; };
    const auto is_unasked = [](const SurveyedWay& way) { return way.options == unasked_way; };
    const auto unasked = std::find_if(mesh_.ways.begin(), mesh_.ways.end(), is_unasked);
    if (unasked != mesh_.ways.end() && unasked->certified) {
      mesh_.end = SurveyEnd::MapsMended;
    } else if (std::any_of(mesh_.ways.begin(), mesh_.ways.end(), is_certified)) {
      mesh_.end = SurveyEnd::MapsIfAsked;
    } else {
      mesh_.end = trial.can_mend() ? SurveyEnd::NotCertified : SurveyEnd::CannotMap;
    }
  }

  void draw_defects(const MeshSource& source, const RepairTrial& trial) {
    if (options_.picture_size == 0) return;
    DefectPicture picture = picture_of_defects(source, trial.handles, options_);
    from_ = picture.from;
    std::string caption = "red: defects";
    if (!trial.handles.empty()) caption += " and loops about handles";
    if (source.inspection.components > 1) caption += "; orange: components beside the largest";
    if (!picture.png.empty()) mesh_.pictures.push_back({caption, std::move(picture.png)});
  }

  void draw_mended(const MeshFile& file, const std::string& options) {
    if (options_.picture_size == 0) return;
    std::string png = picture_of_mended(file, from_, options_);
    const std::string caption = "after " + options + "; red lines: about what was closed";
    if (!png.empty()) mesh_.pictures.push_back({caption, std::move(png)});
  }

  void end(SurveyEnd how, const std::string& why) {
    mesh_.end = how;
    mesh_.reasons = {why};
    if (how != SurveyEnd::Stopped) return;
    mesh_.repairs.clear();  // half of what there is to know
    mesh_.ways.clear();
  }

  /// Messages name the file as the page does, wherever the folder lies.
  std::string by_name(std::string text) const {
    for (std::size_t at = 0; (at = text.find(path_, at)) != std::string::npos;
         at += mesh_.name.size())
      text.replace(at, path_.size(), mesh_.name);
    return text;
  }

  std::string path_;
  const SurveyOptions& options_;
  SurveyedMesh mesh_;
  std::optional<Vector3> from_;  // where pictures are seen from
};

}  // namespace

SurveyedMesh survey_mesh(const std::string& folder, const std::string& name,
                         const SurveyOptions& options) {
  return Surveyor(folder, name, options).run();
}

}  // namespace sphparam
