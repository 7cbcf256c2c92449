#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/polygons.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/sphere/certificate.h"

namespace sphparam {

class MappedMesh;

// Data that a mesh carries (vertex_data.h) is written beside it where its format has it so
// (`has_data_beside`), in files named by `data_path`, with it or not at all. What these functions
// return says where, too. Nobody gave these names: a file that is there already is left as it is,
// and WriteError tells of it, unless it has the same bytes.

/// Those files, of a mesh that is written as `path`; none where its format holds data itself.
std::vector<std::string> paths_beside(const std::string& path, const MeshFile& file);

/// Throws UnmeasurableMesh where a mesh that was made here, to be written as `path`, has positions
/// or values that are no finite numbers.
void require_numbers(const MeshFile& file, const std::string& path);

/// Adds the bytes of a PLY that carries a map. They are read back once written, and their map must
/// be one-to-one: NotCertifiedError if not. `topology` is that of the faces in them.
void add_certified(PendingFiles& files, const std::string& path, std::string bytes,
                   const Topology& topology, int threads);

/// The same for a mesh that carries no map: `map` has a ray for each of its vertices.
void add_certified(PendingFiles& files, const std::string& path, std::string bytes,
                   const Topology& topology, const SphereMap& map, int threads);

/// Adds a mesh that carries a map, proved like this, in the format that the name asks for (see
/// `serialise_mesh`); where that has no place for a map, the mesh alone. `faces`: the polygons that
/// its triangles are cut of, as `adopt_triangulation` does. Returns what the format had no place
/// for (losses.h), not the map. Throws: UnmeasurableMesh as `require_numbers`; WriteError for a
/// name of no format.
std::vector<std::string> add_mapped(PendingFiles& files, const std::string& path, MeshFile file,
                                    const Polygons& faces, const Topology& topology, int threads,
                                    WriteOptions options = {});

/// Adds a mesh whatever it is, in the format that the name asks for: without its fillers where that
/// has no place for their mark, as they would be surface there. It is read back once written, and
/// must have the same triangles: WriteError if not. Returns what the format had no place for.
/// Throws: UnmeasurableMesh as `require_numbers`; WriteError for a name of no format.
std::vector<std::string> add_mesh(PendingFiles& files, const std::string& path, MeshFile file,
                                  const WriteOptions& options = {});

/// What becomes of fillers where a mapped mesh is written.
enum class FillersInFile {
  Marked,  // kept where the format has a place for their mark, which is where it has one for a map
  Kept,    // everywhere
  Left,    // the surface alone, and no map: it has holes
};

/// Adds a mapped mesh like this, its provenance with it: what `save_mapped` writes. A surface alone
/// is proved by the map that it had, and is compared with what is read back; what is returned tells
/// how many fillers were left out. Throws: also WriteError where what was read back differs.
std::vector<std::string> add_mapped(PendingFiles& files, const std::string& path,
                                    const MappedMesh& mapped, int threads = 0,
                                    const WriteOptions& options = {},
                                    FillersInFile fillers = FillersInFile::Marked);

}  // namespace sphparam
