#pragma once

#include <string>
#include <utility>
#include <vector>

namespace sphparam::tools {

/// Is this path the name of standard input or output?
inline bool is_stream(const std::string& path) { return path == "-"; }

/// A file as people want to see it: no folders; "-" becomes "standard input".
std::string display_name(const std::string& path);

/// The same for a file that is written.
std::string output_name(const std::string& path);

/// "statue" of "folder/statue.ply" and of "folder/statue.sph.ply".
std::string stem_of(const std::string& path);

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

}  // namespace sphparam::tools
