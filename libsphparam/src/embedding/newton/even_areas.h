#pragma once

#include <vector>

#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/progress.h"

namespace sphparam {

struct EvenAreasOptions {
  double area_error = 0.1;          // mean |log2 area ratio| that is good enough; ≥ 0
  std::vector<Vertex> pinned = {};  // stay where they are
  int threads = 0;                  // 0: all cores
  Progress progress = {};
};

struct EvenedMap {
  SphereMap map;
  int steps;
};

/// Makes solid angles Ω of image triangles equal to the areas A of the source, by Gauss–Newton
/// steps on Σ A (ln Ω/A)². A step is the one that reaches the wanted areas, or comes near, with the
/// least deformation of triangles, each by its source's area. Determinants, which are what the
/// energy knows of areas, shrink again in triangles of more than about a quarter of the sphere:
/// `optimise_balance` comes here where it fails on meshes of a few of these.
///
/// Ensures: no triangle folds, the sphere is covered once, pinned vertices keep their bits; what is
/// minimised does not rise; same bits for any number of threads. It ends where areas are good
/// enough, or where steps gain next to nothing.
/// Requires: a bijective map. Cost: one sparse factorisation of two unknowns a vertex a step, as a
/// rule some tens of steps. Source: our own; Levenberg and Marquardt for the steps.
EvenedMap even_areas(const Topology& topology, const RestTriangles& source, SphereMap map,
                     const EvenAreasOptions& options = {});

}  // namespace sphparam
