#pragma once

#include <string_view>
#include <vector>

#include "sphparam/io/mesh_file.h"

namespace sphparam {

/// Whether a property of this name is a component of a normal, a colour or texture coordinates that
/// are there with all their components. One that is alone, "t" without "s", is a number like
/// others: a temperature, say.
bool is_of_whole_vector(std::string_view name, const std::vector<Property>& properties);

}  // namespace sphparam
