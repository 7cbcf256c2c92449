#include "sphparam/io/harmonic_expansion.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "sphparam/errors.h"
#include "sphparam/io/certified_files.h"
#include "sphparam/io/mesh_writer.h"

namespace sphparam {

namespace {

constexpr Eigen::Index axes = 3;

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
  result.functions = {"x", "y", "z"};
  result.functions.insert(result.functions.end(), scalars.begin(), scalars.end());
  if (radius_about) result.functions.emplace_back("radius");
  result.least_squares = options.least_squares;
  result.diagonal = (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).norm();
  const Functions values = functions_of(file, scalars, radius_about);
  result.fit = fit_harmonics(mapped.topology(), mapped.map(), values, options);
  if (options.progress && !options.progress("residuals", 0)) throw Cancelled();
  result.values = synthesise(result.fit.coefficients, mapped.map().points, options.threads);
  result.plain_rms = (values - result.values).cwiseAbs2().colwise().mean().cwiseSqrt();
  return result;
}

MeshFile reconstruction(const MappedMesh& mapped, const HarmonicExpansion& expansion) {
  MeshFile file = mapped.file();
  file.mesh.positions = expansion.values.leftCols(axes);
  file.position_type = ScalarType::Float64;
  file.corner_normals.reset();
  remove_properties(file.vertex_properties, {"nx", "ny", "nz"});
  for (Eigen::Index k = axes; k < expansion.values.cols(); ++k) {
    const VectorX column = expansion.values.col(k);
    file.set_vertex_property({expansion.functions[static_cast<size_t>(k)], ScalarType::Float64,
                              std::vector<double>(column.begin(), column.end())});
  }
  Provenance lines = mapped.provenance();
  lines.emplace_back("harmonics", std::to_string(expansion.degree()));
  return attach_map(std::move(file), mapped.map(), lines);
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
