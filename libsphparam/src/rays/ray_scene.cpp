// Embree, and the only file that knows it. It works in floats, in coordinates of a SceneFrame: what
// a ray hits is Embree's word, which triangle is nearest is judged in doubles (nearest_search.cpp).
// The tree of Embree has boxes along the axes; where these overlap much, boxes that lie as the
// triangles do (OrientedBoxes) take their place in searches for nearest points.

#include "rays/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "rays/distinct_faces.h"
#include "rays/nearest_search.h"
#include "rays/oriented_boxes.h"
#include "rays/scene_frame.h"

namespace sphparam {

namespace {

// One thread builds: the same tree, whatever --threads. AVX2 at most: the same arithmetic on all
// machines of the last ten years.
constexpr char settings[] = "threads=1,isa=avx2";

constexpr double local_clearance = 0x1p-20;

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

/// Returns true where the radius has changed, as Embree wants it.
bool come_to_triangle(RTCPointQueryFunctionArguments* arguments) {
  auto& search = *static_cast<NearestSearch*>(arguments->userPtr);
  if (!search.come_to(arguments->primID)) return false;
  const float radius = search.radius();
  // Of two triangles equally near the second may have the wider radius, by rounding.
  if (!(radius < arguments->query->radius)) return false;
  arguments->query->radius = radius;
  return true;
}

void go_through(RTCScene scene, NearestSearch& search, float radius) {
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

void go_through(const OrientedBoxes& boxes, NearestSearch& search) {
  boxes.visit(
      search.point(), [&] { return search.beyond(); },
      [&](Face face) { return search.consider(face) && search.ends(); });
}

}  // namespace

struct RayScene::Tree {
  explicit Tree(const TriangleMesh& triangles)
      : mesh(triangles),
        frame(scene_frame(triangles)),
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
      NearestSearch search(mesh, faces, frame, middle, -1);
      search.consider(face);
      sphparam::go_through(scene.handle, search, search.radius());
      visited += static_cast<size_t>(search.visited());
    }
    return visited > many * probes;
  }

  /// The rest of a search; nothing beyond the radius, of Embree's coordinates, is of interest.
  void go_through(NearestSearch& search, float radius) const {
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
  SceneFrame frame;
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
  NearestSearch search(tree_->mesh, tree_->faces, tree_->frame, point, near_enough);
  if (guess >= 0) search.consider(guess);
  if (!search.ends()) tree_->go_through(search, search.radius());
  return search.best();
}

bool RayScene::is_within(double distance, const Vector3& point, Face guess) const {
  NearestSearch search(tree_->mesh, tree_->faces, tree_->frame, point, distance * distance);
  if (guess >= 0) search.consider(guess);
  search.pass_over_what_is_not_near_enough();
  if (!search.ends()) tree_->go_through(search, search.radius_of_near_enough());
  return search.ends();
}

}  // namespace sphparam
