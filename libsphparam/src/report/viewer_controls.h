#pragma once

#include <string_view>

namespace sphparam {

/// The style and the script of the page's own controls: see `add_viewer`.
std::string_view viewer_style();
std::string_view viewer_controls();

}  // namespace sphparam
