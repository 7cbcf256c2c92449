// What is made of a fit: the mesh of its control points, of its limit points, and how flat faces on
// the same grid compare.

#include <algorithm>
#include <utility>

#include "remesh/distance_on_grid.h"
#include "remesh/shown_limit.h"
#include "remesh/subdivision/limit_vertices.h"
#include "sphparam/remesh/subdivision.h"

namespace sphparam {

namespace {

constexpr std::int64_t comparing_samples = 50'000;  // on each side

void set(MeshFile& file, const char* name, const auto& values) {
  file.set_vertex_property({name, ScalarType::Float64, {values.begin(), values.end()}});
}

Provenance with_scheme(Provenance lines, Scheme scheme) {
  const auto verdict = std::find_if(lines.begin(), lines.end(),
                                    [](const auto& line) { return line.first == "verdict"; });
  lines.insert(verdict, {"subdivision", name_of(scheme)});
  return lines;
}

/// Cuts the faces anew, as a reader of the new positions would, with what they and corners have.
void cut_anew(MeshFile& file, const Polygons& faces) {
  const std::vector<int> before = corners_in(file.mesh.triangles, faces);
  Triangulation cut = triangulate(file.mesh.positions, faces);
  for (Property& property : file.face_properties) {
    std::vector<double> of_faces;
    for (std::int64_t p = 0; p < faces.count(); ++p) {
      const int corner = before[static_cast<size_t>(faces.starts[static_cast<size_t>(p)])];
      of_faces.push_back(property.values[static_cast<size_t>(corner / 3)]);
    }
    property.values = std::move(of_faces);
  }
  const auto move_rows = [&](auto& table) {
    if (!table) return;
    const auto old = *table;
    for (Eigen::Index i = 0; i < old.rows(); ++i)
      table->row(i) = old.row(before[static_cast<size_t>(cut.corner_of(i))]);
  };
  move_rows(file.corner_texcoords);
  move_rows(file.corner_normals);
  move_rows(file.second_texcoords);
  move_rows(file.corner_tangents);
  file.notes.clear();  // of the cut before
  adopt_triangulation(file, std::move(cut));
}

/// The same grid with other positions.
Remeshed with_file(const Remeshed& mesh, MeshFile file, Provenance provenance, int threads) {
  cut_anew(file, mesh.faces());
  return {MappedMesh({.file = std::move(file),
                      .map = mesh.map(),
                      .provenance = std::move(provenance),
                      .polygons = mesh.faces(),
                      .name = mesh.name()},
                     threads),
          mesh.spec(), mesh.figures()};
}

LimitVertices vertices_of(const SubdivisionFit& fit, const Polygons& faces, int threads) {
  return limit_at_vertices(LimitSurface(fit.topology, fit.control), faces, threads);
}

}  // namespace

std::string name_of(Scheme scheme) { return scheme == Scheme::Loop ? "loop" : "catmark"; }

Remeshed control_mesh(const Remeshed& flat, const SubdivisionFit& fit, int threads) {
  const LimitVertices limit = vertices_of(fit, flat.faces(), threads);
  MeshFile file = flat.file();
  file.mesh.positions = fit.control;
  file.position_type = ScalarType::Float64;
  file.corner_normals.reset();
  set(file, "nx", limit.normals.col(0));
  set(file, "ny", limit.normals.col(1));
  set(file, "nz", limit.normals.col(2));
  set(file, "mean_curvature", limit.mean);
  set(file, "gauss_curvature", limit.gauss);
  return with_file(flat, std::move(file), with_scheme(flat.provenance(), fit.topology->scheme()),
                   threads);
}

Remeshed limit_mesh(const Remeshed& control, const SubdivisionFit& fit, int threads) {
  MeshFile file = control.file();
  file.mesh.positions = vertices_of(fit, control.faces(), threads).positions;
  return with_file(control, std::move(file), control.provenance(), threads);
}

void compare_with_flat(SubdivisionFit& fit, const MappedMesh& source, const Remeshed& flat,
                       const SubdivisionFitOptions& options) {
  const auto rms = [&](const TriangleMesh& mesh) {
    return distance_on_grid(source.mesh(), mesh, flat.name(),
                            {.samples = comparing_samples,
                             .extremes = false,
                             .threads = options.threads,
                             .progress = options.progress})
        .rms();
  };
  fit.two_sided_rms =
      rms(fine_limit_mesh(fit, flat.faces(), shown_pieces(flat.faces()), options.threads));
  fit.flat_rms = rms(flat.mesh());
}

}  // namespace sphparam
