#include <stdexcept>

#include "bake/inside_out.h"
#include "bake/shared_sphere.h"
#include "gltf/export_asset.h"
#include "gltf/export_domain.h"
#include "gltf/export_names.h"
#include "gltf/fillers_left_out.h"
#include "gltf/level.h"
#include "io/attributes/appearance.h"
#include "io/attributes/authorship.h"
#include "io/attributes/remarks.h"
#include "number_text.h"
#include "sphparam/gltf/export.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/shared_places.h"
#include "sphparam/io/upright_frame.h"

namespace sphparam {

namespace {

GeometryOptions geometry_options(const ExportOptions& options, const MappedMesh& mapped,
                                 const Look& look) {
  GeometryOptions geometry{.shape = options.shape,
                           .morph = options.morph,
                           .others = options.others,
                           .up = upright_axes(mapped.file(), options.up),
                           .threads = options.threads};
  geometry.front_at_zero = map_is_upright(mapped.provenance(), geometry.up);
  // What wraps beyond 1 has no place in normalised integers.
  geometry.buffers = {.uv = {.sixteen_bits = options.quantise && !options.keep_topology,
                             .upwards = options.upward_v},
                      .tangents = look.has_normals(),
                      .colours = look.vertex_colours,
                      .theta_phi = options.theta_phi,
                      .position_lo = options.shape == ShapeKind::Sphere,
                      .source_texcoords = options.source_uv};
  return geometry;
}

std::string name_of_asset(const MappedMesh& mapped, const ExportOptions& options) {
  if (!options.name.empty()) return options.name;
  return stem_of(mapped.name());
}

void require_a_row_a_vertex(const std::vector<OtherShape>& shapes, const MappedMesh& mapped) {
  const Eigen::Index count = mapped.mesh().vertex_count();
  for (const OtherShape& shape : shapes) {
    if (shape.positions.rows() == count && shape.normals.rows() == count) continue;
    throw std::invalid_argument("the shape " + shape.name +
                                " needs a position and a normal for each vertex of the mesh");
  }
}

/// Before any work.
void require_makeable(const MappedMesh& mapped, const ExportOptions& options) {
  require_export_domain(options);
  require_a_row_a_vertex(options.others, mapped);
  if (options.source_uv && !has_texcoords(mapped.file()))
    throw std::invalid_argument("the mesh has no texture coordinates of its own");
}

double mean_edge_of_diagonal(const TriangleMesh& mesh) {
  double sum = 0;
  for (Face f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k)
      sum += (mesh.positions.row(mesh.triangles(f, k)) -
              mesh.positions.row(mesh.triangles(f, (k + 1) % 3)))
                 .norm();
  const Vector3 extent = mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff();
  return sum / (3 * static_cast<double>(mesh.face_count())) / extent.norm();
}

/// A texture would show other places on it than on the finest. Levels are far from the surface
/// where they are coarse, as an icosahedron is, though they share its sphere: by about an edge of
/// theirs.
void warn_of_other_sphere(const MappedMesh& mapped, const MappedMesh& coarse, int threads,
                          std::vector<std::string>& warnings) {
  const double apart = disagreement(mapped, coarse, threads);
  if (apart <= other_sphere_disagreement + mean_edge_of_diagonal(coarse.mesh())) return;
  warnings.push_back("the level of " + counted(coarse.mesh().face_count(), "triangle") +
                     " may be on another sphere, and textures show other places on it: half of its "
                     "surface is more than " +
                     percent(apart) + " of the diagonal away from the mesh in the same directions");
}

/// How the mesh stood in its own file.
void add_axes(Asset& asset, const UprightAxes& axes) {
  asset.extras.emplace_back("up", name_of_direction(axes.up));
  asset.extras.emplace_back("front", name_of_direction(axes.front));
}

/// But for what glTF has a place for.
void add_comments(Asset& asset, const MeshFile& file) {
  MeshFile said;
  said.comments = file.comments;
  note_authorship(said, {});
  const std::vector<std::string> remarks = remarks_of(said);
  if (!remarks.empty()) asset.extras.emplace_back("comments", joined(remarks, "\n"));
}

/// Of the mesh itself: its map keeps the sense of the faces and mirrors, so that the sphere looks
/// outward.
void tell_facing(const MappedMesh& mapped, ShapeKind shape, std::vector<std::string>& warnings) {
  if (shape == ShapeKind::Mesh && is_inside_out(mapped))
    warnings.emplace_back(
        "the mesh is inside out: viewers show the inside of its far side, or light it from "
        "behind; --repair=orientation turns it over");
}

/// A chart has some vertices more than once, so that readers make those of a place one.
void tell_shared_places(const MappedMesh& mapped, ShapeKind shape,
                        std::vector<std::string>& warnings) {
  if (shape != ShapeKind::Mesh) return;
  const SharedPlaces shared = shared_places(mapped.mesh());
  if (shared.vertices > 0)
    warnings.push_back(words_of(shared) +
                       ": who reads glTF as a closed surface welds them, we too (" +
                       words_when_welded(shared) + "); .ply keeps them apart");
}

/// In one line.
void tell_numbers_left_out(const MeshFile& file, std::vector<std::string>& warnings) {
  const std::vector<std::string> words = numbers_not_shown(file);
  if (!words.empty()) add_loss(warnings, joined(words, " and ") + ": .ply has room for that");
}

Asset without_levels(const MappedMesh& mapped, const Look& look, const ExportOptions& options) {
  Authorship author = noted_authorship(mapped.file());
  Asset asset{.name = name_of_asset(mapped, options),
              .levels = {},
              .images = look.images,
              .coarse_levels_have_normal_maps = !look.normals_given,
              .materials = look.materials,
              .extras = {{"source", source_name(mapped, options)}},
              .copyright = std::move(author.copyright),
              .source_extras = std::move(author.extras),
              .quantised = options.quantise,
              .upward_v = options.upward_v,
              .warnings = look.warnings};
  for (const auto& [key, value] : mapped.provenance())
    asset.extras.emplace_back("map_" + key, value);
  if (options.up != Up{} || noted_up(mapped.file()) != Up{})
    add_axes(asset, upright_axes(mapped.file(), options.up));
  add_comments(asset, mapped.file());
  tell_numbers_left_out(mapped.file(), asset.warnings);
  tell_facing(mapped, options.shape, asset.warnings);
  tell_shared_places(mapped, options.shape, asset.warnings);
  return asset;
}

void add_level(Asset& asset, const MappedMesh& mapped, const std::string& name, const Look& look,
               const ExportOptions& options) {
  const ExportChart chart = chart_of_level(mapped, options);
  ExportGeometry geometry =
      export_geometry(chart, mapped.file(), geometry_options(options, mapped, look));
  if (asset.levels.empty()) {
    for (auto& extra : chart_extras(chart, geometry, chart_options(options)))
      asset.extras.push_back(std::move(extra));
  }
  ChartFigures figures = figures_of(chart);
  figures.stored = std::move(geometry.stored);
  figures.sphere_folds = geometry.stored_sphere_folds;
  warn_of_moves(name, chart, asset.warnings);
  warn_of_folds(name, figures, options.keep_topology, asset.warnings);
  asset.charts.push_back(std::move(figures));
  leave_out(geometry.surface, fillers_of_chart(chart.chart, mapped.fillers()));
  asset.levels.push_back(std::move(geometry.surface));
}

}  // namespace

Asset make_asset(const MappedMesh& mapped, const Look& look, const ExportOptions& options) {
  require_makeable(mapped, options);
  Asset asset = without_levels(mapped, look, options);
  const std::string name = source_name(mapped, options);
  for (const MappedMesh& coarse : options.coarser)
    warn_of_other_sphere(mapped, coarse, options.threads, asset.warnings);
  add_level(asset, mapped, name, look, options);
  if (options.coarser.empty()) return asset;
  if (look.normals_given) asset.warnings.emplace_back(normals_left_out);
  const Look coarse_look = without_given_normals(look);
  ExportOptions coarse_options = options;
  coarse_options.others.clear();
  for (const MappedMesh& coarse : options.coarser)
    add_level(asset, coarse, name, coarse_look, coarse_options);
  return asset;
}

Asset make_asset(const MappedMesh& mapped, const ExportOptions& options) {
  require_makeable(mapped, options);
  return make_asset(mapped, make_look(mapped, options), options);
}

}  // namespace sphparam
