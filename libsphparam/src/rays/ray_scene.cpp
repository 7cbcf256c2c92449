// Embree, and the only file that knows it. The mesh is moved and scaled by a power of two into the
// cube [−1, 1]³ in doubles (turned where triangles are long and lie across the axes), then rounded:
// each coordinate is off by at most 2⁻²⁵, turned by 2⁻²⁴.
//
// Nearest points: Embree walks its tree by boxes in floats; here every triangle it comes to is
// judged in doubles. A box may be passed over only if no triangle in it can be the nearest, so the
// radius of the search is the distance known so far, widened by what rounding may have cost. Where
// such boxes overlap much, boxes that lie as the triangles do take their place. For a
// point p far away floats cannot tell distances apart; the search then goes round a point p' on the
// way from p to the centre, at distance D' ≥ r from it, where all of the mesh is within r = √3.
// Lemma: where x is no farther from p than y, |p' − x|² ≤ |p' − y|² + r². Proof: with centre 0 and
// p = D u, |p − x| ≤ |p − y| says g_D(x) ≤ g_D(y) for g_D(x) = |x|²/2D − u·x. As D' ≤ D,
// g_D'(x) ≤ g_D(x) + r²/2D' ≤ g_D(y) + r²/2D' ≤ g_D'(y) + r²/2D'; times 2D', plus D'².

#include "rays/ray_scene.h"

#include <embree3/rtcore.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "rays/distinct_faces.h"
#include "rays/oriented_boxes.h"
#include "rays/triangle_distance.h"

namespace sphparam {

namespace {

// One thread builds: the same tree, whatever --threads. AVX2 at most: the same arithmetic on all
// machines of the last ten years.
constexpr char settings[] = "threads=1,isa=avx2";

constexpr double local_clearance = 0x1p-20;

// In the search for nearest points, beyond the rounding of the mesh and of the point (2⁻²⁴ of the
// size of each, times √3) and of Embree's few operations (some 2⁻²⁴ of the radius each).
constexpr double position_slack = 0x1p-21, radius_slack = 0x1p-20;

constexpr double squared_reach_of_cube = 3;  // r²
constexpr double far_away = 1024;            // D': the widening r² is a thousandth of the radius

// Rays that Embree gets at once; it works on them together where they go together.
constexpr size_t bundle = 64;

void require_success(RTCDevice device) {
  const RTCError error = rtcGetDeviceError(device);
  if (error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  throw std::runtime_error("Embree failed with its error " + std::to_string(error));
}

/// Handles of Embree, released at the end of the scope.
struct Device {
  RTCDevice handle = rtcNewDevice(settings);
  Device() {
    if (!handle) require_success(nullptr);
  }
  ~Device() { rtcReleaseDevice(handle); }
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
};

struct Scene {
  RTCScene handle;
  explicit Scene(RTCDevice device) : handle(rtcNewScene(device)) {
    if (!handle) require_success(device);
  }
  ~Scene() { rtcReleaseScene(handle); }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
};

struct Geometry {
  RTCGeometry handle;
  explicit Geometry(RTCDevice device) : handle(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE)) {
    if (!handle) require_success(device);
  }
  ~Geometry() { rtcReleaseGeometry(handle); }
  Geometry(const Geometry&) = delete;
  Geometry& operator=(const Geometry&) = delete;
};

/// From the mesh to the cube [−1, 1]³ and back.
struct Frame {
  Vector3 centre;
  double scale;  // a power of two
  double diagonal;
  std::optional<Eigen::Matrix3d> turn;  // see `turned`

