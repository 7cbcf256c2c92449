#pragma once

#include <string>
#include <string_view>

namespace sphparam {

/// What the folder of a shape's results is called, on every file system and in every shell without
/// quotes: letters of any alphabet (as UTF-8), digits, '.', '_' and '-', no '.' or '-' at first,
/// and at most 100 bytes, as others come behind it in names of files.
bool is_shape_id(std::string_view text);

/// An id of any text, the same for the same: '_' stands for each character that is none of those,
/// and a hash of the text for the end of what is too long.
std::string shape_id_of(std::string_view text);

/// The same with a hash of the text at its end.
std::string shape_id_with_hash(std::string_view text);

}  // namespace sphparam
