#include "commands/surfaces.h"

#include <algorithm>

#include "commands/sources.h"
#include "number_text.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/paths.h"

namespace sphparam::cli {

namespace {

MeshFile told_surface(MeshFile file, const std::string& path, Session& session) {
  for (const std::string& note : file.notes) session.console.detail(note);
  const FillerMarks fillers = fillers_of(file);
  if (fillers.empty()) return file;
  const auto count = std::count(fillers.begin(), fillers.end(), 1);
  session.console.say("  " + display_name(path) + ": " + counted(count, "filler", "fillers") +
                      " left out");
  return without_fillers(file);
}

}  // namespace

MeshFile read_surface(const std::string& path, Session& session, const ReadOptions& options) {
  return told_surface(read_mesh(path, options), path, session);
}

MeshFile read_surface(const std::string& path, const RepairArguments& repair, Session& session) {
  if (!wanted_repairs(repair)) return read_surface(path, session);
  return told_surface(read_mended_as_far(path, repair, session).file, path, session);
}

}  // namespace sphparam::cli
