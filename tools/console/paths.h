#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sphparam/io/paths.h"

namespace sphparam::cli {

/// Do two paths, however spelled, name one place? Not where one of them is empty.
bool is_same_place(const std::string& one, const std::string& other);

/// What is written where: option and path; empty paths are not written.
using Outputs = std::vector<std::pair<std::string, std::string>>;

/// Looks at what will be written before any work is done for it. Empty paths are not looked at.
/// Throws: UsageMistake when an output would replace an input, also through links (a slip of the
/// hand must not cost anybody their mesh), or when two outputs are one place, however spelled (a
/// device, as /dev/null, may be named twice); WriteError when an output cannot be written: no
/// folder, a folder's name, no permission. `new_folder`: one that will be made for the outputs in
/// it.
void check_places(const std::vector<std::string>& inputs, const Outputs& outputs,
                  const std::string& new_folder = "");

}  // namespace sphparam::cli
