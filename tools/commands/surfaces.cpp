#include "commands/surfaces.h"

#include <algorithm>

#include "number_text.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/paths.h"

namespace sphparam::cli {

MeshFile read_surface(const std::string& path, Session& session, const ReadOptions& options) {
  MeshFile file = read_mesh(path, options);
  for (const std::string& note : file.notes) session.console.detail(note);
  const FillerMarks fillers = fillers_of(file);
  if (fillers.empty()) return file;
  const auto count = std::count(fillers.begin(), fillers.end(), 1);
  session.console.say("  " + display_name(path) + ": " + counted(count, "filler", "fillers") +
                      " left out");
  return without_fillers(file);
}

}  // namespace sphparam::cli
