#include "reports/map_wording.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "console/places.h"
#include "embedding/frame/landmarks.h"
#include "mesh/box.h"
#include "number_text.h"
#include "reports/told_losses.h"
#include "reports/told_repairs.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/up_axis.h"
#include "sphparam/records/map_record.h"
#include "sphparam/words.h"

namespace sphparam::cli {

namespace {

std::string residual_line(const std::string& what, long number, double residual,
                          const std::string& place) {
  if (residual == 0) return "";
  return "  " + what + " " + std::to_string(number) + " is " + short_number(residual) +
         " radians from " + place + "\n";
}

/// Every pin and pole that is not at its point, by its number in the file.
std::string complaint_of_frame(const MapOutcome& outcome) {
  const FileNumbers numbers(outcome.source.file);
  std::string lines;
  for (size_t i = 0; i < std::min(outcome.options.pins.size(), outcome.result.pin_residuals.size());
       ++i) {
    lines += residual_line("pin", numbers.number(outcome.options.pins[i].vertex),
                           outcome.result.pin_residuals[i], "its point");
  }
  const ParameterizeOptions& wanted = outcome.options;
  const std::vector<double>& of_poles = outcome.frame.pole_residuals;
  if (!outcome.frame.poles && !of_poles.empty()) {
    lines += residual_line("pole", numbers.number(wanted.poles->north), of_poles[0], "+z") +
             residual_line("pole", numbers.number(wanted.poles->south), of_poles[1], "-z");
  }
  if (!outcome.frame.meridian) {
    lines +=
        "  vertex " + std::to_string(numbers.number(*wanted.meridian)) + " is not at theta = 0\n";
  }
  return lines;
}

/// "certified one-to-one", or what the map lacks.
std::string verdict_words(const MapOutcome& outcome) {
  if (!outcome.bijective()) return "not one-to-one: " + outcome.verdict();
  std::string missing;
  const auto add = [&](bool holds, const char* what) {
    if (!holds) missing += (missing.empty() ? "" : ", ") + std::string(what);
  };
  add(outcome.frame.pins, "pins are not at their points");
  add(outcome.frame.poles, "the poles are not at ±z");
  add(outcome.frame.meridian, "the meridian is not at theta = 0");
  return missing.empty() ? "certified one-to-one" : "one-to-one, but " + missing;
}

std::string advice(const MapOutcome& outcome, bool written) {
  if (written) return "  written all the same and marked in its header (--keep-folded)";
  const bool ours = outcome.method == AnyMethod(Method::Progressive) ||
                    outcome.method == AnyMethod(Method::Curvilinear);
  const bool as_printed = !ours && !outcome.options.repair_paper;
  return as_printed ? "  --repair-map mends it, --keep-folded writes it as it is"
                    : "  --keep-folded writes it as it is";
}

}  // namespace

void tell_stages(const MapOutcome& outcome, Console& console) {
  tell_losses(outcome.source, console);
  for (const std::string& note : quiet_notes(outcome.source.notes))
    console.detail("  note: " + note);
  tell_repairs(outcome.source, console);
  // What looks wrong on the map is told unasked.
  for (const std::string& warning : shape_warnings(outcome.source)) console.warning(warning);
  for (const MeshDefect& defect : outcome.source.inspection.defects)
    if (defect.kind != DefectKind::InsideOut) console.detail("  note: " + defect.message);
  if (outcome.account) {
    console.say("  " + outcome.account->citation + ": " + outcome.account->statement);
  }
  for (const StageRecord& stage : outcome.result.stages) {
    const bool asked = outcome.method == AnyMethod(Method::Paper);
    asked ? console.say("  " + stage_line(stage)) : console.detail("  " + stage_line(stage));
  }
  if (outcome.result.filler_share) {
    console.say("  fillers: " + percent(*outcome.result.filler_share) + " of the sphere");
  }
  if (const std::optional<BalanceRecord>& balance = outcome.result.balance) {
    console.detail("  balanced at lambda " + short_number(balance->lambda, 6) +
                   ", mean |log2 area ratio| " + short_number(balance->area_error));
  }
  for (const std::string& warning : outcome.result.warnings) console.warning(warning);
}

namespace {

/// Vertices that mending put in have no number in the file.
std::string pole_words(const FileNumbers& numbers, const Poles& poles) {
  const long north = numbers.number(poles.north), south = numbers.number(poles.south);
  if (north >= 0 && south >= 0)
    return "vertices " + std::to_string(north) + " and " + std::to_string(south);
  const auto words = [](long number) {
    return number >= 0 ? "vertex " + std::to_string(number) : "a vertex that closes a hole";
  };
  return words(north) + " and " + words(south);
}

/// Where the poles are: the paper's smoothing may have moved those that its map was built about.
std::string place_of_poles(const Parameterization& result, const Poles& poles) {
  const bool exact = all_exact(pin_residuals(
      result.map, {{poles.north, Vector3::UnitZ()}, {poles.south, -Vector3::UnitZ()}}));
  return exact ? "at ±z" : "near ±z, at the ends of the date line";
}

}  // namespace

void tell_frame(const MapOutcome& outcome, Console& console) {
  const Parameterization& result = outcome.result;
  const bool given = outcome.options.poles || !outcome.options.pins.empty();
  if (!outcome.succeeded() || (!result.poles && outcome.options.pins.empty())) return;
  const FileNumbers numbers(outcome.source.file);
  std::string line = "  ";
  if (result.poles) {
    line += pole_words(numbers, *result.poles) + " " + place_of_poles(result, *result.poles);
  }
  if (!outcome.options.pins.empty()) {
    line += (result.poles ? ", " : "") + std::to_string(outcome.options.pins.size()) + " pinned";
  }
  const double percent = 100 * result.pole_cost;
  if (outcome.method != AnyMethod(Method::Paper) || result.made_anew)  // it has none before
    line += ": " + short_number(std::abs(percent)) + " % " + (percent < 0 ? "less" : "more") +
            " energy than before";
  given ? console.say(line) : console.detail(line);
}

/// What is told of a map may be right and of no use: that of a cow in a truck.
void tell_likeness(const Likeness& likeness, const std::string& other, Console& console) {
  constexpr double doubtful = 0.05;  // of the diagonal
  console.say("  like " + other + ": " + to_text(likeness));
  if (likeness.median > doubtful)
    console.warning("in the same directions, half of the mesh is more than " +
                    percent(likeness.median) + " of the diagonal away from " + other +
                    ": are they of one thing, in the same place?");
}

void tell_directions(const MapOutcome& outcome, Console& console) {
  if (!outcome.has_map()) return;
  if (outcome.likeness) tell_likeness(*outcome.likeness, outcome.other, console);
  if (const auto& radial = outcome.result.radial)
    console.say("  " + radial_line(*radial, longest_side(outcome.source.file.mesh)));
  const UprightAxes axes = upright_axes(outcome.source.file);
  if ((outcome.result.radial || outcome.options.align_to) && axes.up != Vector3::UnitZ())
    console.say("  " + name_of_direction(axes.up) + " points up in the file: it is north");
  const bool inside_out = !shape_warnings(outcome.source).empty();
  if (outcome.result.radial && outcome.result.radial->folds > 0 && inside_out)
    console.say("  the faces point inwards: --repair=orientation turns them");
  if (const auto& angle = outcome.result.alignment) {
    console.say("  turned to the directions it is aligned to: " +
                short_number(*angle * 180 / std::numbers::pi) +
                "° are left (RMS over the surface)");
  }
}

void tell_result(const MapOutcome& outcome, const std::string& written, double seconds,
                 Console& console, const std::string& when) {
  std::string line = display_name(outcome.source.path) + ": " +
                     std::to_string(outcome.source.file.mesh.face_count()) + " triangles, " +
                     verdict_words(outcome);
  if (outcome.has_map()) line += " (" + outcome.result.made_by + ")";
  if (outcome.figures) line += ", " + distortion_line(*outcome.figures);
  line += ", " + short_number(seconds) + " s";
  line += written.empty() ? ", no map written" : " → " + output_name(written) + when;
  if (outcome.succeeded()) return console.say(line);
  if (!outcome.bijective()) {
    line += '\n' + complaint(outcome.result.certificate) + advice(outcome, !written.empty());
  }
  if (!outcome.frame.holds()) {
    line += '\n' + complaint_of_frame(outcome) + "  no map is written without them";
  }
  console.error(line);
}

}  // namespace sphparam::cli
