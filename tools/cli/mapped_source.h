#pragma once

#include <string>

#include "cli/console.h"
#include "cli/source.h"
#include "mesh_io/sphere_file.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam::tools {

/// A mesh with a map of it that may be relied on, as bake, remesh and export take it.
struct MappedSource {
  Source source;
  SphereMap map;          // unit rays, certified one-to-one as they are here
  Provenance provenance;  // of the file, or of the map that was made here
  bool mapped_here = false;
};

/// Rays as they are where all have unit length up to rounding, so that a map stays itself; else
/// each divided by its length.
SphereMap unit_rays(SphereMap map);

/// Reads a mesh and its map: from the file `sphere`, of the same connectivity, where one is named
/// (sx sy sz, or the vertices of a bare sphere about the origin); else sx sy sz of the mesh file
/// itself; else a map is made now, with the λ given, and said so.
/// Throws: ReadError, also where the two are not one connectivity; MeshRefusal for what is no
/// closed genus-0 mesh; NotCertifiedError where the map is not one-to-one; Cancelled.
MappedSource read_mapped_source(const std::string& path, const std::string& sphere, int threads,
                                Console& console, double lambda = 1);

}  // namespace sphparam::tools
