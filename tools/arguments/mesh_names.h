#pragma once

#include <string>

#include "arguments/words.h"

namespace sphparam::cli {

/// Refuses a name that a mesh cannot be written under, packed by gzip or not. Standard output
/// passes, and no name at all. `what`: "the new mesh"; `more`: other endings that are good too.
/// Throws: UsageMistake.
void require_mesh_name(const std::string& option, const std::string& what, const std::string& path,
                       const Words& more = {});

/// What stands between the columns of a table: a tab in a .tsv, else a comma. Refuses names of what
/// is no such table: .json, .xlsx. Throws: UsageMistake.
char table_separator(const std::string& option, const std::string& path);

}  // namespace sphparam::cli
