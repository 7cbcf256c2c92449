// Directions → places on the source → values there. The place of a face's middle decides on which
// side of a seam its corners are.

#include "sphparam/remesh/remesh.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <utility>

#include "io/attributes/mixed_colour.h"
#include "option_domain.h"
#include "remesh/cell_means.h"
#include "remesh/face_means.h"
#include "remesh/grid_domain.h"
#include "remesh/grid_holes.h"
#include "remesh/resampling.h"
#include "remesh/seams.h"
#include "remesh/wanted_values.h"
#include "sphere/move_to_surface.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/planetocentric.h"
#include "sphparam/parallel.h"
#include "sphparam/remesh/adaptation.h"
#include "sphparam/sphere/sphere_locator.h"
#include "sphparam/stopwatch.h"
#include "sphparam/version.h"

namespace sphparam {

namespace {

constexpr std::int64_t grain = 4096;
constexpr std::int64_t located_at_once = 1 << 20;  // between two looks whether to go on

std::vector<SurfacePoint> locate(const SphereLocator& locator, const Points& directions,
                                 const char* stage, const RemeshOptions& options) {
  const std::int64_t all = directions.rows();
  std::vector<SurfacePoint> points(static_cast<size_t>(all));
  for (std::int64_t first = 0; first < all; first += located_at_once) {
    report(options.progress, stage, static_cast<double>(first) / static_cast<double>(all));
    const std::int64_t count = std::min(located_at_once, all - first);
    locator.locate_all(
        directions.middleRows(first, count),
        std::span(points).subspan(static_cast<size_t>(first), static_cast<size_t>(count)),
        options.threads);
  }
  return points;
}

/// Of a map that is radial: from where the map's triangles have directions, which are flat on the
/// sphere, to where rays from its centre meet the mesh. Edges stay edges.
void move_to_rays(const MappedMesh& source, std::vector<SurfacePoint>& points, int threads) {
  const auto radial = planetocentric(source.provenance());
  if (!radial || !is_as_said(*radial, source.file(), source.map())) return;
  const TriangleMesh& mesh = source.mesh();
  const VectorX distances =
      (mesh.positions.rowwise() - radial->centre.transpose()).rowwise().norm();
  parallel_for(std::ssize(points), grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      SurfacePoint& point = points[static_cast<size_t>(i)];
      Vector3 of_corners;
      for (int k = 0; k < 3; ++k) of_corners[k] = distances[mesh.triangles(point.face, k)];
      move_to_surface(of_corners, point.barycentric);
    }
  });
}

/// The middle of each face, as a direction of any length.
Points middles(const SphereGrid& grid) {
  Points result(grid.faces.count(), 3);
  for (std::int64_t f = 0; f < grid.faces.count(); ++f) {
    Vector3 sum = Vector3::Zero();
    for (const int v : grid.faces.polygon(f)) sum += grid.directions.row(v);
    result.row(f) = sum.normalized();
  }
  return result;
}

/// Rows of three numbers made unit, but for those of a source vertex as it is, and zeros.
void make_unit(double* rows, std::int64_t count, const std::vector<SurfacePoint>* points) {
  for (std::int64_t i = 0; i < count; ++i) {
    if (points && (*points)[static_cast<size_t>(i)].barycentric.maxCoeff() == 1) continue;
    Eigen::Map<Vector3> row(rows + 3 * i);
    const double length = row.norm();
    if (length > 0) row /= length;
  }
}

class Transfer {
 public:
  Transfer(const MappedMesh& source, const SphereGrid& grid, const RemeshOptions& options)
      : source_(source.file()),
        wanted_(options.transfer, source_),
        grid_(grid),
        options_(options),
        topology_(source.topology()),
        locator_(source.locator()) {
    const Stopwatch stopwatch;
    points_ = locate(locator_, grid.directions, "locate", options);
    move_to_rays(source, points_, options.threads);
    locate_seconds = stopwatch.seconds();
    if (options.sample == SampleMode::Cell) {
      report(options.progress, "gather", 0);
      const Topology of_grid(as_triangles(grid.faces), static_cast<int>(grid.directions.rows()),
                             options.threads);
      cells_ = gather_cells(source.mesh(), source.map(), of_grid, SphereMap{grid.directions},
                            options.threads);
    }
  }

