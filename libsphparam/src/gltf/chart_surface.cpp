#include "gltf/chart_surface.h"

#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "io/attributes/source_attributes.h"
#include "io/polygons/distinct_rows.h"
#include "mesh/float32_size.h"
#include "sphparam/chart/carry_attributes.h"
#include "sphparam/parallel.h"

// A vertex is a wedge; where corners of one wedge want different texture coordinates of the source,
// a vertex is a distinct (wedge, u, v). Everything else is gathered by wedge.

namespace sphparam {
namespace {

/// Which vertices there are.
struct Numbering {
  std::vector<int> wedges;             // of each vertex
  std::vector<std::uint32_t> indices;  // three a face
  FloatRows source_uv;                 // of each vertex; empty where not asked for
  int threads = 0;                     // that rows are gathered by
};

Numbering number_wedges(const SphericalChart& chart) {
  Numbering numbering;
  numbering.wedges.resize(static_cast<size_t>(chart.wedge_count()));
  for (size_t w = 0; w < numbering.wedges.size(); ++w) numbering.wedges[w] = static_cast<int>(w);
  numbering.indices.assign(chart.wedges.data(), chart.wedges.data() + chart.wedges.size());
  return numbering;
}

Numbering number_with_texcoords(const SphericalChart& chart, const MeshFile& mesh, int threads) {
  const std::optional<CornerTexcoords> own = texcoords_of(mesh);
  if (!own) throw std::invalid_argument("the mesh has no texture coordinates of its own");
  const Attributes corners =
      carry_corner_attribute(chart, mesh.mesh.triangles, Attributes(*own), threads);
  DistinctRows<float, 3> distinct(static_cast<size_t>(chart.wedge_count()));
  Numbering numbering;
  for (Eigen::Index corner = 0; corner < corners.rows(); ++corner) {
    const int wedge = chart.wedges.data()[corner];
    const auto s = static_cast<float>(corners(corner, 0)),
               v = static_cast<float>(1 - corners(corner, 1));
    // The bits of the wedge's number, as a key.
    const int id = distinct.insert({std::bit_cast<float>(wedge), s, v});
    if (id == static_cast<int>(numbering.wedges.size())) numbering.wedges.push_back(wedge);
    numbering.indices.push_back(static_cast<std::uint32_t>(id));
  }
  numbering.source_uv.resize(static_cast<Eigen::Index>(distinct.rows().size()), 2);
  for (size_t i = 0; i < distinct.rows().size(); ++i)
    numbering.source_uv.row(static_cast<Eigen::Index>(i)) << distinct.rows()[i][1],
        distinct.rows()[i][2];
  return numbering;
}

template <class Rows>
FloatRows gather(const Rows& rows, const Numbering& numbering) {
  constexpr std::int64_t chunk_size = 16384;
  FloatRows gathered(static_cast<Eigen::Index>(numbering.wedges.size()), rows.cols());
  parallel_for(gathered.rows(), chunk_size, numbering.threads,
               [&](std::int64_t first, std::int64_t last) {
                 for (std::int64_t i = first; i < last; ++i) {
                   gathered.row(i) =
                       rows.row(numbering.wedges[static_cast<size_t>(i)]).template cast<float>();
                 }
               });
  return gathered;
}

/// Tangents follow u: where it is mirrored they turn round, and the bitangent stays.
FloatRows gather_tangents(const Shape& shape, const Numbering& numbering, bool mirrored) {
  FloatRows tangents = gather(shape.frame.tangents, numbering);
  if (mirrored) tangents = -tangents;
  return tangents;
}

/// Rows of positions, from an origin.
FloatRows gather_from(const Eigen::RowVector3d& origin, const Shape& shape,
                      const Numbering& numbering) {
  if (origin.isZero(0)) return gather(shape.positions, numbering);
  return gather((shape.positions.rowwise() - origin).eval(), numbering);
}

/// What float32 leaves: x − float32(x).
FloatRows remainder(const Shape& shape, const Surface& surface, const Numbering& numbering) {
  const FloatRows& stored = surface.positions;
  FloatRows low(stored.rows(), 3);
  for (Eigen::Index i = 0; i < low.rows(); ++i) {
    const auto x = shape.positions.row(numbering.wedges[static_cast<size_t>(i)]);
    low.row(i) = (x - surface.origin - stored.row(i).cast<double>()).cast<float>();
  }
  return low;
}

/// θ in [0, 2π) whatever the convention; where u = 1 is θ = 2π, its copies of the seam keep that.
FloatRows theta_phi(const SphericalChart& chart, const Numbering& numbering, double offset) {
  constexpr double pi = std::numbers::pi;
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> angles(chart.wedge_count(), 2);
  for (Eigen::Index w = 0; w < angles.rows(); ++w) {
    const double u = chart.uv(w, 0);
    double theta = 2 * pi * u + offset;
    const bool is_in_place = offset == 0 && u <= 1;
    if (!is_in_place) theta -= 2 * pi * std::floor(theta / (2 * pi));
    const bool rounds_to_a_turn = static_cast<float>(theta) >= static_cast<float>(2 * pi);
    if (!is_in_place && rounds_to_a_turn) theta = 0;
    angles.row(w) << theta, pi * chart.uv(w, 1);
  }
  return gather(angles, numbering);
}

/// Red, green, blue and alpha of vertices in linear light, #V×4; nothing where there are none.
std::optional<Attributes> light_and_alpha(const MeshFile& mesh) {
  const std::optional<Points> light = linear_colours(mesh);
  if (!light) return std::nullopt;
  Attributes colours = Attributes::Ones(mesh.mesh.vertex_count(), 4);
  colours.leftCols(3) = *light;
  if (const Property* alpha = mesh.find_vertex_property("alpha")) {
    for (Eigen::Index v = 0; v < colours.rows(); ++v)
      colours(v, 3) = alpha->values[static_cast<size_t>(v)] / brightest(alpha->type);
  }
  return colours.cwiseMax(0).cwiseMin(1);
}

std::vector<std::array<std::uint16_t, 4>> vertex_colours(const SphericalChart& chart,
                                                         const MeshFile& mesh,
                                                         const Numbering& numbering) {
  const std::optional<Attributes> own = light_and_alpha(mesh);
  if (!own) return {};
  const Attributes refined =
      carry_vertex_attribute(chart, mesh.mesh.triangles, *own, numbering.threads);
  std::vector<std::array<std::uint16_t, 4>> colours;
  colours.reserve(numbering.wedges.size());
  for (const int wedge : numbering.wedges) {
    const Vertex v = chart.wedge_vertices[static_cast<size_t>(wedge)];
    std::array<std::uint16_t, 4> colour;
    for (int k = 0; k < 4; ++k) {
      colour[static_cast<size_t>(k)] =
          static_cast<std::uint16_t>(std::lround(65535 * refined(v, k)));
    }
    colours.push_back(colour);
  }
  return colours;
}

template <class Rows>
void require_float32(const Rows& positions) {
  if (!(positions.array().abs() <= std::numeric_limits<float>::max()).all())
    throw std::range_error("a position is beyond what glTF's float32 holds: scale the mesh down");
}

MorphTarget morph_target(const NamedShape& to, const Surface& from, const Numbering& numbering,
                         bool mirrored) {
  MorphTarget target{to.name,
                     gather_from(from.origin, to.shape, numbering) - from.positions,
                     gather(to.shape.frame.normals, numbering) - from.normals,
                     {}};
  require_float32(target.positions);
  if (from.tangents.size() > 0) {
    target.tangents =
        gather_tangents(to.shape, numbering, mirrored).leftCols(3) - from.tangents.leftCols(3);
  }
  return target;
}

}  // namespace

// A multiple of a power of two that is not above the extent: differences from it are exact.
Eigen::RowVector3d origin_for_float32(const Points& positions) {
  constexpr double farthest = 16;  // extents: so much of float32's digits is lost
  const Eigen::RowVector3d least = positions.colwise().minCoeff(),
                           greatest = positions.colwise().maxCoeff();
  const double extent = (greatest - least).maxCoeff(),
               size = greatest.cwiseAbs().cwiseMax(least.cwiseAbs()).maxCoeff();
  if (!(extent > 0 && size > farthest * extent)) return Eigen::RowVector3d::Zero();
  const double step = std::ldexp(1.0, std::ilogb(extent));
  return step * ((0.5 * least + 0.5 * greatest) / step).array().round().matrix();
}

Surface chart_surface(const SphericalChart& chart, const Shape& shape,
                      const std::vector<NamedShape>& targets, const MeshFile& mesh,
                      const SurfaceOptions& options, double theta_offset) {
  Numbering numbering = options.source_texcoords
                            ? number_with_texcoords(chart, mesh, options.threads)
                            : number_wedges(chart);
  numbering.threads = options.threads;
  const bool mirrored = options.uv.mirrored;
  Surface surface;
  require_float32(shape.positions);
  require_float32_least(shape.positions, "glTF");
  surface.origin = origin_for_float32(shape.positions);
  surface.positions = gather_from(surface.origin, shape, numbering);
  surface.normals = gather(shape.frame.normals, numbering);
  if (options.tangents) surface.tangents = gather_tangents(shape, numbering, mirrored);
  surface.texcoords.push_back(gather(stored_uv(chart, options.uv), numbering));
  if (options.source_texcoords) surface.texcoords.push_back(std::move(numbering.source_uv));
  if (options.colours) surface.colours = vertex_colours(chart, mesh, numbering);
  if (options.theta_phi)
    surface.custom.push_back({"_THETA_PHI", theta_phi(chart, numbering, theta_offset)});
  if (options.position_lo)
    surface.custom.push_back({"_POSITION_LO", remainder(shape, surface, numbering)});
  for (const NamedShape& target : targets)
    surface.targets.push_back(morph_target(target, surface, numbering, mirrored));
  surface.indices = std::move(numbering.indices);
  return surface;
}

}  // namespace sphparam
