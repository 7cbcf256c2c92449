#include "io/attributes/other_coordinates.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "io/formats/freesurfer_comments.h"
#include "sphparam/io/up_axis.h"

namespace sphparam {

void take_volume(MeshFile& file, const MeshFile& other) {
  std::erase_if(file.comments, is_of_volume);
  std::ranges::copy_if(other.comments, std::back_inserter(file.comments), is_of_volume);
}

void move_into(MeshFile& file, const MeshFile& other, Points positions) {
  file.mesh.positions = std::move(positions);
  file.position_type = ScalarType::Float64;
  take_up(file, other);
  take_volume(file, other);
  remove_properties(file.vertex_properties, {"nx", "ny", "nz"});
  file.corner_normals.reset();
  file.corner_tangents.reset();
}

}  // namespace sphparam
