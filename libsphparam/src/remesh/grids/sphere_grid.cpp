// Names of grids, and what holds of all families.

#include "sphparam/remesh/sphere_grid.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "io/shell_word.h"
#include "parsed_number.h"
#include "remesh/grids/grid_family.h"
#include "sphparam/errors.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/verify_map.h"
#include "sphparam/sphere/certificate.h"

namespace sphparam {

namespace {

/// What to do with a mesh that is no sphere.
std::string with_a_map(const std::string& path) {
  const std::string mapped = shell_word(stem_of(path) + ".sph.ply");
  return ": its map is one: `sphparam map " + shell_word(display_name(path)) + " -o " + mapped +
         "`, then like:" + mapped;
}

/// Not a negative one.
std::optional<int> whole_number(std::string_view text) {
  const std::optional<int> value = parsed<int>(text);
  return value.value_or(-1) >= 0 ? value : std::nullopt;
}

/// "N", or "WxH".
std::optional<GridSpec> read_size(const GridFamily& family, std::string_view text) {
  GridSpec spec{family.kind, 0, 0};
  if (family.has_height) {
    const size_t cross = text.find('x');
    if (cross == std::string_view::npos) return std::nullopt;
    const auto height = whole_number(text.substr(cross + 1));
    if (!height) return std::nullopt;
    spec.height = *height;
    text = text.substr(0, cross);
  }
  const auto size = whole_number(text);
  if (!size) return std::nullopt;
  spec.size = *size;
  return spec;
}

std::string expected(const GridFamily& family) {
  return std::string("expected ") + family.pattern + ", " + family.sizes;
}

/// Why there is no such grid; empty: there is one.
std::string complaint_about(const GridSpec& spec) {
  const GridFamily& family = family_of(spec.kind);
  if (!family.is_size(spec)) return expected(family);
  if (vertex_count(spec) <= most_grid_vertices) return "";
  return "more than the " + std::to_string(most_grid_vertices) + " vertices that are allowed";
}

/// The family with the longest prefix that a text has; null where there is none.
const GridFamily* family_named(std::string_view text) {
  const GridFamily* best = nullptr;
  for (const GridFamily* family : grid_families()) {
    const std::string_view prefix = family->prefix;
    if (text.starts_with(prefix) &&
        (!best || prefix.size() > std::string_view(best->prefix).size())) {
      best = family;
    }
  }
  return best;
}

}  // namespace

std::string grid_patterns() {
  std::string patterns;
  for (const GridFamily* family : grid_families()) patterns.append(family->pattern).append(", ");
  patterns.erase(patterns.size() - 2);
  return patterns;
}

GridSpec parse_grid(const std::string& text) {
  const GridFamily* const family = family_named(text);
  if (!family) throw std::invalid_argument("expected " + grid_patterns() + " or like:MESH");
  const auto spec =
      read_size(*family, std::string_view(text).substr(std::string_view(family->prefix).size()));
  if (!spec) throw std::invalid_argument(expected(*family));
  const std::string complaint = complaint_about(*spec);
  if (!complaint.empty()) throw std::invalid_argument(complaint);
  return *spec;
}

void require_grid(const GridSpec& spec) {
  const std::string complaint = complaint_about(spec);
  if (!complaint.empty()) throw std::invalid_argument(name_of(spec) + ": " + complaint);
}

std::string name_of(const GridSpec& spec) {
  const GridFamily& family = family_of(spec.kind);
  std::string name = family.prefix;
  name.append(std::to_string(spec.size));
  if (family.has_height) name.append("x").append(std::to_string(spec.height));
  return name;
}

std::int64_t vertex_count(const GridSpec& spec) {
  constexpr int beyond = 1 << 24;  // squares of more do not fit
  const GridFamily& family = family_of(spec.kind);
  GridSpec bounded = spec;
  if (!family.has_height) bounded.size = std::min(spec.size, beyond);
  return family.vertex_count(bounded);
}

bool has_quads(const GridSpec& spec) { return family_of(spec.kind).has_quads; }

std::optional<GridSpec> coarser_grid(const GridSpec& spec, int halvings) {
  const GridFamily& family = family_of(spec.kind);
  return family.coarser ? family.coarser(spec, halvings) : std::nullopt;
}

SphereGrid make_grid(const GridSpec& spec, const GridOptions& options) {
  require_grid(spec);
  SphereGrid grid = family_of(spec.kind).make(spec, options);
  grid.name = name_of(spec);
  grid.spec = spec;
  return grid;
}

SphereGrid grid_of(const MappedMesh& mapped) {
  return {.directions = mapped.map().points,
          .faces = triangles_as_polygons(mapped.mesh().triangles),
          .level_vertices = {},
          .parents = {},
          .name = mapped.name()};
}

SphereGrid load_grid(const std::string& path, const ReadOptions& read, int threads) {
  const MeshSource source = read_source(path, read);
  require_mappable(source);
  const TriangleMesh& mesh = source.file.mesh;
  const std::optional<SphereMap> given = read_sphere(source.file);
  SphereMap map = given.value_or(SphereMap{mesh.positions});
  const Topology& topology = source.topology.value();
  const std::string warning = roundness_warning(map);
  Certificate certificate = certify(topology, map, threads);
  if (certificate.bijective()) {
    map = unit_rays(std::move(map));
    certificate = certify(topology, map, threads);
  }
  if (!certificate.bijective()) {
    throw NotCertifiedError(display_name(path) +
                            ": no sphere about the origin: " + verdict(certificate) +
                            (given ? "" : with_a_map(path)) + "\n" + complaint(certificate));
  }
  return {.directions = std::move(map.points),
          .faces = triangles_as_polygons(mesh.triangles),
          .level_vertices = {},
          .parents = {},
          .name = display_name(path),
          .warning = warning.empty() ? "" : display_name(path) + ": " + warning};
}

}  // namespace sphparam
