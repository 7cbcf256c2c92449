#include "sphparam/io/components.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "io/mesh_part.h"
#include "mesh/triangle_geometry.h"
#include "mesh/union_find.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/io/repair_advice.h"
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

MeshSource source_of(const MeshSource& whole, const MeshFile& numbered, const Part& part) {
  MeshSource source;
  source.path = whole.path;
  source.file = part_of(numbered, part.faces);
  source.topology = Topology::try_build(source.file.mesh.triangles,
                                        static_cast<int>(source.file.mesh.vertex_count()));
  source.inspection = inspect_mesh(source.file.mesh);
  source.inspection.defects =
      by_file_numbers(std::move(source.inspection.defects), FileNumbers(source.file));
  source.welded = whole.welded;
  source.notes = whole.notes;
  source.repairs = whole.repairs;
  return source;
}

}  // namespace

std::vector<MeshPart> connected_parts(MeshSource source, const RepairOptions& repairs) {
  RepairOptions first = repairs;
  first.components = first.holes = first.handles = first.flat_faces = first.unused = false;
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
  for (const Part& part : parts) {
    const double share =
        area > 0 ? part.area / area : static_cast<double>(part.faces.size()) / faces;
    result.push_back({source_of(source, numbered, part), share});
  }
  return result;
}

bool PartsTrial::are_enough() const {
  return mended == parts || (mended > 0 && area_share >= RepairOptions{}.least_kept);
}

// Each part is tried as `map --all-components` maps it: by itself, after what comes before parts.
PartsTrial try_parts(const MeshSource& source) {
  PartsTrial trial;
  const std::vector<MeshPart> parts = connected_parts(source, {});
  trial.parts = std::ssize(parts);
  trial.as_they_are = parts.front().source.repairs.empty();
  double left_out = 0;
  for (const MeshPart& part : parts) {
    if (part.source.inspection.is_sphere()) {
      ++trial.mended;
      continue;
    }
    trial.as_they_are = false;
    const RepairTrial of_part = try_repair(part.source);
    const bool mends = of_part.can_mend() && of_part.options.component == 0;
    if (!mends) {
      left_out += part.area_share;
      continue;
    }
    ++trial.mended;
    RepairOptions& all = trial.options;
    all.largest_hole = std::max(all.largest_hole, of_part.options.largest_hole);
    all.longest_handle = std::max(all.longest_handle, of_part.options.longest_handle);
  }
  if (trial.mended < trial.parts) trial.area_share = 1 - left_out;
  return trial;
}

}  // namespace sphparam
