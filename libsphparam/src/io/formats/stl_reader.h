#pragma once

#include <string>
#include <string_view>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

/// True when the length is what the triangle count of a binary STL asks for. Binary files that
/// start with "solid" exist, so this is asked first; no text can be taken for one.
bool looks_like_binary_stl(std::string_view bytes);

/// True when the text starts with the word `solid`.
bool looks_like_ascii_stl(std::string_view bytes);

/// One or the other.
bool looks_like_stl(std::string_view bytes);

/// Reads an STL file, ASCII or binary.
///
/// Corners of the same coordinates (−0 = +0, never by a tolerance) are one vertex, in the order of
/// first use. A facet that then names a vertex twice stays, `inspect_mesh` lists it. Facet normals
/// are not kept, nor need they be finite: they follow from the corners. What comes after the last
/// triangle is noted, but of a binary file refused where it is whole triangles that its count
/// leaves out. Kept: the face property `solid` where an ASCII file has several, `attribute` (two
/// bytes a facet) where a binary file uses them, names and header as comments. Where the two bytes
/// are colours, by the convention of VisCAM and SolidView or by that of Magics, faces have `red`,
/// `green` and `blue` as well; those without are white (noted), or as the header of Magics says.
/// Throws: ReadError with the line, or with the byte. Cost: O(triangles), expected.
MeshFile read_stl(std::string_view bytes, const std::string& name, const ReadOptions& options = {});

}  // namespace sphparam
