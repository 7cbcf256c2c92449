#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sphparam/group/group.h"
#include "sphparam/group/template_landmarks.h"
#include "sphparam/io/mesh_source.h"
#include "sphparam/measure/growth.h"

namespace sphparam {

/// What repairs did to a shape before it was mapped; `MeshSource` says what is what.
struct MendedShape {
  std::vector<RepairAction> repairs = {};  // none: it stayed as it was
  KeptParts parts = {};
  std::vector<HandleLoop> handles = {};
  double added_share = 0;
  std::string added = {};  // `added_line`
};
MendedShape what_was_mended(const MeshSource& source);

/// A group as it is told. References are to values that outlive the record.
struct GroupRecord {
  const Group& group;
  const GroupOptions& options;
  std::vector<std::string> files;  // of the shapes
  std::vector<std::string> names;  // of the shapes, each its own; see `names_of_shapes`
  std::vector<bool> mapped_now;    // of the shapes: no file had its map
  std::string reference;           // the template's file
  std::vector<TemplateLandmark> landmarks = {};
  std::vector<MendedShape> mended = {};              // of the shapes; empty: none was
  std::optional<MendedShape> reference_mended = {};  // of a template that is none of the shapes
  std::vector<std::string> outputs = {};             // names in the folder
  double seconds = 0;
};

/// What shapes are called: their files' names without folders and endings, "SUBJECT_lh_white" of
/// SUBJECT/surf/lh.white; where several have one name, "name_2" and so on.
std::vector<std::string> names_of_shapes(const std::vector<std::string>& files);

/// As `sphparam group` writes it to group.json.
std::string to_json(const GroupRecord& record);

// Tables, with tabs between; numbers come back exactly.

/// A row a shape: how it was brought (no energy where nothing was minimised), its size, its
/// distance from the mean, scores of the modes, what was mended of it, by kind and count, as a
/// batch tells it, and its file.
std::string shapes_table(const GroupRecord& record);
/// Distances of each two shapes.
std::string distances_table(const GroupRecord& record);
/// A row a vertex of the mean: where it is, how much shapes differ there, what the modes do there
/// along the normal; `Group::scalars`.
std::string vertices_table(const GroupRecord& record);
/// A row a shape and landmark: where it is on the shape, in its file's coordinates, its triangle
/// and weights of the corners, and the vertex of the file that is nearest to it in space, by its
/// number there; −1 where repair left none. Cost: a pass over the vertices each.
std::string landmarks_table(const GroupRecord& record);

/// What the files of a group call a number that shapes carry: by its name, but "growth_carried"
/// where a group writes a column of that name itself: normal (whose deviation would be
/// normal_deviation), normal_displacement, growth. No two are called alike.
std::string carried_name(const Group& group, const std::string& name);

/// "ico:5", or "template".
std::string grid_name(const GroupOptions& options);

/// RMS distance of a member's aligned shape from the mean, weighted; the mesh's unit.
double distance_from_mean(const Group& group, size_t member);
/// How areas grow from the mean to it.
Growth growth_from_mean(const Group& group, size_t member);
/// Of all members' distances together: the root of the mean of the squares of the distances.
double rms_distance_from_mean(const Group& group);
/// Of the shapes' sizes, to which `GroupOptions::scale` brings them.
double mean_size(const Group& group);
/// `surface_size` of the mean, which is less where shapes differ: what distances are held against.
double size_of_mean(const Group& group);

/// For people.
std::string to_text(const GroupRecord& record);
std::vector<std::string> mode_lines(const GroupRecord& record);
/// What was done to meshes before they were mapped, a line a mesh with its name: each repair, what
/// choosing a component kept, what was put in.
std::vector<std::string> mended_lines(const GroupRecord& record);
/// What is to be looked at, each with the shape's name: what was told of each, and shapes whose
/// energy is far above the others'; of `Group::scalars` which shapes are without; and which numbers
/// are called otherwise (`carried_name`).
std::vector<std::string> group_warnings(const GroupRecord& record);

}  // namespace sphparam
