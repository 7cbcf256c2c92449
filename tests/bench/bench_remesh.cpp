// Measures `sphparam remesh` in ratios to what others need, in the same run:
//
//   location against Embree's rays from the centre, one thread, in random order, in the order of an
//   image's rows and in the order of a subdivided grid; also in maps squashed by 1e-4;
//   location and transfer of position against OpenSubdiv's refinement of the same grid.
//
// Usage: bench_remesh [--level L] [--repeat N] [--threads N] [MESH]
// Without a mesh: the sample body, 348,480 triangles. Never a test: machines are noisy.

#include <embree3/rtcore.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <random>

#include "io/polygons/welding.h"
#include "remesh/grids/polyhedron.h"
#include "sample_meshes.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/parameterize.h"
#include "sphparam/remesh/remesh.h"
#include "sphparam/sphere/certificate.h"
#include "sphparam/sphere/sphere_locator.h"
#include "yardstick.h"

using namespace sphparam;
using namespace sphparam::bench;

namespace {

double quickest(int repeat, const std::function<void()>& work) {
  double best = std::numeric_limits<double>::max();
  for (int i = 0; i < repeat; ++i) {
    const double start = now();
    work();
    best = std::min(best, now() - start);
  }
  return best;
}

/// Rays from the centre through a sphere of float32 triangles, one at a time on one thread.
class EmbreeRays {
 public:
  EmbreeRays(const Triangles& triangles, const SphereMap& map, bool robust)
      : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    if (robust) rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), static_cast<size_t>(map.points.rows())));
    std::transform(map.points.data(), map.points.data() + map.points.size(), points,
                   [](double x) { return static_cast<float>(x); });
    auto* indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), static_cast<size_t>(triangles.rows())));
    std::copy(triangles.data(), triangles.data() + triangles.size(), indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~EmbreeRays() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeRays(const EmbreeRays&) = delete;
  EmbreeRays& operator=(const EmbreeRays&) = delete;

  /// Returns how many rays hit nothing.
  long locate_all(const Points& directions, std::vector<SurfacePoint>& points) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    long missed = 0;
    points.resize(static_cast<size_t>(directions.rows()));
    for (Eigen::Index i = 0; i < directions.rows(); ++i) {
      RTCRayHit ray = {};
      ray.ray.dir_x = static_cast<float>(directions(i, 0));
      ray.ray.dir_y = static_cast<float>(directions(i, 1));
      ray.ray.dir_z = static_cast<float>(directions(i, 2));
      ray.ray.tfar = std::numeric_limits<float>::infinity();
      ray.ray.mask = ~0U;
      ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene_, &context, &ray);
      missed += ray.hit.geomID == RTC_INVALID_GEOMETRY_ID;
      const auto u = static_cast<double>(ray.hit.u), v = static_cast<double>(ray.hit.v);
      points[static_cast<size_t>(i)] = {static_cast<Face>(ray.hit.primID), {1 - u - v, u, v}};
    }
    return missed;
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

Points random_directions(int count) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  Points q(count, 3);
  for (int i = 0; i < count; ++i) {
    q.row(i) = Vector3(normal(random), normal(random), normal(random)).normalized();
  }
  return q;
}

/// A million directions in the order of an image's rows.
Points image_rows() { return make_grid({GridKind::Geographic, 1000, 1001}).directions; }

SphereMap squashed(SphereMap map, double factor) {
  map.points.rightCols(2) *= factor;
  map.points.rowwise().normalize();
  return map;
}

void compare_location(const char* name, const Topology& topology, const Triangles& triangles,
                      const SphereMap& map, int repeat) {
  double building = 0;
  const SphereLocator locator = [&] {
    const double start = now();
    SphereLocator made(topology, map, 1);
    building = now() - start;
    return made;
  }();
  const EmbreeRays quick(triangles, map, false), robust(triangles, map, true);
  std::printf("%s: locator built in %.3f s on one thread\n", name, building);
  const std::pair<const char*, Points> orders[] = {
      {"random order", random_directions(1'000'000)},
      {"rows of an image", image_rows()},
      {"ico:8", make_grid({GridKind::Icosahedron, 8, 0}).directions}};
  for (const auto& [order, q] : orders) {
    std::vector<SurfacePoint> points(static_cast<size_t>(q.rows()));
    long missed = 0, missed_robust = 0;
    const double ours = quickest(repeat, [&] { locator.locate_all(q, points, 1); });
    std::vector<SurfacePoint> hits;
    const double theirs = quickest(repeat, [&] { missed = quick.locate_all(q, hits); });
    const double safe = quickest(repeat, [&] { missed_robust = robust.locate_all(q, hits); });
    long other = 0;
    for (size_t i = 0; i < points.size(); ++i) other += points[i].face != hits[i].face;
    const double n = static_cast<double>(q.rows()) / 1e9;
    std::printf(
        "  %-17s ours %5.0f ns, Embree %5.0f ns (robust %5.0f): %.2f × (%.2f ×); misses %ld "
        "(robust %ld), other face %ld\n",
        order, ours / n, theirs / n, safe / n, theirs / ours, safe / ours, missed, missed_robust,
        other);
    std::fflush(stdout);
  }
}

