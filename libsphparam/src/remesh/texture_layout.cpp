// How large layouts are, and meshes with coordinates in them.

#include "remesh/texture_layout.h"

#include <stdexcept>
#include <utility>

#include "io/attributes/texture_pages.h"
#include "io/attributes/whole_vector.h"
#include "remesh/grids/grid_family.h"
#include "remesh/texture_lattice.h"

namespace sphparam {

namespace {

constexpr int gutter = 4;        // texels: two levels of detail of an image
constexpr int most_levels = 20;  // of subdivision
constexpr char no_layout[] =
    " has no layout of its own: cube:N, octa:N, ico:L, ico:f=N and uv:WxH have";

/// Of a layout with so many levels.
TextureLayout with_levels(const ChartCells& cells, int levels) {
  TextureLayout layout{.columns = cells.columns, .rows = cells.rows, .levels = levels};
  layout.steps = 1 << levels;
  layout.gutter = cells.closed ? 0 : gutter;
  const int more = cells.closed ? 0 : 1 + 2 * gutter;
  layout.width = cells.columns * (cells.width * layout.steps + more);
  layout.height = cells.rows * (cells.height * layout.steps + more);
  return layout;
}

std::string comment_of(const std::string& grid, const TextureLayout& layout) {
  const auto times = [](int a, int b) { return std::to_string(a) + "x" + std::to_string(b); };
  return "texture coordinates: the layout of " + grid + ", " + times(layout.columns, layout.rows) +
         (layout.columns > 1 ? " tiles in " : " tile in ") + times(layout.width, layout.height) +
         " texels, " + std::to_string(layout.steps) + " texels a face, " +
         std::to_string(layout.gutter) + " about a tile; straight over each face (not smoothed)";
}

/// Of each corner of the triangles, the one of the polygons that they are cut of.
std::vector<int> polygon_corners(const Triangles& triangles, const Polygons& faces) {
  std::vector<int> found;
  found.reserve(static_cast<size_t>(triangles.size()));
  Eigen::Index t = 0;
  for (std::int64_t p = 0; p < faces.count(); ++p) {
    const auto polygon = faces.polygon(p);
    for (int piece = 2; piece < faces.degree(p); ++piece, ++t) {
      for (int k = 0; k < 3; ++k) {
        int i = 0;
        while (polygon[static_cast<size_t>(i)] != triangles(t, k)) ++i;
        found.push_back(faces.starts[static_cast<size_t>(p)] + i);
      }
    }
  }
  return found;
}

void put_coordinates(MeshFile& file, const Polygons& faces, const TextureLattice& lattice) {
  const std::vector<int> corners = polygon_corners(file.mesh.triangles, faces);
  if (is_of_whole_vector("s", file.vertex_properties))
    remove_properties(file.vertex_properties, {"s", "t"});
  file.corner_texcoords.emplace(static_cast<Eigen::Index>(corners.size()), 2);
  file.corner_texcoord_type = ScalarType::Float64;
  for (size_t i = 0; i < corners.size(); ++i)
    file.corner_texcoords->row(static_cast<Eigen::Index>(i)) =
        lattice.coordinates(lattice.corner(corners[i]));
}

}  // namespace

bool has_texture_layout(const GridSpec& spec) { return family_of(spec.kind).chart != nullptr; }

GridSpec spec_with_layout(const Remeshed& mesh) {
  if (mesh.spec() && has_texture_layout(*mesh.spec())) return *mesh.spec();
  throw std::invalid_argument(mesh.name() + no_layout);
}

TextureLayout texture_layout(const GridSpec& spec, std::int64_t texels) {
  require_grid(spec);
  if (!has_texture_layout(spec)) throw std::invalid_argument(name_of(spec) + no_layout);
  const ChartCells cells = family_of(spec.kind).chart_cells(spec);
  int levels = 0;
  const auto fits = [&](int count) {
    const std::int64_t steps = std::int64_t{1} << count, more = cells.closed ? 0 : 1 + 2 * gutter;
    return cells.columns * (cells.width * steps + more) * cells.rows *
               (cells.height * steps + more) <=
           texels;
  };
  while (levels < most_levels && fits(levels + 1)) ++levels;
  return with_levels(cells, levels);
}

Remeshed with_grid_texture(const Remeshed& mesh, const TextureLayout& layout, int threads,
                           const std::vector<std::string>& comments) {
  const TextureLattice lattice(spec_with_layout(mesh), mesh.grid(), layout);
  MeshFile file = mesh.file();
  put_coordinates(file, mesh.faces(), lattice);
  remove_textures(file);  // which lie on other coordinates
  file.comments.push_back(comment_of(name_of(*mesh.spec()), layout));
  file.comments.insert(file.comments.end(), comments.begin(), comments.end());
  return {MappedMesh({.file = std::move(file),
                      .map = mesh.map(),
                      .provenance = mesh.provenance(),
                      .topology = mesh.topology(),
                      .polygons = mesh.faces(),
                      .name = mesh.name()},
                     threads),
          mesh.spec(), mesh.figures()};
}

}  // namespace sphparam
