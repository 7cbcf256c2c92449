#include "sphparam/io/repair_advice.h"

#include <algorithm>
#include <cmath>

#include "io/attributes/appearance.h"
#include "io/shell_word.h"
#include "mesh/repair/repair_kinds.h"
#include "number_text.h"
#include "sphparam/io/mesh_refusal.h"
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

/// What maps each component; empty: nothing does. `in_map`: what is typed is `map`, which alone
/// takes --all-components.
std::string all_parts_line(const std::optional<PartsTrial>& parts, const std::string& mesh,
                           bool in_map) {
  if (parts && !parts->are_enough()) return "";
  const std::string options =
      parts && !parts->as_they_are ? all_components_line(parts->options) : "--all-components";
  const std::string typed = "`sphparam map " + mesh + " " + options + " -o parts.sph.ply`";
  const bool all = !parts || parts->mended == parts->parts;
  const std::string what =
      all ? "each" : "all but " + counted(parts->parts - parts->mended, "speck") + ", each";
  return "  " + (in_map ? options : typed) + " maps " + what + " into a file of its own.\n";
}

/// Why --repair alone leaves all components, and how to choose.
std::string choice_lines(const RepairTrial& trial, const std::string& path, bool in_map,
                         const std::optional<PartsTrial>& tried) {
  const KeptParts& parts = trial.parts;
  if (!parts.refused) return "";
  const std::string all_parts = all_parts_line(tried, shell_file(path), in_map);
  return "  --repair keeps one of " + std::to_string(parts.count) +
         " components, and drops no more than specks unasked. By area, before holes are closed:\n" +
         part_lines(parts) + "  --component N keeps the N-th, --min-kept " + reached_share(parts) +
         " the largest" + (all_parts.empty() ? ".\n" : ", and\n") + all_parts;
}

std::string wrap_line(const RepairTrial& trial, const std::string& path) {
  if (!wrap_keeps_more(trial)) return "";
  return "  `sphparam wrap " + shell_file(path) +
         " -o wrapped.ply` draws one closed surface about all of it.\n";
}

}  // namespace

std::string all_components_line(const RepairOptions& options) {
  return options_line(options).insert(std::string("--repair").size(), " --all-components");
}

std::optional<double> kept_share(const RepairTrial& trial) {
  const KeptParts& parts = trial.parts;
  if (!parts.refused)
    return parts.count > 0 && parts.area_share < 1 ? std::optional(parts.area_share) : std::nullopt;
  const auto chosen = static_cast<size_t>(trial.options.component);
  if (chosen < 1 || chosen > parts.largest.size()) return std::nullopt;
  return parts.largest[chosen - 1].area_share;
}

bool wrap_keeps_more(const RepairTrial& trial) {
  if (trial.can_mend()) return trial.parts.refused;
  const auto has_no_triangles = [](const MeshDefect& left) {
    return left.kind == DefectKind::Empty || left.kind == DefectKind::IndexOutOfRange;
  };
  return std::none_of(trial.remaining.begin(), trial.remaining.end(), has_no_triangles);
}

std::string repair_advice(const RepairTrial& trial, const std::string& path,
                          const std::string& command, const std::optional<PartsTrial>& parts) {
  const bool in_map = command.empty() || command.starts_with("sphparam map ");
  const std::string choice = choice_lines(trial, path, in_map, parts),
                    options = options_line(trial.options), wrap = wrap_line(trial, path);
  if (!trial.can_mend()) {
    return choice + "  " + options + " cannot mend it. This would remain:\n" +
           message_lines(trial.remaining) + wrap;
  }
  const std::string kept = kept_line(trial.parts, trial.actions);
  const std::optional<double> share =
      trial.parts.refused ? kept_share(trial) : std::optional<double>();
  const bool fills = count_of(trial.actions, RepairKind::HoleFilled) > 0;
  const std::string plain =
      "sphparam map " + shell_file(path) + " " + options + " -o mended.sph.ply";
  return choice + wrap + "  " + options + " would mend it, as in `" +
         (command.empty() ? plain : command) + "`:\n" +
         (share ? "    it keeps " + percent(*share) + " of the area\n" : "") +
         message_lines(trial.actions) + handle_lines(trial.handles, "      ") +
         (kept.empty() ? "" : "    " + kept + "\n") +
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
  const auto* const of_parts = dynamic_cast<const PartsRefusal*>(&refusal);
  const std::optional<PartsTrial> parts =
      of_parts ? std::optional(of_parts->parts()) : std::nullopt;
  std::string advice =
      refusal.trial() ? repair_advice(*refusal.trial(), refusal.path(), command, parts) : "";
  if (!refusal.done().empty()) advice += "  Done already:\n" + message_lines(refusal.done());
  return advice;
}

}  // namespace sphparam
