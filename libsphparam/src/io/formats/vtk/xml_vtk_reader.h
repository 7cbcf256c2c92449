#pragma once

#include <string>
#include <string_view>

#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

/// True when XML starts with VTK's root element.
bool looks_like_xml_vtk(std::string_view bytes);

/// Reads an XML polydata of VTK (.vtp): data as text, base64 or appended, this raw or base64,
/// packed by zlib or not, in either byte order; several pieces become one mesh.
///
/// Kept and told as `read_legacy_vtk` does; arrays that not all pieces have are told as not
/// carried. Refused by name: other kinds of data (.vtu, .vti, …), other compressors.
/// Throws: ReadError with the line.
MeshFile read_xml_vtk(std::string_view bytes, const std::string& name,
                      const ReadOptions& options = {});

}  // namespace sphparam
