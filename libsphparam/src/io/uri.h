#pragma once

#include <string>
#include <string_view>

namespace sphparam {

/// "data:MIME;base64,…"
std::string data_uri(std::string_view mime, std::string_view bytes);

/// The name of a file in the same folder as a relative URI: whatever is no letter, digit, or one of
/// - . _ ~ is written with percent signs.
std::string uri_of_file(std::string_view name);

}  // namespace sphparam
