#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sphparam/bake/body.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/texture/texture_options.h"

namespace sphparam {

/// What may be asked of fields.
struct FieldOptions {
  TextureFilter filter = TextureFilter::Bilinear;  // how textures are magnified
  bool normal_y_down = false;  // normal-tangent for DirectX; else for OpenGL and glTF
  bool height_radial = false;  // distance from the origin; else along the target's normal
  // Distortion, curvature and scalars as colours instead of numbers: of scalars those that pictures
  // of the mesh have (`DrawingOptions::scalar`), labels too, over the same range.
  bool heat = false;
  int rays = 64;                  // a sample, of ao, bent and thickness: 1 to 65536
  double max_ray_distance = 0.1;  // of ao and bent, in diagonals of the bounding box: positive
  // Of scalars that measure, in integers: what 0 and the greatest one stand for, and of heat the
  // ends of the scale, so that images of several meshes or times can be compared. Numbers beyond
  // end there, which is told. None: the least and the greatest of the mesh's own; of heat its 2nd
  // and 98th percentile.
  std::optional<std::pair<double, double>> scalar_range = {};
  // Of lon, lat, radius, slope and elevation: the body's centre, in the mesh's coordinates; none:
  // that of a radial map, else the origin.
  std::optional<Vector3> centre = {};
  bool positive_west = false;     // longitudes grow to the west
  std::optional<Body> body = {};  // what elevations are above, and what images say they lie on
};

/// A kind of field that can be baked.
struct FieldInfo {
  std::string name;             // "position"; with an argument "scalar:NAME"
  std::string about;            // one line
  bool takes_argument = false;  // after a colon
};

/// All kinds, in the order in which they are listed; test images, which are drawn, are not among
/// them.
std::vector<FieldInfo> all_fields();

/// The channels that viewers take, as fields: base colour, normal-tangent, orm, emissive.
const std::vector<std::string>& all_channels();

/// Those of `all_channels` that a mesh has something to say of by its materials or colours; baked
/// on another mesh, also by its normals.
std::vector<std::string> channels_of(const MeshFile& file, bool on_another_mesh = false);

/// "axes", "checker" and "graticule": images that show how the sphere lies on a mesh.
std::vector<std::string> test_image_names();

/// Whether a name may be asked for, judged before any mesh is there: that of a field, or of a test
/// image. Throws: FieldError.
void require_field_name(const std::string& name);

/// A field that cannot be made of a mesh, or whose name nobody knows. Says what would help.
class FieldError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  /// `unknown` is the name that is not among `known`: whoever talks to the user may suggest one.
  FieldError(const std::string& message, std::string unknown, std::vector<std::string> known)
      : std::runtime_error(message), unknown_(std::move(unknown)), known_(std::move(known)) {}

  const std::string& unknown() const { return unknown_; }  // empty: it is no matter of names
  const std::vector<std::string>& known() const { return known_; }

 private:
  std::string unknown_;
  std::vector<std::string> known_;
};

/// The base colour of a mesh that has none: a texture would help.
class NoColoursError : public FieldError {
 public:
  using FieldError::FieldError;
};

}  // namespace sphparam
