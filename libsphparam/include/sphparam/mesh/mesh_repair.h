#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "sphparam/mesh/fillers.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/mesh/surface_point.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// The component to keep is beyond those the mesh has.
class NoSuchComponent : public std::out_of_range {
 public:
  using std::out_of_range::out_of_range;
};

/// Which of the two loops of a handle it is cut along, or the other where it has none such. The
/// mug's: about the handle, with a cap through the clay, or about the hole, with one through air.
enum class HandleChoice {
  Shortest,  // whichever is shorter
  Cut,       // handles are cut through, what is between them stays open
  Fill,      // what goes through them is closed, the handles stay
  Area,      // whichever has the smaller caps
};

/// What `repair_mesh` may do. The names, in the order in which it is done:
struct RepairOptions {
  bool non_finite = true;  // drop vertices whose coordinates are no finite numbers, and their faces
  bool duplicates = true;  // remove faces that name a vertex twice, and copies of faces
  bool cracks = true;      // join boundary vertices that rounding tears, split edges where some lie
  bool orientation = true;   // orient faces alike, by majority; the closed surface outward
  bool non_manifold = true;  // give each sheet its own copy of the edges and vertices it shares
  bool components = true;    // keep one component, where that loses no more than specks
  bool holes = true;         // fill holes
  bool handles = true;       // of closed surfaces: cut along short loops, and close the two holes
  bool flat_faces = true;    // turn or collapse faces without area where the surface stays a sphere
  bool unused = true;        // drop vertices that no face uses

  /// Which to keep, whatever its share: 1 is the one with the largest area, 2 the next, …
  /// 0: the largest, if it has `least_kept` of the area of all; else none is dropped.
  int component = 0;
  double least_kept = 0.98;
  int largest_hole = 500;  // edges of a hole that may be filled
  /// With `holes`: all holes, of any length, are closed by fillers, which are no part of the
  /// surface: see `RepairedMesh::fillers`.
  bool keep_holes = false;
  HandleChoice handle_choice = HandleChoice::Shortest;
  /// Not negative: boundary vertices that are at most so far apart become one, and edges are split
  /// at vertices that lie so near (with `cracks`); in diagonals of the box about the vertices that
  /// faces use, or a length of the mesh instead where `weld_length` is not negative.
  double weld_share = -1, weld_length = -1;
  /// The longest loop that a handle may be cut along, in diagonals of the bounding box of the part
  /// that it is in; a length of the mesh instead where `longest_handle_length` is more than 0.
  double longest_handle = 0.35;
  double longest_handle_length = 0;
  /// More than 0: at last, edges of a closed surface that are longer are halved until none is; in
  /// diagonals of the box about it, or a length of the mesh instead where `edge_length` is more
  /// than 0. The surface stays what it is: a map has room to bend within its large faces.
  double edge_share = 0, edge_length = 0;
  /// Ends where no component is large enough (`parts.refused`): whatever follows, several stay.
  bool only_whole = false;

  /// Nothing at all is wanted; then single ones are switched on.
  static RepairOptions none() {
    return {.non_finite = false,
            .duplicates = false,
            .cracks = false,
            .orientation = false,
            .non_manifold = false,
            .components = false,
            .holes = false,
            .handles = false,
            .flat_faces = false,
            .unused = false};
  }
};

enum class RepairKind {
  NonFiniteFaceRemoved,    // one of its vertices has no place
  NonFiniteVertexDropped,  // it had none
  InvalidFaceRemoved,      // it named a vertex twice, or one that is not there
  DuplicateFaceRemoved,
  VertexWelded,       // onto another one that was near
  EdgeSplitAtVertex,  // a boundary edge, at a vertex that lay on it
  FaceTurned,         // to run the same way as its neighbours
  EdgeSplit,          // shared by several sheets; each got its own
  DiagonalTurned,     // two sheets had the same edge between the same vertices
  EdgeMidpointAdded,  // the same, where no diagonal was free
  VertexSplit,        // one copy for each fan of faces
  ComponentDropped,
  HoleFilled,
  HoleKept,           // closed by fillers, which are marked
  HandleCut,          // along a loop about the handle: both ends closed
  HandleFilled,       // along a loop about what goes through it: closed on both sides
  TurnedOutward,      // the whole surface was inside out
  FlatFaceTurned,     // with its neighbour across its longest edge
  FlatFaceCollapsed,  // two vertices at the same place became one
  UnusedVertexDropped,
  EdgeHalved,  // it was longer than was asked for
};

/// What the ids of an action name; edges have two.
enum class RepairPlace { Faces, Vertices, Edges };
RepairPlace place_of(RepairKind kind);

/// One kind of action, all its places.
struct RepairAction {
  RepairKind kind;
  long count = 0;
  std::vector<int> elements;  // ids in the input of the first places (−1: not of the input)
  std::string message;        // "1 vertex split, one copy for each fan of faces: vertices 253"
};

/// The message of an action, for instance after its ids were renamed.
std::string describe(const RepairAction& action);

/// A vertex of the input, and how much it weighs in a mean.
struct WeighedVertex {
  Vertex vertex;
  double weight;

  bool operator==(const WeighedVertex&) const = default;
};

