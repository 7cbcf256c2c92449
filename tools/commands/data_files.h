#pragma once

#include "arguments/words.h"
#include "console/session.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/io/vertex_data.h"

namespace sphparam::cli {

/// What becomes of columns that have values that are no finite numbers: mesh files hold none.
/// Refused: they are wanted in a file of their own, and a mesh file beside that has no place.
enum class MissingValues { Kept, LeftOut, Refused };

/// Reads the files that --data names, each word one or several with commas between, and makes them
/// properties of the mesh (`attach_data`); what they lose is told. No output may replace them from
/// now on. The last one is the `last_attached` of the mesh then, those before it count down from
/// there. Throws: ReadError, also where the numbers of vertices differ; UsageMistake for more
/// columns than a mesh file holds, and for refused ones.
void attach_data_files(MeshSource& source, const Words& words, MissingValues missing,
                       Session& session);

}  // namespace sphparam::cli
