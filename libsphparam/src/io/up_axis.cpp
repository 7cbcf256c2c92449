#include "sphparam/io/up_axis.h"

#include <algorithm>

namespace sphparam {

Up up_axis(const MeshFile& file) {
  return std::ranges::find(file.comments, comment_of_y_up()) == file.comments.end() ? Up::Z : Up::Y;
}

std::string comment_of_y_up() { return "up axis y"; }

Vector3 direction_of(Up up) { return up == Up::Y ? Vector3::UnitY() : Vector3::UnitZ(); }

}  // namespace sphparam
