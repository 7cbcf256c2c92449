#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "sphparam/io/mesh_file.h"
#include "sphparam/mesh/triangle_mesh.h"

namespace sphparam {

/// How a mesh is to be stood up, in its own coordinates: what points up, and what looks at who sees
/// it. Finite vectors that are not 0, of any length; nothing: as its file says.
struct Up {
  std::optional<Vector3> direction = std::nullopt;
  std::optional<Vector3> front = std::nullopt;  // only its part across `direction` counts

  bool operator==(const Up&) const = default;
};

/// How a mesh stands: unit vectors at right angles. Exact where the mesh stands along its axes.
struct UprightAxes {
  Vector3 up, front;

  Vector3 right() const { return up.cross(front); }  // of who sees it, when it looks at them
};

/// What should be the front points straight up or down. The message names both.
class FrontError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What is asked for, else what the file says (comments "up axis y", "front axis -x", which glTF
/// brings and `note_up` makes), else z is up. The front, where nobody speaks of it or what the file
/// says of it lies along another up: −y; where up lies nearest to ±y, z. So glTF and what is
/// modelled for z up look at us. Throws: FrontError for a front that is asked for and is not across
/// what is up; std::invalid_argument for vectors that are none.
UprightAxes upright_axes(const MeshFile& file, const Up& wanted = {});

/// The rows are right, up, front: turns the mesh as glTF has it, y up and z in front.
Eigen::Matrix3d upright_rotation(const UprightAxes& axes);

/// Writes into the comments of a file what is asked for, instead of what they said of that.
void note_up(MeshFile& file, const Up& wanted);

/// What the comments of another file say of it, instead of what they said.
void take_up(MeshFile& file, const MeshFile& other);

/// What a file says of it itself; nothing where it says nothing.
Up noted_up(const MeshFile& file);

/// x, -x, y, -y, z or -z, or three numbers with commas between, as a unit vector; nothing for other
/// words and for 0,0,0.
std::optional<Vector3> direction_named(const std::string& text);

/// The shortest words that `direction_named` reads as this.
std::string name_of_direction(const Vector3& direction);

}  // namespace sphparam
