#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sphparam/io/mapped_mesh.h"
#include "sphparam/io/safe_file.h"
#include "sphparam/progress.h"
#include "sphparam/remesh/image_depth.h"
#include "sphparam/remesh/remesh.h"
#include "sphparam/remesh/sphere_grid.h"

namespace sphparam {

// A mesh on a grid as an image of its vertices: what each has, laid out as the grid says, so that
// the way back needs nothing else.
//
// octa:N: N×N samples. The northern half is the square turned by 45° in the middle, x to the right
// and y upwards; the southern half is folded out to the corners, which are −z. cube:N: six sides of
// (N + 1)×(N + 1) samples below one another, +x −x +y −y +z −z, each seen from outside. Samples on
// the cut occur twice or more, and name the same vertex.

/// Whether a grid can be laid flat so.
bool has_image_layout(const GridSpec& spec);

/// Adds the image of `what` each vertex has: "position", "normal", "color", or the name of a
/// property. The depth, if none is given: 16 bits in .png, else float; 16 bits hold the range from
/// the least to the greatest of each channel in 65,535 steps. Texts in the image name grid, depth,
/// `what`, range, and the type of a property, so that labels stay labels.
/// Ensures: what is decoded is the nearest that the depth can hold.
/// Throws: std::invalid_argument for a grid without an image layout, and for a name that is not
/// .exr for half and float, .png for 16 bits; NoSuchProperty; std::range_error where half (65,504)
/// or float has no such number, and where the depth does not tell labels apart; ImageError;
/// WriteError.
void add_geometry_image(PendingFiles& files, const std::string& path, const Remeshed& mesh,
                        const std::string& what, std::optional<ImageDepth> depth = {});

struct GeometryImageFiles {
  std::string positions;
  std::string normals = {};                                          // empty: none
  std::vector<std::pair<std::string, std::string>> attributes = {};  // name and path of each
};

/// The mesh that such images were made of, with its map, the directions of the grid. Properties of
/// whole numbers are such again, in the type that the mesh had; of an image that does not say it,
/// colours that are whole numbers from 0 to 255 are bytes, others floats. `warnings`, where given,
/// gets a line where those may be labels.
/// Throws: ImageError for what is no image of positions, for attributes of another grid, for an
/// image whose texts name another thing than it is given as, and where samples of one vertex
/// differ, as the image was changed on one side of its cut; NotCertifiedError; Cancelled.
Remeshed load_geometry_image(const GeometryImageFiles& files, int threads = 0,
                             const Progress& progress = {},
                             std::vector<std::string>* warnings = nullptr);

}  // namespace sphparam
