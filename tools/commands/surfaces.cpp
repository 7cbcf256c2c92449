#include "commands/surfaces.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "commands/sources.h"
#include "number_text.h"
#include "sphparam/io/coarse_coordinates.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/paths.h"

namespace sphparam::cli {

namespace {

MeshFile told_surface(MeshFile file, const std::string& path, Session& session,
                      std::optional<TriangleMesh>* with_fillers = nullptr) {
  for (const std::string& coarse : coarse_coordinates_among(file.notes))
    session.console.warning(display_name(path) + ": " + coarse);
  for (const std::string& note : file.notes) session.console.detail(note);
  const FillerMarks fillers = fillers_of(file);
  if (fillers.empty()) return file;
  const auto count = std::count(fillers.begin(), fillers.end(), 1);
  session.console.say("  " + display_name(path) + ": " + counted(count, "filler", "fillers") +
                      " left out");
  if (with_fillers) *with_fillers = file.mesh;
  return without_fillers(file);
}

/// What repairs left of a mesh that no map takes: here it is a surface all the same.
void tell_left(const MeshSource& source, Session& session) {
  std::vector<std::string> left;
  for (const MeshDefect& defect : source.inspection.defects)
    if (defect.fatal) left.push_back(defect.message);
  if (left.empty()) return;
  const std::string how = source.repairs.empty() ? ": not mended, and taken as it is: "
                                                 : ": mended no farther than that, and taken so: ";
  session.console.say("  " + display_name(source.path) + how + joined(left, "; "));
}

}  // namespace

MeshFile read_surface(const std::string& path, Session& session, const ReadOptions& options) {
  return told_surface(read_mesh(path, options), path, session);
}

MeshFile read_surface(const std::string& path, const RepairArguments& repair, Session& session,
                      std::optional<TriangleMesh>* with_fillers) {
  if (!wanted_repairs(repair))
    return told_surface(read_mesh(path, input_limits()), path, session, with_fillers);
  MeshSource source = read_mended_as_far(path, repair, session);
  tell_left(source, session);
  return told_surface(std::move(source.file), path, session, with_fillers);
}

}  // namespace sphparam::cli
