#pragma once

#include <string>
#include <string_view>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

/// True when XML starts with the root element or the document type of GIFTI.
bool looks_like_gifti(std::string_view bytes);

/// Reads a GIFTI surface: the one array of NIFTI_INTENT_POINTSET and the one of
/// NIFTI_INTENT_TRIANGLE.
///
/// Arrays of one number a vertex (shape, labels, time series, …) become vertex properties with the
/// name in their metadata, the label table comments (gifti_labels.h). Coordinates are taken as
/// written: transforms other than the identity are told, not applied. Anatomical structure and
/// geometric type become comments "gifti KEY VALUE"; `serialise_gifti` writes all these back.
/// Comments of our own (sphparam KEY VALUE) come back as such. Arrays that are not one number a
/// vertex are told as not carried.
/// Refused: data in other files, dimensions that the data cannot hold, unknown types.
/// Throws: ReadError with the line.
MeshFile read_gifti(std::string_view bytes, const std::string& name,
                    const ReadOptions& options = {});

}  // namespace sphparam
