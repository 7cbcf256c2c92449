#pragma once

#include "sphparam/mesh/triangle_mesh.h"
#include "sphparam/progress.h"

namespace sphparam {

/// A closed surface of genus 0 with about so many triangles: edges are collapsed, those first that
/// change the shape least, until no more than that are left, or no edge can go without turning a
/// triangle over or making a needle of it.
///
/// A collapse is taken only where the two ends have no more than two neighbours in common (the link
/// condition; Dey, Edelsbrunner, Guha and Nekhayev, "Topology preserving edge contraction", 1999),
/// so that the result is such a surface too; it may pass through itself where the surface does not.
/// Source: quadrics of Garland and Heckbert, "Surface simplification using quadric error metrics",
/// 1997; with a little of the distance from the vertices that went, which spreads vertices evenly
/// where the surface is flat.
/// Requires: a closed manifold of genus 0. Ensures: `require_sphere` takes it.
/// Throws: Cancelled. Cost: O(#F log #F), about 3 µs a triangle, one thread.
TriangleMesh simplified(TriangleMesh sphere, long triangles, const Progress& progress = {});

}  // namespace sphparam
