#include "sphparam/io/harmonic_expansion.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "io/attributes/other_coordinates.h"
#include "sphere/move_to_surface.h"
#include "sphere/solid_angle.h"
#include "sphparam/errors.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/losses.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/planetocentric.h"

namespace sphparam {

namespace {

constexpr Eigen::Index axes = 3;

/// Of `functions_of`, each once: by its name one is told, and read again.
std::vector<std::string> names_of(const std::vector<std::string>& scalars, bool with_radius) {
  std::vector<std::string> names = {"x", "y", "z"};
  names.insert(names.end(), scalars.begin(), scalars.end());
  if (with_radius) names.emplace_back("radius");
  for (auto name = names.begin(); name != names.end(); ++name)
    if (std::find(names.begin(), name, *name) != name)
      throw std::invalid_argument("two functions would be called " + *name);
  return names;
}

/// x, y, z, the scalars and the radius, one a column.
Functions functions_of(const MeshFile& file, const std::vector<std::string>& scalars,
                       const std::optional<Vector3>& radius_about) {
  const Eigen::Index radius = radius_about ? 1 : 0;
  Functions values(file.mesh.vertex_count(), axes + std::ssize(scalars) + radius);
  values.leftCols(axes) = file.mesh.positions;
  Eigen::Index column = axes;
  for (const std::string& name : scalars) {
    const Property* const property = file.find_vertex_property(name);
    if (!property) throw std::invalid_argument("the vertices have no property " + name);
    values.col(column++) =
        Eigen::Map<const VectorX>(property->values.data(), file.mesh.vertex_count());
  }
  if (radius_about) {
    values.col(column) =
        (file.mesh.positions.rowwise() - radius_about->transpose()).rowwise().norm();
  }
  return values;
}

/// The functions between the vertices.
class OnTriangles {
 public:
  OnTriangles(const MappedMesh& mapped, const Functions& values,
              const std::optional<Vector3>& radius_about)
      : triangles_(mapped.mesh().triangles), values_(values), radius_about_(radius_about) {
    const auto radial = planetocentric(mapped.provenance());
    if (!radial || !is_as_said(*radial, mapped.file(), mapped.map())) return;
    distances_ = (mapped.mesh().positions.rowwise() - radial->centre.transpose()).rowwise().norm();
  }

  VectorX operator()(const SurfacePoint& point) const {
    Vector3 weights = point.barycentric;
    if (distances_.size() > 0) move_to_surface(distances(point.face), weights);
    VectorX result = VectorX::Zero(values_.cols());
    for (int k = 0; k < 3; ++k)
      result += weights[k] * values_.row(triangles_(point.face, k)).transpose();
    if (radius_about_) result[result.size() - 1] = (result.head<axes>() - *radius_about_).norm();
    return result;
  }

 private:
  Vector3 distances(Face f) const {
    return {distances_[triangles_(f, 0)], distances_[triangles_(f, 1)],
            distances_[triangles_(f, 2)]};
  }

