// The image is read back while it is checked, before it has its name; the proof is made of what was
// read.

#include <string_view>
#include <utility>
#include <vector>

#include "displace/displacement.h"
#include "displace/displacement_file.h"
#include "displace/rebuild.h"
#include "io/formats/polygon_ply.h"
#include "remesh/distance_on_grid.h"
#include "remesh/image_file.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/remesh/displacement.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/stopwatch.h"
#include "sphparam/version.h"

namespace sphparam {

namespace {

Provenance provenance_of(const Remeshed& control, Scheme scheme) {
  return {{"version", version},
          {"method", "rebuild"},
          {"grid", display_name(control.name())},
          {"subdivision", name_of(scheme)},
          {"verdict", "one-to-one"}};
}

/// Adds the rebuilt mesh, with the directions of its vertices where they are a map of it.
bool add_rebuilt(PendingFiles& files, const std::string& path, const Rebuilt& rebuilt,
                 const Provenance& provenance, int threads) {
  MeshFile file;
  file.mesh = rebuilt.mesh;
  require_numbers(file, path);
  const Topology topology(file.mesh, threads);
  const bool certified = certify(topology, rebuilt.map, threads).bijective();
  if (certified) {
    add_mapped(files, path, attach_map(std::move(file), rebuilt.map, provenance), rebuilt.faces,
               topology, threads);
  } else {
    const bool obj = extension_of(path) == ".obj";
    files.add(path, obj ? serialise_polygon_obj(file, rebuilt.faces)
                        : serialise_polygon_ply(std::move(file), rebuilt.faces));
  }
  return certified;
}

RebuildProof prove(PendingFiles& files, const std::string& path, const MappedMesh& source,
                   const Remeshed& control, const DirectedBase& base, const Image& displacement,
                   const DisplacementOptions& options) {
  const Stopwatch stopwatch;
  report(options.progress, "rebuild", 0);
  const int cuts = cuts_for(base, vertices_to_rebuild(displacement, source.mesh().vertex_count()));
  const Rebuilt rebuilt = rebuild(base, displacement, cuts, options.threads);
  const auto error_of = [&](const TriangleMesh& mesh) {
    const SurfaceDistance distance = distance_on_grid(source.mesh(), mesh, control.name(),
                                                      {.samples = distance_samples(control.faces()),
                                                       .threads = options.threads,
                                                       .progress = options.progress});
    return RebuildProof::Error{distance.rms(), distance.max()};
  };
  RebuildProof proof;
  proof.vertices = rebuilt.mesh.vertex_count();
  proof.triangles = rebuilt.mesh.face_count();
  proof.base = error_of(rebuilt.base);
  proof.rebuilt = error_of(rebuilt.mesh);
  proof.certified =
      add_rebuilt(files, path, rebuilt, provenance_of(control, base.surface().topology().scheme()),
                  options.threads);
  proof.seconds = stopwatch.seconds();
  return proof;
}

}  // namespace

WrittenDisplacement add_displacement(PendingFiles& files, const DisplacementFiles& paths,
                                     const MappedMesh& source, const Remeshed& control,
                                     const SubdivisionFit& fit,
                                     const DisplacementOptions& options) {
  const Stopwatch stopwatch;
  const Scheme scheme = fit.topology->scheme();
  const DirectedBase base(control.grid(), fit.control, scheme, options.threads);
  const Displacement made =
      make_displacement(base, source.mesh(), source.topology(), source.locator(), options);
  const std::vector<char> bytes =
      encode_displacement(made, paths.depth.value_or(usual_depth(paths.image)),
                          display_name(control.name()), name_of(scheme));
  Image read;
  files.add(paths.image, {bytes.begin(), bytes.end()},
            [&](std::string_view written) { read = decode_displacement(written, paths.image); });
  WrittenDisplacement result{.width = options.width,
                             .height = options.height,
                             .figures = made.figures,
                             .seconds = stopwatch.seconds()};
  if (!paths.rebuilt.empty())
    result.proof = prove(files, paths.rebuilt, source, control, base, read, options);
  return result;
}

}  // namespace sphparam