  Vector3 local(const Vector3& point) const {
    const Vector3 moved = (point - centre) * scale;
    return turn ? Vector3(*turn * moved) : moved;
  }
  Eigen::Vector3f local_direction(const Eigen::Vector3f& direction) const {
    return turn ? Eigen::Vector3f(turn->cast<float>() * direction) : direction;
  }
  /// As Embree takes it: beyond, and where a mesh is one point that rounding misses, a ray meets
  /// nothing that floats could tell.
  Eigen::Vector3f local_origin(const Vector3& point) const {
    constexpr double farthest = 0x1p40;
    return local(point).cwiseMax(-farthest).cwiseMin(farthest).cast<float>();
  }
  float local_length(double length) const {
    return static_cast<float>(std::min<double>(length * scale, std::numeric_limits<float>::max()));
  }
};

Frame frame_of(const TriangleMesh& mesh) {
  if (mesh.face_count() == 0) throw std::invalid_argument("RayScene: no triangles");
  if (mesh.triangles.minCoeff() < 0 || mesh.triangles.maxCoeff() >= mesh.vertex_count())
    throw std::invalid_argument("RayScene: a triangle names a vertex that is not there");
  Vector3 lower = mesh.position(mesh.triangles(0, 0)), upper = lower;
  for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3 corner = mesh.position(mesh.triangles.data()[i]);
    if (!corner.allFinite()) throw std::invalid_argument("RayScene: not finite");
    lower = lower.cwiseMin(corner);
    upper = upper.cwiseMax(corner);
  }
  // Halves first: the difference of two large numbers may be none.
  const Vector3 halves = upper / 2 - lower / 2;
  const double half = halves.maxCoeff();
  int exponent = 0;
  std::frexp(half, &exponent);
  constexpr int greatest = 1000;  // 2¹⁰²⁴ is infinite, and numbers below the normal ask for more
  return {lower + halves, half > 0 ? std::ldexp(1.0, std::min(greatest, -exponent)) : 1.0,
          2 * halves.stableNorm(), std::nullopt};
}

/// How many boxes of triangles a place of the mesh's box is in, by and large: Σ surface of their
/// boxes / surface of the mesh's. Some 4 where triangles are compact, as many as there are where
/// each goes from end to end.
double overlap(const TriangleMesh& mesh, const Frame& frame) {
  const auto half_surface = [](const Vector3& size) {
    return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
  };
  Eigen::AlignedBox3d whole;
  double sum = 0;
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    Eigen::AlignedBox3d box;
    for (int k = 0; k < 3; ++k) box.extend(frame.local(mesh.position(mesh.triangles(f, k))));
    sum += half_surface(box.sizes());
    whole.extend(box);
  }
  const double all = half_surface(whole.sizes());
  return all > 0 ? sum / all : 0;
}

/// Triangles that are long and lie across the axes have boxes that overlap, so that a search goes
/// through all of them. Where that is so, and many have one direction, that direction becomes an
/// axis: the principal axes of the sides, each weighted by its squared length. The turned cube
/// reaches √3 from the centre, as the cube does.
Frame turned(const TriangleMesh& mesh, Frame frame) {
  constexpr double crowded = 32, worthwhile = 0.5;
  const double given = overlap(mesh, frame);
  if (!(given > crowded)) return frame;
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (Eigen::Index f = 0; f < mesh.face_count(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const Vector3 side = frame.local(mesh.position(mesh.triangles(f, (k + 1) % 3))) -
                           frame.local(mesh.position(mesh.triangles(f, k)));
      squares += side * side.transpose();
    }
  }
  Frame other = frame;
  other.turn =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(squares).eigenvectors().transpose().eval();
  return overlap(mesh, other) < worthwhile * given ? other : frame;
}

/// A ray that is no number anywhere meets nothing.
template <class Ray>
void set_ray(Ray& ray, const Eigen::Vector3f& wanted_origin,
             const Eigen::Vector3f& wanted_direction, float wanted_reach) {
  const bool is_ray =
      wanted_origin.allFinite() && wanted_direction.allFinite() && !std::isnan(wanted_reach);
  const Eigen::Vector3f origin = is_ray ? wanted_origin : Eigen::Vector3f::Zero();
  const Eigen::Vector3f direction = is_ray ? wanted_direction : Eigen::Vector3f::UnitZ();
  const float reach = is_ray ? wanted_reach : -1;
  ray.org_x = origin.x();
  ray.org_y = origin.y();
  ray.org_z = origin.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tnear = 0;
  ray.tfar = reach;
  ray.time = 0;
  ray.mask = ~0u;
  ray.id = 0;
  ray.flags = 0;
}

RTCIntersectContext context_of_rays(RTCIntersectContextFlags flags) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = flags;
  return context;
}

