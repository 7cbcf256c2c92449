// A limit surface is cut fine: patches into so many pieces that their flatness is not what is seen.

#include "commands/remesh_level.h"

#include "remesh/fine_limit_mesh.h"

namespace sphparam::cli {

namespace {

constexpr std::int64_t pieces_of_limit_surface = 250'000;

}  // namespace

TriangleMesh shown_mesh(const RemeshLevel& level) {
  if (!level.fit) return level.mesh.file.mesh;
  return fine_limit_mesh(*level.fit, level.mesh.faces, pieces_of_limit_surface,
                         level.arguments.threads);
}

}  // namespace sphparam::cli
