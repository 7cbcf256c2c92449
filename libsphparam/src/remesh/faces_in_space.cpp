#include "sphparam/remesh/faces_in_space.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "mesh/box.h"
#include "mesh/triangle_geometry.h"
#include "number_text.h"
#include "place_text.h"
#include "rays/flat_normal.h"
#include "sphparam/parallel.h"
#include "sphparam/remesh/adaptation.h"

// Signs of crossings are exact, those of normals are not: near a right angle it makes no difference
// on which side of it one is.

namespace sphparam {
namespace {

constexpr std::int64_t grain = 4096;

/// Faces keep their numbers. Requires: some surface.
TriangleMesh surface_alone(const MappedMesh& mapped) {
  return mapped.fillers().empty() ? mapped.mesh()
                                  : surface_in_place(mapped.mesh(), mapped.fillers());
}

Vector3 normal_of(const TriangleMesh& mesh, Face f) {
  return flat_normal(mesh.position(mesh.triangles(f, 0)), mesh.position(mesh.triangles(f, 1)),
                     mesh.position(mesh.triangles(f, 2)));
}

double area_of(const TriangleMesh& mesh, Face f) {
  return triangle_area(mesh.position(mesh.triangles(f, 0)), mesh.position(mesh.triangles(f, 1)),
                       mesh.position(mesh.triangles(f, 2)));
}

/// Directions of the middles of faces, of any length.
Points middles(const MappedMesh& made) {
  const Triangles& triangles = made.mesh().triangles;
  const Points& rays = made.map().points;
  Points result(triangles.rows(), 3);
  for (Face f = 0; f < triangles.rows(); ++f)
    result.row(f) =
        rays.row(triangles(f, 0)) + rays.row(triangles(f, 1)) + rays.row(triangles(f, 2));
  return result;
}

/// Of what lies about each vertex, weighted by area.
Points normals_about(const TriangleMesh& mesh) {
  Points sums = Points::Zero(mesh.vertex_count(), 3);
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const Vector3 normal = area_of(mesh, f) * normal_of(mesh, f);
    for (int k = 0; k < 3; ++k) sums.row(mesh.triangles(f, k)) += normal;
  }
  return sums;
}

/// By face of `shape`, which is what is looked at of `made`.
FillerMarks turned_over(const MappedMesh& source, const MappedMesh& made, const TriangleMesh& shape,
                        int threads) {
  const std::vector<SurfacePoint> places = source.locator().locate_all(middles(made), threads);
  const Points about = normals_about(shape);
  FillerMarks marks(places.size());
  parallel_for(std::ssize(places), grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto f = static_cast<Face>(first); f < last; ++f) {
      const size_t i = static_cast<size_t>(f);
      const Vector3 normal = normal_of(shape, f);
      Vector3 around = Vector3::Zero();
      for (int k = 0; k < 3; ++k) around += about.row(shape.triangles(f, k));
      marks[i] = normal.dot(normal_of(source.mesh(), places[i].face)) < 0 && normal.dot(around) < 0;
    }
  });
  return marks;
}

double share_of_area(const TriangleMesh& mesh, const FillerMarks& marks) {
  double marked = 0, all = 0;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const double area = area_of(mesh, f);
    all += area;
    if (marks[static_cast<size_t>(f)]) marked += area;
  }
  return all > 0 ? marked / all : 0;
}

std::string concave_words(const FacesInSpace& found) {
  return counted(found.concave_quads, "quad is concave", "quads are concave") +
         " (a corner's Jacobian is negative)";
}

/// "3 pairs of triangles cross, the first about 1 2 3; 2 are turned over; 5 quads are concave"
std::string kinds(const FacesInSpace& found, const TriangleMesh& mesh) {
  const SelfCrossings& crossings = found.crossings;
  std::vector<std::string> words;
  if (crossings.pairs > 0)
    words.push_back((crossings.all ? "" : "at least ") +
                    counted(crossings.pairs, "pair crosses", "pairs cross") + ", the first at (" +
                    place_text(crossings.place, longest_side(mesh)) + ")");
  if (found.turned_over > 0)
    words.push_back(counted(found.turned_over, "is turned over", "are turned over"));
  if (found.concave_quads > 0) words.push_back(concave_words(found));
  return joined(words, "; ");
}

bool is_concave(const TriangleMesh& mesh, std::span<const int> quad) {
  const auto at = [&](size_t k) { return mesh.position(quad[k % 4]); };
  const Vector3 normal = (at(2) - at(0)).cross(at(3) - at(1));
  for (size_t k = 0; k < 4; ++k) {
    if ((at(k + 1) - at(k)).cross(at(k + 3) - at(k)).dot(normal) < 0) return true;
  }
  return false;
}

