#pragma once

#include <optional>
#include <string>

#include "arguments/declaration.h"
#include "sphparam/io/brain_names.h"

namespace sphparam::cli {

/// --names and --subject: files named as a field names them, in a folder.
struct Naming {
  std::optional<NamePattern> pattern;
  std::string subject;  // empty: as the mesh's name says
};

void declare_naming(Declaration& command, Naming& naming, const std::string& option);

/// The path of a surface below `folder`, which an option named. The mesh's name says of whom and
/// which hemisphere it is, or the sphere's. `what`: empty: what the mesh's name says. `grid`: of
/// --grid; empty: the mesh's own vertices.
/// Throws: UsageMistake where --names needs a folder, or where nothing says the hemisphere.
std::string named_surface(const Naming& naming, const std::string& folder,
                          const std::string& option, const std::string& mesh,
                          const std::string& sphere, const std::string& what,
                          const std::string& grid);

}  // namespace sphparam::cli
