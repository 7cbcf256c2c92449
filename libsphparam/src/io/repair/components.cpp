#include "sphparam/io/components.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "io/repair/mesh_part.h"
#include "io/repair/repaired_file.h"
#include "mesh/cavities.h"
#include "mesh/flat_face.h"
#include "mesh/triangle_geometry.h"
#include "mesh/union_find.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/names.h"

// Areas are of the mesh at unit size, and added in the order of the faces.

namespace sphparam {

namespace {

struct Part {
  std::vector<Face> faces;
  double area = 0;
  Vertex vertex = 0;  // the lowest
};

double unit_of(const TriangleMesh& mesh) {
  const double extent = mesh.positions.size() > 0 ? mesh.positions.cwiseAbs().maxCoeff() : 0;
  return extent > 0 ? extent : 1;
}

std::vector<Part> parts_of(const TriangleMesh& mesh) {
  UnionFind classes(static_cast<std::size_t>(mesh.vertex_count()));
  for (Face f = 0; f < mesh.face_count(); ++f) {
    classes.unite(mesh.triangles(f, 0), mesh.triangles(f, 1));
    classes.unite(mesh.triangles(f, 1), mesh.triangles(f, 2));
  }
  const double unit = unit_of(mesh);
  std::map<int, Part> by_root;
  for (Face f = 0; f < mesh.face_count(); ++f) {
    const auto corner = [&](int k) -> Vector3 {
      return mesh.position(mesh.triangles(f, k)) / unit;
    };
    Part& part = by_root[classes.find(mesh.triangles(f, 0))];
    const Vertex lowest = mesh.triangles.row(f).minCoeff();
    part.vertex = part.faces.empty() ? lowest : std::min(part.vertex, lowest);
    part.faces.push_back(f);
    part.area += triangle_area(corner(0), corner(1), corner(2));
  }
  std::vector<Part> parts;
  for (auto& [root, part] : by_root) parts.push_back(std::move(part));
  std::sort(parts.begin(), parts.end(), [](const Part& x, const Part& y) {
    return std::tuple(y.area, y.faces.size(), x.vertex) <
           std::tuple(x.area, x.faces.size(), y.vertex);
  });
  return parts;
}

/// Whose faces look inward as they should.
void forgive_inside_out(MeshInspection& inspection) {
  std::erase_if(inspection.defects,
                [](const MeshDefect& defect) { return defect.kind == DefectKind::InsideOut; });
}

MeshSource source_of(const MeshSource& whole, const MeshFile& numbered, const Part& part,
                     bool is_cavity) {
  MeshSource source;
  source.path = whole.path;
  source.file = part_of(numbered, part.faces);
  source.topology = Topology::try_build(source.file.mesh.triangles,
                                        static_cast<int>(source.file.mesh.vertex_count()));
  source.inspection = inspect_mesh(source.file.mesh);
  if (is_cavity) forgive_inside_out(source.inspection);
  source.inspection.defects =
      by_file_numbers(std::move(source.inspection.defects), FileNumbers(source.file));
  source.welded = whole.welded;
  source.notes = whole.notes;
  source.repairs = whole.repairs;
  return source;
}

/// With all faces the other way round, as after a repair that does nothing else.
MeshSource turned_over(MeshSource source) {
  RepairedMesh turned{.mesh = source.file.mesh};
  Triangles& triangles = turned.mesh.triangles;
  triangles.col(1).swap(triangles.col(2));
  for (Vertex v = 0; v < source.file.mesh.vertex_count(); ++v) turned.vertex_origin.push_back(v);
  for (Face f = 0; f < source.file.mesh.face_count(); ++f) {
    turned.face_origin.push_back(f);
    for (const int k : {0, 2, 1}) turned.corner_origin.push_back(3 * f + k);
  }
  RepairAction action{.kind = RepairKind::TurnedOutward, .count = 1, .elements = {0}};
  action.message = describe(action);
  turned.actions.push_back(action);
  source.file = repaired_file(source.file, turned);
  source.repairs.push_back(std::move(action));
  source.topology.emplace(triangles, static_cast<int>(source.file.mesh.vertex_count()));
  source.inspection = inspect_mesh(source.file.mesh);
  return source;
}

/// The places alone of a part. names: −1 for each vertex of the whole; for those of the part
/// theirs then, as no other part has them.
TriangleMesh mesh_of(const TriangleMesh& whole, const Part& part, std::vector<Vertex>& names) {
  std::vector<Vertex> vertices;
  for (const Face f : part.faces)
    for (const Vertex v : whole.triangles.row(f)) vertices.push_back(v);
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  TriangleMesh mesh{Points(std::ssize(vertices), 3), Triangles(std::ssize(part.faces), 3)};
  for (int i = 0; i < static_cast<int>(vertices.size()); ++i) {
    mesh.positions.row(i) = whole.positions.row(vertices[i]);
    names[vertices[i]] = i;
  }
  for (int i = 0; i < static_cast<int>(part.faces.size()); ++i)
    for (int k = 0; k < 3; ++k) mesh.triangles(i, k) = names[whole.triangles(part.faces[i], k)];
  return mesh;
}

/// How a part comes to a map.
struct PartTrial {
  bool can_be_mapped = false, as_it_is = false;
  RepairOptions options = {};  // that it takes
};

PartTrial try_alone(TriangleMesh mesh) {
  if (!has_area(mesh)) return {};  // whatever is mended, there is nothing to map
  MeshSource alone;
  alone.inspection = inspect_mesh(mesh);
  alone.file.mesh = std::move(mesh);
  if (alone.inspection.is_sphere()) return {.can_be_mapped = true, .as_it_is = true};
  const RepairTrial trial = try_part(alone);
  const bool mends = trial.can_mend() && trial.options.component == 0;
  return {.can_be_mapped = mends, .options = trial.options};
}

}  // namespace

RepairOptions before_components(RepairOptions repairs) {
  repairs.components = repairs.holes = repairs.handles = false;
  repairs.flat_faces = repairs.unused = false;
  repairs.edge_share = repairs.edge_length = 0;
  return repairs;
}

std::vector<MeshPart> connected_parts(MeshSource source, const RepairOptions& repairs) {
  const RepairOptions first = before_components(repairs);
  if (!names_of(first).empty()) source = mended(std::move(source), first);
  const std::vector<Part> parts = parts_of(source.file.mesh);
  std::vector<MeshPart> result;
  if (parts.size() <= 1) {
    result.push_back({std::move(source)});
    return result;
  }
  double area = 0;
  for (const Part& part : parts) area += part.area;
  const auto faces = static_cast<double>(source.file.mesh.face_count());
  const MeshFile numbered = with_numbers(source.file);
  const Cavities cavities = find_cavities(source.file.mesh);
  for (const Part& part : parts) {
    const bool is_cavity = std::ranges::binary_search(cavities.lowest, part.vertex);
    const double share =
        area > 0 ? part.area / area : static_cast<double>(part.faces.size()) / faces;
    result.push_back({source_of(source, numbered, part, is_cavity), share, is_cavity});
  }
  return result;
}

MeshSource repaired_part(MeshPart part, RepairOptions repairs) {
  if (!part.is_cavity) return repaired(std::move(part.source), repairs);
  // It is closed, and its faces run alike: there is nothing else to orient than inside and outside.
  const bool looks_inward = std::exchange(repairs.orientation, false);
  MeshSource source = repaired(std::move(part.source), repairs);
  if (looks_inward && source.inspection.volume > 0) source = turned_over(std::move(source));
  forgive_inside_out(source.inspection);
  return source;
}

bool PartsTrial::are_enough() const {
  return mended == parts || (mended > 0 && area_share >= RepairOptions{}.least_kept);
}

// Each part is tried as `map --all-components` maps it: by itself, after what comes before parts.
// Its places are enough, so that thousands of parts cost no more than one.
PartsTrial try_parts(const MeshSource& source) {
  PartsTrial trial;
  const MeshSource whole = mended(source, before_components({}));
  const TriangleMesh& mesh = whole.file.mesh;
  const std::vector<Part> parts = parts_of(mesh);
  trial.parts = std::ssize(parts);
  trial.as_they_are = whole.repairs.empty();
  std::vector<Vertex> names(static_cast<std::size_t>(mesh.vertex_count()), -1);
  double area = 0, left_out = 0;
  for (const Part& part : parts) {
    area += part.area;
    const PartTrial of_part = try_alone(mesh_of(mesh, part, names));
    trial.as_they_are = trial.as_they_are && of_part.as_it_is;
    if (!of_part.can_be_mapped) {
      left_out += part.area;
      continue;
    }
    ++trial.mended;
    RepairOptions& all = trial.options;
    all.largest_hole = std::max(all.largest_hole, of_part.options.largest_hole);
    all.longest_handle = std::max(all.longest_handle, of_part.options.longest_handle);
  }
  if (trial.mended < trial.parts) trial.area_share = area > 0 ? 1 - left_out / area : 0;
  return trial;
}

}  // namespace sphparam
