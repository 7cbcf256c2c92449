#pragma once

#include <string>
#include <vector>

#include "sphparam/io/vertex_data.h"

namespace sphparam {

// The geometry of the volume that a surface of FreeSurfer was made of: eight lines in the footer of
// its own files, metadata of the coordinates in GIFTI, as mris_convert names them ("VolGeomWidth",
// …, "VolGeomC_S", "VolGeomFname"); in between comments (freesurfer_comments.h). Numbers pass as
// they are written.

/// The metadata that says what the comments say; none where they have no valid geometry.
Metadata gifti_geometry(const std::vector<std::string>& comments);

/// The comments that say what the metadata says, in the order of the footer; none where a number is
/// missing or is none. Without a name the volume is "unknown".
std::vector<std::string> freesurfer_geometry_of(const Metadata& metadata);

/// Whether it is one of these keys.
bool is_gifti_geometry(const std::string& key);

}  // namespace sphparam
