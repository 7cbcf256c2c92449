#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sphparam/io/read_options.h"
#include "sphparam/mesh/fillers.h"
#include "sphparam/mesh/triangle_mesh.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/sphere/distortion.h"
#include "sphparam/sphere/sphere_map.h"

namespace sphparam {

/// Where a file has the rays of its vertices.
enum class RayPlace {
  Rays,             // the properties sx sy sz
  Angles,           // the properties theta phi, where the positions are no sphere
  AnglesAttribute,  // _THETA_PHI of a glTF
  Positions         // of the vertices: a bare sphere
};

/// Theta and phi that a file has beside its rays.
struct AngleClaims {
  long off = 0;         // vertices whose theta and phi are more than 1e-5 radians from their ray
  double farthest = 0;  // of these, in radians
};

/// A map as somebody wrote it, and what was proved of it.
struct VerifiedMap {
  TriangleMesh mesh;  // its faces are the certificate's: turned over where `reversed` says so
  SphereMap map;      // as it was found: a ray has no length. Longer than 2⁶⁴ it is shortened
  /// Of the map or, where every face is negative, of its mirror image, and `reversed` then: a
  /// sphere seen from inside is one-to-one too.
  Certificate certificate;
  RayPlace place = RayPlace::Positions;
  bool of_two_files = false;
  long cut_otherwise = 0;       // polygons of the sphere's file, cut as the mesh's are
  double mean_length = 1;       // of the rays
  double length_deviation = 0;  // largest | length / mean − 1 |
  /// Of the map with unit rays, without fillers; nothing where there is no shape but the sphere, or
  /// rays are unusable.
  std::optional<DistortionSummary> distortion;
  FillerMarks fillers;             // that the mesh's file marks: the map is proved with them
  double filler_share = 0;         // of the sphere; of the map with unit rays
  std::string format;              // of the mesh's file
  std::vector<std::string> notes;  // of the readers
  std::optional<AngleClaims> angles = {};  // nothing: none stand beside sx sy sz
  /// What the file says of the map and the rays do not: theta and phi, poles, meridian, verdict.
  std::vector<std::string> warnings = {};

  /// Whether the map is one-to-one, and its theta and phi are those of its rays.
  bool holds() const;

  /// Whether the rays are points of a sphere about the origin. Only their directions were judged.
  bool is_round() const;
};

struct VerifyOptions {
  std::string sphere = {};  // the sphere of the mesh, a file of its own; empty: there is none
  ReadOptions read = {};
  int threads = 0;  // 0: all cores
};

/// Of rays of any length or, where every face is negative, of their mirror image, and `reversed`
/// then: the faces of `mesh` are turned over. Rays longer than 2⁶⁴ are shortened in `map`.
/// Requires: a ray a vertex. Throws: MeshError for what is no closed manifold.
Certificate certify_either_way(TriangleMesh& mesh, SphereMap& map, int threads = 0);

/// Proves a written map again, ours or anybody's: the rays are found in the file, and certified as
/// they are. A map that is not one-to-one is a value, see `certificate`.
/// Throws: ReadError, also where the two files are not one connectivity, the same vertices in every
/// triangle: nothing can be said then; MeshError for what is no closed manifold, or has no faces.
/// Cost: reading, and the certificate's.
VerifiedMap verify_map(const std::string& path, const VerifyOptions& options = {});

/// Where the rays are no points of a sphere: what was judged instead, and the way out. Else empty.
std::string roundness_warning(const VerifiedMap& map);
/// The same of rays as a file has them. Requires: at least one.
std::string roundness_warning(const SphereMap& rays);

}  // namespace sphparam
