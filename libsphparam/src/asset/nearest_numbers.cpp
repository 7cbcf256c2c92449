#include "asset/nearest_numbers.h"

#include <algorithm>
#include <utility>

#include "asset/soup.h"
#include "io/attributes/whole_vector.h"
#include "io/data_comments.h"
#include "number_text.h"
#include "rays/ray_scene.h"
#include "remesh/resampling.h"
#include "remesh/wanted_values.h"
#include "sphparam/io/losses.h"
#include "sphparam/parallel.h"

namespace sphparam {
namespace {

std::vector<SurfacePoint> nearest_points(const TriangleMesh& asset, const Points& places,
                                         int threads) {
  const RayScene scene(asset);
  std::vector<SurfacePoint> points(static_cast<size_t>(places.rows()));
  constexpr std::int64_t grain = 256;
  parallel_for(std::ssize(points), grain, threads, [&](std::int64_t first, std::int64_t last) {
    Face guess = -1;
    for (std::int64_t v = first; v < last; ++v) {
      SurfacePoint& point = points[static_cast<size_t>(v)];
      point = scene.nearest(places.row(v).transpose(), guess).on;
      guess = point.face;
    }
  });
  return points;
}

/// All but what belongs to the asset's own vertices, and what is baked.
std::vector<Property> numbers_of(const MeshFile& asset) {
  const WantedValues wanted({"all"}, asset);
  std::vector<Property> numbers;
  std::ranges::copy_if(
      asset.vertex_properties, std::back_inserter(numbers), [&](const Property& own) {
        return wanted.property(own.name) && !is_of_whole_vector(own.name, asset.vertex_properties);
      });
  return numbers;
}

/// Adds the numbers, and what comments of the asset say of their files; those on labels it has.
void add_numbers(MeshFile& wrap, const MeshFile& asset, const std::vector<Property>& numbers,
                 int threads) {
  const std::vector<SurfacePoint> points = nearest_points(asset.mesh, wrap.mesh.positions, threads);
  const Gather no_cells;
  const Resampling resampling{asset.mesh.triangles, points, no_cells, threads};
  for (const Property& own : numbers)
    wrap.set_vertex_property({own.name, own.type,
                              is_floating(own.type) ? resample_property(resampling, own)
                                                    : resample_labels(resampling, own)});
  tell_data_of(wrap, asset);
}

std::string line_of(const std::vector<Property>& numbers) {
  std::vector<std::string> names;
  for (const Property& number : numbers) names.push_back(number.name);
  return "its vertices have " + enumerated(names) + " of the asset's nearest points";
}

}  // namespace

WholeSurface with_nearest_numbers(WholeSurface whole, const MeshSource& asset, int threads) {
  if (whole.by != WholeBy::Wrap) return whole;
  const MeshFile placed = with_places(asset);
  const std::vector<Property> numbers = numbers_of(placed);
  if (numbers.empty()) return whole;
  const MappedMesh& bare = whole.mapped;
  MeshFile file = bare.file();
  add_numbers(file, placed, numbers, threads);
  whole.done.push_back(line_of(numbers));
  file.comments.push_back("numbers: " + whole.done.back());
  whole.mapped = MappedMesh({.file = std::move(file),
                             .map = bare.map(),
                             .provenance = bare.provenance(),
                             .topology = bare.topology(),
                             .polygons = bare.polygons(),
                             .notes = bare.notes(),
                             .mapped_here = bare.mapped_here(),
                             .name = bare.name()},
                            threads)
                     .with_chart(threads);
  return whole;
}

}  // namespace sphparam
