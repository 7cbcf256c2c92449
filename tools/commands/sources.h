#pragma once

#include <memory>
#include <optional>
#include <string>

#include "arguments/repair_arguments.h"
#include "commands/data_files.h"
#include "console/session.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/texture/convention.h"
#include "sphparam/texture/mesh_textures.h"

namespace sphparam::cli {

/// A mesh within the limits of the command line.
MeshSource read_source(const std::string& path);

/// The limits of the command line, and what of a file the repairs that are wanted can take away.
ReadOptions limits_for(const RepairArguments& repair);

/// A mesh within the limits of the command line, with the numbers of --data, after the repairs that
/// are wanted: what the file loses and what is done is told, and that a map is left behind which is
/// of the mesh before. Throws: as `repaired`; UsageMistake.
MeshSource read_mended(const std::string& path, const RepairArguments& repair, Session& session,
                       const Words& data = {}, MissingValues missing = MissingValues::LeftOut);

/// The same, mended as far as these repairs go, whether it can be mapped then or not.
MeshSource read_mended_as_far(const std::string& path, const RepairArguments& repair,
                              Session& session);

/// `load_mapped` within the limits of the command line, from where on signals are held; what the
/// file loses is told, what repairs do, and so is a map that had to be made, with the λ given.
/// `data`: of --data.
MappedMesh read_mapped(const std::string& path, const std::string& sphere, Session& session,
                       const RepairArguments& repair = {}, double lambda = 1,
                       const Words& data = {}, MissingValues missing = MissingValues::LeftOut);
/// The same of a mesh that was read by `read_mended`, with these repairs.
MappedMesh map_source(MeshSource source, const std::string& sphere, Session& session,
                      const RepairArguments& repair = {}, double lambda = 1);

/// Of images for geographers: how far the map's longitudes and latitudes are from those of the body
/// that the mesh is, seen from the given centre, else that of a radial map or the origin; nothing
/// where they are the same, and of what is no body: neither named as one, nor mapped as one, nor
/// star-shaped but for little.
void tell_longitudes(const MappedMesh& mapped, Convention convention, bool named_as_body,
                     const std::optional<Vector3>& given_centre, Session& session);

/// Hard edges where the faces turn by more than so many degrees (`add_creases`), as --crease wants
/// it, unless below 0: nothing is wanted then. That a mesh has normals of its own is told.
void crease(MeshFile& file, const std::string& path, double degrees, Session& session);

/// What --source-normal-y says of them. Warns where there is none.
void turn_normals(MeshFile& file, const std::string& path, bool down, Session& session);

/// `shown_textures` with --texture IMAGE, if it is not empty; what stands against those of the file
/// is told. `path`: of the mesh. Throws: UsageMistake where there is no place for the image.
std::shared_ptr<const MeshTextures> read_shown_textures(const MeshFile& file,
                                                        const std::string& path,
                                                        const std::string& image, Session& session);

}  // namespace sphparam::cli
