// Ambient occlusion against bare Embree, and nearest points, in ratios within one run.
//
// Usage: bench_rays [TEXELS [RAYS]]          (default: 2048·1024 texels, 64 rays; one thread)
// The field casts the rays of `occlusion_field`; beside it stand loops over the very same rays,
// aimed beforehand, that do nothing but call Embree: one by one, and in streams of 64.
// Never a test: machines are noisy.

#include <embree3/rtcore.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include "bake/fields/ray_fields.h"
#include "measure/surface_samples.h"
#include "mesh/vertex_normals.h"
#include "rays/cosine_rays.h"
#include "yardstick.h"

using namespace sphparam;
using namespace sphparam::bench;

namespace {

constexpr double reach = 0.1;   // of the diagonal
constexpr size_t block = 1024;  // texels

/// Embree as its tutorials use it: its own choice of instructions, the mesh in floats as it is.
struct BareScene {
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = rtcNewScene(device);

  explicit BareScene(const TriangleMesh& mesh) {
    const auto vertices = static_cast<size_t>(mesh.vertex_count());
    const auto faces = static_cast<size_t>(mesh.face_count());
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, vertices));
    auto* indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, faces));
    for (size_t i = 0; i < 3 * vertices; ++i) {
      positions[i] = static_cast<float>(mesh.positions.data()[i]);
    }
    std::copy_n(mesh.triangles.data(), 3 * faces, indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(scene);
  }
  ~BareScene() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  BareScene(const BareScene&) = delete;
  BareScene& operator=(const BareScene&) = delete;

  void one_by_one(std::vector<RTCRay>& rays) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (RTCRay& ray : rays) rtcOccluded1(scene, &context, &ray);
  }

  void in_streams(std::vector<RTCRay>& rays, size_t length) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (size_t i = 0; i < rays.size(); i += length) {
      rtcOccluded1M(scene, &context, &rays[i], static_cast<unsigned>(length), sizeof(RTCRay));
    }
  }
};

/// The rays that the field casts from a sample, in the coordinates of the mesh.
void append_rays(const TriangleMesh& mesh, const Points& normals, const RayScene& scene,
                 const CosineRays& cosine, const SurfaceSample& sample, std::vector<RTCRay>& rays) {
  const auto corners = mesh.triangles.row(sample.point.face);
  const Vector3& w = sample.point.barycentric;
  Vector3 origin = Vector3::Zero(), smooth = Vector3::Zero();
  for (int k = 0; k < 3; ++k) {
    origin += w[k] * mesh.position(corners[k]);
    smooth += w[k] * normals.row(corners[k]).transpose();
  }
  const Vector3 a = mesh.position(corners[0]);
  const Vector3 plane =
      (mesh.position(corners[1]) - a).cross(mesh.position(corners[2]) - a).stableNormalized();
  origin += scene.clearance() * plane;
  std::vector<Eigen::Vector3f> directions(static_cast<size_t>(cosine.count()));
  cosine.aim(smooth.stableNormalized().cast<float>(), sample.seed, directions);
  for (Eigen::Vector3f d : directions) {
    const Eigen::Vector3f up = plane.cast<float>();
    if (d.dot(up) < 0) d -= 2 * d.dot(up) * up;
    RTCRay ray = {};
    ray.org_x = static_cast<float>(origin.x());
    ray.org_y = static_cast<float>(origin.y());
    ray.org_z = static_cast<float>(origin.z());
    ray.dir_x = d.x();
    ray.dir_y = d.y();
    ray.dir_z = d.z();
    ray.tfar = static_cast<float>(reach * scene.diagonal());
    ray.mask = ~0u;
    rays.push_back(ray);
  }
}

struct Tally {
  double seconds = 0;
  size_t open = 0;
};

template <class Cast>
void run_bare(std::vector<RTCRay> rays, const Cast& cast, Tally& tally) {
  const double start = now();
  cast(rays);
  tally.seconds += now() - start;
  for (const RTCRay& ray : rays) tally.open += ray.tfar >= 0;
}

void bench_occlusion(const TriangleMesh& mesh, size_t texels, int rays_each) {
  const Points normals = vertex_normals(mesh);
  const auto scene = std::make_shared<const RayScene>(mesh);
  const BareScene bare(mesh);
  const CosineRays cosine(rays_each);
  const SurfaceField field =
      occlusion_field(scene, mesh, normals, {.rays = rays_each, .reach = reach});
  Tally ours, single, streams;
  std::vector<float> values(block);
  for (size_t first = 0; first < texels; first += block) {
    std::vector<SurfaceSample> samples;
    for (size_t i = first; i < std::min(texels, first + block); ++i) {
      const auto face = static_cast<Face>(i * static_cast<size_t>(mesh.face_count()) / texels);
      samples.push_back({{face, Vector3(0.3, 0.3, 0.4)}, i});
    }
    std::vector<RTCRay> rays;
    for (const SurfaceSample& s : samples) append_rays(mesh, normals, *scene, cosine, s, rays);
    run_bare(
        rays, [&](auto& all) { bare.one_by_one(all); }, single);
    run_bare(
        rays, [&](auto& all) { bare.in_streams(all, 64); }, streams);
    const double start = now();
    field.evaluate(samples, values.data());
    ours.seconds += now() - start;
    for (size_t i = 0; i < samples.size(); ++i) {
      ours.open += static_cast<size_t>(std::lround(values[i] * static_cast<float>(cosine.count())));
    }
  }
  const double count = static_cast<double>(texels) * cosine.count();
  std::printf("ambient occlusion: %td triangles, %zu texels, %d rays each, one thread\n",
              mesh.face_count(), texels, cosine.count());
  const auto line = [&](const char* name, const Tally& tally) {
    std::printf("  %-28s %8.2f million rays/s   open %.5f   ours at %5.1f %% of it\n", name,
                1e-6 * count / tally.seconds, static_cast<double>(tally.open) / count,
                100 * tally.seconds / ours.seconds);
  };
  line("the field", ours);
  line("bare Embree, one by one", single);
  line("bare Embree, streams of 64", streams);
}

void bench_nearest(const TriangleMesh& mesh) {
  const RayScene scene(mesh);
  const FaceSamples on_surface(mesh, 1'000'000, 1);
  double start = now(), sum = 0;
  Face guess = -1;
  for (std::int64_t i = 0; i < on_surface.count(); ++i) {
    const Vector3 p = 1.01 * on_surface(i);
    const NearestPoint found = scene.nearest(p, guess);
    guess = found.on.face;
    sum += found.squared_distance;
  }
  const double with_guess = now() - start;
  start = now();
  for (std::int64_t i = 0; i < on_surface.count(); ++i) {
    sum += scene.nearest(1.01 * on_surface(i)).squared_distance;
  }
  std::printf("nearest points, one thread: %.2f µs each in order, %.2f µs without a guess  (%g)\n",
              with_guess, now() - start, sum);
}

}  // namespace

int main(int argc, char** argv) {
  const size_t texels = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 2048 * 1024;
  const int rays = argc > 2 ? std::atoi(argv[2]) : 64;
  const TriangleMesh mesh = yardstick_mesh(meshes_folder());
  bench_occlusion(mesh, std::max<size_t>(texels, block), std::max(rays, 1));
  bench_nearest(mesh);
}