  Points positions() const {
    const std::vector<double> rows = resample(resampling(), source_.mesh.positions.data(), 3);
    return Eigen::Map<const Points>(rows.data(), static_cast<Eigen::Index>(rows.size() / 3), 3);
  }

  /// From here on, what vertices have is as Workbench would take it.
  void weigh(const MappedMesh& source, const TriangleMesh& on_grid) {
    if (options_.sample == SampleMode::Barycentric)
      cells_ = barycentric_weights(source, grid_.directions, options_.threads);
    if (options_.sample == SampleMode::AdapBaryArea) weigh_by_areas(source, on_grid);
  }

  void vertex_properties(MeshFile& file) const {
    for (const Property& property : source_.vertex_properties) {
      if (!wanted_.property(property.name)) continue;
      report(options_.progress, "transfer", 0);
      file.vertex_properties.push_back({property.name, property.type,
                                        is_of_colour(property, source_.vertex_properties)
                                            ? resample_colour(resampling(), property)
                                        : is_floating(property.type)
                                            ? resample_property(resampling(), property)
                                            : resample_labels(resampling(), property)});
    }
    renormalise(file);
  }

  /// Faces and corners need to know where the middles lie.
  void of_faces(MeshFile& file, const MappedMesh& source, const Triangulation& cut) const {
    const bool uv = source_.corner_texcoords && wanted_.corner_texcoords();
    const bool normal = source_.corner_normals && wanted_.corner_normals();
    const bool any_property =
        std::any_of(source_.face_properties.begin(), source_.face_properties.end(),
                    [&](const Property& property) { return carries(property); });
    if (!uv && !normal && !any_property) return;
    const Points directions = middles(grid_);
    const auto places = locate(locator_, directions, "locate faces", options_);
    if (any_property) face_properties(file, source, places, cut);
    report(options_.progress, "corners", 0);
    if (uv) {
      file.corner_texcoords =
          corners(*source_.corner_texcoords, source_.corner_texcoord_type, directions, places, cut);
      file.corner_texcoord_type = source_.corner_texcoord_type;
    }
    if (normal) {
      file.corner_normals =
          corners(*source_.corner_normals, source_.corner_normal_type, directions, places, cut);
      file.corner_normal_type = source_.corner_normal_type;
    }
  }

  long averaged() const {
    if (options_.sample != SampleMode::Cell) return 0;
    long count = 0;
    for (std::int64_t i = 0; i < cells_.count(); ++i) {
      const auto at = static_cast<size_t>(i);
      count += cells_.starts[at + 1] > cells_.starts[at];
    }
    return count;
  }

  double locate_seconds = 0;

 private:
  static size_t at(int i) { return static_cast<size_t>(i); }

  /// The new positions may have to tell the areas.
  void weigh_by_areas(const MappedMesh& source, const TriangleMesh& on_grid) {
    report(options_.progress, "gather", 0);
    const VectorX& of_source = options_.source_areas;
    const VectorX& of_grid = options_.grid_areas;
    const Topology topology(on_grid, options_.threads);
    cells_ = adap_bary_area_weights(
        source, topology, SphereMap{grid_.directions},
        of_source.size() > 0 ? of_source : relative_areas(source.mesh()),
        of_grid.size() > 0 ? of_grid : relative_areas(on_grid), options_.threads);
  }

  /// Of faces; what marks fillers is no matter of choice.
  bool carries(const Property& property) const {
    return property.name == filler_property || wanted_.property(property.name);
  }

  Resampling resampling() const {
    return {source_.mesh.triangles, points_, cells_, options_.threads};
  }

