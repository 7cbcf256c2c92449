#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sphparam {

/// The path that a URI of a glTF file means, relative to the file's folder.
///
/// Percent signs are decoded first; then schemes, absolute paths, backslashes, control characters
/// and `..` are refused. Throws: std::runtime_error that says why.
std::filesystem::path path_of_uri(std::string_view uri);

/// The bytes of a regular file below `folder`, also after links are followed.
/// Throws: std::runtime_error when it is not there, leads out of the folder, is no regular file or
/// has more than `max_bytes`.
std::vector<unsigned char> read_below(const std::filesystem::path& folder,
                                      const std::filesystem::path& path, std::uint64_t max_bytes);

}  // namespace sphparam
