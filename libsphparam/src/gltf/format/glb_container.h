#pragma once

#include <string>

namespace sphparam {

/// A .glb: header, a chunk of JSON padded by blanks, a chunk of bytes. glTF 2.0, Section 4.
/// Requires: the bytes are a multiple of 4. Throws: std::length_error where it has 4 GiB or more.
std::string glb_container(std::string json, const std::string& bytes);

}  // namespace sphparam