  void renormalise(MeshFile& file) const {
    std::array<Property*, 3> of_file{};
    for (Property& property : file.vertex_properties) {
      const auto* const at =
          std::find(std::begin(normal_names), std::end(normal_names), property.name);
      if (at != std::end(normal_names)) of_file[static_cast<size_t>(at - normal_names)] = &property;
    }
    if (std::count(of_file.begin(), of_file.end(), nullptr) > 0) return;
    std::vector<double> rows(3 * points_.size());
    for (size_t i = 0; i < rows.size(); ++i) rows[i] = of_file[i % 3]->values[i / 3];
    make_unit(rows.data(), static_cast<std::int64_t>(points_.size()), &points_);
    for (size_t i = 0; i < rows.size(); ++i) {
      Property& property = *of_file[i % 3];
      property.values[i / 3] = property.type == ScalarType::Float32
                                   ? static_cast<double>(static_cast<float>(rows[i]))
                                   : rows[i];
    }
  }

  /// Whether faces that are measured get means over several of the source.
  bool averages_faces() const {
    const bool means =
        options_.sample == SampleMode::Cell || options_.sample == SampleMode::AdapBaryArea;
    return means && std::ranges::any_of(source_.face_properties, [&](const Property& property) {
             return carries(property) && property.name != filler_property &&
                    is_floating(property.type);
           });
  }

  /// One a face of the grid: that of the face at its middle, or a mean.
  std::vector<double> of_grid_faces(const Property& property,
                                    const std::vector<SurfacePoint>& places,
                                    const std::optional<Gather>& faces) const {
    if (faces && is_floating(property.type)) {
      std::vector<double> values = weighted_means(*faces, property.values, options_.threads);
      if (property.type == ScalarType::Float32)
        for (double& value : values) value = static_cast<double>(static_cast<float>(value));
      return values;
    }
    std::vector<double> values;
    values.reserve(places.size());
    for (const SurfacePoint& place : places)
      values.push_back(property.values[static_cast<size_t>(place.face)]);
    return values;
  }

  void face_properties(MeshFile& file, const MappedMesh& source,
                       const std::vector<SurfacePoint>& places, const Triangulation& cut) const {
    std::optional<Gather> faces;
    if (averages_faces()) faces = gather_faces(source, grid_, places, options_.threads);
    for (const Property& property : source_.face_properties) {
      if (!carries(property) || property.name == filler_property) continue;
      const std::vector<double> of_polygons = of_grid_faces(property, places, faces);
      std::vector<double> values(static_cast<size_t>(cut.triangles.rows()));
      for (size_t t = 0; t < values.size(); ++t)
        values[t] = of_polygons[static_cast<size_t>(cut.polygon_of(static_cast<std::int64_t>(t)))];
      file.set_face_property({property.name, property.type, std::move(values)});
      if (property.name == "material") file.materials = source_.materials;
    }
    mark_fillers(file, fillers_on_grid(cut));
  }

  /// Directions of so many points a side, from its first corner on: corner by corner of all faces.
  Points points_on_sides(int points) const {
    const Polygons& faces = grid_.faces;
    Points directions(points * std::ssize(faces.corners), 3);
    Eigen::Index row = 0;
    for (std::int64_t f = 0; f < faces.count(); ++f) {
      const auto corners = faces.polygon(f);
      for (size_t k = 0; k < corners.size(); ++k) {
        const auto from = grid_.directions.row(corners[k]);
        const auto to = grid_.directions.row(corners[(k + 1) % corners.size()]);
        for (int i = 0; i < points; ++i) {
          const double along = static_cast<double>(i) / points;
          directions.row(row++) = ((1 - along) * from + along * to).normalized();
        }
      }
    }
    return directions;
  }

  /// By corner of the grid's faces: the hole that the side after it comes upon, −1 for none.
  std::vector<int> holes_on_sides(const FillerMarks& fillers) const {
    constexpr int looks = 4;
    const auto places = locate(locator_, points_on_sides(looks), "locate holes", options_);
    const std::vector<int> holes = holes_of(topology_, fillers);
    std::vector<int> found(places.size() / looks, -1);
    for (size_t i = 0; i < places.size(); ++i)
      found[i / looks] = std::max(found[i / looks], holes[static_cast<size_t>(places[i].face)]);
    return found;
  }

