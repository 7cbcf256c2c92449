#include "io/polygons/welding.h"

#include <algorithm>
#include <numeric>
#include <string_view>

#include "io/attributes/corner_colours.h"
#include "io/polygons/distinct_rows.h"
#include "mesh/defect_places.h"
#include "number_text.h"
#include "sphparam/io/file_numbers.h"

// Both operations give every vertex a new id and keep one old vertex for every new id. Attributes
// of a kind (normals, texture coordinates, colours) that differ between an old vertex and the one
// kept for it become attributes of corners before the ids change.

namespace sphparam {
namespace {

constexpr const char* source_vertex = "source_vertex";
constexpr std::string_view welded_note = "welded ", dropped_note = "dropped ";

struct Renumbering {
  std::vector<int> new_vertex;  // of each old vertex
  std::vector<int> kept;        // the old vertex of each new one
};

MeshFile renumbered(MeshFile file, const Renumbering& renumbering) {
  const std::vector<int>& kept = renumbering.kept;
  Points positions(static_cast<Eigen::Index>(kept.size()), 3);
  for (std::size_t v = 0; v < kept.size(); ++v)
    positions.row(static_cast<Eigen::Index>(v)) = file.mesh.positions.row(kept[v]);
  file.mesh.positions = std::move(positions);

  // Ids of the file are remembered, not ids of an intermediate step.
  if (!file.find_vertex_property(source_vertex)) {
    Property source{source_vertex, ScalarType::Int32, {}};
    source.values.resize(renumbering.new_vertex.size());
    std::iota(source.values.begin(), source.values.end(), 0.0);
    file.vertex_properties.push_back(std::move(source));
    keep_vertices_of_file(file, std::ssize(renumbering.new_vertex));
  }
  for (Property& property : file.vertex_properties) {
    std::vector<double> values;
    values.reserve(kept.size());
    for (const int v : kept) values.push_back(property.values[v]);
    property.values = std::move(values);
  }
  for (int& v : file.mesh.triangles.reshaped()) v = renumbering.new_vertex[v];
  return file;
}

std::vector<bool> used_vertices(const TriangleMesh& mesh) {
  std::vector<bool> used(static_cast<std::size_t>(mesh.vertex_count()), false);
  for (const int v : mesh.triangles.reshaped()) used[v] = true;
  return used;
}

/// Keeps the first copy that some face uses: what the others have is seen nowhere.
Renumbering by_position(const TriangleMesh& mesh) {
  const Points& positions = mesh.positions;
  const std::vector<bool> used = used_vertices(mesh);
  Renumbering result;
  DistinctRows<double, 3> distinct(static_cast<std::size_t>(positions.rows()));
  result.new_vertex.reserve(static_cast<std::size_t>(positions.rows()));
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    // Adding +0 makes −0 and +0 the same bits.
    const int id =
        distinct.insert({positions(v, 0) + 0.0, positions(v, 1) + 0.0, positions(v, 2) + 0.0});
    if (id == static_cast<int>(result.kept.size())) result.kept.push_back(static_cast<int>(v));
    if (used[v] && !used[result.kept[id]]) result.kept[id] = static_cast<int>(v);
    result.new_vertex.push_back(id);
  }
  return result;
}

bool differs_between_copies(const Property& property, const Renumbering& renumbering) {
  for (std::size_t v = 0; v < renumbering.new_vertex.size(); ++v)
    if (property.values[v] != property.values[renumbering.kept[renumbering.new_vertex[v]]])
      return true;
  return false;
}

/// Moves vertex properties of these names to the corners, if they are all there and differ between
/// the copies of a vertex. Returns whether they were moved.
template <class Table>
bool move_to_corners(MeshFile& file, const std::vector<std::string>& names,
                     const Renumbering& renumbering, std::optional<Table>& corners,
                     ScalarType& corner_type) {
  std::vector<const Property*> properties;
  for (const std::string& name : names) properties.push_back(file.find_vertex_property(name));
  const auto differs = [&](const Property* property) {
    return differs_between_copies(*property, renumbering);
  };
  if (corners || std::count(properties.begin(), properties.end(), nullptr) > 0) return false;
  if (std::none_of(properties.begin(), properties.end(), differs)) return false;

  Table table(file.mesh.triangles.size(), static_cast<Eigen::Index>(names.size()));
  for (Eigen::Index i = 0; i < table.rows(); ++i)
    for (Eigen::Index k = 0; k < table.cols(); ++k)
      table(i, k) = properties[k]->values[file.mesh.triangles.data()[i]];
  corners = std::move(table);
  corner_type = properties.front()->type;
  remove_properties(file.vertex_properties, names);
  return true;
}

/// Gives corners the colours of their copies where one has another than the copy that is kept.
void keep_colours_at_corners(MeshFile& file, const Renumbering& renumbering) {
  std::vector<const Property*> channels;
  for (const char* name : {"red", "green", "blue"})
    channels.push_back(file.find_vertex_property(name));
  if (std::ranges::count(channels, nullptr) > 0 || corner_colours(file)) return;
  if (const Property* alpha = file.find_vertex_property("alpha")) channels.push_back(alpha);
  const Triangles& triangles = file.mesh.triangles;
  const auto corners = triangles.reshaped<Eigen::RowMajor>();
  const bool differ = std::ranges::any_of(channels, [&](const Property* channel) {
    return std::ranges::any_of(corners, [&](Vertex v) {
      return channel->values[v] != channel->values[renumbering.kept[renumbering.new_vertex[v]]];
    });
  });
  if (!differ) return;
  CornerColours colours = CornerColours::Zero(triangles.size(), 4);
  for (Eigen::Index i = 0; i < colours.rows(); ++i)
    for (std::size_t c = 0; c < channels.size(); ++c)
      colours(i, static_cast<Eigen::Index>(c)) = channels[c]->values[triangles.data()[i]];
  set_corner_colours(file, colours);
}

/// True when some edge has one face only. Edges are gathered by their smaller vertex, so that a
/// mesh of any size costs little more than two passes (`inspect_mesh` would answer this too, but
/// takes ten times as long for everything else it answers).
bool has_boundary(const Triangles& triangles, Eigen::Index vertex_count) {
  const auto for_each_edge = [&](auto&& visit) {
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
      for (int k = 0; k < 3; ++k) {
        const int a = triangles(f, k), b = triangles(f, (k + 1) % 3);
        visit(std::min(a, b), std::max(a, b));
      }
  };
  std::vector<int> starts(static_cast<std::size_t>(vertex_count) + 2);
  for_each_edge([&](int smaller, int) { ++starts[smaller + 2]; });
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<int> larger_ends(static_cast<std::size_t>(triangles.size()));
  for_each_edge([&](int smaller, int larger) { larger_ends[starts[smaller + 1]++] = larger; });

  for (Eigen::Index v = 0; v < vertex_count; ++v) {
    const auto first = larger_ends.begin() + starts[v], last = larger_ends.begin() + starts[v + 1];
    std::sort(first, last);
    for (auto edge = first; edge != last;) {
      const auto next_edge = std::upper_bound(edge, last, *edge);
      if (next_edge - edge == 1) return true;
      edge = next_edge;
    }
  }
  return false;
}

/// "2 vertices that no face uses: vertices 4, 17", by their numbers in the file; empty: there is
/// none.
std::string words_of_unused(const MeshFile& file) {
  constexpr std::size_t most_named = 10;
  std::vector<char> used(static_cast<std::size_t>(file.mesh.vertex_count()), 0);
  for (const int v : file.mesh.triangles.reshaped()) used[static_cast<std::size_t>(v)] = 1;
  const long count = std::ranges::count(used, 0);
  if (count == 0) return {};
  const FileNumbers numbers(file);
  std::vector<int> named;
  for (std::size_t v = 0; v < used.size() && named.size() < most_named; ++v)
    if (!used[v]) named.push_back(static_cast<int>(numbers.number(static_cast<Vertex>(v))));
  return counted(count, "vertex", "vertices") + " that no face uses" +
         place_list(RepairPlace::Vertices, named, count);
}

}  // namespace

