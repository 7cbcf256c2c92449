#pragma once

#include <vector>

#include "sphparam/io/polygons.h"
#include "sphparam/mesh/fillers.h"
#include "sphparam/mesh/topology.h"

namespace sphparam {

/// For each face the hole that it closes, from 0, or −1: fillers that share an edge close one hole.
/// Requires: a mark a face. Cost: near linear.
std::vector<int> holes_of(const Topology& topology, const FillerMarks& fillers);

/// Which triangles of a grid are fillers, where `holes` says of each which hole it lies on, or −1:
/// each hole one piece, the surface one piece, and no vertex between two fans of fillers. Where a
/// boundary runs through triangles it leaves specks of both and pieces that touch; these go to the
/// side that they lie in. Requires: the grid is closed; its triangles are those of `cut`, and those
/// of a polygon lie on one hole. Ensures: those of a polygon are fillers all or none; some surface,
/// if there was any. Cost: a few passes. Our own.
FillerMarks tidy_fillers(const Topology& grid, const Triangulation& cut,
                         const std::vector<int>& holes);

}  // namespace sphparam