  const Triangles& triangles_;
  const Functions& values_;
  const std::optional<Vector3>& radius_about_;
  VectorX distances_;  // from the centre of a radial map; none of others
};

/// The positions as they were turned.
Points turned_positions(const MappedMesh& mapped, const HarmonicExpansion& expansion) {
  const Points& positions = mapped.mesh().positions;
  if (expansion.aligned != HarmonicAlignment::SphereAndSurface) return positions;
  return (positions.rowwise() - expansion.alignment->centre.transpose()) *
         expansion.alignment->object.transpose();
}

/// What a map no longer is once it is turned.
bool is_of_frame(const std::pair<std::string, std::string>& line) {
  const std::string& key = line.first;
  return key == "poles" || key == "meridian" || key == "upright" || is_planetocentric(key);
}

/// Comments of a file without those on what its coordinates are of.
std::vector<std::string> without_place(std::vector<std::string> comments) {
  MeshFile file;
  file.comments = std::move(comments);
  move_into(file, MeshFile{}, Points(0, 3));
  return std::move(file.comments);
}

Provenance lines_of(const MappedMesh& mapped, const HarmonicExpansion& expansion) {
  Provenance lines = mapped.provenance();
  lines.emplace_back("harmonics", std::to_string(expansion.degree()));
  if (expansion.aligned == HarmonicAlignment::None) return lines;
  std::erase_if(lines, is_of_frame);
  lines.emplace_back("aligned", "first-order ellipsoid");
  return lines;
}

SphereMap turned_map(const MappedMesh& mapped, const HarmonicExpansion& expansion) {
  if (expansion.aligned == HarmonicAlignment::None) return mapped.map();
  const Points turned = mapped.map().points * expansion.alignment->sphere.transpose();
  return {turned.rowwise().normalized()};
}

/// "velocity" of velocity_X and velocity_0, "stress" of stress_XY; empty of other names.
std::string stem_of_component(const std::string& name) {
  const std::size_t line = name.rfind('_');
  if (line == std::string::npos || line == 0 || line + 1 == name.size()) return {};
  const bool is_component =
      name.find_first_not_of("0123456789", line + 1) == std::string::npos ||
      (name.size() - line <= 3 && name.find_first_not_of("xyzXYZ", line + 1) == std::string::npos);
  return is_component ? name.substr(0, line) : std::string{};
}

/// What has the components of a vector, or of a tensor, in the order of the file.
std::vector<std::string> vectors_of(const MeshFile& file) {
  std::vector<std::string> stems;
  std::map<std::string, int> components;
  for (const Property& property : file.vertex_properties) {
    const std::string stem = stem_of_component(property.name);
    if (stem.empty() || !is_floating(property.type)) continue;
    if (components[stem]++ == 0) stems.push_back(stem);
  }
  std::erase_if(stems, [&](const std::string& stem) {
    const int count = components[stem];
    return count != 3 && count != 6 && count != 9;
  });
  return stems;
}

bool has_normals(const MeshFile& file) {
  return file.corner_normals || file.find_vertex_property("nx");
}

}  // namespace

int HarmonicExpansion::degree() const {
  return static_cast<int>(std::lround(std::sqrt(double(fit.coefficients.rows())))) - 1;
}

Functions HarmonicExpansion::told_coefficients() const {
  if (normalisation == HarmonicNormalisation::Orthonormal) return fit.coefficients;
  return fit.coefficients / std::sqrt(4 * std::numbers::pi);
}

HarmonicExpansion expand_in_harmonics(const MappedMesh& mapped,
                                      const std::vector<std::string>& scalars,
                                      const HarmonicFitOptions& options,
                                      const std::optional<Vector3>& radius_about) {
  const MeshFile& file = mapped.file();
  const Points& positions = file.mesh.positions;
  HarmonicExpansion result;
  result.functions = names_of(scalars, radius_about.has_value());
  result.radius_about = radius_about;
  result.least_squares = options.least_squares;
  result.map = mapped.provenance();
  result.comments = file.comments;
  result.diagonal = (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).norm();
  const Functions values = functions_of(file, scalars, radius_about);
  HarmonicFitOptions fitted = options;
  fitted.between = OnTriangles(mapped, values, radius_about);
  result.fit = fit_harmonics(mapped.topology(), mapped.map(), values, fitted);
  if (options.progress && !options.progress("residuals", 0)) throw Cancelled();
  result.values = synthesise(result.fit.coefficients, mapped.map().points, options.threads);
  result.plain_rms = (values - result.values).cwiseAbs2().colwise().mean().cwiseSqrt();
  return result;
}

void align(HarmonicExpansion& expansion, const MappedMesh& mapped, HarmonicAlignment what,
           const Functions* flips, int threads) {
  if (what == HarmonicAlignment::None) return;
  const bool surface = what == HarmonicAlignment::SphereAndSurface;
  Functions& coefficients = expansion.fit.coefficients;
  expansion.alignment = first_order_alignment(coefficients, flips, threads);
  expansion.aligned = what;
  coefficients = aligned(coefficients, *expansion.alignment, surface, threads);
  std::erase_if(expansion.map, is_of_frame);
  if (!surface) return;
  expansion.comments = without_place(std::move(expansion.comments));
  const Points shown = expansion.values.leftCols(axes);
  expansion.values.leftCols(axes) = (shown.rowwise() - expansion.alignment->centre.transpose()) *
                                    expansion.alignment->object.transpose();
  const Points left = turned_positions(mapped, expansion) - expansion.values.leftCols(axes);
  const VectorX shares = vertex_solid_angles(mapped.topology(), mapped.map());
  expansion.plain_rms.head<axes>() = left.cwiseAbs2().colwise().mean().cwiseSqrt();
  expansion.fit.rms.head<axes>() =
      ((shares.asDiagonal() * left.cwiseAbs2()).colwise().sum() / shares.sum()).cwiseSqrt();
}

MeshFile reconstruction(const MappedMesh& mapped, const HarmonicExpansion& expansion) {
  MeshFile file = mapped.file();
  const bool is_turned = expansion.aligned == HarmonicAlignment::SphereAndSurface;
  move_into(file, is_turned ? MeshFile{} : mapped.file(), expansion.values.leftCols(axes));
  for (Eigen::Index k = axes; k < expansion.values.cols(); ++k) {
    const VectorX column = expansion.values.col(k);
    file.set_vertex_property({expansion.functions[static_cast<size_t>(k)], ScalarType::Float64,
                              std::vector<double>(column.begin(), column.end())});
  }
  return attach_map(std::move(file), turned_map(mapped, expansion), lines_of(mapped, expansion));
}

std::vector<std::string> reconstruction_losses(const MappedMesh& mapped,
                                               const HarmonicExpansion& expansion) {
  const MeshFile& file = mapped.file();
  std::vector<std::string> losses;
  if (has_normals(file)) add_loss(losses, "normals, which are those of the surface before");
  if (file.corner_tangents) add_loss(losses, "tangents, which are those of the surface before");
  const bool is_turned = expansion.aligned == HarmonicAlignment::SphereAndSurface;
  if (const auto vectors = vectors_of(file); is_turned && !vectors.empty())
    losses.push_back("the surface is turned, not what its vertices have: components of " +
                     enumerated(vectors) + " are along the axes of before");
  return losses;
}

void add_reconstruction(PendingFiles& files, const std::string& path, const MappedMesh& mapped,
                        const HarmonicExpansion& expansion, int threads) {
  const MeshFile file = reconstruction(mapped, expansion);
  require_numbers(file, path);
  std::string bytes = serialise_mesh(path, file);
  if (keeps_map(path)) {
    add_certified(files, path, std::move(bytes), mapped.topology(), threads);
  } else {
    files.add(path, std::move(bytes));
  }
}

}  // namespace sphparam