RTCIntersectContext scattered_rays() {
  return context_of_rays(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
}

RTCIntersectContext rays_side_by_side() {
  return context_of_rays(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
}

/// A search for the nearest point, as it goes on.
///
/// Most triangles that the tree comes to are farther away than the best so far already by their
/// boxes, and are passed over. That is told from squared distances, whose rounding must not decide:
/// a point of a triangle is computed to within 8√3 roundings of the longest vector that goes in,
/// and the distance of a box likewise, e = 2⁻⁴⁷ L together, so that one found at distance d has a
/// box at d + e at most, and (d + e)² ≤ (1 + 2⁻³⁰) d² + (1 + 2³⁰) e².
class Search {
 public:
  Search(const TriangleMesh& mesh, const std::vector<Face>& faces, const Frame& frame,
         const Vector3& point, double near_enough)
      : mesh_(mesh),
        faces_(faces),
        frame_(frame),
        point_(point),
        near_enough_(near_enough),
        slack_(0x1p-63 * squared_longest(frame, point)),
        centre_(frame.local(point)) {
    if (centre_.squaredNorm() <= far_away * far_away) return;
    const Vector3 away = (point - frame.centre).stableNormalized();
    centre_ = far_away * (frame.turn ? Vector3(*frame.turn * away) : away);
    widening_ = squared_reach_of_cube;
  }

  const Vector3& point() const { return point_; }
  const Vector3& centre() const { return centre_; }
  bool is_far_away() const { return widening_ > 0; }
  const NearestPoint& best() const { return best_; }
  /// Squared: a box farther than that has nothing to offer.
  double beyond() const { return beyond_; }
  /// How many triangles the tree of boxes came to.
  int visited() const { return visited_; }

  void pass_over_what_is_not_near_enough() {
    beyond_ = std::min(beyond_, widened_square(near_enough_));
  }

  bool ends() const { return best_.squared_distance <= near_enough_; }

  /// By Embree's number.
  bool come_to(unsigned number) {
    ++visited_;
    return !ends() && consider(faces_[number]);
  }

  /// Is this face nearer than the best so far?
  bool consider(Face face) {
    const auto corners = mesh_.triangles.row(face);
    const Vector3 a = mesh_.position(corners[0]), b = mesh_.position(corners[1]),
                  c = mesh_.position(corners[2]);
    if (is_beyond_best(a, b, c)) return false;
    const TrianglePoint found = nearest_on_triangle(point_, a, b, c);
    const double squared = found.squared_distance;
    const bool first = best_.on.face < 0;
    const bool wins =
        first || squared < best_.squared_distance ||
        (squared == best_.squared_distance && face < best_.on.face);  // whoever came first
    if (!wins) return false;
    best_ = {{face, found.barycentric}, squared};
    beyond_ = std::min(beyond_, widened_square(squared));
    const Vector3& w = found.barycentric;
    foot_ = w[0] * frame_.local(a) + w[1] * frame_.local(b) + w[2] * frame_.local(c);
    return true;
  }

  /// Beyond it from `centre` nothing can be the nearest.
  float radius() const {
    if (best_.on.face < 0) return std::numeric_limits<float>::infinity();
    return widened(std::sqrt((centre_ - foot_).squaredNorm() + widening_));
  }

  /// Beyond it nothing is near enough.
  float radius_of_near_enough() const {
    if (widening_ > 0) return std::numeric_limits<float>::infinity();
    return widened(std::sqrt(near_enough_) * frame_.scale);
  }

 private:
  /// L²: from the point to any other of the mesh, and of two sides of a triangle.
  static double squared_longest(const Frame& frame, const Vector3& point) {
    const double longest = (point - frame.centre).stableNorm() + 2.5 * frame.diagonal;
    return longest * longest;
  }

  bool is_beyond_best(const Vector3& a, const Vector3& b, const Vector3& c) const {
    const Vector3 lower = a.cwiseMin(b).cwiseMin(c), upper = a.cwiseMax(b).cwiseMax(c);
    return (lower - point_).cwiseMax(point_ - upper).cwiseMax(0).squaredNorm() > beyond_;
  }

  double widened_square(double squared) const { return (1 + 0x1p-30) * squared + slack_; }

  float widened(double known) const {
    const double size = 1 + centre_.cwiseAbs().maxCoeff();
    return static_cast<float>(known * (1 + radius_slack) + position_slack * size);
  }

  const TriangleMesh& mesh_;
  const std::vector<Face>& faces_;
  const Frame& frame_;
  const Vector3& point_;
  const double near_enough_;  // squared; where triangles are piled up, all of them are near
  const double slack_;        // of squared distances of boxes
  int visited_ = 0;
  double beyond_ = std::numeric_limits<double>::infinity();
  Vector3 centre_;       // p, or p' where p is far away; local
  double widening_ = 0;  // of the squared radius
  NearestPoint best_ = {{-1, Vector3::Zero()}, std::numeric_limits<double>::infinity()};
  Vector3 foot_ = Vector3::Zero();  // of the best; local
};

/// Returns true where the radius has changed, as Embree wants it.
bool come_to_triangle(RTCPointQueryFunctionArguments* arguments) {
  auto& search = *static_cast<Search*>(arguments->userPtr);
  if (!search.come_to(arguments->primID)) return false;
  const float radius = search.radius();
  // Of two triangles equally near the second may have the wider radius, by rounding.
  if (!(radius < arguments->query->radius)) return false;
  arguments->query->radius = radius;
  return true;
}

void go_through(RTCScene scene, Search& search, float radius) {
  RTCPointQuery query;
  query.x = static_cast<float>(search.centre().x());
  query.y = static_cast<float>(search.centre().y());
  query.z = static_cast<float>(search.centre().z());
  query.time = 0;
  query.radius = radius;
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene, &query, &context, come_to_triangle, &search);
}

void go_through(const OrientedBoxes& boxes, Search& search) {
  boxes.visit(
      search.point(), [&] { return search.beyond(); },
      [&](Face face) { return search.consider(face) && search.ends(); });
}

}  // namespace

