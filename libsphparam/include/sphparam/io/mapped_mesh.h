#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/io/polygons.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/mesh/fillers.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/parameterize.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/sphere/sphere_locator.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

struct SphericalChart;

/// A mesh with a map of it onto the unit sphere that is proved one-to-one: what all uses of maps
/// begin with.
///
/// A value that never changes: copies share one state and cost nothing; whatever is derived from
/// the mesh or its map is made once. Threads may share it.
class MappedMesh {
 public:
  struct Parts {
    MeshFile file;
    SphereMap map;                          // one ray a vertex, of any length
    Provenance provenance = {};             // how the map came about
    std::optional<Topology> topology = {};  // of the file's triangles, if it is there already
    std::optional<Polygons> polygons = {};  // that the triangles are cut of: quads of a grid
    std::vector<std::string> notes = {};    // of reader and repair
    bool mapped_here = false;               // no file had the map
    std::string name = "mesh";              // for messages
  };

  /// Proves the map, with the rays made unit where they are not: those of an earlier map keep their
  /// bits. Ensures: the certificate is of the rays as they are here.
  /// Throws: MeshError unless the mesh is a closed manifold; UnmeasurableMesh for positions that
  /// are not finite; NotCertifiedError, with faces, unless one-to-one, as on genus 0 only;
  /// std::invalid_argument unless map and arrays have a row a vertex, face or corner and topology,
  /// polygons are of it. Cost: some 0.1 µs a triangle; without a topology, as much again.
  explicit MappedMesh(Parts parts, int threads = 0);

  /// The same mesh, shared, with another map, made here and proved as above.
  MappedMesh with_map(SphereMap map, Provenance provenance) const;

  /// Vertices and triangles, as they are mapped.
  const TriangleMesh& mesh() const;
  const MeshFile& file() const;                     // the mesh with all that its file carried
  const Topology& topology() const;                 // of the triangles
  const SphereMap& map() const;                     // unit rays, one a vertex
  const Certificate& certificate() const;           // that the map is one-to-one, as it is here
  const Provenance& provenance() const;             // how the map came about
  const std::optional<Polygons>& polygons() const;  // that the triangles are cut of, where known
  const std::vector<std::string>& notes() const;    // of reader and repair, a line each
  const FillerMarks& fillers() const;               // of the file
  const TriangleMesh& surface() const;  // `surface_of` mesh and fillers: what is not filler
  bool mapped_here() const;             // no file had the map
  const std::string& name() const;      // for messages

  /// Which triangle a direction lies in. Made at the first call, from whatever thread, and shared
  /// by the copies: 0.3 µs and 100 bytes a triangle.
  const SphereLocator& locator() const;

  /// The same with its chart at hand, for those of whose stages several would make it each.
  /// Throws, cost: as `spherical_chart`; copies share it, some 200 bytes a triangle.
  MappedMesh with_chart(int threads = 0, const Progress& progress = {}) const;
  const SphericalChart* chart() const { return chart_.get(); }  // null without `with_chart`

 private:
  struct Shape;
  struct State;
  explicit MappedMesh(std::shared_ptr<const Shape> shape);
  void prove(SphereMap map, Provenance provenance, bool mapped_here);

  std::shared_ptr<const Shape> shape_;
  std::shared_ptr<const State> state_;  // of it
  std::shared_ptr<const SphericalChart> chart_;
};

struct LoadOptions {
  std::string sphere = {};                   // the map in a file of its own; empty: the mesh's file
  std::optional<RepairOptions> repair = {};  // nothing: a mesh that needs it is refused
  ReadOptions read = {};
  /// Of a mesh without a map. Vertices in it are those of the mesh as it is mapped: welded and
  /// mended; `FileNumbers` tells them by the numbers of the file. Its threads and progress serve
  /// all.
  ParameterizeOptions map = {};
};

/// Reads a mesh and its map: from the file `sphere`, of the same connectivity, where one is named
/// (sx sy sz, or the vertices of a bare sphere about the origin); else sx sy sz of the mesh file
/// itself; else a map is made now.
/// Throws: ReadError, also where the two are not one connectivity; MeshRefusal for no closed
/// genus-0 mesh; NoSuchComponent; UnmeasurableMesh where one without area is to be mapped;
/// NotCertifiedError where it is not one-to-one; Cancelled; and those of `parameterize`.
MappedMesh load_mapped(const std::string& path, const LoadOptions& options = {});

/// The same of a mesh that was read already, or of a source of which only `file` is filled.
MappedMesh mapped_mesh(MeshSource source, const LoadOptions& options = {});

/// Writes mesh and map as a .ply, .vtk or .vtp; under a name of another format (`serialise_mesh`)
/// the mesh alone, as these have no place for the map. All of it or nothing; what is on the disk is
/// read back and the map proved on it before it gets its name. `threads`, 0: all cores.
/// Throws: WriteError; UnmeasurableMesh for positions or values that are no finite numbers;
/// NotCertifiedError.
void save_mapped(const std::string& path, const MappedMesh& mapped, int threads = 0);

/// The chart that is at hand, or else is made now.
SphericalChart chart_of(const MappedMesh& mapped, int threads = 0, const Progress& progress = {});

/// Rays as they are where all have unit length up to rounding, so that a map stays itself; else
/// each divided by its length. Requires: no zero ray.
SphereMap unit_rays(SphereMap map);

}  // namespace sphparam
