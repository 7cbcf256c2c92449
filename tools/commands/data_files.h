#pragma once

#include "arguments/words.h"
#include "console/session.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/io/vertex_data.h"

namespace sphparam::cli {

/// What becomes of columns that have values that are no finite numbers: mesh files hold none.
/// Refused: they are wanted in a file of their own, and a mesh file beside that has no place.
enum class MissingValues { Kept, LeftOut, Refused };

/// Reads the files that --data names, each word one or several with commas between, and makes them
/// properties of the mesh (`attach_data`); what they lose is told. No output may replace them from
/// now on. The last one is the `last_attached` of the mesh then, those before it count down from
/// there. Data of the other hemisphere is told. `surface`: the name of the mesh's file. Returns the
/// properties, of all files. Throws: ReadError, also where the numbers of vertices differ;
/// UsageMistake for more columns than a mesh file holds, and for refused ones.
std::vector<std::string> attach_data_files(MeshFile& file, const std::string& surface,
                                           const Words& words, MissingValues missing,
                                           Session& session);

}  // namespace sphparam::cli