  /// Faces of which some point that is looked at lies on a filler: corners, and three a side. One
  /// that reaches over a boundary, or across a slit, would be no surface.
  FillerMarks fillers_on_grid(const Triangulation& cut) const {
    const FillerMarks fillers = fillers_of(source_);
    if (fillers.empty()) return {};
    const Polygons& faces = grid_.faces;
    const std::vector<int> holes = holes_on_sides(fillers);
    std::vector<int> marks(at(static_cast<int>(cut.triangles.rows())), -1);
    for (size_t t = 0; t < marks.size(); ++t) {
      const auto p = static_cast<size_t>(cut.polygon_of(static_cast<std::int64_t>(t)));
      for (int i = faces.starts[p]; i < faces.starts[p + 1]; ++i) {
        marks[t] = std::max(marks[t], holes[at(i)]);
      }
    }
    const int vertices = static_cast<int>(grid_.directions.rows());
    return tidy_fillers(Topology(cut.triangles, vertices, options_.threads), cut, marks);
  }

  template <class Table>
  Table corners(const Table& of_source, ScalarType type, const Points& directions,
                const std::vector<SurfacePoint>& places, const Triangulation& cut) const {
    constexpr int width = Table::ColsAtCompileTime;
    const Seams seams(topology_, locator_, of_source.data(), width);
    const Polygons& faces = grid_.faces;
    Table of_polygons(static_cast<Eigen::Index>(faces.corners.size()), width);
    parallel_for(faces.count(), grain, options_.threads,
                 [&](std::int64_t first, std::int64_t last) {
                   for (std::int64_t f = first; f < last; ++f) {
                     const Middle middle{directions.row(f), places[static_cast<size_t>(f)]};
                     for (int i = faces.starts[static_cast<size_t>(f)];
                          i < faces.starts[static_cast<size_t>(f) + 1]; ++i) {
                       const int v = faces.corners[static_cast<size_t>(i)];
                       const SurfacePoint& at = points_[static_cast<size_t>(v)];
                       double* const row = of_polygons.row(i).data();
                       seams.evaluate(middle, grid_.directions.row(v), at, row);
                       if (width == 3 && at.barycentric.maxCoeff() < 1) make_unit(row, 1, nullptr);
                       if (type == ScalarType::Float32) {
                         for (int k = 0; k < width; ++k)
                           row[k] = static_cast<double>(static_cast<float>(row[k]));
                       }
                     }
                   }
                 });
    if (cut.corner.empty()) return of_polygons;
    Table result(3 * cut.triangles.rows(), width);
    for (Eigen::Index i = 0; i < result.rows(); ++i)
      result.row(i) = of_polygons.row(cut.corner_of(i));
    return result;
  }

  const MeshFile& source_;
  WantedValues wanted_;
  const SphereGrid& grid_;
  const RemeshOptions& options_;
  const Topology& topology_;
  const SphereLocator& locator_;
  std::vector<SurfacePoint> points_;
  Gather cells_;
};

void require_areas(const char* option, const VectorX& areas) {
  for (const double area : areas) {
    if (!(area >= 0)) refuse_option(option, area, "the area of a vertex, at least 0");
  }
}

void require_domain(const RemeshOptions& options) {
  require_one_of("sample", options.sample, SampleMode::AdapBaryArea);
  require_areas("source_areas", options.source_areas);
  require_areas("grid_areas", options.grid_areas);
}

Provenance provenance_of(const MappedMesh& source, const std::string& grid, SampleMode sample) {
  Provenance lines = {{"version", version},
                      {"method", "remesh"},
                      {"grid", std::filesystem::path(grid).filename().string()},
                      {"sample", name_of(sample)}};
  for (const auto& [key, value] : source.provenance()) {
    if (key == "method") lines.emplace_back("source", value);
    if (key == "upright") lines.emplace_back(key, value);
  }
  if (is_adapted(source)) lines.emplace_back("options", "--adaptive");
  lines.emplace_back("verdict", "one-to-one");
  return lines;
}

