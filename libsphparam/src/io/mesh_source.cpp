#include "sphparam/io/mesh_source.h"

#include <atomic>
#include <filesystem>

#include "io/polygons/welding.h"
#include "mesh/defect_places.h"
#include "sphparam/io/companions.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/safe_file.h"

namespace sphparam {

namespace {

long count_of(const MeshInspection& inspection, DefectKind kind) {
  for (const MeshDefect& defect : inspection.defects) {
    if (defect.kind == kind) return defect.count;
  }
  return 0;
}

/// As the file has the mesh: its vertices, and its polygons where they are cut into triangles.
MeshInspection inspect_as_read(const MeshFile& file) {
  MeshInspection inspection = inspect_mesh(file.mesh);
  if (file.polygons == 0) return inspection;
  const FileNumbers numbers(file);
  for (MeshDefect& defect : inspection.defects)
    defect = renumbered(
        std::move(defect), [](Vertex v) { return v; },
        [&](Face f) { return numbers.face_number(f); });
  return inspection;
}

/// The inspection of the welded mesh; what is not true of the faces as the file has them says so.
MeshInspection inspect_welded(const MeshFile& file, const MeshInspection& as_indexed) {
  MeshInspection inspection = inspect_mesh(file.mesh);
  inspection.defects = by_file_numbers(std::move(inspection.defects), FileNumbers(file));
  for (MeshDefect& defect : inspection.defects) {
    const bool more = defect.count > count_of(as_indexed, defect.kind);
    if (more) defect.message = "after welding, " + defect.message;
  }
  return inspection;
}

std::atomic<bool>& companions_are_guarded() {
  static std::atomic<bool> guarded = false;
  return guarded;
}

}  // namespace

void guard_companions() { companions_are_guarded() = true; }

void keep_companions(const MeshFile& file) {
  if (!companions_are_guarded()) return;
  keep_from_outputs(file.companions);
  const auto keep = [](const MaterialTexture& texture) {
    if (texture.path.empty()) return;
    keep_from_outputs({(std::filesystem::path(texture.folder) / texture.path).string()});
  };
  for (const MaterialTexture& colour : file.base_colours) keep(colour);
  for (const MaterialChannels& channels : file.channels)
    for (const MaterialTexture* texture : channels.textures()) keep(*texture);
}

MeshSource read_source(const std::string& path, const ReadOptions& options) {
  MeshSource source;
  source.path = path;
  source.file = read_mesh(path, options);
  keep_companions(source.file);
  source.inspection = inspect_as_read(source.file);
  source.notes = source.file.notes;
  if (has_other_numbers(source.file)) source.notes.emplace_back(other_numbers_note);
  MappableMesh mappable = make_mappable(std::move(source.file), &source.notes);
  source.file = std::move(mappable.file);
  source.topology = std::move(mappable.topology);
  // Dropping unused vertices leaves all used ones; welding merges some of these.
  source.welded = source.file.mesh.vertex_count() < source.inspection.used_vertices;
  if (source.welded) source.inspection = inspect_welded(source.file, source.inspection);
  return source;
}

}  // namespace sphparam
