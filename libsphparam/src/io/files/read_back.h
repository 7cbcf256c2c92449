#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/sphere/certificate.h"

namespace sphparam {

// What is claimed of a file is claimed of its bytes: they are read back before they get their name.

/// What we wrote may be larger than what strangers may send.
inline constexpr ReadOptions own_file = {
    .max_file_bytes = std::numeric_limits<std::uint64_t>::max(),
    .max_line_bytes = std::numeric_limits<std::int64_t>::max(),
    .max_ply_properties = std::numeric_limits<std::int64_t>::max()};

/// To prove a written map, the map is enough.
inline constexpr ReadOptions own_map = [] {
  ReadOptions options = own_file;
  options.only_map = true;
  return options;
}();

/// What was written, as it is read; where its format gives each triangle corners of its own, with
/// the numbers that vertices had.
struct ReadBack {
  MeshFile file;
  Eigen::Index joined = 0;  // vertices that lie in the place of others there, which are one then
  bool renumbered = false;
};

/// Throws: ReadError; WriteError where there are other triangles.
ReadBack read_back(std::string_view bytes, const std::string& path, const MeshFile& written,
                   const ReadOptions& options = own_file);

/// What `losses_of_writing` tells, and what corners of each triangle's own do not tell.
std::vector<std::string> losses_of_read_back(const MeshFile& written, const ReadBack& read);

/// The certificate of a map on the faces that were read back. `written` saves building their
/// topology anew where they are the faces that were to be written. Throws: as `Topology`.
Certificate certify_read_back(const MeshFile& file, const SphereMap& map, const Topology& written,
                              int threads = 0);

}  // namespace sphparam
