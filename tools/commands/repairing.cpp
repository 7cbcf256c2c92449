#include "commands/repairing.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

#include "reports/wording.h"

namespace sphparam::cli {

namespace {

template <class Items>
std::string message_lines(const Items& items) {
  std::string lines;
  for (const auto& item : items) lines += "    " + item.message + "\n";
  return lines;
}

std::string percent(double share, int digits) { return short_number(100 * share, digits) + " %"; }

/// "    2: 6.1 % of the area, 7 % of the faces (1203), with vertex 410"
std::string part_lines(const KeptParts& parts) {
  std::string lines;
  for (size_t i = 0; i < parts.largest.size(); ++i) {
    const SurfacePart& part = parts.largest[i];
    lines += "    " + std::to_string(i + 1) + ": " + percent(part.area_share, 3) +
             " of the area, " + percent(part.face_share, 3) + " of the faces (" +
             std::to_string(part.faces) + "), with vertex " + std::to_string(part.vertex) + "\n";
  }
  return lines + (parts.count > std::ssize(parts.largest) ? "    …\n" : "");
}

/// A share that the largest part reaches, with two decimals.
std::string reached_share(const KeptParts& parts) {
  return short_number(std::floor(100 * parts.largest.front().area_share) / 100);
}

/// Why --repair alone leaves all components, and how to choose.
std::string choice_lines(const KeptParts& parts) {
  if (!parts.refused) return "";
  return "  --repair keeps one of " + std::to_string(parts.count) +
         " components, and drops no more than specks unasked. By area:\n" + part_lines(parts) +
         "  --component N keeps the N-th, --min-kept " + reached_share(parts) + " the largest.\n";
}

/// A name as a shell takes it.
std::string quoted(const std::string& path) {
  constexpr std::string_view harmless = "._-/+:@%,=";
  const auto plain = [&](unsigned char c) {
    return std::isalnum(c) || c >= 0x80 || harmless.find(static_cast<char>(c)) < harmless.size();
  };
  if (std::all_of(path.begin(), path.end(), plain)) return path;
  std::string result = "'";
  for (const char c : path) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

}  // namespace

std::string further_options(const RepairOptions& options) {
  std::string further =
      options.component > 0 ? " --component " + std::to_string(options.component) : "";
  if (options.largest_hole != RepairOptions{}.largest_hole) {
    further += " --max-hole " + std::to_string(options.largest_hole);
  }
  return further;
}

std::string words_of(const RepairTrial& trial, const std::string& path) {
  const std::string choice = choice_lines(trial.parts);
  const std::string further = further_options(trial.options);
  if (!trial.can_mend()) {
    return choice + "  --repair" + further + " cannot mend it. This would remain:\n" +
           message_lines(trial.remaining);
  }
  return choice + "  --repair" + further + " would mend it, as in `sphparam map " + quoted(path) +
         " --repair" + further + " -o mended.sph.ply`:\n" + message_lines(trial.actions) +
         (trial.parts.refused || trial.parts.count == 0 ? ""
                                                        : "    " + line_of(trial.parts) + "\n");
}

std::string line_of(const KeptParts& parts) {
  if (parts.count == 0 || parts.refused) return "";
  return "kept " + percent(parts.area_share, 5) + " of the area and " +
         percent(parts.face_share, 5) + " of the faces, lost " + percent(1 - parts.area_share, 2) +
         " and " + percent(1 - parts.face_share, 2);
}

std::string advice_of(const MeshRefusal& refusal) {
  std::string advice = refusal.trial() ? words_of(*refusal.trial(), refusal.path()) : "";
  if (!refusal.done().empty()) advice += "  Done already:\n" + message_lines(refusal.done());
  return advice;
}

}  // namespace sphparam::cli