std::int64_t concave_quads(const MappedMesh& made) {
  if (!made.polygons()) return 0;
  const Polygons& faces = *made.polygons();
  const FillerMarks& fillers = made.fillers();
  std::int64_t count = 0;
  Face triangle = 0;  // the first that the polygon is cut into
  for (std::int64_t p = 0; p < faces.count(); triangle += faces.degree(p++) - 2) {
    const bool is_filler = !fillers.empty() && fillers[static_cast<size_t>(triangle)] != 0;
    if (faces.degree(p) == 4 && !is_filler) count += is_concave(made.mesh(), faces.polygon(p));
  }
  return count;
}

double longest_edge(const TriangleMesh& mesh) {
  double longest = 0;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const Vector3 side =
          mesh.position(mesh.triangles(f, k)) - mesh.position(mesh.triangles(f, (k + 1) % 3));
      longest = std::max(longest, side.norm());
    }
  }
  return longest;
}

double area_of(const TriangleMesh& mesh) {
  double area = 0;
  for (Face f = 0; f < mesh.face_count(); ++f) area += area_of(mesh, f);
  return area;
}

/// Twice the side of a triangle of the grid, if all were alike on the surface.
double fine_enough(const TriangleMesh& surface, const TriangleMesh& grid) {
  const double area = area_of(surface) / static_cast<double>(grid.face_count());
  return 2 * std::sqrt(4 / std::sqrt(3.0) * area);
}

/// Some thirty times longer than wide, if it is a rod: a map of one bends all along it, more where
/// its triangles are smaller.
bool is_long(const TriangleMesh& surface) {
  constexpr double long_squared = 10;  // of an area
  const double length = longest_side(surface);
  return length * length > long_squared * area_of(surface);
}

std::string what_helps(const FacesInSpace& found, const MappedMesh& source,
                       const MappedMesh& made) {
  if (is_adapted(source)) return "leave out --adaptive, under which what is flat has few vertices";
  const double enough = fine_enough(source.mesh(), made.mesh());
  return longest_edge(source.mesh()) > 1.1 * enough && !is_long(source.mesh())
             ? "a map bends at the sides of large triangles: map the mesh with --max-edge " +
                   short_number(enough, 2)
             : "on a finer grid, or with a smaller --lambda of the map, they are a smaller share "
               "of it";
}

/// "the mesh itself has 89 pairs that cross, "
std::string what_was_there(const FacesInSpace& found) {
  if (found.source_pairs == 0) return "";
  return "the mesh itself has " + counted(found.source_pairs, "pair", "pairs") + " that cross; ";
}

}  // namespace

FacesInSpace faces_in_space(const MappedMesh& source, const MappedMesh& made,
                            const SelfCrossingOptions& options) {
  if (made.surface().face_count() == 0) return {};
  const TriangleMesh shape = surface_alone(made);
  FacesInSpace found{.crossings = find_self_crossings(shape, options)};
  report(options.progress, "normals", 0);
  FillerMarks marks = turned_over(source, made, shape, options.threads);
  found.turned_over = std::ranges::count(marks, 1);
  for (size_t f = 0; f < found.crossings.marks.size(); ++f) marks[f] |= found.crossings.marks[f];
  found.faces = std::ranges::count(marks, 1);
  found.area_share = share_of_area(shape, marks);
  found.concave_quads = concave_quads(made);
  if (found.crossings.pairs > 0)
    found.source_pairs = find_self_crossings(surface_alone(source), options).pairs;
  return found;
}

std::string warning_of(const FacesInSpace& found, const MappedMesh& source,
                       const MappedMesh& made) {
  if (found.all_well()) return "";
  if (!found.crossings.none() && found.faces == 0)
    return made.name() + ": too many triangles are near one another to say whether any cross";
  if (found.faces == 0)
    return made.name() + ": of " + counted(made.polygons()->count(), "face", "faces") + " " +
           concave_words(found) + ": " + what_helps(found, source, made);
  return made.name() + ": " + std::to_string(found.faces) + " of " +
         counted(made.mesh().face_count(), "triangle", "triangles") + ", " +
         percent(found.area_share) + " of the area, cross others in space or lie inverted (" +
         kinds(found, made.mesh()) + "): what is proved is the map; " + what_was_there(found) +
         what_helps(found, source, made);
}

}  // namespace sphparam
