#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "sphparam/mesh/triangle_mesh.h"

// Every option is asked whether it is in its domain before any work. All of these throw
// std::invalid_argument, which names the option, its value, and what it may be.

namespace sphparam {

/// "OPTION is VALUE: it must be WANTED".
[[noreturn]] void refuse_option(std::string_view option, double value, const std::string& wanted);

/// NaN is between nothing.
void require_between(std::string_view option, double value, double least, double greatest);

/// At least, and finite.
void require_at_least(std::string_view option, double value, double least);
void require_more_than(std::string_view option, double value, double bound);
void require_finite(std::string_view option, double value);

void require_vertex(std::string_view option, Vertex vertex, Eigen::Index vertex_count);
void require_vertices(std::string_view option, const std::vector<Vertex>& vertices,
                      Eigen::Index vertex_count);

/// For what was cast from a number. Requires: `last` is the last of the values, which begin at 0.
template <class Enum>
requires std::is_enum_v<Enum>
void require_one_of(std::string_view option, Enum value, Enum last) {
  require_between(option, static_cast<int>(value), 0, static_cast<int>(last));
}

}  // namespace sphparam
