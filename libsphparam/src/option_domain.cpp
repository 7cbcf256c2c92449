#include "option_domain.h"

#include <cmath>
#include <stdexcept>

#include "number_text.h"

namespace sphparam {

void refuse_option(std::string_view option, double value, const std::string& wanted) {
  throw std::invalid_argument(std::string(option) + " is " + shortest(value) + ": it must be " +
                              wanted);
}

void require_between(std::string_view option, double value, double least, double greatest) {
  if (value >= least && value <= greatest) return;
  refuse_option(option, value, "from " + shortest(least) + " to " + shortest(greatest));
}

void require_at_least(std::string_view option, double value, double least) {
  if (value >= least && std::isfinite(value)) return;
  refuse_option(option, value, "a finite number, at least " + shortest(least));
}

void require_more_than(std::string_view option, double value, double bound) {
  if (value > bound && std::isfinite(value)) return;
  refuse_option(option, value, "a finite number above " + shortest(bound));
}

void require_finite(std::string_view option, double value) {
  if (!std::isfinite(value)) refuse_option(option, value, "finite");
}

void require_vertex(std::string_view option, Vertex vertex, Eigen::Index vertex_count) {
  if (vertex >= 0 && vertex < vertex_count) return;
  refuse_option(option, vertex,
                "a vertex, from 0 to " + shortest(static_cast<double>(vertex_count - 1)));
}

void require_vertices(std::string_view option, const std::vector<Vertex>& vertices,
                      Eigen::Index vertex_count) {
  for (const Vertex v : vertices) require_vertex(option, v, vertex_count);
}

}  // namespace sphparam
