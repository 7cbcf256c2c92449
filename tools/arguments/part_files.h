#pragma once

#include <functional>
#include <string>
#include <vector>

#include "console/session.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam::cli {

// Each file of `map --all-components` says "2 of 3 of MARK" in its provenance: files of other runs
// that lie beside it under the same name are told from it so.

inline constexpr char component_key[] = "component";

/// What tells the parts of a mesh from those of another: 16 digits of its places and triangles.
std::string mark_of(const TriangleMesh& mesh);

/// "2 of 3 of 0123456789abcdef"
std::string component_words(std::size_t number, std::size_t count, const std::string& mark);

/// The numbers of the files that are so named, in order; none for a stream.
std::vector<int> parts_on_disk(const std::string& path);

/// The numbers of the files that `map --all-components -o PATH` has written, in order; those that
/// are missing between them are told. Throws: UsageMistake where there is none, for a stream, or
/// where they are not of one run.
std::vector<int> numbers_of_parts(const std::string& path, Console& console);

/// The file of a part where there is one, else the path as it is: what all parts share.
std::string file_for_part(const std::string& path, int part);

/// Calls `run` with the number of each part, 0 alone where it is not of parts; what it returns is
/// what --json says, of parts as a list.
void report_each(const std::string& command, bool of_parts, const std::string& input,
                 Session& session, const std::function<std::string(int part)>& run);

/// What --json of a subcommand says of parts: their reports, with commas between them.
std::string report_of_parts(const std::string& command, const std::string& reports);

}  // namespace sphparam::cli