struct RayScene::Tree {
  explicit Tree(const TriangleMesh& triangles)
      : mesh(triangles),
        frame(turned(triangles, frame_of(triangles))),
        faces(distinct_faces(triangles)),
        scene(device.handle) {
    Geometry geometry(device.handle);
    fill(geometry.handle);
    rtcCommitGeometry(geometry.handle);
    rtcAttachGeometry(scene.handle, geometry.handle);
    rtcSetSceneFlags(scene.handle, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene.handle);
    require_success(device.handle);
  }

  void fill(RTCGeometry geometry) const {
    const auto vertices = static_cast<size_t>(mesh.vertex_count());
    auto* const positions = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices));
    auto* const indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), faces.size()));
    if (!positions || !indices) require_success(device.handle);
    for (size_t v = 0; v < vertices; ++v) {
      const Vector3 point = frame.local(mesh.position(static_cast<Vertex>(v)));
      for (size_t axis = 0; axis < 3; ++axis) {
        positions[3 * v + axis] = static_cast<float>(point[static_cast<Eigen::Index>(axis)]);
      }
    }
    for (size_t i = 0; i < faces.size(); ++i) {
      std::copy_n(mesh.triangles.row(faces[i]).data(), 3, indices + 3 * i);
    }
  }

  /// Do boxes along the axes overlap, so that a search comes to many triangles also where it begins
  /// on the mesh? A handful is usual.
  bool is_crowded() const {
    constexpr size_t probes = 256, many = 24;
    size_t visited = 0;
    for (size_t i = 0; i < probes && visited <= many * probes; ++i) {
      const Face face = faces[i * faces.size() / probes];
      Vector3 middle = Vector3::Zero();
      for (int k = 0; k < 3; ++k) middle += mesh.position(mesh.triangles(face, k)) / 3;
      Search search(mesh, faces, frame, middle, -1);
      search.consider(face);
      sphparam::go_through(scene.handle, search, search.radius());
      visited += static_cast<size_t>(search.visited());
    }
    return visited > many * probes;
  }

  /// The rest of a search; nothing beyond the radius, of Embree's coordinates, is of interest.
  void go_through(Search& search, float radius) const {
    std::call_once(boxes_chosen, [&] {
      if (is_crowded()) oriented.emplace(mesh, faces, frame.scale);
    });
    if (oriented && !search.is_far_away()) return sphparam::go_through(*oriented, search);
    sphparam::go_through(scene.handle, search, radius);
  }

  RayHit hit_of(const RTCRayHit& ray) const {
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {faces[ray.hit.primID], ray.ray.tfar / frame.scale};
  }

  const TriangleMesh& mesh;
  Frame frame;
  std::vector<Face> faces;  // of the mesh, by Embree's numbers
  Device device;
  Scene scene;
  mutable std::once_flag boxes_chosen;
  mutable std::optional<OrientedBoxes> oriented;  // for nearest points, where it is crowded
};

RayScene::RayScene(const TriangleMesh& mesh) : tree_(std::make_unique<Tree>(mesh)) {}
RayScene::~RayScene() = default;

