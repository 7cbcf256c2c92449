#include "sphparam/io/shape_change.h"

#include <cmath>
#include <vector>

#include "io/shell_word.h"
#include "mesh/box.h"
#include "mesh/enclosed_volume.h"
#include "mesh/face_sides.h"
#include "mesh/flat_face.h"
#include "number_text.h"
#include "sphparam/io/fillers.h"

// The numbers that a mended file keeps say what was there before: faces and vertices that have one.
// Copies of a vertex have the same, so that what was closed before a cut is so by these numbers.

namespace sphparam {
namespace {

constexpr double least_told = 1e-6;  // of the volume, of the diagonal
constexpr int digits = 6;

/// The faces that were there, by the numbers that their vertices had.
struct FormerFaces {
  std::vector<Face> faces;
  Triangles by_number;
  bool all_have_numbers = true;
};

FormerFaces former_faces(const TriangleMesh& mesh, const Property& of_faces,
                         const Property& of_vertices) {
  FormerFaces former;
  for (Face f = 0; f < static_cast<Face>(mesh.face_count()); ++f)
    if (of_faces.values[static_cast<size_t>(f)] >= 0) former.faces.push_back(f);
  former.by_number.resize(std::ssize(former.faces), 3);
  for (size_t i = 0; i < former.faces.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const Vertex v = mesh.triangles(former.faces[i], k);
      const auto number = static_cast<Vertex>(of_vertices.values[static_cast<size_t>(v)]);
      former.by_number(static_cast<Eigen::Index>(i), k) = number;
      former.all_have_numbers = former.all_have_numbers && number >= 0;
    }
  }
  return former;
}

/// Whether faces run along each edge as often one way as the other.
bool is_closed(const Triangles& triangles) {
  bool closed = true;
  const std::vector<FaceSide> sides = sorted_sides(triangles, [](Face) { return true; });
  for_each_edge(sides, [&](size_t i, size_t j) {
    long ways = 0;
    for (size_t s = i; s < j; ++s) ways += sides[s].forward ? 1 : -1;
    closed = closed && ways == 0;
  });
  return closed;
}

Box box_about(const TriangleMesh& mesh, const std::vector<Face>& faces) {
  Box box;
  for (const Face f : faces)
    for (const Vertex v : mesh.triangles.row(f)) box.add(mesh.position(v));
  return box;
}

double volume_of(const TriangleMesh& mesh, const std::vector<Face>& faces, const Vector3& centre) {
  double six = 0;
  for (const Face f : faces) {
    const auto corner = [&](int k) -> Vector3 {
      return mesh.position(mesh.triangles(f, k)) - centre;
    };
    six += corner(0).dot(corner(1).cross(corner(2)));
  }
  return six / 6;
}

std::string volume_words(const ShapeChange& change) {
  if (!change.volume || !change.volume_before) return "";
  const double more = *change.volume - *change.volume_before;
  const double share = std::abs(more / *change.volume_before);
  if (!(share > least_told)) return "";
  return "the volume is " + short_number(*change.volume, digits) + " and was " +
         short_number(*change.volume_before, digits) + " (" + percent(share) +
         (more * *change.volume_before > 0 ? " more)" : " less)");
}

std::string box_words(const ShapeChange& change) {
  const double least = least_told * (change.upper - change.lower).norm();
  std::vector<std::string> axes;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = change.lower_before[axis], high = change.upper_before[axis];
    if (!(low - change.lower[axis] > least || change.upper[axis] - high > least)) continue;
    axes.push_back(std::string(1, "xyz"[axis]) + " was from " + short_number(low, digits) + " to " +
                   short_number(high, digits) + " and is from " +
                   short_number(change.lower[axis], digits) + " to " +
                   short_number(change.upper[axis], digits));
  }
  return axes.empty() ? "" : "what was put in leaves the bounding box: " + joined(axes);
}

}  // namespace

std::optional<ShapeChange> shape_change(const MeshSource& mended) {
  const MeshFile& file = mended.file;
  const Property* const of_faces = file.find_face_property("source_face");
  const Property* const of_vertices = file.find_vertex_property("source_vertex");
  if (mended.repairs.empty() || !of_faces || !of_vertices || !fillers_of(file).empty())
    return std::nullopt;
  const FormerFaces former = former_faces(file.mesh, *of_faces, *of_vertices);
  if (former.faces.empty() || std::ssize(former.faces) == file.mesh.face_count())
    return std::nullopt;
  const Box before = box_about(file.mesh, former.faces), now = surface_box(file.mesh);
  ShapeChange change{.lower_before = before.lower,
                     .upper_before = before.upper,
                     .lower = now.lower,
                     .upper = now.upper};
  if (former.all_have_numbers && is_closed(former.by_number))
    change.volume_before = volume_of(file.mesh, former.faces, before.lower / 2 + before.upper / 2);
  if (mended.topology) change.volume = mended.inspection.volume;
  return change;
}

std::string shape_line(const MeshSource& mended) {
  const std::optional<ShapeChange> change = shape_change(mended);
  if (!change) return "";
  const std::string volume = volume_words(*change), box = box_words(*change);
  return volume + (volume.empty() || box.empty() ? "" : "; ") + box;
}

std::string hollow_line(const MeshSource& source) {
  constexpr double nothing = 1e-6;  // a cortex has 0.01
  if (!source.topology || !has_area(source.file.mesh) || !fillers_of(source.file).empty())
    return "";
  const double share = enclosed(source.file.mesh);
  if (!(std::abs(share) <= nothing)) return "";
  return "it encloses nothing: two sheets that lie on one another; `sphparam wrap " +
         shell_file(source.path) +
         " -o wrapped.ply` makes a body of it, twice its --distance LENGTH thick";
}

}  // namespace sphparam
