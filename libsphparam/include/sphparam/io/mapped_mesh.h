#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/io/polygons.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/parameterize.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/sphere/sphere_locator.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// A mesh with a map of it onto the unit sphere that is proved one-to-one: what all uses of maps
/// begin with.
///
/// A value that never changes: copies share one state and cost nothing; whatever is derived from
/// the mesh or its map is made once. Threads may share it.
class MappedMesh {
 public:
  struct Parts {
    MeshFile file;
    SphereMap map;                                  // one ray a vertex, of any length
    Provenance provenance = {};                     // how the map came about
    std::optional<Topology> topology = {};          // of the file's triangles, if it is there already
    std::optional<Polygons> polygons = {};          // that the triangles are cut of: quads of a grid
    std::vector<std::string> notes = {};            // of reader and repair
    bool mapped_here = false;                       // no file had the map
    std::string name = "mesh";                      // for messages
  };

  /// Proves the map, with the rays made unit.
  /// Throws: MeshError unless the mesh is a closed genus-0 manifold; NotCertifiedError unless the
  /// map is one-to-one; std::invalid_argument unless there is a ray a vertex.
  /// Cost: the certificate's, about 0.1 µs a triangle.
  explicit MappedMesh(Parts parts, int threads = 0);

  /// The same mesh, shared, with another map, proved as above.
  MappedMesh with_map(SphereMap map, Provenance provenance) const;

  const TriangleMesh& mesh() const;
  const MeshFile& file() const;  // the mesh with all that its file carried
  const Topology& topology() const;
  const SphereMap& map() const;  // unit rays
  const Certificate& certificate() const;
  const Provenance& provenance() const;
  const std::optional<Polygons>& polygons() const;
  const std::vector<std::string>& notes() const;
  bool mapped_here() const;
  const std::string& name() const;

  /// Which triangle a direction lies in. Made at the first call: 0.3 µs and 100 bytes a triangle.
  const SphereLocator& locator() const;

 private:
  struct Shape;
  struct State;
  explicit MappedMesh(std::shared_ptr<const Shape> shape);
  void prove(SphereMap map, Provenance provenance, bool mapped_here);

  std::shared_ptr<const Shape> shape_;
  std::shared_ptr<const State> state_;  // of it
};

struct LoadOptions {
  std::string sphere = {};                   // the map in a file of its own; empty: the mesh's file
  std::optional<RepairOptions> repair = {};  // nothing: a mesh that needs it is refused
  ReadOptions read = {};
  ParameterizeOptions map = {};  // of a mesh without one; its threads and progress serve all
};

/// Reads a mesh and its map: from the file `sphere`, of the same connectivity, where one is named
/// (sx sy sz, or the vertices of a bare sphere about the origin); else sx sy sz of the mesh file
/// itself; else a map is made now.
/// Throws: ReadError, also where the two are not one connectivity; MeshRefusal for what is no
/// closed genus-0 mesh; NotCertifiedError where the map is not one-to-one; std::invalid_argument
/// for `map` as `parameterize`; Cancelled.
MappedMesh load_mapped(const std::string& path, const LoadOptions& options = {});

/// The same of a mesh that was read already.
MappedMesh mapped_mesh(MeshSource source, const LoadOptions& options = {});

/// Writes mesh and map: a .sph.ply, or an .obj, which has no room for the map. All of it or
/// nothing; what is on the disk is read back and proved before it gets its name.
/// Throws: WriteError; UnmeasurableMesh for positions that are no finite numbers; NotCertifiedError.
void save_mapped(const std::string& path, const MappedMesh& mapped, int threads = 0);

/// Rays as they are where all have unit length up to rounding, so that a map stays itself; else
/// each divided by its length.
SphereMap unit_rays(SphereMap map);

}  // namespace sphparam
