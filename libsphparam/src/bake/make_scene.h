#pragma once

#include <string>

#include "bake/bake_scene.h"
#include "sphparam/progress.h"
#include "texture/read_textures.h"

namespace sphparam {

/// The chart of a mesh with what bakes need on it: where an exporter refines the triangles at the
/// poles, or a mesh has hard edges, images must be baked for that very chart.
/// `pole_wedges`: as `refine_poles` takes them. Progress is told of the chart.
/// Requires: a certified map. Throws: std::invalid_argument as `refine_poles` does; Cancelled.
/// Cost: that of `spherical_chart`.
BakeTarget make_target(const MeshFile& file, const Topology& topology, const SphereMap& map,
                       bool is_source, int threads, int pole_wedges = 1,
                       const Progress& progress = {});

/// The same of a mesh that knows its topology and its map.
BakeTarget make_target(const MappedMesh& mapped, bool is_source, int threads, int pole_wedges = 1,
                       const Progress& progress = {});

/// The mesh with its own normals and no textures, to bake of.
BakeSource make_source(const MappedMesh& mapped);

/// The same of a surface without a map. Throws: FieldError where it has no triangles.
BakeSource make_source(MeshFile surface);

}  // namespace sphparam
