#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sphparam/embedding/distortion_energy.h"
#include "sphparam/group/procrustes.h"
#include "sphparam/group/shape_modes.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/mesh/surface_point.h"
#include "sphparam/progress.h"
#include "sphparam/remesh/sphere_grid.h"

namespace sphparam {

/// Where the way of a shape to the template begins.
enum class GroupStart {
  /// Ends of what sticks out, paired as `match_surfaces` does it; where there are not three on both
  /// the turn that it finds then. Where maps are held, as Rotation.
  Ends,
  Rotation,   // spheres turned so that curvatures and area ratios agree most (map_alignment.h)
  Ellipsoid,  // spheres turned so that first-order ellipsoids lie alike, as SPHARM-PDM does
  Maps,       // as the maps lie: they are registered already
};

/// "ends", "rotation", "ellipsoid", "maps".
std::string name_of(GroupStart start);

struct GroupOptions {
  GroupStart start = GroupStart::Ends;
  bool alike = false;  // shapes lie alike in space: Ends and Rotation are also judged by places
  /// Shapes may be mirror images, as right hands among left ones: each is also brought to the
  /// template as its own mirror image (`mirror_image`), and that is taken where it fits clearly
  /// better: by the energy beyond that of isometry, where one is minimised, else by the RMS
  /// distance of a shape from the template that is moved and scaled onto it; less than 0.9 times as
  /// much.
  bool mirror = false;
  bool hold = false;  // maps are only turned; else the distortion of shape → template is minimised
  int rounds = 1;     // ≥ 0: how often all are then brought to their mean
  /// Of the mean, of triangles; nothing: the template's own vertices and triangles.
  std::optional<GridSpec> grid = GridSpec{.kind = GridKind::Icosahedron, .size = 5};
  bool scale = false;  // shapes are brought to one size: the mean of theirs (`GroupMember::size`)
  int modes = 3;       // ≥ 0: at most so many are kept
  DistortionEnergy energy = {.kind = EnergyKind::SymmetricDirichlet};  // as in MatchOptions
  int threads = 0;  // 0: all cores. The result does not depend on it.
  Progress progress = {};
};

/// One shape of a group.
struct GroupMember {
  MappedMesh mapped;     // with its map moved into correspondence; its mirror image if `mirrored`
  MappedMesh resampled;  // on the grid, where it was; with what its vertices have but normals
  Points aligned;        // the resampled one's vertices, on the mean
  double size = 0;       // of the resampled one, whoever else is in the group: `surface_size`
  ProcrustesMotion motion;  // that brought them there
  /// What its way began with: "template", "rotation", "ellipsoid", "ends", "turn" where there were
  /// none, "places" nearest in space, "its map".
  std::string start;
  double energy = 0;  // of the last minimisation, a unit of area (`Match::energy`); 0: none
  /// In where its way began: of ends `Match::confidence`; of rotations 1 − (1 − c) / (1 − d), with
  /// c and d the correlations of the best position and the next; of ellipsoids as
  /// `FirstOrderAlignment`. 0: another is as good; 1: there is none, or a symmetry makes it as
  /// right.
  double confidence = 1;
  /// How far its own vertices are from the resampled shape, in their own directions: the mesh's
  /// unit; RMS weighted by area.
  double resampling_rms = 0, resampling_max = 0;
  std::vector<std::string> warnings = {};  // for people
  bool mirrored = false;                   // its mirror image was taken
};

/// What vertices of shapes have under one name, on the grid: floating numbers, not labels.
struct GroupScalar {
  std::string name;
  std::vector<size_t> shapes;  // those that have it, two at least
  VectorX mean, deviation;     // #V: of these; deviations are those of a sample, as the group's
};

/// Shapes in correspondence: vertex v of the mean is the same place on all.
struct Group {
  std::vector<GroupMember> members;  // in the order of the shapes
  MappedMesh reference;              // the template, with its map moved into correspondence
  MappedMesh mean;                   // on the grid, where and as the template lies
  VectorX weights;                   // of vertices: their mean share of the area
  ShapeModes modes;
  MatrixX distances;         // `procrustes_distances` of the aligned shapes, the mesh's unit
  VectorX deviation;         // #V: root of Σ |x − mean|² / (shapes − 1); 0 of one shape
  VectorX normal_deviation;  // #V: the same along the mean's normals
  int iterations = 0;        // of Procrustes
  std::vector<GroupScalar> scalars = {};  // in the order in which shapes have them
};

/// Brings shapes into correspondence, each to the template and then, so often as asked for, to the
/// mean of all, on the template's own triangles; resamples them on one grid; aligns them; and finds
/// what they have in common.
///
/// Every map is proved one-to-one, so every correspondence is, too: shape → sphere → mean. A shape
/// that is the template, or has a map that fits exactly, stays as it is.
/// Requires: at least one shape. Throws: std::invalid_argument if not, and for options;
/// NotCertifiedError where a map that is turned folds by rounding; UnmeasurableMesh; Cancelled.
/// Ensures: the same bits for any number of threads. Cost: about 0.1 ms a triangle and round;
/// with Ends some seconds more a shape. Source: our own, of the parts named where they are.
Group make_group(const std::vector<MappedMesh>& shapes, const MappedMesh& reference,
                 const GroupOptions& options = {});

/// The mean and so many standard deviations of a mode, on the grid, with the mean's map.
/// Throws: std::out_of_range for a mode that there is not.
MappedMesh group_shape(const Group& group, int mode, double deviations);

/// A member's shape on the mean, on the grid, with what `resampled` has; what points up and the
/// volume of FreeSurfer are those of the template, in whose coordinates it is.
/// Throws: std::out_of_range for no member.
MappedMesh aligned_shape(const Group& group, size_t member);

/// Where vertices of the template are on a member.
/// Throws: std::out_of_range for no member; std::invalid_argument for no vertices of it. Cost: a
/// location each.
std::vector<SurfacePoint> carried_to(const Group& group, size_t member,
                                     const std::vector<Vertex>& vertices);

}  // namespace sphparam
