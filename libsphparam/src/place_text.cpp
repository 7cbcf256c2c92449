#include "place_text.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "number_text.h"

namespace sphparam {

std::string place_text(const Vector3& place, double length, std::string_view between) {
  constexpr int digits = 6, most = std::numeric_limits<double>::max_digits10;
  const double far = place.cwiseAbs().maxCoeff() / length;
  const int more = far > 1 ? static_cast<int>(std::ceil(std::log10(std::min(far, 1e15)))) : 0;
  const auto text = [&](double x) { return short_number(x, std::min(digits + more, most)); };
  return joined({text(place.x()), text(place.y()), text(place.z())}, between);
}

}  // namespace sphparam