/// A sphere of neuroimaging, whose file says so, has its points on it on any grid, not on its flat
/// triangles: Workbench takes no other. Others, and what is no sphere about the origin, stay.
void put_on_sphere(const MeshFile& source, Points& positions) {
  constexpr double rounding = 1e-4;  // of the radius, of files that round
  if (std::ranges::find(source.comments, "gifti GeometricType Spherical") == source.comments.end())
    return;
  const VectorX radii = source.mesh.positions.rowwise().norm();
  const double radius = radii.mean();
  if (!(radii.maxCoeff() - radii.minCoeff() <= rounding * radius)) return;
  for (auto row : positions.rowwise()) row *= radius / row.norm();
}

/// Of a radial map: vertices are where rays of the grid meet the mesh, so that the
/// grid is a radial map of them, but for what the map moved.
Provenance radial_lines(const MappedMesh& source, const MeshFile& file, const SphereMap& grid) {
  constexpr double rounding = 1e-9;  // of positions whose centre is far from the origin
  auto radial = planetocentric(source.provenance());
  if (!radial || !is_as_said(*radial, source.file(), source.map())) return {};
  const double said = radial->largest_movement,
               found = largest_movement(radial->centre, file, grid);
  radial->largest_movement = found <= rounding ? 0 : found;
  return found <= said + rounding ? planetocentric_lines(*radial) : Provenance{};
}

}  // namespace

std::string name_of(SampleMode mode) {
  switch (mode) {
    case SampleMode::Cell:
      return "cell";
    case SampleMode::Barycentric:
      return "barycentric";
    case SampleMode::AdapBaryArea:
      return "adap-bary-area";
    default:
      return "point";
  }
}

Remeshed::Remeshed(MappedMesh mesh, std::optional<GridSpec> spec, const Figures& figures)
    : MappedMesh(std::move(mesh)), spec_(spec), figures_(figures) {}

SphereGrid Remeshed::grid() const {
  return {.directions = map().points,
          .faces = faces(),
          .level_vertices = {},
          .parents = {},
          .name = name(),
          .spec = spec_};
}

Remeshed remesh(const MappedMesh& source, SphereGrid grid, const RemeshOptions& options) {
  require_domain(options);
  require_domain(grid);
  MeshFile file;
  Remeshed::Figures figures;
  Transfer transfer(source, grid, options);
  figures.locate_seconds = transfer.locate_seconds;
  figures.averaged = transfer.averaged();
  const Stopwatch stopwatch;
  file.position_type = source.file().position_type;
  file.comments = source.file().comments;
  forget_vertices_of_file(file);
  file.mesh.positions = transfer.positions();
  put_on_sphere(source.file(), file.mesh.positions);
  figures.transfer_seconds = stopwatch.seconds();
  const Triangulation cut = triangulate(file.mesh.positions, grid.faces);
  transfer.weigh(source, {file.mesh.positions, cut.triangles});
  transfer.vertex_properties(file);
  adopt_triangulation(file, cut);
  transfer.of_faces(file, source, cut);
  report(options.progress, "certify", 0);
  SphereMap map{std::move(grid.directions)};
  Provenance lines = provenance_of(source, grid.name, options.sample);
  const Provenance radial = radial_lines(source, file, map);
  lines.insert(lines.end() - 1, radial.begin(), radial.end());
  return {MappedMesh({.file = std::move(file),
                      .map = std::move(map),
                      .provenance = std::move(lines),
                      .polygons = std::move(grid.faces),
                      .name = grid.name},
                     options.threads),
          grid.spec, figures};
}

Remeshed remesh(const MappedMesh& source, const GridSpec& grid, const RemeshOptions& options) {
  return remesh(source, make_grid(grid, {.threads = options.threads}), options);
}

}  // namespace sphparam
