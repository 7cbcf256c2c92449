#include "cli/repairing.h"

#include <new>
#include <utility>

#include "cli/command.h"
#include "cli/file_numbers.h"
#include "mesh_io/repaired_file.h"

// The library names elements of the mesh it was given; people know the numbers of the file, which
// welding and dropping vertices have changed.

namespace sphparam::tools {

namespace {

std::vector<RepairAction> by_file_numbers(std::vector<RepairAction> actions, const MeshFile& file) {
  const FileNumbers numbers(file);
  for (RepairAction& action : actions) {
    if (place_of(action.kind) == RepairPlace::Faces) continue;
    for (int& vertex : action.elements) {
      if (vertex >= 0) vertex = static_cast<int>(numbers.number(vertex));
    }
    action.message = describe(action);
  }
  return actions;
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

Source with_repairs(Source source, RepairedMesh mended) {
  source.repairs = by_file_numbers(mended.actions, source.file);
  source.file = repaired_file(source.file, mended);
  source.inspection = std::move(mended.inspection);
  source.topology = Topology::try_build(source.file.mesh.triangles,
                                        static_cast<int>(source.file.mesh.vertex_count()));
  return source;
}

/// Whether repair would help; nothing where there is no memory to find out.
std::string advice_for(const Source& source) {
  try {
    return words_of(try_repair(source));
  } catch (const std::bad_alloc&) {
    return "";
  }
}

}  // namespace

MeshRefusal::MeshRefusal(const Source& source, std::string advice)
    : MeshError(source.inspection.defects), advice_(std::move(advice)) {}

Source repaired(Source source, const RepairOptions& options) {
  try {
    return with_repairs(std::move(source), repair_mesh(source.file.mesh, options));
  } catch (const NoSuchComponent& error) {
    throw UsageMistake(std::string("--component: ") + error.what());
  }
}

RepairTrial try_repair(const Source& source) {
  const RepairedMesh mended = repair_mesh(source.file.mesh);
  return {by_file_numbers(mended.actions, source.file), fatal_ones(mended.inspection)};
}

std::string words_of(const RepairTrial& trial) {
  if (trial.mends()) return "  --repair would mend it:\n" + message_lines(trial.actions);
  return "  --repair cannot mend it. This would remain:\n" + message_lines(trial.remaining);
}

void require_mappable(const Source& source) {
  if (source.inspection.is_sphere()) return;
  std::string advice = advice_for(source);
  if (!source.repairs.empty()) advice += "  Done already:\n" + message_lines(source.repairs);
  throw MeshRefusal(source, std::move(advice));
}

}  // namespace sphparam::tools
