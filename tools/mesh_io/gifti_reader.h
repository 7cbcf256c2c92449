#pragma once

#include <string>
#include <string_view>

#include "mesh_io/mesh_file.h"
#include "mesh_io/read_options.h"

namespace sphparam::tools {

/// True when XML starts with the root element or the document type of GIFTI.
bool looks_like_gifti(std::string_view bytes);

/// Reads a GIFTI surface: the one array of NIFTI_INTENT_POINTSET and the one of
/// NIFTI_INTENT_TRIANGLE.
///
/// Arrays of one number a vertex (shape, labels, time series, …) become vertex properties with the
/// name in their metadata. Coordinates are taken as written: coordinate systems are noted, not
/// applied. Anatomical structure and geometric type become comments "gifti KEY VALUE", which
/// `serialise_gifti` writes back; comments of our own (sphparam KEY VALUE) come back as such.
/// Refused: data in other files, dimensions that the data cannot hold, unknown types.
/// Throws: ReadError with the line.
MeshFile read_gifti(std::string_view bytes, const std::string& name,
                    const ReadOptions& options = {});

}  // namespace sphparam::tools
