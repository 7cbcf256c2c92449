#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sphparam/io/mesh_file.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/parameterize.h"

namespace sphparam {

/// Vertices by their numbers in the file, from 0: welding, repair and dropping what no face uses
/// renumber the mesh, and people name vertices as their other programs show them.
class FileNumbers {
 public:
  /// Cost: O(#V log #V) where vertices were renumbered, else nothing.
  explicit FileNumbers(const MeshFile& file);

  /// The vertex of the mesh, or −1 where it has none: see `absence`.
  Vertex vertex(long number) const;

  /// The number in the file of a vertex of the mesh.
  long number(Vertex vertex) const;

  /// The same of a face: where polygons were cut into triangles, that of its polygon. Negative: the
  /// file does not have it.
  long face_number(Face face) const;

  /// "the mesh has no vertex 99; they are 0 to 41".
  std::string absence(long number) const;

 private:
  Vertex vertices_;
  std::vector<double> numbers_;  // by vertex; empty: vertices have their numbers
  std::vector<std::pair<double, Vertex>> by_number_;  // sorted; the first of equal ones counts
  std::vector<double> face_numbers_;                  // by face; likewise
};

/// The note of a reader where vertices have other numbers than their rows in the very file: those
/// of the file that it was made of, as repair writes them (`source_vertex`). They are called by
/// these.
inline constexpr char other_numbers_note[] =
    "vertices are called by source_vertex, their numbers in the file that this one was made of, "
    "not "
    "by their rows";

/// Whether the file of this mesh, as it was read, has such numbers; those of ICQ, which has each
/// point of an edge twice, are its own. Cost: O(#V).
bool has_other_numbers(const MeshFile& file);

/// Defects of a mesh by the numbers that its file has for their places. What the file does not have
/// is counted in their messages, and not among their elements.
std::vector<MeshDefect> by_file_numbers(std::vector<MeshDefect> defects,
                                        const FileNumbers& numbers);

/// How many vertices the mesh's file had: those of the mesh, or, where they were renumbered
/// (`source_vertex`), what the comment "source_vertices N" says; 0 where that is not there or
/// cannot be, as in files of other programs. Cost: O(#V) where they were renumbered.
Eigen::Index vertices_of_file(const MeshFile& file);

/// Says so in a comment, which passes through welding, repair and files: whoever adds
/// `source_vertex` to a mesh calls it. Replaces what was said before.
void keep_vertices_of_file(MeshFile& file, Eigen::Index count);

/// Whether a comment is that one.
bool says_vertices_of_file(std::string_view comment);

/// For a mesh whose vertices are no longer those of a file.
void forget_vertices_of_file(MeshFile& file);

/// A number that stands for no vertex of the mesh. Says whose, as `parameterize` calls it: "poles",
/// "meridian".
class NoSuchVertex : public std::runtime_error {
 public:
  NoSuchVertex(const std::string& whose, const std::string& message)
      : std::runtime_error(message), whose_(whose) {}
  const std::string& whose() const { return whose_; }

 private:
  std::string whose_;
};

/// Poles and meridian that are given by their numbers in the file, as vertices of the mesh.
/// Throws: NoSuchVertex, also where two poles are one vertex, welded.
ParameterizeOptions with_vertices_of_mesh(ParameterizeOptions options, const FileNumbers& numbers);

}  // namespace sphparam
