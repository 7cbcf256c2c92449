// The rays are found in the file (sx sy sz, angles, or the positions of a bare sphere) and
// certified as they are: a ray has no length, so a sphere of any radius will do. What the file says
// of them besides is held against them.

#include "sphparam/io/verify_map.h"

#include <numbers>
#include <sstream>
#include <utility>

#include "io/sphere_angles.h"
#include "mesh/triangle_geometry.h"
#include "number_text.h"
#include "sphere/radius.h"
#include "sphparam/io/connectivity.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/io/paths.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/io/written_map.h"
#include "sphparam/names.h"
#include "sphparam/sphere/sphere_share.h"

namespace sphparam {

namespace {

/// Beyond this share of the radius a "sphere" is not one, and only the directions of its vertices
/// count: six printed digits, or a float32, stay far below.
constexpr double roundness = 1e-3;

/// Radians: theta and phi of six printed digits, or in float32, are nearer to the rays.
constexpr double angle_tolerance = 1e-5;

/// A map as a file has it, and what the file says of it besides.
struct Claim {
  VerifiedMap map;
  std::optional<SphereMap> angles = {};  // theta and phi beside the rays
  std::string verdict = {};              // of its header; empty: none
};

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

/// Of the vertices of that number, which are several where repair has split one, how far off the
/// nearest is; nothing: there is none.
std::optional<double> distance_of(long number, const FileNumbers& numbers, const SphereMap& map,
                                  double (*off)(const Vector3& ray)) {
  std::optional<double> nearest;
  for (Vertex v = 0; v < map.points.rows(); ++v) {
    if (numbers.number(v) != number) continue;
    const double distance = off(map.point(v).stableNormalized());
    if (!nearest || distance < *nearest) nearest = distance;
  }
  return nearest;
}

/// What a file says of a pole or of the meridian, by its number there.
void judge_place(const std::string& what, const std::string& place, long number,
                 const FileNumbers& numbers, const SphereMap& map,
                 double (*off)(const Vector3& ray), std::vector<std::string>& warnings) {
  if (number < 0) return;  // that of all vertices that repair has made
  const std::string said = "the header says that vertex " + std::to_string(number) + " is " + what;
  const std::optional<double> angle = distance_of(number, numbers, map, off);
  if (!angle) return warnings.push_back(said + ", and there is none");
  if (*angle > angle_tolerance)
    warnings.push_back(said + ", and it is " + short_number(*angle) + " radians from " + place);
}

double from_north(const Vector3& ray) { return angle_between(ray, Vector3::UnitZ()); }
double from_south(const Vector3& ray) { return angle_between(ray, -Vector3::UnitZ()); }

/// On the sphere, to the nearest point of the half circle: near a pole every longitude is near it.
double from_meridian(const Vector3& ray) {
  const double beside = elementary::hypot(std::min(ray.x(), 0.0), ray.y());
  return elementary::atan2(beside, elementary::hypot(std::max(ray.x(), 0.0), ray.z()));
}

/// What the header says of the rays, and theta and phi beside them. Poles and meridian are judged
/// at once, while the numbers are known that they are told by: those of `numbered`, if any.
void take_claims(const MeshFile& file, const MeshFile* numbered, Claim& claim) {
  if (claim.map.place == RayPlace::Rays) claim.angles = read_angles(file);
  std::optional<FileNumbers> numbers;
  if (numbered) numbers.emplace(*numbered);
  bool as_printed = false;  // the poles of the paper's method are those of its date line alone
  for (const auto& [key, value] : read_provenance(file)) {
    if (key == "method") as_printed = value == name_of(Method::Paper);
    if (key == "verdict") claim.verdict = value;
    if (!numbers) continue;
    std::istringstream words(value);
    long first = 0, second = 0;
    if (!(words >> first)) continue;  // "none"
    std::vector<std::string>& warnings = claim.map.warnings;
    if (key == "meridian")
      judge_place("on the meridian", "theta = 0", first, *numbers, claim.map.map, from_meridian,
                  warnings);
    if (key != "poles" || as_printed || !(words >> second)) continue;
    judge_place("the north pole", "+z", first, *numbers, claim.map.map, from_north, warnings);
    judge_place("the south pole", "-z", second, *numbers, claim.map.map, from_south, warnings);
  }
}

/// The map to be proved, on the mesh that it is a map of. It has no shape where the positions are
/// the rays.
Claim claim_of(MeshSource source) {
  Claim whole;
  VerifiedMap& claim = whole.map;
  std::optional<SphereMap> map = read_sphere(source.file);
  if (map) claim.place = RayPlace::Rays;
  if (!map && has_angles_only(source.file) && (map = read_angles(source.file)))
    claim.place = is_gltf(source.file) ? RayPlace::AnglesAttribute : RayPlace::Angles;
  claim.map = map ? std::move(*map) : SphereMap{source.file.mesh.positions};
  // A bare sphere names vertices by the numbers of its mesh's file, which is not here.
  const bool bare = claim.place == RayPlace::Positions;
  take_claims(source.file, bare ? nullptr : &source.file, whole);
  claim.fillers = fillers_of(source.file);
  claim.mesh = std::move(source.file.mesh);
  claim.format = std::move(source.file.format);
  claim.notes = std::move(source.notes);
  return whole;
}

Claim claim_of(MeshSource shape, const MeshSource& sphere) {
  require_connectivity_of(shape, sphere, "sphere");
  std::optional<SphereMap> map = read_sphere(sphere.file);
  Claim whole;
  VerifiedMap& claim = whole.map;
  claim.place = map ? RayPlace::Rays : RayPlace::Positions;
  claim.of_two_files = true;
  claim.cut_otherwise = cut_otherwise(shape.file, sphere.file);
  claim.map = map ? std::move(*map) : SphereMap{sphere.file.mesh.positions};
  const bool bare = claim.place == RayPlace::Positions;
  take_claims(sphere.file, bare ? &shape.file : &sphere.file, whole);
  claim.fillers = fillers_of(shape.file);
  claim.mesh = std::move(shape.file.mesh);
  claim.format = std::move(shape.file.format);
  claim.notes = std::move(shape.notes);
  claim.notes.insert(claim.notes.end(), sphere.notes.begin(), sphere.notes.end());
  return whole;
}

/// Theta and phi are held against unit rays.
AngleClaims judge_angles(const SphereMap& angles, const SphereMap& unit) {
  AngleClaims found;
  for (Vertex v = 0; v < unit.points.rows(); ++v) {
    const bool finite = angles.points.row(v).allFinite();
    const double angle = finite ? angle_between(angles.point(v), unit.point(v)) : std::numbers::pi;
    if (angle <= angle_tolerance) continue;
    ++found.off;
    found.farthest = std::max(found.farthest, angle);
  }
  return found;
}

std::string words_of(const AngleClaims& angles) {
  return "theta and phi of " + counted(angles.off, "vertex is not that", "vertices are not those") +
         " of sx sy sz, by up to " + short_number(angles.farthest) + " radians";
}

}  // namespace

bool VerifiedMap::is_round() const { return length_deviation <= roundness; }

bool VerifiedMap::holds() const { return certificate.bijective() && !(angles && angles->off > 0); }

Certificate certify_either_way(TriangleMesh& mesh, SphereMap& map, int threads) {
  const double greatest = map.points.rows() > 0 ? measure_radius(map.points).greatest : 0;
  shorten(map.points);
  Certificate certificate = certify(Topology(mesh, threads), map, threads);
  if (certificate.reversed) {
    mesh.triangles.col(1).swap(mesh.triangles.col(2));
    certificate = certify(Topology(mesh, threads), map, threads);
    certificate.reversed = true;
  }
  if (greatest > largest_ray) certificate.max_length_error = greatest - 1;  // as they were
  return certificate;
}

VerifiedMap verify_map(const std::string& path, const VerifyOptions& options) {
  MeshSource source = read_claimed(path, options.read);
  Claim claim = options.sphere.empty()
                    ? claim_of(std::move(source))
                    : claim_of(std::move(source), read_claimed(options.sphere, options.read));
  VerifiedMap verified = std::move(claim.map);
  const TriangleMesh as_claimed = verified.mesh;
  const Radius radius = measure_radius(verified.map.points);
  verified.mean_length = radius.mean;
  verified.length_deviation = radius.deviation;
  verified.certificate = certify_either_way(verified.mesh, verified.map, options.threads);
  if (!claim.verdict.empty() && claim.verdict != verdict(verified.certificate))
    verified.warnings.push_back("the header says: " + claim.verdict + "; it is " +
                                verdict(verified.certificate));
  const bool has_shape = verified.of_two_files || verified.place != RayPlace::Positions;
  if (!verified.certificate.unusable_points.empty()) return verified;
  const SphereMap unit = normalised(verified.map.points);  // any radius is judged alike
  if (claim.angles) {
    verified.angles = judge_angles(*claim.angles, unit);
    if (verified.angles->off > 0) verified.warnings.push_back(words_of(*verified.angles));
  }
  verified.filler_share = sphere_share(as_claimed.triangles, unit, verified.fillers);
  if (has_shape) {
    verified.distortion =
        summarise_distortion(surface_of(as_claimed, verified.fillers), unit, options.threads);
  }
  return verified;
}

std::string roundness_warning(const VerifiedMap& map) {
  if (map.is_round()) return "";
  const bool is_gltf = !map.of_two_files && map.format.starts_with("glTF");
  return "these points are not on a sphere about the origin: their radius is " +
         short_number(map.mean_length) + " in the mean, and up to " +
         percent(map.length_deviation) + " more or less; their directions are judged" +
         (is_gltf ? "; `sphparam export --theta-phi` writes the map into glTF, as the attribute "
                    "_THETA_PHI"
                  : "");
}

std::string roundness_warning(const SphereMap& rays) {
  const Radius radius = measure_radius(rays.points);
  VerifiedMap map;
  map.of_two_files = true;  // a sphere beside its mesh
  map.mean_length = radius.mean;
  map.length_deviation = radius.deviation;
  return roundness_warning(map);
}

}  // namespace sphparam
