#include "place_text.h"

#include <limits>

#include "number_text.h"

namespace sphparam {

std::string place_text(const Vector3& place, double length, std::string_view between) {
  constexpr int digits = 6, most = std::numeric_limits<double>::max_digits10;
  int wanted = digits;
  for (double told = length; told < place.cwiseAbs().maxCoeff() && wanted < most; told *= 10)
    ++wanted;
  const auto text = [&](double x) { return short_number(x, wanted); };
  return joined({text(place.x()), text(place.y()), text(place.z())}, between);
}

}  // namespace sphparam
