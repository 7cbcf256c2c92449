#include "sphparam/io/vertex_place.h"

#include <cmath>
#include <stdexcept>

#include "io/files/nearest_vertex.h"
#include "mesh/box.h"
#include "number_text.h"
#include "sphparam/io/file_numbers.h"

namespace sphparam {

namespace {

constexpr double far_share = 0.02;

}  // namespace

struct VertexPlaces::Search {
  const TriangleMesh& mesh;
  FileNumbers numbers;
  NearestVertex nearest;
  double diagonal;
};

VertexPlaces::VertexPlaces(const MeshFile& file) {
  const Box box = surface_box(file.mesh);
  const FileNumbers numbers(file);
  search_ = std::make_unique<Search>(Search{file.mesh, numbers, NearestVertex(file.mesh, numbers),
                                            (box.upper - box.lower).stableNorm()});
}

VertexPlaces::~VertexPlaces() = default;

FoundVertex VertexPlaces::at(const VertexPlace& place) const {
  const long number = place.point ? search_->nearest.at(*place.point) : place.number;
  const Vertex vertex = search_->numbers.vertex(number);
  if (vertex < 0)
    throw std::invalid_argument(place.point ? "no vertex is near this point"
                                            : search_->numbers.absence(number));
  if (!place.point) return {.vertex = vertex};
  const double distance = (search_->mesh.position(vertex) - *place.point).stableNorm();
  return {vertex, distance, search_->diagonal > 0 ? distance / search_->diagonal : 0};
}

void SnappedPoints::add(const FoundVertex& found, const std::string& where) {
  if (!found.distance) return;
  ++count_;
  if (farthest_.distance && *found.distance <= *farthest_.distance) return;
  farthest_ = found;
  where_ = where;
}

std::string SnappedPoints::words() const {
  if (count_ == 0) return "";
  return counted(count_, "point is taken for the vertex nearest to it, ",
                 "points are taken for the vertices nearest to them, at most ") +
         short_number(*farthest_.distance) + " away (" + percent(farthest_.share) +
         " of the diagonal; " + where_ + ")";
}

bool SnappedPoints::is_far() const { return farthest_.share >= far_share; }

}  // namespace sphparam
