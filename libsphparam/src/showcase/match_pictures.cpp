#include "showcase/match_pictures.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "io/attributes/shading_normals.h"
#include "render/figure.h"
#include "render/geodesic.h"

namespace sphparam {
namespace {

constexpr int links_made = 100;  // some of which are seen from a side
constexpr double facing = 0.2;   // cosine between a normal and the view, for points to be seen
constexpr double dark = 0.10, light = 0.95;  // of the colours of places

size_t at(int i) { return static_cast<size_t>(i); }

Points turned(const Points& normals, const Similarity& similarity) {
  return normals * similarity.rotation.transpose();
}

/// Colours of triangles that are left.
Paint without(const FillerMarks& fillers, Paint paint) {
  auto* const faces = std::get_if<FacePaint>(&paint);
  if (fillers.empty() || !faces) return paint;
  std::vector<Rgb> kept;
  for (size_t f = 0; f < faces->colours.size(); ++f)
    if (!fillers[f]) kept.push_back(faces->colours[f]);
  return FacePaint{std::move(kept)};
}

RenderObject object_of(const MappedMesh& mapped, TriangleMesh mesh, const Points& normals,
                       Paint paint) {
  mesh.triangles = mapped.surface().triangles;
  return {.mesh = std::move(mesh),
          .normals = normals,
          .paint = without(mapped.fillers(), std::move(paint)),
          .occlusion = true};
}

}  // namespace

std::vector<Rgb> place_colours(const Points& positions, const Points& box) {
  const Eigen::RowVector3d low = box.colwise().minCoeff(), high = box.colwise().maxCoeff();
  std::vector<Rgb> colours;
  for (const auto& position : positions.rowwise()) {
    Rgb colour;
    for (int c = 0; c < 3; ++c) {
      const double span = high[c] - low[c];
      const double share = span > 0 ? std::clamp((position[c] - low[c]) / span, 0.0, 1.0) : 0.5;
      colour[c] = static_cast<float>(dark + (light - dark) * share);
    }
    colours.push_back(colour);
  }
  return colours;
}

std::vector<Vertex> spread_vertices(const TriangleMesh& mesh, const std::vector<Vertex>& first,
                                    int count) {
  std::vector<Vertex> chosen;
  VectorX distance = VectorX::Constant(mesh.vertex_count(), std::numeric_limits<double>::max());
  const auto choose = [&](Vertex v) {
    chosen.push_back(v);
    const VectorX to_it =
        (mesh.positions.rowwise() - mesh.positions.row(v)).rowwise().squaredNorm();
    distance = distance.cwiseMin(to_it);
  };
  for (const Vertex v : first) choose(v);
  if (chosen.empty()) choose(0);
  while (std::ssize(chosen) < std::min(count, static_cast<int>(mesh.vertex_count()))) {
    Eigen::Index farthest = 0;
    if (!(distance.maxCoeff(&farthest) > 0)) break;
    choose(static_cast<Vertex>(farthest));
  }
  return chosen;
}

MatchPictures::MatchPictures(const SurfaceMap& map, const std::vector<Vertex>& from_landmarks,
                             const PairLook& look)
    : map_(map), look_(look), distortion_(measure_distortion(map, look.threads)) {
  const Similarity similarity = placement_on(map, Placement::Scaled, look.threads);
  CarriedShape carried = carried_shape(map, look.threads);
  const Points& box = map.to().mesh().positions;
  first_colours_ = place_colours(carried.mesh.positions, box);
  second_colours_ = place_colours(box, box);
  first_ = map.from().mesh();
  second_ = map.to().mesh();
  second_.positions = moved(std::move(second_.positions), similarity);
  carried_ = std::move(carried.mesh);
  carried_.positions = moved(std::move(carried_.positions), similarity);
  first_normals_ = shading_normals(map.from().file());
  second_normals_ = turned(shading_normals(map.to().file()), similarity);
  carried_normals_ = turned(carried.normals, similarity);
  linked_ = spread_vertices(first_, from_landmarks, links_made);
}

PairLook MatchPictures::look_from(bool from_behind) const {
  PairLook look = look_;
  if (!from_behind) return look;
  // Turned about what is up: still seen from above.
  const Vector3 up = look.up.normalized();
  look.view = 2 * look.view.dot(up) * up - look.view;
  return look;
}

RenderObject MatchPictures::first(Paint paint) const {
  return object_of(map_.from(), first_, first_normals_, std::move(paint));
}

RenderObject MatchPictures::second(Paint paint) const {
  return object_of(map_.to(), second_, second_normals_, std::move(paint));
}

std::vector<Link> MatchPictures::links(const PairLook& look) const {
  const Vector3 view = look.view.normalized();
  std::vector<Link> seen;
  for (const Vertex v : linked_) {
    if (first_normals_.row(v).dot(view) < facing || carried_normals_.row(v).dot(view) < facing)
      continue;
    seen.push_back({first_.position(v), carried_.position(v), 0.75F * first_colours_[at(v)]});
  }
  return seen;
}

Image MatchPictures::places(bool from_behind) const {
  const PairLook look = look_from(from_behind);
  return side_by_side(first(VertexPaint{first_colours_}), second(VertexPaint{second_colours_}),
                      links(look), look);
}

Image MatchPictures::graticules() const {
  RenderObject left = first(UniformPaint{}), right = second(UniformPaint{});
  left.graticule = Graticule{.rays = map_.from().map().points};
  right.graticule = Graticule{.rays = map_.to().map().points};
  return side_by_side(std::move(left), std::move(right), {}, look_);
}

Image MatchPictures::spheres() const {
  const auto sphere = [](const MappedMesh& mapped, const std::vector<Rgb>& colours) {
    const Points& rays = mapped.map().points;
    RenderObject object{
        .mesh = mapped.mesh(), .paint = VertexPaint{colours}, .graticule = Graticule{.rays = rays}};
    return on_sphere(object, rays);
  };
  PairLook look = look_;
  const SphereView side =
      corresponding_view(map_.from().mesh(), map_.from().map(), look_.view, look_.up);
  look.view = side.direction;
  look.up = side.up;
  return side_by_side(sphere(map_.from(), first_colours_), sphere(map_.to(), second_colours_), {},
                      look);
}

Image MatchPictures::heat(Heat heat, bool from_behind) const {
  const FacePaint paint = heat_paint(heat, distortion_);
  RenderObject left = first(paint),
               right = object_of(map_.from(), carried_, carried_normals_, paint);
  left.occlusion = right.occlusion = false;  // colours are to be read
  return side_by_side(std::move(left), std::move(right), {}, look_from(from_behind));
}

}  // namespace sphparam
