#pragma once

#include "arguments/words.h"
#include "console/session.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/io/vertex_data.h"

namespace sphparam::cli {

/// What becomes of columns that have values that are no finite numbers: mesh files hold none.
enum class MissingValues { Kept, LeftOut };

/// Reads the files that --data names, each word one or several with commas between, and makes them
/// properties of the mesh (`attach_data`); what they lose is told. No output may replace them from
/// now on. Throws: ReadError, also where the numbers of vertices differ; UsageMistake for more
/// columns than a mesh file holds.
void attach_data_files(MeshSource& source, const Words& words, MissingValues missing,
                       Session& session);

}  // namespace sphparam::cli
