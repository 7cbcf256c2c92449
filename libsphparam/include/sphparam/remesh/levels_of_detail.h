#pragma once

#include <optional>
#include <span>
#include <vector>

#include "sphparam/io/mapped_mesh.h"
#include "sphparam/progress.h"
#include "sphparam/remesh/faces_in_space.h"
#include "sphparam/remesh/remesh.h"
#include "sphparam/remesh/sphere_grid.h"
#include "sphparam/remesh/subdivision.h"

namespace sphparam {

struct LevelOptions {
  SampleMode sample = SampleMode::Point;
  VectorX source_areas = {}, grid_areas = {};   // as in RemeshOptions; the latter, of the
                                                // first level
  std::vector<std::string> transfer = {"all"};  // as in RemeshOptions
  /// A subdivision surface is fitted to each level: nested in vertices and directions, as near to
  /// the mesh as each can be. Loop for triangles, Catmull-Clark for quads.
  std::optional<Scheme> subdivision = {};
  bool measure = true;          // `distance` of each level
  bool look_into_space = true;  // `in_space` of each level
  int threads = 0;              // 0: all cores
  Progress progress = {};
};

/// A mesh on one of several grids.
struct LevelOfDetail {
  Remeshed mesh;                           // the control mesh, where a surface is fitted
  std::optional<SubdivisionFit> fit = {};  // with the flat faces compared
  struct Distance {
    double rms = 0, max = 0;
  };
  /// From the source, both ways, of what is seen: of the limit surface, where one is fitted.
  std::optional<Distance> distance = {};
  /// Of flat faces: where a surface is fitted they are not what is seen.
  std::optional<FacesInSpace> in_space = {};
};

/// The same mesh on one grid after another, each sampled from the source itself.
/// Requires: grids as they should come out, finest first by custom; a scheme for the faces of all.
/// Throws: as `remesh` and `fit_subdivision`; UnmeasurableMesh where distances to the source mean
/// nothing, or nothing of its area is left on a grid; Cancelled.
/// Cost: that of `remesh`, some 0.5 s a level to measure, and that of `faces_in_space`.
std::vector<LevelOfDetail> levels_of_detail(const MappedMesh& source,
                                            std::span<const GridSpec> grids,
                                            const LevelOptions& options = {});

/// The same with a first grid that was made before, or is another sphere's.
std::vector<LevelOfDetail> levels_of_detail(const MappedMesh& source, SphereGrid finest,
                                            std::span<const GridSpec> coarser,
                                            const LevelOptions& options = {});

/// The next `count` coarser grids, each with a quarter of the faces: see `coarser_grid`; fewer
/// where there are no more.
std::vector<GridSpec> coarser_grids(const GridSpec& finest, int count);

/// `count` meshes on icosahedra's grids, each with a quarter of the vertices of the one before, the
/// first with a quarter of the mesh's: levels of detail of any mesh, on its sphere, which keep its
/// name and provenance. Fewer where the icosahedron itself, of 12 vertices, is reached. Of
/// `options`: sample, transfer, threads, progress. Throws: as `remesh`; Cancelled. Cost: that of
/// `remesh`.
std::vector<MappedMesh> quartered_meshes(const MappedMesh& source, int count,
                                         const LevelOptions& options = {});

/// How far a level is from the mesh that it was made of, both ways, as `levels_of_detail` measures
/// it: of what is surface. Throws: UnmeasurableMesh where that means nothing; Cancelled.
/// Cost: some 0.5 s.
LevelOfDetail::Distance distance_of_level(const MappedMesh& source, const MappedMesh& level,
                                          int threads = 0, const Progress& progress = {});

/// The finest grid that is looked at: 2,621,442 vertices.
constexpr int finest_sought = 9;

/// A grid of the icosahedron, ico:L, and how far the mesh on it is from its source.
struct GridWithin {
  GridSpec grid = {};
  double most = 0;  // that was wanted
  double max = 0;   // of both ways, as `measure_distance` finds it
  bool holds() const { return max <= most; }
};

/// The coarsest of the grids ico:0, ico:1, … on which the mesh is nowhere farther than `most` from
/// its source, nor its source from it: of what is surface, by flat faces. The finest that is looked
/// at where none holds. Of `options`: sample, threads, progress. Requires: most ≥ 0. Throws:
/// std::invalid_argument if not; as `remesh`; UnmeasurableMesh where distances mean nothing;
/// Cancelled. Cost: a remesh and a quick look a level, and `measure_distance` of the last ones.
GridWithin coarsest_grid_within(const MappedMesh& source, double most,
                                const LevelOptions& options = {});

/// What a level shows and is measured by: of its limit surface, where one is fitted, a fine mesh;
/// else its triangles.
TriangleMesh shown_mesh(const LevelOfDetail& level, int threads = 0);

}  // namespace sphparam
