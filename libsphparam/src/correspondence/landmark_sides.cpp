#include "correspondence/landmark_sides.h"

#include "number_text.h"
#include "sphparam/correspondence/match.h"

// Mirrored landmarks are known by the energy on the coarse level beyond that of isometry.

namespace sphparam {
namespace {

constexpr size_t telling_landmarks = 3;  // fewer have no sides
constexpr double alike = 1.05;           // of the energy: the mirror image fits about as well
constexpr double mirrored_share = 0.5;   // less of it is the mirror image's
constexpr double telling_energy = 0.25;  // what lies between the two must be more

TriangleMesh mirrored(TriangleMesh mesh) {
  mesh.positions.col(0) *= -1;
  mesh.triangles.col(1).swap(mesh.triangles.col(2));
  return mesh;
}

/// Of the mirror image, on its coarse level; nothing where it cannot have the landmarks.
std::optional<double> mirrored_energy(const MappedMesh& from, const TargetSurface& target,
                                      const ComposedOptions& options) {
  const TriangleMesh image = mirrored(from.mesh());
  const Topology topology(image, options.threads);
  return CoarseToFine(image, topology, target, options).start(1);
}

/// Energies that are compared.
struct BothSides {
  double least;  // of isometry
  std::optional<double> direct;
  double image;

  bool is_direct() const { return direct && image - least > alike * (*direct - least); }
  bool is_mirrored() const {
    return !direct ||
           (image - least < mirrored_share * (*direct - least) && *direct - image > telling_energy);
  }
  std::string words() const {
    return "energy " + short_number(image) +
           (direct ? " against " + short_number(*direct) : ", and cannot be reached without it") +
           " (" + short_number(least) + " is isometry)";
  }
};

}  // namespace

std::optional<std::string> suspicion_of_sides(const MappedMesh& from, const TargetSurface& target,
                                              const ComposedOptions& options,
                                              std::optional<double> direct) {
  if (options.release || options.landmarks.size() < telling_landmarks) return std::nullopt;
  const std::optional<double> image = mirrored_energy(from, target, options);
  if (!image) return std::nullopt;
  const BothSides sides{differentiate(options.energy.energy, 1, 1).f, direct, *image};
  if (sides.is_direct()) return std::nullopt;
  if (sides.is_mirrored()) {
    throw MirroredLandmarks("the landmarks look mirrored: they fit the mirror image of " +
                            from.name() + " far better, " + sides.words());
  }
  return "the landmarks fit the mirror image of " + from.name() +
         (*image < *direct ? " better, " : " about as well, ") + sides.words() +
         ": are left and right as they should be?";
}

}  // namespace sphparam
