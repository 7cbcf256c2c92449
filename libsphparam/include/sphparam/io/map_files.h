#pragma once

#include <string>

#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/mesh/topology.h"
#include "sphparam/parameterize.h"
#include "sphparam/progress.h"
#include "sphparam/sphere/certificate.h"

namespace sphparam {

// The files of a map, which may also be a folded one: it is marked in the header then, and what is
// written is proved to be what was found in memory, neither better nor worse.

/// What a `Parameterization` does not say of how it came about.
struct MapOrigin {
  std::string method;
  std::string options;        // that shaped it
  std::string citation = {};  // of a method of others; empty: ours
  std::size_t pins = 0;       // how many were asked for
  std::string upright = {};   // `upright_words`; empty: it lies otherwise
  std::string verdict;        // on the map, or "no map"
};

/// The lines in the header of a written map; vertices go by their numbers in the mesh's file.
Provenance provenance_of(const Parameterization& result, const MapOrigin& origin,
                         const FileNumbers& numbers);

/// Adds the mesh with its map, which `attach_map` gave it. What was written must have this verdict
/// when it is read back. Returns what the format had no place for (losses.h). Requires: a name of a
/// format that keeps maps. Throws: WriteError; NotCertifiedError.
std::vector<std::string> add_map(PendingFiles& files, const std::string& path,
                                 const MeshFile& with_map, const Topology& topology,
                                 const std::string& verdict, int threads = 0);

struct SphereOptions {
  DistortionEnergy energy = {};  // where the map has to be made anew, what is minimised
  bool may_remap = true;    // false: vertices of it are held at given points, which that would lose
  std::string origin = {};  // the mesh's file: its name may say which hemisphere it is
  int threads = 0;          // 0: all cores
  Progress progress = {};
};

/// A map and the mesh it is of. References to what outlives the call.
struct FinishedMap {
  const MeshFile& file;
  const Topology& topology;
  const SphereMap& map;  // unit rays up to rounding
  const Certificate& certificate;
  const Provenance& provenance;
};

/// Whether a bare sphere is written under this name: as a mesh, but for formats that do not keep
/// the numbers of vertices, which tie it to its mesh: STL.
bool is_written_as_sphere(const std::string& path);

/// What names of spheres may end in: ".ply, .obj or .gii".
std::string sphere_extensions();

/// Adds the bare sphere: the triangles of the mesh on the rays of the map. In doubles, exactly, but
/// for GIFTI, which is in floats, of the radius 100 that FreeSurfer, HCP and MSM give their
/// spheres, rounded so that a certified map stays one (`round_to_float`). Where floats cannot hold
/// it, it is made anew with small triangles taken for larger ones: returns the share of the mean
/// area that these count as; else 0. What was written is proved as `add_map` does. Throws:
/// WriteError, also for names that no sphere is written under; NotCertifiedError, also where floats
/// cannot hold the map even so; Cancelled.
double add_sphere(PendingFiles& files, const std::string& path, const FinishedMap& finished,
                  const SphereOptions& options = {});

/// The same as a file of its own.
double save_sphere(const std::string& path, const MappedMesh& mapped,
                   const SphereOptions& options = {});

}  // namespace sphparam
