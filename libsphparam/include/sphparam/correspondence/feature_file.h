#pragma once

#include <string>
#include <vector>

#include "sphparam/correspondence/match.h"
#include "sphparam/io/mesh_file.h"
#include "sphparam/io/read_options.h"

namespace sphparam {

/// Values at the vertices of a mesh, #V×k, as `MatchFeatures` takes them: the columns of a file of
/// numbers a vertex, in any format of `read_vertex_data`; or, where there is no such file, the
/// property of the mesh's vertices that is called so. Where vertices of the mesh's file were welded
/// or dropped, those that are left have the values of their numbers in it.
///
/// Throws: ReadError where there is neither, for another number of vertices, and for labels, which
/// are no measure: properties of whole numbers are such.
Functions read_features(const std::string& file_or_property, const MeshFile& mesh,
                        const ReadOptions& options = {});

/// Features of two meshes from pairs of such names, one of `from` and one of `to`: the columns of
/// all, in this order.
/// Throws: as above, also where one of a pair has more columns, or a column no two different
/// numbers; std::invalid_argument for an odd number of names.
MatchFeatures read_features(const std::vector<std::string>& pairs, const MeshFile& from,
                            const MeshFile& to, const ReadOptions& options = {});

}  // namespace sphparam
