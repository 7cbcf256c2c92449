#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/sphere/first_order_alignment.h"
#include "sphparam/sphere/spherical_harmonics.h"

namespace sphparam {

/// How large the functions are that coefficients belong to: of unit integral of squares over the
/// sphere, or, as geodesy has them, of 4π. Nothing else differs: both are real and without the
/// Condon–Shortley phase, so that rows m ≥ 0 and −m are geodesy's C̄_lm and S̄_lm.
enum class HarmonicNormalisation { Orthonormal, FourPi };

/// What was turned so that it lies along the axes of the first-order ellipsoid. Sphere and surface
/// is what SPHARM-PDM calls ellipsoid alignment (files *_SPHARM_ellalign), the sphere alone what it
/// always does (*_SPHARM).
enum class HarmonicAlignment { None, Sphere, SphereAndSurface };

/// A surface, and what it carries, as a sum of spherical harmonics: the shape description that a
/// map to the sphere was first made for (Brechbühler, Gerig and Kübler 1995).
struct HarmonicExpansion {
  // "x", "y", "z", then scalars by name, "radius" last where it was wanted: one a column
  std::vector<std::string> functions;
  bool least_squares = true;  // else by quadrature
  HarmonicFit fit;            // orthonormal; its residuals are weighted by solid angle
  Functions values;           // #V: what the harmonics have at the vertices
  VectorX plain_rms;          // of what is left at the vertices, each counted once
  double diagonal = 0;        // of the bounding box: the scale of the residuals of x, y, z
  std::optional<Vector3> radius_about = {};  // what "radius" is the distance from

  // Of the coefficients that are told: `told_coefficients`, and what `records` writes of them.
  HarmonicNormalisation normalisation = HarmonicNormalisation::Orthonormal;

  // What `align` turned, and how. Coefficients and values are of the turned ones.
  HarmonicAlignment aligned = HarmonicAlignment::None;
  std::optional<FirstOrderAlignment> alignment = {};

  // Of the mesh, for a surface that is made of the harmonics alone; not what is so no more once
  // they are turned.
  Provenance map = {};                     // of the map that was used
  std::vector<std::string> comments = {};  // of its file

  int degree() const;
  /// Those of `fit` in the normalisation that is told.
  Functions told_coefficients() const;
  /// Of the distances, not of one coordinate: weighted by solid angle, and plain.
  double position_rms() const { return fit.rms.head<3>().norm(); }
  double plain_position_rms() const { return plain_rms.head<3>().norm(); }
};

/// Expands the positions of a mesh's vertices, the vertex properties of these names, and, with a
/// centre in the mesh's coordinates, the distance from there under the name "radius". Of a radial
/// map its harmonics are those of planetocentric longitude and latitude. The integral is of the
/// mesh's own flat triangles, as the map carries them to the sphere: of a map that is radial as it
/// says (`is_as_said`) along rays from its centre, of others linearly; the radius is that of their
/// points, not linear.
/// Requires: numbers whose squares doubles hold. Throws: std::invalid_argument for a name that no
/// vertex property has, or that two functions would have, and as `fit_harmonics`; Cancelled. Cost:
/// `fit_harmonics`'.
HarmonicExpansion expand_in_harmonics(const MappedMesh& mapped,
                                      const std::vector<std::string>& scalars = {},
                                      const HarmonicFitOptions& options = {},
                                      const std::optional<Vector3>& radius_about = {});

/// Turns what was asked for along the axes of the first-order ellipsoid (first_order_alignment.h);
/// what is left at the vertices is told along the new axes. Requires: an expansion of this mesh,
/// nothing turned yet. Throws: std::invalid_argument for degree 0, and as `first_order_alignment`.
void align(HarmonicExpansion& expansion, const MappedMesh& mapped, HarmonicAlignment what,
           const Functions* flips = nullptr, int threads = 0);

/// The mesh with the positions and scalars that the harmonics have at its vertices, and its map,
/// as it was turned, with a line of provenance more; what said that the map lies as a body does
/// goes where it was turned, as does, where the surface was, what its coordinates are of: what
/// points up, and a volume of FreeSurfer. Normals and tangents go: they were of the other surface.
MeshFile reconstruction(const MappedMesh& mapped, const HarmonicExpansion& expansion);

/// What of the mesh's file its reconstruction has not, or as it was: normals and tangents, and, of
/// a surface that is turned, vectors and tensors (three, six or nine numbers of one name), which
/// are not. For people, a line each.
std::vector<std::string> reconstruction_losses(const MappedMesh& mapped,
                                               const HarmonicExpansion& expansion);

/// Adds it, in the format that the name asks for; where that keeps the map, what was written is
/// read back and proved. Throws: WriteError; UnmeasurableMesh; NotCertifiedError.
void add_reconstruction(PendingFiles& files, const std::string& path, const MappedMesh& mapped,
                        const HarmonicExpansion& expansion, int threads = 0);

}  // namespace sphparam
