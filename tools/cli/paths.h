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

/// Throws UsageMistake when two outputs are one place, however spelled. A device, as /dev/null, may
/// be named twice.
void require_distinct(const Outputs& outputs);

/// Throws UsageMistake when an output would replace the input, also through links: a slip of the
/// hand must not cost anybody their mesh. `option` names the output.
void require_not_input(const std::string& input, const std::string& output,
                       const std::string& option);

}  // namespace sphparam::tools
