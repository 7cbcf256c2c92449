// The image is read back while it is checked, before it has its name; the proof is made of what was
// read.

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "displace/displacement.h"
#include "displace/displacement_file.h"
#include "displace/rebuild.h"
#include "io/formats/ply/polygon_ply.h"
#include "option_domain.h"
#include "remesh/distance_on_grid.h"
#include "remesh/image_file.h"
#include "remesh/texture_layout.h"
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

/// An image as it was read back, and how it lies.
struct Heights {
  Image image;
  std::optional<TextureLattice> lattice;  // nothing: equirectangular

  /// So many cuts of a patch or more; in the layout of a grid vertices then meet middles of texels.
  int settled_cuts(const DirectedBase& base, int least) const {
    if (!lattice) return least;
    const bool halves = base.net().patch_count() != base.grid_faces().count();
    int cuts = std::max(1, lattice->layout().steps / (halves ? 2 : 1));
    while (cuts % 2 == 0 && cuts / 2 >= least) cuts /= 2;
    return (least + cuts - 1) / cuts * cuts;
  }

  Rebuilt rebuild(const DirectedBase& base, int cuts, int threads) const {
    if (!lattice) return sphparam::rebuild(base, image, cuts, threads);
    const auto looked_up = [&](const LimitPlace& place, const Vector3&) {
      return displacement_at(image, *lattice, lattice->point(base.on_face(place)));
    };
    return sphparam::rebuild(base, looked_up, cuts, threads);
  }
};

void require_domain(const DisplacementFiles& paths, const DisplacementOptions& options) {
  constexpr auto most = static_cast<double>(most_texels);
  require_between("width", options.width, 1, most);
  require_between("height", options.height, 1, most);
  require_between("width times height", double{1} * options.width * options.height, 1, most);
  require_one_of("layout", options.layout, DisplacementLayout::Grid);
  const std::string& mesh = paths.rebuilt;
  const std::string kind = is_stream(mesh) ? ".ply" : extension_of(mesh);
  if (mesh.empty() || kind == ".ply" || kind == ".obj") return;
  throw std::invalid_argument(mesh + ": the rebuilt mesh is written as .ply or .obj");
}

std::optional<TextureLattice> lattice_for(const Remeshed& control,
                                          const DisplacementOptions& options) {
  if (options.layout == DisplacementLayout::Equirectangular) return std::nullopt;
  const GridSpec spec = spec_with_layout(control);
  return TextureLattice(spec, control.grid(),
                        texture_layout(spec, std::int64_t{options.width} * options.height));
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
                   const Remeshed& control, const DirectedBase& base, const Heights& heights,
                   const DisplacementOptions& options) {
  const Stopwatch stopwatch;
  report(options.progress, "rebuild", 0);
  const int least =
      cuts_for(base, vertices_to_rebuild(heights.image, source.mesh().vertex_count()));
  const Rebuilt rebuilt = heights.rebuild(base, heights.settled_cuts(base, least), options.threads);
  const auto error_of = [&](const TriangleMesh& mesh) {
    const SurfaceDistance distance =
        distance_on_grid(source.mesh(), mesh, control.name(),
                         {.samples = distance_samples(control.faces().count()),
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
  const ImageDepth depth = depth_in(paths.image, paths.depth);
  require_domain(paths, options);
  const Stopwatch stopwatch;
  const Scheme scheme = fit.topology->scheme();
  const DirectedBase base(control.grid(), fit.control, scheme, options.threads);
  Heights heights{.lattice = lattice_for(control, options)};
  const Displacement made =
      heights.lattice
          ? make_displacement(base, *heights.lattice, source.mesh(), source.topology(),
                              source.locator(), options)
          : make_displacement(base, source.mesh(), source.topology(), source.locator(), options);
  WrittenDisplacement result{
      .width = made.image.width, .height = made.image.height, .figures = made.figures};
  if (heights.lattice) result.layout = heights.lattice->layout();
  const DisplacementCoding coding = coding_of(made, depth);
  std::tie(result.scale, result.midlevel) = std::tie(coding.scale, coding.midlevel);
  const std::vector<char> bytes = encode_displacement(made, depth, display_name(control.name()),
                                                      name_of(scheme), result.layout);
  files.add(paths.image, {bytes.begin(), bytes.end()}, [&](std::string_view written) {
    heights.image = decode_displacement(written, paths.image);
  });
  result.seconds = stopwatch.seconds();
  if (!paths.rebuilt.empty())
    result.proof = prove(files, paths.rebuilt, source, control, base, heights, options);
  return result;
}

}  // namespace sphparam
