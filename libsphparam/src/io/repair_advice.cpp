#include "sphparam/io/repair_advice.h"

#include <algorithm>
#include <cmath>

#include "io/attributes/appearance.h"
#include "io/shell_word.h"
#include "number_text.h"
#include "sphparam/names.h"
#include "sphparam/words.h"

namespace sphparam {

namespace {

template <class Items>
std::string message_lines(const Items& items) {
  std::string lines;
  for (const auto& item : items) lines += "    " + item.message + "\n";
  return lines;
}

/// "    2: 6.1 % of the area, 7 % of the faces (1203), with vertex 410"
std::string part_lines(const KeptParts& parts) {
  std::string lines;
  for (size_t i = 0; i < parts.largest.size(); ++i) {
    const SurfacePart& part = parts.largest[i];
    lines += "    " + std::to_string(i + 1) + ": " + percent(part.area_share) + " of the area, " +
             percent(part.face_share) + " of the faces (" + std::to_string(part.faces) +
             "), with vertex " + std::to_string(part.vertex) + "\n";
  }
  return lines + (parts.count > std::ssize(parts.largest) ? "    …\n" : "");
}

/// A share that the largest part reaches, with two decimals.
std::string reached_share(const KeptParts& parts) {
  return short_number(std::floor(100 * parts.largest.front().area_share) / 100);
}

/// Why --repair alone leaves all components, and how to choose. `in_map`: what is typed is `map`,
/// which alone takes --all-components.
std::string choice_lines(const KeptParts& parts, const std::string& path, bool in_map) {
  if (!parts.refused) return "";
  const std::string mesh = shell_file(path);
  const std::string each =
      in_map ? "--all-components maps"
             : "`sphparam map " + mesh + " --all-components -o parts.sph.ply` maps";
  std::string lines =
      "  --repair keeps one of " + std::to_string(parts.count) +
      " components, and drops no more than specks unasked. By area, before holes are closed:\n" +
      part_lines(parts) + "  --component N keeps the N-th, --min-kept " + reached_share(parts) +
      " the largest, and\n  " + each + " each into a file of its own.\n";
  const bool too_many_to_choose = parts.count > std::ssize(parts.largest);
  if (too_many_to_choose)
    lines += "  `sphparam wrap " + mesh + " -o wrapped.ply` draws one closed surface about all.\n";
  return lines;
}

/// What a component that is chosen because it must be has of all.
std::string share_line(const RepairTrial& trial) {
  const auto chosen = static_cast<size_t>(trial.options.component);
  if (!trial.parts.refused || chosen < 1 || chosen > trial.parts.largest.size()) return "";
  return "    it keeps " + percent(trial.parts.largest[chosen - 1].area_share) + " of the area\n";
}

}  // namespace

std::string repair_advice(const RepairTrial& trial, const std::string& path,
                          const std::string& command) {
  const bool in_map = command.empty() || command.starts_with("sphparam map ");
  const std::string choice = choice_lines(trial.parts, path, in_map),
                    options = options_line(trial.options);
  if (!trial.can_mend()) {
    return choice + "  " + options + " cannot mend it. This would remain:\n" +
           message_lines(trial.remaining);
  }
  const std::string kept = kept_line(trial.parts);
  const auto closes = [](const RepairAction& done) { return done.kind == RepairKind::HoleFilled; };
  const bool fills = std::any_of(trial.actions.begin(), trial.actions.end(), closes);
  const std::string plain =
      "sphparam map " + shell_file(path) + " " + options + " -o mended.sph.ply";
  return choice + "  " + options + " would mend it, as in `" + (command.empty() ? plain : command) +
         "`:\n" + share_line(trial) + message_lines(trial.actions) +
         handle_lines(trial.handles, "      ") + (kept.empty() ? "" : "    " + kept + "\n") +
         (fills ? "  With --keep-holes holes stay holes.\n" : "");
}

std::string added_line(const MeshSource& source) {
  if (!(source.added_share > 0)) return "";
  const bool textured = has_texcoords(source.file),
             coloured = vertex_colours(source.file).has_value();
  const std::string what = textured ? "texture" : "colours";
  return "what was put in is " + percent(source.added_share) + " of the area" +
         (textured || coloured ? ", and has the " + what + " of what is beside it" : "");
}

std::string repair_advice(const MeshRefusal& refusal, const std::string& command) {
  std::string advice =
      refusal.trial() ? repair_advice(*refusal.trial(), refusal.path(), command) : "";
  if (!refusal.done().empty()) advice += "  Done already:\n" + message_lines(refusal.done());
  return advice;
}

}  // namespace sphparam
