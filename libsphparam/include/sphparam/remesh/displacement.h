#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/progress.h"
#include "sphparam/remesh/image_depth.h"
#include "sphparam/remesh/remesh.h"
#include "sphparam/remesh/subdivision.h"
#include "sphparam/remesh/texture_layout.h"

namespace sphparam {

constexpr std::int64_t most_texels = std::int64_t{1} << 28;

enum class DisplacementLayout {
  Equirectangular,
  Grid,  // of the control mesh's own grid: `texture_layout`
};

struct DisplacementOptions {
  int width = 4096, height = 2048;  // from 1; at most `most_texels` in all
  /// In that of a grid there are at most width·height texels, or one a vertex.
  DisplacementLayout layout = DisplacementLayout::Equirectangular;
  int threads = 0;  // 0: all cores
  Progress progress = {};
};

/// What is in an image of displacements, and how its texels came by their values.
struct DisplacementFigures {
  double least = 0, greatest = 0;     // in units of the mesh
  std::int64_t walked = 0, cast = 0;  // a point of the surface on the normal
  std::int64_t missed = 0;            // none near by: where the normal comes nearest to the surface
  std::int64_t inexact = 0;           // whose place on the base is that of the flat grid
};

/// Where a displacement is written. The depth, if none is given: 16 bits in .png, else float.
struct DisplacementFiles {
  std::string image;                     // .exr or .png
  std::optional<ImageDepth> depth = {};  // Uint16 for .png only, and there alone
  std::string rebuilt = {};              // a mesh, .ply or .obj; empty: none, and no proof
};

/// The mesh that a surface and its image give, and how far it and the surface alone are from the
/// mesh that the image was made of, both ways.
struct RebuildProof {
  struct Error {
    double rms = 0, max = 0;
  };
  std::int64_t vertices = 0, triangles = 0;
  bool certified = false;  // the directions of its vertices are a map of it
  Error base, rebuilt;
  double seconds = 0;
  /// The image does harm, by RMS: see `farther_warning`.
  bool farther_than_base() const { return rebuilt.rms > base.rms; }
};

/// What is told then.
inline constexpr char farther_warning[] =
    "--displace makes it worse: surface and image together are farther from the mesh than the "
    "surface alone";

struct WrittenDisplacement {
  int width = 0, height = 0;                 // of the image
  std::optional<TextureLayout> layout = {};  // nothing: equirectangular
  double scale = 1, midlevel = 0;            // height = (value in the file − midlevel)·scale
  DisplacementFigures figures = {};
  double seconds = 0;  // of the image
  std::optional<RebuildProof> proof = {};
};

/// Adds the image of what a fitted surface leaves of a mesh, and the mesh that is rebuilt from
/// surface and image as they were read back from the disk.
///
/// An equirectangular image: column c and row r are the direction θ = 2π(c + ½)/width,
/// ϕ = π(r + ½)/height. It holds the signed distance, in units of the mesh, from the surface's
/// point with that direction along its unit normal, outwards, to the mesh. The direction of a point
/// of the surface is that of the limit point which the grid's directions, as control points, have
/// there: smooth like the surface. Texts in the image say what it holds, of which base, and how.
///
/// In it coordinates u = θ/2π, v = ϕ/π (row 0 north) that are interpolated in straight lines over
/// faces are off by about an eighth of the square of a face's size in radians; near the poles by
/// more.
///
/// An image in the layout of the grid is what other programs take: subdivide a control mesh that
/// has the coordinates of `with_grid_texture` by its scheme to the limit surface, leave the
/// coordinates straight over its faces, and displace along the normal by (value − midlevel)·scale.
/// A vertex of up to `levels` subdivisions finds its own texel.
///
/// The rebuilt mesh is as fine as the image; its directions are its map, where that is one-to-one.
///
/// Requires: a fit on `control`'s grid. Throws: std::invalid_argument before any work for sizes
/// that are not as DisplacementOptions says, for names that are not as DisplacementFiles says, and
/// for the layout of a grid that has none; std::range_error where the depth cannot hold the
/// distances; ImageError; WriteError; UnmeasurableMesh where nothing of the mesh's area is left on
/// the grid; Cancelled. Ensures: the same bytes for any number of threads. Cost: some 0.1 µs a
/// texel, and 5 µs a triangle of the rebuilt mesh.
WrittenDisplacement add_displacement(PendingFiles& files, const DisplacementFiles& paths,
                                     const MappedMesh& source, const Remeshed& control,
                                     const SubdivisionFit& fit,
                                     const DisplacementOptions& options = {});

}  // namespace sphparam
