#include "cli/repairing.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <new>
#include <string_view>
#include <utility>

#include "cli/command.h"
#include "cli/file_numbers.h"
#include "cli/paths.h"
#include "cli/wording.h"
#include "mesh_io/repaired_file.h"

// The library names elements of the mesh it was given; people know the numbers of the file, which
// welding and dropping vertices have changed.

namespace sphparam::tools {

namespace {

std::vector<RepairAction> by_file_numbers(std::vector<RepairAction> actions, const Source& source) {
  const FileNumbers numbers(source.file);
  for (RepairAction& action : actions) {
    if (place_of(action.kind) != RepairPlace::Faces) {
      for (int& vertex : action.elements) {
        if (vertex >= 0) vertex = static_cast<int>(numbers.number(vertex));
      }
      action.message = describe(action);
    }
    const bool made_by_welding = action.kind == RepairKind::InvalidFaceRemoved ||
                                 action.kind == RepairKind::DuplicateFaceRemoved;
    if (source.welded && made_by_welding) action.message = "after welding, " + action.message;
  }
  return actions;
}

KeptParts by_file_numbers(KeptParts parts, const Source& source) {
  const FileNumbers numbers(source.file);
  for (SurfacePart& part : parts.largest) {
    if (part.vertex >= 0) part.vertex = static_cast<Vertex>(numbers.number(part.vertex));
  }
  return parts;
}

std::vector<MeshDefect> fatal_ones(const MeshInspection& inspection) {
  std::vector<MeshDefect> fatal;
  for (const MeshDefect& defect : inspection.defects) {
    if (defect.fatal) fatal.push_back(defect);
  }
  return fatal;
}

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

Source with_repairs(Source source, RepairedMesh mended) {
  source.repairs = by_file_numbers(mended.actions, source);
  source.parts = by_file_numbers(mended.parts, source);
  source.file = repaired_file(source.file, mended);
  source.inspection = std::move(mended.inspection);
  source.topology = Topology::try_build(source.file.mesh.triangles,
                                        static_cast<int>(source.file.mesh.vertex_count()));
  return source;
}

/// Whether repair would help; nothing where there is no memory to find out.
std::string advice_for(const Source& source) {
  try {
    return words_of(try_repair(source), source.path);
  } catch (const std::bad_alloc&) {
    return "";
  }
}

}  // namespace

MeshRefusal::MeshRefusal(const Source& source, std::string advice)
    : MeshError(source.inspection.defects), advice_(std::move(advice)) {}

Source repaired(Source source, const RepairOptions& options) try {
  RepairedMesh mended = repair_mesh(source.file.mesh, options);
  if (mended.inspection.is_sphere()) return with_repairs(std::move(source), std::move(mended));
  // Components are numbered as they are in the mesh that was given.
  std::string advice = advice_for(source);
  source = with_repairs(std::move(source), std::move(mended));
  if (!source.repairs.empty()) advice += "  Done already:\n" + message_lines(source.repairs);
  throw MeshRefusal(source, std::move(advice));
} catch (const NoSuchComponent& error) {
  throw UsageMistake(std::string("--component: ") + error.what());
}

RepairTrial try_repair(const Source& source) {
  RepairOptions options;
  KeptParts parts;
  for (;;) {
    const RepairedMesh mended = repair_mesh(source.file.mesh, options);
    const bool choose = mended.parts.refused;
    if (options.component == 0) parts = mended.parts;
    if (!mended.inspection.is_sphere() && (choose || mended.largest_hole_left > 0)) {
      if (choose) {
        options.component = 1;
      } else {
        options.largest_hole = static_cast<int>(mended.largest_hole_left);
      }
      continue;
    }
    std::string further = options.component > 0 ? " --component 1" : "";
    if (options.largest_hole != RepairOptions{}.largest_hole) {
      further += " --max-hole " + std::to_string(options.largest_hole);
    }
    return {std::move(further), by_file_numbers(mended.actions, source),
            fatal_ones(mended.inspection), by_file_numbers(std::move(parts), source)};
  }
}

std::string words_of(const RepairTrial& trial, const std::string& path) {
  const std::string choice = choice_lines(trial.parts);
  if (!trial.can_mend()) {
    return choice + "  --repair" + trial.further + " cannot mend it. This would remain:\n" +
           message_lines(trial.remaining);
  }
  return choice + "  --repair" + trial.further + " would mend it, as in `sphparam map " +
         quoted(path) + " --repair" + trial.further + " -o mended.sph.ply`:\n" +
         message_lines(trial.actions) +
         (trial.parts.refused || trial.parts.count == 0 ? ""
                                                        : "    " + line_of(trial.parts) + "\n");
}

std::string line_of(const KeptParts& parts) {
  if (parts.count == 0 || parts.refused) return "";
  return "kept " + percent(parts.area_share, 5) + " of the area and " +
         percent(parts.face_share, 5) + " of the faces, lost " + percent(1 - parts.area_share, 2) +
         " and " + percent(1 - parts.face_share, 2);
}

void require_mappable(const Source& source) {
  if (source.inspection.is_sphere()) return;
  throw MeshRefusal(source, advice_for(source));
}

}  // namespace sphparam::tools
