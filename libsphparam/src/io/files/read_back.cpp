#include "io/files/read_back.h"

#include "io/formats/mesh_formats.h"
#include "number_text.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/safe_file.h"

namespace sphparam {

namespace {

bool has_own_corners(const std::string& path) {
  const MeshFormat* const format =
      is_stream(path) ? nullptr : format_of_extension(inner_extension_of(path));
  return format && format->own_corners;
}

/// Gives vertices the numbers that they had.
void number_as(const TriangleMesh& written, const std::string& path, ReadBack& back) {
  const TriangleMesh read = std::move(back.file.mesh);
  std::vector<Vertex> known(static_cast<size_t>(written.vertex_count()), -1);
  Eigen::Index used = 0;
  for (Face f = 0; f < written.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      Vertex& vertex = known[static_cast<size_t>(written.triangles(f, k))];
      used += vertex < 0;
      if (vertex >= 0 && vertex != read.triangles(f, k))
        throw WriteError(path, "as written, it has other triangles");
      vertex = read.triangles(f, k);
    }
  }
  back.file.mesh = written;
  for (Vertex v = 0; v < written.vertex_count(); ++v)
    if (const Vertex vertex = known[static_cast<size_t>(v)]; vertex >= 0)
      back.file.mesh.positions.row(v) = read.positions.row(vertex);
  back.joined = used - read.vertex_count();
  back.renumbered = true;
}

}  // namespace

ReadBack read_back(std::string_view bytes, const std::string& path, const MeshFile& written,
                   const ReadOptions& options) {
  ReadBack back{read_mesh(bytes, path, options)};
  if (!has_own_corners(path)) return back;
  if (back.file.mesh.face_count() != written.mesh.face_count())
    throw WriteError(path, "as written, it has other triangles");
  number_as(written.mesh, path, back);
  return back;
}

std::vector<std::string> losses_of_read_back(const MeshFile& written, const ReadBack& back) {
  std::vector<std::string> losses = losses_of_writing(written, back.file);
  if (back.renumbered)
    add_loss(losses, "numbers of vertices: triangles there have corners of their own");
  if (back.joined > 0)
    add_loss(losses, std::to_string(back.joined) + " of " +
                         counted(written.mesh.vertex_count(), "vertex", "vertices") +
                         ": they lie in the place of others there, and are one with these to who "
                         "reads it, so that edges may have more than two triangles");
  return losses;
}

Certificate certify_read_back(const MeshFile& file, const SphereMap& map, const Topology& written,
                              int threads) {
  const bool as_wanted = written.is_of(file.mesh.triangles) &&
                         written.vertex_count() == static_cast<int>(file.mesh.vertex_count());
  if (as_wanted) return certify(written, map, threads);
  return certify(Topology(file.mesh, threads), map, threads);
}

}  // namespace sphparam