WeldResult weld_exact(const MeshFile& file) {
  const Renumbering renumbering = by_position(file.mesh);
  WeldResult result{file, renumbering.new_vertex,
                    static_cast<long>(renumbering.new_vertex.size() - renumbering.kept.size())};
  if (result.merged == 0) return result;
  move_to_corners(result.file, {"s", "t"}, renumbering, result.file.corner_texcoords,
                  result.file.corner_texcoord_type);
  move_to_corners(result.file, {"nx", "ny", "nz"}, renumbering, result.file.corner_normals,
                  result.file.corner_normal_type);
  keep_colours_at_corners(result.file, renumbering);
  result.file = renumbered(std::move(result.file), renumbering);
  return result;
}

MeshFile drop_unused_vertices(MeshFile file) {
  Renumbering renumbering;
  renumbering.new_vertex.assign(static_cast<std::size_t>(file.mesh.vertex_count()), -1);
  for (const int v : file.mesh.triangles.reshaped()) renumbering.new_vertex[v] = 0;
  for (std::size_t v = 0; v < renumbering.new_vertex.size(); ++v) {
    if (renumbering.new_vertex[v] < 0) continue;
    renumbering.new_vertex[v] = static_cast<int>(renumbering.kept.size());
    renumbering.kept.push_back(static_cast<int>(v));
  }
  if (renumbering.kept.size() == renumbering.new_vertex.size()) return file;
  return renumbered(std::move(file), renumbering);
}

MappableMesh make_mappable(MeshFile file, std::vector<std::string>* notes) {
  const auto note = [notes](const std::string& text) {
    if (notes) notes->push_back(text);
  };
  const auto connect = [&] {
    return Topology::try_build(file.mesh.triangles, static_cast<int>(file.mesh.vertex_count()));
  };
  std::optional<Topology> topology = connect();
  if (!topology && has_boundary(file.mesh.triangles, file.mesh.vertex_count())) {
    WeldResult welded = weld_exact(file);
    if (welded.merged > 0) {
      note(std::string(welded_note) + counted(welded.merged, "vertex", "vertices") +
           " onto others of the same position: the faces as indexed are not closed");
      file = std::move(welded.file);
      topology = connect();
    }
  }
  if (const std::string unused = words_of_unused(file); !unused.empty()) {
    note(std::string(dropped_note) + unused);
    file = drop_unused_vertices(std::move(file));
    if (topology) topology = connect();
  }
  return {std::move(file), std::move(topology)};
}

std::vector<std::string> renumberings_among(const std::vector<std::string>& notes) {
  std::vector<std::string> made;
  for (const std::string& note : notes)
    if (note.starts_with(welded_note) || note.starts_with(dropped_note)) made.push_back(note);
  return made;
}

MeshFile prepare_for_mapping(MeshFile file, std::vector<std::string>* notes) {
  return make_mappable(std::move(file), notes).file;
}

}  // namespace sphparam