double refine_seconds(int level, bool full_topology, int repeat) {
  namespace Far = OpenSubdiv::Far;
  namespace Sdc = OpenSubdiv::Sdc;
  const Polyhedron base = icosahedron();
  const std::vector<int> degrees(20, 3);
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = 12;
  descriptor.numFaces = 20;
  descriptor.numVertsPerFace = degrees.data();
  descriptor.vertIndicesPerFace = base.faces.data();
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  return quickest(repeat, [&] {
    std::unique_ptr<Far::TopologyRefiner> refiner(
        Factory::Create(descriptor, Factory::Options(Sdc::SCHEME_LOOP, Sdc::Options())));
    Far::TopologyRefiner::UniformOptions options(level);
    options.fullTopologyInLastLevel = full_topology;
    refiner->RefineUniform(options);
  });
}

double peak_megabytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmHWM:", 0) == 0) return std::atof(line.c_str() + 6) / 1024;
  }
  return 0;
}

void compare_stages(const MeshFile& file, const SphereMap& map, int level, int threads,
                    int repeat) {
  const GridSpec spec{GridKind::Icosahedron, level, 0};
  SphereGrid grid;
  const double making = quickest(repeat, [&] { grid = make_grid(spec, {.threads = threads}); });
  const double refining = refine_seconds(level, true, repeat);
  const double lean = refine_seconds(level, false, repeat);
  double locating = 1e9, moving = 1e9, all = 1e9;
  for (int i = 0; i < repeat; ++i) {
    const MappedMesh source({.file = file, .map = map}, threads);  // without its locator yet
    const double start = now();
    const Remeshed result = remesh(source, grid, {.transfer = {"none"}, .threads = threads});
    all = std::min(all, now() - start);
    locating = std::min(locating, result.figures().locate_seconds);
    moving = std::min(moving, result.figures().transfer_seconds);
  }
  std::printf(
      "%s, %ld vertices, %d threads: OpenSubdiv refines in %.3f s (%.3f s without the last "
      "level's edges)\n",
      name_of(spec).c_str(), static_cast<long>(grid.directions.rows()), threads, refining, lean);
  std::printf(
      "  location %.3f s + positions %.3f s = %.2f of that; grid %.3f s; all of it with "
      "locator, faces, topology and its proof: %.3f s; peak %.0f MB\n",
      locating, moving, (locating + moving) / refining, making, all, peak_megabytes());
}

MeshFile source_file(const std::string& path) {
  constexpr int frequency = 132;  // 348,480 triangles
  return path.empty() ? samples::make_body(frequency) : prepare_for_mapping(read_mesh(path));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Locates directions and resamples a mesh; see the top of the source.");
  std::string path;
  int level = 8, repeat = 3, threads = 2;
  program.add_option("MESH", path, "A mesh, with its map or without");
  program.add_option("--level", level, "of the icosahedral grid (8)");
  program.add_option("--repeat", repeat, "the quickest counts (3)");
  program.add_option("--threads", threads, "of the stages (2)");
  CLI11_PARSE(program, argc, argv);
  const MeshFile file = source_file(path);
  const std::optional<SphereMap> written = read_sphere(file);
  const SphereMap map = written ? *written : parameterize(file.mesh).map;
  const Topology topology(file.mesh);
  std::printf("%ld triangles\n", static_cast<long>(file.mesh.face_count()));
  compare_location("map", topology, file.mesh.triangles, map, repeat);
  const SphereMap flat = squashed(map, 1e-4);
  if (certify(topology, flat).bijective()) {
    compare_location("squashed by 1e-4", topology, file.mesh.triangles, flat, repeat);
  }
  compare_stages(file, map, level, threads, repeat);
}