/// A vertex that the input does not have: the mean of some of the input's, by their weights.
struct CreatedVertex {
  Vertex vertex;
  std::vector<WeighedVertex> mean_of;
};

/// A corner that the input does not have: on a side of a face that was split. What corners carry is
/// there the mean of that face's.
struct BlendedCorner {
  int corner;            // of the mended mesh, 3·face + k
  SurfacePoint between;  // in the input; its weights are of corners
};

/// A component, as it was when one of them was to be kept. Shares are of all of them; of a mesh
/// without area, those of the faces stand for it.
struct SurfacePart {
  double area_share = 1;
  double face_share = 1;
  long faces = 0;
  Vertex vertex = -1;  // the one with the lowest id in the input
};

/// What choosing a component kept of the surface.
struct KeptParts {
  long count = 0;                    // of components there were; 0: there was nothing to choose
  std::vector<SurfacePart> largest;  // the first of them, by area: those that can be asked for
  bool refused = false;   // none was dropped: the largest has too small a share of the area
  double area_share = 1;  // kept, over all rounds
  double face_share = 1;
};

/// A loop of edges that the surface was cut along, to be rid of a handle.
struct HandleLoop {
  bool filled = false;    // its caps go through air; else through what the surface encloses
  double length = 0;      // in units of the mesh
  double share = 0;       // the same in diagonals of the box about its part
  double area_added = 0;  // of both caps
  long crossings = 0;     // pairs of triangles, of a cap and of the surface, that cross
  Vector3 centre = Vector3::Zero();  // mean of its points
  std::vector<Vertex> vertices;      // in order, ids in the input; −1 for created ones
  std::vector<Vector3> points;       // theirs
};

/// The mended mesh, and where everything in it comes from.
struct RepairedMesh {
  TriangleMesh mesh;
  std::vector<Vertex> vertex_origin;   // #V: id in the input, −1 for created ones
  std::vector<Face> face_origin;       // #F: id in the input, −1 for faces that fill holes
  std::vector<int> corner_origin;      // #F·3: corner 3·face + k of the input that it is like
  std::vector<BlendedCorner> blended;  // by corner
  std::vector<CreatedVertex> created;  // by vertex
  FillerMarks fillers;                 // that close holes that are kept
  std::vector<RepairAction> actions;   // in the order of RepairKind; empty: nothing was done
  KeptParts parts;
  std::vector<HandleLoop> handles;  // one for each that is gone, in the order of the cuts
  long largest_hole_left = 0;  // edges of the largest hole that the limit alone kept open; or 0
  /// The shortest loop that the limit kept from being cut, in diagonals of the box about its part;
  /// or 0. What comes after it may be longer.
  double shortest_handle_left = 0;
  MeshInspection inspection;  // of `mesh`; `is_sphere()` tells whether it can be mapped
};

/// Mends what can be mended with little change to what the surface is: faults of files, of
/// modelling programs and of segmentations. What is one-sided, or has large handles, stays so:
/// `inspection` says it.
///
/// The order is that of the options; it is gone through until a round does nothing, but that
/// vertices without a place are dropped and cracks are closed once, before all else. Mended once, a
/// mesh is mended: a closed surface comes back as it is.
///
/// Vertices keep their order, copies and created ones come last; faces keep theirs, those that fill
/// holes come last. A mesh without defects is returned as it is, with the same ids. Non-manifold
/// edges are cut apart and their sheets paired across the material between them (Guéziec, Taubin,
/// Lazarus & Horn, "Cutting and stitching", 2001); holes are filled by ears, or by the fan of a
/// created vertex where every ear would double an edge. Repeated until nothing more is to be done.
/// Holes that are kept are closed by rings of created vertices, each of half as many as the one
/// before: O(n) faces, none of them long, whatever the boundary is like. No other step touches the
/// surface for their sake: nothing is turned outward where they are over 0.4 of the area, no flat
/// filler is mended, and loops of handles keep to the surface where they can.
/// Handles: loops that do not separate the surface, the shortest found first (a basis of loops by
/// tree and cotree, Eppstein 2003; each shorter one crosses one of these, so searches begin there;
/// which loops separate is told by random cohomology classes), each tightened until no vertex of it
/// has a shorter one of its class; the faces beside it get copies of its vertices, and both rims
/// get caps, bent apart and out of the surface's way. No position changes, and no face but its
/// names. Components are ranked by area; of equal ones the one with more faces comes first, then
/// the one with the lowest vertex. Long edges are halved where they are the longest of both of
/// their faces (Rivara 1997), so that the least angle stays at least half of what it was.
///
/// Throws: NoSuchComponent; std::range_error where edges are to be so short that faces could not be
///         numbered; std::invalid_argument unless component ≥ 0, least_kept from 0 to 1,
///         largest_hole ≥ 3, and longest_handle, longest_handle_length, edge_share, edge_length ≥
///         0, or where a weld is NaN.
/// Ensures: deterministic. Cost: O((#V + #F) log #F), for any valence and any hole, #F of the
///          result; about that again for each doubling of the length of handles, on all cores.
RepairedMesh repair_mesh(const TriangleMesh& mesh, const RepairOptions& options = {});

}  // namespace sphparam
