#include "arguments/centre_argument.h"

#include "arguments/words.h"
#include "sphere/body_centre.h"

namespace sphparam::cli {

const char centre_pattern[] = "X,Y,Z|centroid";
const char wanted_centre[] =
    "expected three numbers, as in 0,0,1.5, or centroid, that of what the mesh encloses, not ";

std::optional<Vector3> CentreArgument::of(const TriangleMesh& mesh) const {
  return is_centroid ? enclosed_centroid(mesh) : point;
}

bool read_centre(const std::string& text, CentreArgument& centre) {
  centre = {};
  centre.is_centroid = text == "centroid";
  if (centre.is_centroid) return true;
  const auto numbers = three_numbers(text);
  if (numbers) centre.point = Vector3(numbers->data());
  return numbers.has_value();
}

}  // namespace sphparam::cli
