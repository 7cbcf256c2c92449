#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/mesh/mesh_repair.h"
#include "sphparam/mesh/topology.h"

namespace sphparam {

/// A mesh file as the map takes it, and what `read_source` found on the way.
struct MeshSource {
  std::string path;                  // as it was named
  MeshFile file;                     // welded where needed, without unused vertices
  std::optional<Topology> topology;  // of it; nothing where it is no closed manifold
  MeshInspection inspection;  // after welding if that was needed; with the numbers of the file
  bool welded = false;
  std::vector<std::string> notes;     // of the reader, then what was done to the mesh
  std::vector<RepairAction> repairs;  // with the numbers of the file; see `repaired`
  KeptParts parts;                    // what they kept of the surface, so numbered too
  std::vector<HandleLoop> handles;    // that they removed; so numbered too
  double added_share = 0;  // of the area of the mended surface: what closes its holes and handles
};

/// Throws: ReadError. A mesh that is no sphere is returned all the same: see `inspection`.
MeshSource read_source(const std::string& path, const ReadOptions& options = {});

/// What a mesh names is read too (textures, libraries of materials, buffers): in a program that
/// asks for it (companions.h) no output may replace it from now on. `read_source` sees to it.
void keep_companions(const MeshFile& file);

/// What repair would do to a mesh, tried out: as it is; where that is not enough, with the
/// component, the holes, the handles and the weld that it does not take unasked.
struct RepairTrial {
  RepairOptions options;              // that mend it, or would most
  std::vector<RepairAction> actions;  // by the numbers of the file
  std::vector<MeshDefect> remaining;  // that stand in the way even then; so numbered too
  KeptParts parts;                    // those that can be chosen from; so numbered too
  std::vector<HandleLoop> handles;    // that would go; so numbered too
  bool can_mend() const { return remaining.empty(); }
  bool mends_unasked() const;  // without choosing a component, a weld, or a larger hole or handle
};
/// Tries the repairs on a copy; the source stays as it is. With `keep_holes`, holes of any length
/// are kept. Cost: that of the repairs.
RepairTrial try_repair(const MeshSource& source, bool keep_holes = false);

/// A mesh that cannot be mapped, and what could be done about it.
class MeshRefusal : public MeshError {
 public:
  MeshRefusal(const MeshSource& source, std::optional<RepairTrial> trial);
  const std::string& path() const { return path_; }
  /// Nothing where there was no memory to find out.
  const std::optional<RepairTrial>& trial() const { return trial_; }
  const std::vector<RepairAction>& done() const { return done_; }  // before it was refused

 private:
  std::string path_;
  std::optional<RepairTrial> trial_;
  std::vector<RepairAction> done_;
};

/// The mesh mended as far as these repairs go, whether it can be mapped then or not: `inspection`
/// is that of what it is then, `repairs`, `parts`, `handles` and `notes` say what was done. Throws:
/// NoSuchComponent.
MeshSource mended(MeshSource source, const RepairOptions& options);

/// What is to be written of it: its file, without a map where something was done to the mesh, which
/// is told among the losses, as is how many of its faces were cut into triangles.
MeshFile written_as_mended(const MeshSource& source, std::vector<std::string>& losses);

/// The mesh mended, with the inspection of what it is then; `repairs`, `parts` and `notes` say what
/// was done, by the numbers of the file.
/// Throws: NoSuchComponent; MeshRefusal where it is no closed genus-0 mesh even then.
MeshSource repaired(MeshSource source, const RepairOptions& options);

/// Throws MeshRefusal, with a repair tried out, unless it is closed and of genus 0, area or none.
void require_mappable(const MeshSource& source);

}  // namespace sphparam
