#include "remesh/subdivision/limit_vertices.h"

#include <vector>

namespace sphparam {

namespace {

LimitPlace corner_place(const LimitSurface& surface, const Polygons& faces, int face, int corner) {
  const LimitTopology& topology = surface.topology();
  const int first = topology.first_patch(face);
  if (topology.first_patch(face + 1) - first > 1) return {first + corner, 0, 0};
  constexpr LimitPlace triangle[] = {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  constexpr LimitPlace quad[] = {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}};
  const LimitPlace& at = faces.degree(face) == 3 ? triangle[corner] : quad[corner];
  return {first, at.s, at.t};
}

int usual_valence(Scheme scheme) { return scheme == Scheme::Loop ? 6 : 4; }

LimitPlace half_way_in(const LimitPlace& place, Scheme scheme) {
  const double middle = scheme == Scheme::Loop ? 1.0 / 3 : 0.5;
  return {place.patch, (place.s + middle) / 2, (place.t + middle) / 2};
}

}  // namespace

LimitVertices limit_at_vertices(const LimitSurface& surface, const Polygons& faces, int threads) {
  const Eigen::Index count = surface.topology().vertex_count();
  const Scheme scheme = surface.topology().scheme();
  VectorX patches = VectorX::Zero(count);
  for (const int v : faces.corners) patches[v] += 1;
  std::vector<LimitPlace> places, bends;  // where normals are taken, and where curvatures
  for (int f = 0; f < static_cast<int>(faces.count()); ++f) {
    for (int k = 0; k < faces.degree(f); ++k) {
      const LimitPlace place = corner_place(surface, faces, f, k);
      const bool usual = patches[faces.polygon(f)[static_cast<size_t>(k)]] == usual_valence(scheme);
      places.push_back(place);
      bends.push_back(usual ? place : half_way_in(place, scheme));
    }
  }
  const std::vector<LimitPoint> points = surface.evaluate_all(places, threads);
  const std::vector<LimitCurvature> curvatures = surface.curvature_all(bends, threads);
  LimitVertices result{Points::Zero(count, 3), Points::Zero(count, 3), VectorX::Zero(count),
                       VectorX::Zero(count)};
  for (size_t i = 0; i < places.size(); ++i) {
    const int v = faces.corners[i];
    result.positions.row(v) += points[i].position;
    result.normals.row(v) += points[i].normal();
    result.mean[v] += curvatures[i].mean;
    result.gauss[v] += curvatures[i].gauss;
  }
  result.positions.array().colwise() /= patches.array();
  result.normals.rowwise().normalize();
  result.mean.array() /= patches.array();
  result.gauss.array() /= patches.array();
  return result;
}

}  // namespace sphparam
