#pragma once

#include <string>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

struct GiftiOptions {
  /// Metadata of the coordinates; what the comments "gifti KEY VALUE" say, where empty.
  std::string geometric_type = {};        // "Anatomical"; "Spherical": in no space but its own
  std::string anatomical_structure = {};  // "CortexLeft", …; "Other" where nobody says
  std::string secondary_structure = {};   // "GrayWhite", "Pial", "MidThickness"
};

/// A GIFTI surface: coordinates, triangles as INT32, comments of our own as metadata, those of
/// labels (gifti_labels.h) as the label table.
///
/// Coordinates are rounded to FLOAT32: the Connectome Workbench opens no file of others. A map goes
/// through `round_to_float` first, whose certificate then holds for the file. Properties have no
/// place in it.
/// Throws: WriteError when libgiftiio fails, or where coordinates are beyond the range of
/// float32; UnmeasurableMesh where all of those that it does not hold are too near. Safe to call
/// from several threads.
std::string serialise_gifti(const MeshFile& file, const GiftiOptions& options = {});

}  // namespace sphparam
