// The rays are found in the file (sx sy sz, angles, or the positions of a bare sphere) and
// certified as they are: a ray has no length, so a sphere of any radius will do.

#include "sphparam/io/verify_map.h"

#include <utility>

#include "io/sphere_angles.h"
#include "sphparam/io/connectivity.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/io/written_map.h"
#include "sphparam/sphere/sphere_share.h"

namespace sphparam {

namespace {

/// Beyond this share of the radius a "sphere" is not one, and only the directions of its vertices
/// count: six printed digits, or a float32, stay far below.
constexpr double roundness = 1e-3;

struct Radius {
  double mean = 0;
  double deviation = 0;  // largest | |x| / mean − 1 |
};

Radius measure_radius(const Points& rays) {
  const Eigen::VectorXd lengths = rays.rowwise().norm();
  const double mean = lengths.mean();
  return {mean, (lengths.array() / mean - 1).abs().maxCoeff()};
}

/// Throws: MeshError when there are no faces: nothing is mapped.
MeshSource read_claimed(const std::string& path, const ReadOptions& options) {
  MeshSource source = read_source(path, options);
  if (source.file.mesh.face_count() == 0) throw MeshError(source.inspection.defects);
  return source;
}

bool is_gltf(const MeshFile& file) { return file.format.starts_with("glTF"); }

/// Angles beside a sphere are somebody's notes: the sphere is the claim. In glTF they are ours.
bool has_angles_only(const MeshFile& file) {
  return is_gltf(file) || !(measure_radius(file.mesh.positions).deviation <= roundness);
}

/// The map to be proved, on the mesh that it is a map of. It has no shape where the positions are
/// the rays.
VerifiedMap claim_of(MeshSource source) {
  VerifiedMap claim;
  std::optional<SphereMap> map = read_sphere(source.file);
  if (map) claim.place = RayPlace::Rays;
  if (!map && has_angles_only(source.file) && (map = read_angles(source.file)))
    claim.place = is_gltf(source.file) ? RayPlace::AnglesAttribute : RayPlace::Angles;
  claim.map = map ? std::move(*map) : SphereMap{source.file.mesh.positions};
  claim.fillers = fillers_of(source.file);
  claim.mesh = std::move(source.file.mesh);
  claim.format = std::move(source.file.format);
  claim.notes = std::move(source.notes);
  return claim;
}

VerifiedMap claim_of(MeshSource shape, const MeshSource& sphere) {
  require_connectivity_of(shape, sphere, "sphere");
  std::optional<SphereMap> map = read_sphere(sphere.file);
  VerifiedMap claim;
  claim.place = map ? RayPlace::Rays : RayPlace::Positions;
  claim.of_two_files = true;
  claim.cut_otherwise = cut_otherwise(shape.file, sphere.file);
  claim.map = map ? std::move(*map) : SphereMap{sphere.file.mesh.positions};
  claim.fillers = fillers_of(shape.file);
  claim.mesh = std::move(shape.file.mesh);
  claim.format = std::move(shape.file.format);
  claim.notes = std::move(shape.notes);
  return claim;
}

/// Turns the faces over where all of them are negative.
void certify_either_way(VerifiedMap& claim, int threads) {
  claim.certificate = certify(Topology(claim.mesh), claim.map, threads);
  if (!claim.certificate.reversed) return;
  claim.mesh.triangles.col(1).swap(claim.mesh.triangles.col(2));
  claim.certificate = certify(Topology(claim.mesh), claim.map, threads);
  claim.certificate.reversed = true;
}

}  // namespace

bool VerifiedMap::is_round() const { return length_deviation <= roundness; }

VerifiedMap verify_map(const std::string& path, const VerifyOptions& options) {
  MeshSource source = read_claimed(path, options.read);
  VerifiedMap verified =
      options.sphere.empty()
          ? claim_of(std::move(source))
          : claim_of(std::move(source), read_claimed(options.sphere, options.read));
  const TriangleMesh as_claimed = verified.mesh;
  certify_either_way(verified, options.threads);
  const Radius radius = measure_radius(verified.map.points);
  verified.mean_length = radius.mean;
  verified.length_deviation = radius.deviation;
  const bool has_shape = verified.of_two_files || verified.place != RayPlace::Positions;
  if (!verified.certificate.unusable_points.empty()) return verified;
  const SphereMap unit = normalised(verified.map.points);  // any radius is judged alike
  verified.filler_share = sphere_share(as_claimed.triangles, unit, verified.fillers);
  if (has_shape) {
    verified.distortion = summarise_distortion(surface_of(as_claimed, verified.fillers), unit,
                                               options.threads);
  }
  return verified;
}

}  // namespace sphparam