double RayScene::clearance() const { return local_clearance / tree_->frame.scale; }
double RayScene::diagonal() const { return tree_->frame.diagonal; }

void RayScene::find_blocked(const Vector3& origin, std::span<const Eigen::Vector3f> directions,
                            double reach, std::span<std::uint8_t> blocked) const {
  const Eigen::Vector3f from = tree_->frame.local_origin(origin);
  const float local_reach = tree_->frame.local_length(reach);
  std::array<RTCRay, bundle> rays;
  for (size_t first = 0; first < directions.size(); first += bundle) {
    const size_t count = std::min(bundle, directions.size() - first);
    for (size_t i = 0; i < count; ++i) {
      set_ray(rays[i], from, tree_->frame.local_direction(directions[first + i]), local_reach);
    }
    RTCIntersectContext context = scattered_rays();
    rtcOccluded1M(tree_->scene.handle, &context, rays.data(), static_cast<unsigned>(count),
                  sizeof(RTCRay));
    // Embree's word for a ray that is blocked is tfar = −∞.
    for (size_t i = 0; i < count; ++i) blocked[first + i] = rays[i].tfar < 0;
  }
}

void RayScene::find_distances(const Vector3& origin, std::span<const Eigen::Vector3f> directions,
                              double reach, std::span<float> distances) const {
  const Eigen::Vector3f from = tree_->frame.local_origin(origin);
  const float local_reach = tree_->frame.local_length(reach);
  std::array<RTCRayHit, bundle> rays;
  for (size_t first = 0; first < directions.size(); first += bundle) {
    const size_t count = std::min(bundle, directions.size() - first);
    for (size_t i = 0; i < count; ++i) {
      set_ray(rays[i].ray, from, tree_->frame.local_direction(directions[first + i]), local_reach);
      rays[i].hit.geomID = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext context = scattered_rays();
    rtcIntersect1M(tree_->scene.handle, &context, rays.data(), static_cast<unsigned>(count),
                   sizeof(RTCRayHit));
    for (size_t i = 0; i < count; ++i) {
      distances[first + i] = static_cast<float>(rays[i].ray.tfar / tree_->frame.scale);
    }
  }
}

RayHit RayScene::first_hit(const Vector3& origin, const Vector3& unit_direction,
                           double reach) const {
  RTCRayHit ray;
  set_ray(ray.ray, tree_->frame.local_origin(origin),
          tree_->frame.local_direction(unit_direction.cast<float>()),
          tree_->frame.local_length(reach));
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context = scattered_rays();
  rtcIntersect1(tree_->scene.handle, &context, &ray);
  return tree_->hit_of(ray);
}

void RayScene::first_hits(std::span<const Ray> rays, std::span<RayHit> hits) const {
  std::array<RTCRayHit, bundle> cast;
  for (size_t first = 0; first < rays.size(); first += bundle) {
    const size_t count = std::min(bundle, rays.size() - first);
    for (size_t i = 0; i < count; ++i) {
      const Ray& ray = rays[first + i];
      set_ray(cast[i].ray, tree_->frame.local_origin(ray.origin),
              tree_->frame.local_direction(ray.unit_direction.cast<float>()),
              tree_->frame.local_length(ray.reach));
      cast[i].hit.geomID = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext context = rays_side_by_side();
    rtcIntersect1M(tree_->scene.handle, &context, cast.data(), static_cast<unsigned>(count),
                   sizeof(RTCRayHit));
    for (size_t i = 0; i < count; ++i) hits[first + i] = tree_->hit_of(cast[i]);
  }
}

NearestPoint RayScene::nearest(const Vector3& point, Face guess, double near_enough) const {
  Search search(tree_->mesh, tree_->faces, tree_->frame, point, near_enough);
  if (guess >= 0) search.consider(guess);
  if (!search.ends()) tree_->go_through(search, search.radius());
  return search.best();
}

bool RayScene::is_within(double distance, const Vector3& point, Face guess) const {
  Search search(tree_->mesh, tree_->faces, tree_->frame, point, distance * distance);
  if (guess >= 0) search.consider(guess);
  search.pass_over_what_is_not_near_enough();
  if (!search.ends()) tree_->go_through(search, search.radius_of_near_enough());
  return search.ends();
}

}  // namespace sphparam
