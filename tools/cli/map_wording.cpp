#include "cli/map_wording.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cli/file_numbers.h"
#include "cli/paths.h"
#include "cli/told_losses.h"
#include "cli/wording.h"
#include "mesh_io/losses.h"

namespace sphparam::tools {

namespace {

/// "harmonic: 0.12 s, 3 folds, angle 0.55 area 0.59"
std::string stage_line(const StageRecord& stage) {
  std::string line = "  " + stage.name + ": " + short_number(stage.seconds) + " s";
  if (stage.planar_folds >= 0) line += ", " + std::to_string(stage.planar_folds) + " planar folds";
  if (stage.folds >= 0) line += ", " + std::to_string(stage.folds) + " folds";
  if (stage.distortion) line += ", " + distortion_line(*stage.distortion);
  return line;
}

/// Every pin that is not at its point, by its number in the file.
std::string complaint_of_pins(const MapOutcome& outcome) {
  if (outcome.pins_hold() || outcome.result.pin_residuals.size() != outcome.pins.size()) return "";
  const FileNumbers numbers(outcome.source.file);
  std::string lines;
  for (size_t i = 0; i < outcome.pins.size(); ++i) {
    const double residual = outcome.result.pin_residuals[i];
    if (residual == 0) continue;
    lines += "  pin " + std::to_string(numbers.number(outcome.pins[i].vertex)) + " is " +
             short_number(residual) + " radians from its point\n";
  }
  return lines;
}

std::string advice(const MapArguments& arguments, bool written) {
  if (written) return "  written all the same and marked in its header (--keep-folded)";
  const bool ours = arguments.method == AnyMethod(Method::Progressive) ||
                    arguments.method == AnyMethod(Method::Curvilinear);
  const bool as_printed = !ours && !arguments.options.repair_paper;
  return as_printed ? "  --repair-map mends it, --keep-folded writes it as it is"
                    : "  --keep-folded writes it as it is";
}

}  // namespace

void tell_stages(const MapArguments& arguments, const MapOutcome& outcome, Console& console) {
  tell_losses(outcome.source, arguments.input, console);
  const std::vector<std::string> told = losses_among(outcome.source.notes);
  for (const std::string& note : outcome.source.notes)
    if (std::find(told.begin(), told.end(), note) == told.end()) console.detail("  note: " + note);
  for (const RepairAction& repair : outcome.source.repairs) console.say("  " + repair.message);
  for (const MeshDefect& defect : outcome.source.inspection.defects) {
    // What looks wrong on the map is told unasked.
    const bool visible = defect.kind == DefectKind::InsideOut;
    visible ? console.warning(defect.message + ": " + defect.hint)
            : console.detail("  note: " + defect.message);
  }
  if (outcome.account) {
    console.say("  " + outcome.account->citation + ": " + outcome.account->statement);
  }
  for (const StageRecord& stage : outcome.result.stages) {
    const bool asked = arguments.method == AnyMethod(Method::Paper);
    asked ? console.say(stage_line(stage)) : console.detail(stage_line(stage));
  }
  for (const std::string& warning : outcome.result.warnings) console.warning(warning);
}

void tell_frame(const MapArguments& arguments, const MapOutcome& outcome, Console& console) {
  const Parameterization& result = outcome.result;
  const bool given = arguments.options.poles || !arguments.pins.empty();
  if (!outcome.succeeded() || (!result.poles && outcome.pins.empty())) return;
  const FileNumbers numbers(outcome.source.file);
  std::string line = "  ";
  if (result.poles) {
    line += "vertices " + std::to_string(numbers.number(result.poles->north)) + " and " +
            std::to_string(numbers.number(result.poles->south)) + " at ±z";
  }
  if (!outcome.pins.empty()) {
    line += (result.poles ? ", " : "") + std::to_string(outcome.pins.size()) + " pinned";
  }
  const double percent = 100 * result.pole_cost;
  line += ": " + short_number(std::abs(percent)) + " % " + (percent < 0 ? "less" : "more") +
          " energy than before";
  given ? console.say(line) : console.detail(line);
}

void tell_result(const MapArguments& arguments, const MapOutcome& outcome, bool written,
                 const Stopwatch& stopwatch, Console& console) {
  const bool certified = outcome.certificate.bijective();
  std::string line = display_name(arguments.input) + ": " +
                     std::to_string(outcome.source.file.mesh.face_count()) + " triangles, " +
                     (!certified            ? "not one-to-one: " + outcome.verdict()
                      : outcome.pins_hold() ? "certified one-to-one"
                                            : "one-to-one, but pins are not at their points");
  if (outcome.has_map()) line += " (" + outcome.result.made_by + ")";
  if (outcome.figures) line += ", " + distortion_line(*outcome.figures);
  line += ", " + short_number(stopwatch.seconds()) + " s";
  line += written ? " → " + output_name(arguments.output) : ", no map written";
  console.say(line);
  if (!certified) console.say(complaint(outcome.certificate) + advice(arguments, written));
  if (!outcome.pins_hold())
    console.say(complaint_of_pins(outcome) + "  no map is written without them");
}

}  // namespace sphparam::tools
