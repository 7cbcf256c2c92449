#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sphparam/curvilinear/date_line.h"
#include "sphparam/curvilinear/poles.h"
#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/embedding/quality.h"
#include "sphparam/mesh/edge_weights.h"
#include "sphparam/mesh/fillers.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/mesh/triangle_mesh.h"
#include "sphparam/progress.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/sphere/distortion.h"
#include "sphparam/sphere/sphere_map.h"
#include "sphparam/sphere/spherical_coordinates.h"

namespace sphparam {

enum class Method {
  Progressive,  // coarse to fine, never folded, near the least distortion: the default
  Curvilinear,  // the paper made sound: periodic θ, guarded relaxation, untangling, fallback
  Paper,        // what the paper prints, folds and all
  Radial,       // directions from a centre: one-to-one where the body is star-shaped, untangled
                // where it folds
};

/// What only `Method::Paper` reads. The defaults are the paper's. No number is below 0.
struct PaperSettings {
  double epsilon = 0.02;  // ϕ of the northern link, π − ϕ of the southern;
                          // above 0, to 1.5
  int iterations = 3;     // of the quasi-harmonic improvement
  int rings = 5;          // neighbourhood of the date line that is smoothed
  int sweeps = 3;         // of tangential smoothing
  WeightKind weights = WeightKind::MeanValue;  // or Cotangent
};

/// A vertex that is to have exactly these coordinates, which are finite.
struct Landmark {
  Vertex vertex;
  SphericalCoordinates coordinates;
};

struct ParameterizeOptions {
  Method method = Method::Progressive;
  /// The vertices at ±z, north first. Method::Paper and Method::Curvilinear build the map about
  /// them, and about a pair of their own choice where none is given; Method::Progressive holds
  /// given ones while it embeds; Method::Radial takes none.
  std::optional<Poles> poles = std::nullopt;
  /// Whether a finished map that has no poles yet, and was given none, is turned and moved so that
  /// two vertices are at ±z. Not with Method::Radial.
  bool automatic_poles = true;
  std::optional<Vertex> meridian = std::nullopt;  // gets θ = 0; chosen with automatic poles
  /// Held exactly where the mesh allows it: see `pin_residuals`. Where three of them, or of them
  /// and the poles, fold their triangle, none is tried: a warning names the three.
  std::vector<Landmark> pins = {};
  PaperSettings paper = {};
  Vector3 centre = Vector3::Zero();  // of Method::Radial, in the mesh's coordinates; finite
  /// Directions, one finite ray that is not 0 a vertex, that the finished map is turned to, as one
  /// piece and as near as it can be: `radial_directions`, or another map of the mesh. Not with
  /// poles, meridian or pins, nor with Method::Radial; then no poles are chosen either.
  std::optional<SphereMap> align_to = std::nullopt;
  /// What Method::Progressive makes leaves fillers at most this share of the sphere, above 0 to 1,
  /// where that can be reached; else, and with other methods, a warning tells what they have.
  FillerMarks fillers = {};
  double filler_share = 0.02;
  // What is minimised; `lambda`, from 1e-10 to 1e6, weighs area against angle.
  DistortionEnergy energy = {};
  // Of Method::Progressive: time against distortion; and what λ is to reach, if not a given value.
  Quality quality = Quality::Normal;
  Balance balance = Balance::Lambda;
  double sweeps = 1.4;  // of Method::Progressive on the finest level, from 0; more: slower, better
  bool repair = true;   // untangle, and fall back; Method::Paper repairs only when `repair_paper`
  bool repair_paper = false;
  int threads = 0;              // 0 or less: all cores. The result does not depend on it.
  bool measure_stages = false;  // folds and distortion after every stage: costs a pass each
  Progress progress = {};
};

/// What one stage did.
struct StageRecord {
  std::string name;        // "poles", "harmonic", "quasi-harmonic 1", "untangling", …
  double seconds = 0;      // wall time
  long planar_folds = -1;  // triangles not positive in (θ, ϕ); -1: not measured or no plane
  long folds = -1;         // triangles not positive on the sphere; -1: not measured
  std::optional<DistortionSummary> distortion = std::nullopt;  // with `measure_stages`
};

/// What a balance of angles against areas has reached.
struct BalanceRecord {
  double lambda;      // the map is minimised for it
  double area_error;  // mean |log2 area ratio|, weighted by source area
  bool moved;         // false: no step was possible, the map is as it was embedded
};

/// How a map of Method::Radial differs from the directions from its centre. Without folds it does
/// not: θ and ϕ are planetocentric, exactly.
struct RadialRecord {
  Vector3 centre;               // in the mesh's coordinates
  long folds = 0;               // triangles that are not positive in these directions
  double folded_area = 0;       // their share of the surface's area
  double moved = 0;             // share of the vertices that the map has elsewhere
  double largest_movement = 0;  // of a vertex, in radians
};

// That nobody is told of: with Quality::Normal, Draft and Best.
constexpr double greatest_energy_gap = 0.01, greatest_gap_of_draft = 0.05,
                 greatest_gap_of_best = 1e-3;

struct Parameterization {
  SphereMap map;
  Certificate certificate;     // of `map`
  std::string made_by;         // the stage that produced the map: "relaxation", "untangling", …
  std::optional<Poles> poles;  // vertices at ±z, where the map has such
  /// Share by which the poles (and pins) of a finished map raised its energy; 0 where none were
  /// tried.
  double pole_cost = 0;
  /// Of a map that the progressive embedding made for a λ near 1, with Quality::Draft only of a
  /// shape with protrusions: an estimate of the share of its energy that more steps would take,
  /// made on the mesh itself; 0 is converged. A warning tells of more than the greatest for its
  /// quality (above). Of much distorted shapes it is at least how far two starts ended from each
  /// other; otherwise it knows of no other minimum. Nothing where fillers had to be pressed.
  std::optional<double> energy_gap;
  /// Of Method::Progressive with a `balance` to find, or a λ far from 1; empty where none was made.
  std::optional<BalanceRecord> balance;
  std::optional<RadialRecord> radial;  // of Method::Radial
  /// With `align_to`: the angle left between the map and these directions, in radians; root of the
  /// mean of squares over the surface.
  std::optional<double> alignment;
  std::optional<Vertex> meridian;      // a vertex with θ = 0 that was asked for or chosen
  std::optional<double> filler_share;  // of the sphere, where there are fillers
  /// Per pin, radians from its point; 0: exactly there. Of pins that were not tried, too.
  std::vector<double> pin_residuals;
  std::optional<DateLine> date_line;  // where the method has one
  std::vector<StageRecord> stages;    // in the order they ran
  /// Whether the method's map had to give way to another one: of its own points nothing is left.
  bool made_anew = false;
  std::vector<std::string> warnings;  // "pole 17 moved to 23: its link has a chord", …
};

/// Maps a closed genus-0 mesh to the unit sphere: the paper's pipeline, one stage a line in the
/// source file. The certificate is of the map returned, folded or not: look at it.
///
/// Ensures: with `repair`, a map that is not bijective is returned only after untangling and every
///          fallback have failed (Method::Paper: only with `repair_paper`).
///          `poles` and `meridian` are empty where given ones could not be reached: a warning says
///          why. So does one where a balance is not what its name promises, or where pins fit the
///          mirror image of the surface far better than the surface.
/// Throws: std::invalid_argument before anything else, naming the option that is outside of its
///         domain: a number, or a pole, pin or meridian that is no vertex, poles that are one, a
///         vertex that is pinned twice, two that are pinned at one point, a vertex at the centre of
///         Method::Radial, directions to align to that are not one a vertex, or that come with
///         poles, meridian or pins; MeshError before any
///         arithmetic if the mesh is not a closed genus-0 manifold; SolveError naming the system;
///         Cancelled.
/// Cost: Method::Progressive: linear, some 2 µs and 200 bytes a triangle, with long protrusions or
///       Quality::Best some times that, and 350 bytes. The other methods and the last rungs of the
///       repair: a handful of sparse factorisations of #V unknowns.
Parameterization parameterize(const TriangleMesh& mesh, const ParameterizeOptions& options = {});
/// The same for a mesh whose topology is there already.
Parameterization parameterize(const TriangleMesh& mesh, const Topology& topology,
                              const ParameterizeOptions& options = {});

/// Makes a map that came from elsewhere one-to-one: the repair of `parameterize` from a given
/// start. Few folds are untangled where they are; more, or what stays folded, is embedded anew, and
/// turned to the directions of the given map. `made_by` says which: "given map" where nothing had
/// to be done. Poles, meridian and pins that are asked for come last, on the map as it is then, as
/// in `parameterize`; none are chosen.
///
/// Of the options, `paper`, `repair`, `repair_paper` and `automatic_poles` say nothing here.
/// `method` makes no map: with Method::Paper pins are not held, which a warning tells; with
/// Method::Radial, which takes no poles, meridian, pins or directions, more folds are untangled
/// where they are. Throws: as `parameterize`; std::invalid_argument also unless there is one finite
/// ray a vertex.
Parameterization repair_map(const TriangleMesh& mesh, const SphereMap& map,
                            const ParameterizeOptions& options = {});

}  // namespace sphparam
