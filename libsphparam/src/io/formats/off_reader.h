#pragma once

#include <string>
#include <string_view>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

/// True when the text starts, after blanks and comments, with a keyword of the OFF family.
bool looks_like_off(std::string_view text);

/// Reads an OFF file with the prefixes ST, C and N in any combination: one vertex and one face a
/// line, counts on the first line or the next one.
///
/// Kept: vertex normals, colours (whole numbers 0–255 as Uint8, else Float32) and texture
/// coordinates s t; face colours where every face has one. Files whose vertices lack what the
/// keyword promises are read without it, other numbers after a face are ignored; both are noted.
/// Refused by name: 4OFF, nOFF and binary OFF.
/// Throws: ReadError with the line.
MeshFile read_off(std::string_view text, const std::string& name, const ReadOptions& options = {});

}  // namespace sphparam
