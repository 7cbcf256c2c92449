#include "cli/diagonal.h"

#include "cli/wording.h"

namespace sphparam::tools {

double diagonal_of(const Points& points) {
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
}

std::string percent_of(double diagonal, double length) {
  return short_number(100 / diagonal * length) + " %";
}

}  // namespace sphparam::tools
