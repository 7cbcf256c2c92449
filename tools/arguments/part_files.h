#pragma once

#include <functional>
#include <string>
#include <vector>

#include "console/session.h"

namespace sphparam::cli {

/// The numbers of the files that `map --all-components -o PATH` has written, in order.
/// Throws: UsageMistake where there is none, or for a stream.
std::vector<int> numbers_of_parts(const std::string& path);

/// The file of a part where there is one, else the path as it is: what all parts share.
std::string file_for_part(const std::string& path, int part);

/// Calls `run` with the number of each part, 0 alone where it is not of parts; what it returns is
/// what --json says, of parts as a list.
void report_each(bool of_parts, const std::string& input, Session& session,
                 const std::function<std::string(int part)>& run);

}  // namespace sphparam::cli
