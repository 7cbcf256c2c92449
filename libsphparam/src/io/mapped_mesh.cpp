// Whoever uses a map first proves it: the certificate costs little, and nothing that follows holds
// without it.

#include "sphparam/io/mapped_mesh.h"

#include <mutex>
#include <stdexcept>
#include <utility>

#include "io/attributes/array_lengths.h"
#include "io/inspected_source.h"
#include "sphere/radius.h"
#include "sphparam/chart/spherical_chart.h"
#include "sphparam/errors.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/map_files.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/planetocentric.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/io/verify_map.h"
#include "sphparam/io/written_map.h"
#include "sphparam/names.h"

namespace sphparam {

/// What maps of one mesh share.
struct MappedMesh::Shape {
  MeshFile file;
  Topology topology;
  std::optional<Polygons> polygons;
  std::vector<std::string> notes;
  std::string name;
  int threads;
  FillerMarks fillers = fillers_of(file);
  // Without fillers it is the mesh.
  std::optional<TriangleMesh> surface =
      fillers.empty() ? std::nullopt : std::optional(surface_of(file.mesh, fillers));
};

struct MappedMesh::State {
  std::shared_ptr<const Shape> shape;
  SphereMap map;
  Certificate certificate;
  Provenance provenance;
  bool mapped_here;
  mutable std::once_flag locator_is_made = {};
  mutable std::optional<SphereLocator> locator = {};
};

namespace {

std::optional<WrittenMap> written_map(const MeshSource& source, const LoadOptions& options) {
  if (!options.sphere.empty()) {
    WrittenMap written = read_map_of(source, options.sphere, options.read);
    written.file = {};  // its memory is wanted
    return written;
  }
  std::optional<SphereMap> map = read_sphere(source.file);
  if (!map) return std::nullopt;
  return WrittenMap{{}, std::move(*map), read_provenance(source.file)};
}

void note_roundness(const std::string& sphere, const SphereMap& rays,
                    std::vector<std::string>& notes) {
  const std::string warning = roundness_warning(rays);
  if (!warning.empty()) notes.push_back(display_name(sphere) + ": " + warning);
}

WrittenMap made_map(const MeshSource& source, ParameterizeOptions options) {
  require_area(source);
  options.fillers = fillers_of(source.file);
  Parameterization result = parameterize_standing(source.file, source.topology.value(), options);
  if (!result.certificate.bijective()) {
    throw NotCertifiedError(display_name(source.path) +
                            ": no one-to-one map was found: " + verdict(result.certificate));
  }
  const MapOrigin origin{.method = name_of(options.method),
                         .options = options_line(options),
                         .pins = options.pins.size(),
                         .verdict = verdict(result.certificate)};
  Provenance lines = provenance_of(result, origin, FileNumbers(source.file));
  return {{}, std::move(result.map), std::move(lines)};
}

/// All that uses of maps take for granted, and readers see to.
void require_whole(const MappedMesh::Parts& parts) {
  require_array_lengths(parts.file);
  const Points& positions = parts.file.mesh.positions;
  for (Vertex v = 0; v < positions.rows(); ++v) {
    if (positions.row(v).allFinite()) continue;
    throw UnmeasurableMesh(parts.name + ": the position of vertex " + std::to_string(v) +
                           " is no finite number; is the mesh very large or small? scale it");
  }
}

Topology topology_of(MappedMesh::Parts& parts, int threads) {
  if (!parts.topology) return Topology(parts.file.mesh, threads);
  const TriangleMesh& mesh = parts.file.mesh;
  if (parts.topology->vertex_count() != mesh.vertex_count() ||
      !parts.topology->is_of(mesh.triangles)) {
    throw std::invalid_argument("MappedMesh: the topology is of another mesh");
  }
  return std::move(*parts.topology);
}

}  // namespace

MappedMesh::MappedMesh(Parts parts, int threads) {
  require_whole(parts);
  Topology topology = topology_of(parts, threads);
  if (parts.polygons) require_polygons_of(parts.file.mesh, *parts.polygons);
  shape_.reset(new Shape{std::move(parts.file), std::move(topology), std::move(parts.polygons),
                         std::move(parts.notes), std::move(parts.name), threads});
  prove(std::move(parts.map), std::move(parts.provenance), parts.mapped_here);
}

MappedMesh::MappedMesh(std::shared_ptr<const Shape> shape) : shape_(std::move(shape)) {}

void MappedMesh::prove(SphereMap map, Provenance provenance, bool mapped_here) {
  const Shape& shape = *shape_;
  if (map.points.rows() != shape.file.mesh.vertex_count()) {
    throw std::invalid_argument("MappedMesh: a map has one ray a vertex");
  }
  shorten(map.points);
  Certificate certificate = certify(shape.topology, map, shape.threads);
  require_certified(certificate, shape.name);
  SphereMap units = unit_rays(map);
  if (units.points != map.points) {
    certificate = certify(shape.topology, units, shape.threads);
    require_certified(certificate, shape.name + ", with rays of unit length");
  }
  state_.reset(new State{shape_, std::move(units), std::move(certificate), std::move(provenance),
                         mapped_here});
}

MappedMesh MappedMesh::with_map(SphereMap map, Provenance provenance) const {
  MappedMesh other(shape_);
  other.prove(std::move(map), std::move(provenance), true);
  return other;
}

const TriangleMesh& MappedMesh::mesh() const { return shape_->file.mesh; }
const MeshFile& MappedMesh::file() const { return shape_->file; }
const Topology& MappedMesh::topology() const { return shape_->topology; }
const SphereMap& MappedMesh::map() const { return state_->map; }
const Certificate& MappedMesh::certificate() const { return state_->certificate; }
const Provenance& MappedMesh::provenance() const { return state_->provenance; }
const std::optional<Polygons>& MappedMesh::polygons() const { return shape_->polygons; }
const std::vector<std::string>& MappedMesh::notes() const { return shape_->notes; }
bool MappedMesh::mapped_here() const { return state_->mapped_here; }
const FillerMarks& MappedMesh::fillers() const { return shape_->fillers; }
const TriangleMesh& MappedMesh::surface() const {
  return shape_->surface ? *shape_->surface : mesh();
}
const std::string& MappedMesh::name() const { return shape_->name; }

const SphereLocator& MappedMesh::locator() const {
  std::call_once(state_->locator_is_made,
                 [&] { state_->locator.emplace(topology(), map(), shape_->threads); });
  return *state_->locator;
}

MappedMesh MappedMesh::with_chart(int threads, const Progress& progress) const {
  MappedMesh other = *this;
  other.chart_ = std::make_shared<SphericalChart>(chart_of(*this, threads, progress));
  return other;
}

SphericalChart chart_of(const MappedMesh& mapped, int threads, const Progress& progress) {
  if (mapped.chart()) return *mapped.chart();
  return spherical_chart(mapped.mesh(), mapped.topology(), mapped.map(), threads, progress);
}

SphereMap unit_rays(SphereMap map) {
  constexpr double roundings = 8 * 2.22e-16;
  const Eigen::ArrayXd deviation = map.points.rowwise().norm().array() - 1;
  if ((deviation.abs() <= roundings).all()) return map;
  return normalised(std::move(map.points));
}

MappedMesh mapped_mesh(MeshSource source, const LoadOptions& options) {
  require_array_lengths(source.file);
  if (options.repair) source = repaired(std::move(source), *options.repair);
  if (!is_inspected(source)) source = inspected(std::move(source));
  require_mappable(source);
  std::optional<WrittenMap> written = written_map(source, options);
  const bool mapped_here = !written;
  if (!options.sphere.empty()) note_roundness(options.sphere, written->map, source.notes);
  if (!written) written = made_map(source, options.map);
  const std::string& named = options.sphere.empty() ? source.path : options.sphere;
  return MappedMesh({.file = std::move(source.file),
                     .map = std::move(written->map),
                     .provenance = std::move(written->provenance),
                     .topology = std::move(source.topology),
                     .notes = std::move(source.notes),
                     .mapped_here = mapped_here,
                     .name = display_name(named)},
                    options.map.threads);
}

MappedMesh load_mapped(const std::string& path, const LoadOptions& options) {
  ReadOptions read = options.read;
  if (options.repair) read.repeated_corners = options.repair->duplicates;
  return mapped_mesh(read_source(path, read), options);
}

void save_mapped(const std::string& path, const MappedMesh& mapped, int threads) {
  PendingFiles files;
  add_mapped(files, path, mapped, threads);
  files.publish();
}

}  // namespace sphparam
