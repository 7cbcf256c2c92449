// How near matches of cortices by features come to registered spheres. Two surfaces of a template's
// vertices, such as fs_LR of 32k, correspond vertex by vertex, by the spheres that they were
// registered with; that correspondence is what is compared with:
//
//     cortex_table 792564.L.midthickness.32k_fs_LR.surf.gii
//     S1200.L.midthickness_MSMAll.32k_fs_LR.surf.gii
//
// Features are made here, of both alike: mean curvature over 2 mm, and how deep a point lies
// beneath the surface averaged over 10 mm.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "correspondence/feature_scales.h"
#include "correspondence/surface_roads.h"
#include "mesh/surface_average.h"
#include "mesh/triangle_geometry.h"
#include "mesh/vertex_normals.h"
#include "sphparam/correspondence/match.h"
#include "sphparam/io/mapped_mesh.h"
#include "sphparam/mesh/curvature.h"
#include "sphparam/mesh/vertex_areas.h"
#include "sphparam/stopwatch.h"

using namespace sphparam;

namespace {

constexpr double curvature_scale = 2, depth_scale = 15;  // mm

VectorX curvature(const MappedMesh& m, int threads) {
  return measure_curvature(m.mesh(), m.topology(), curvature_scale, threads).mean;
}

VectorX depth(const MappedMesh& m) {
  const TriangleMesh& mesh = m.mesh();
  VectorX faces(mesh.face_count());
  for (Face f = 0; f < mesh.face_count(); ++f) faces[f] = face_area(mesh, f);
  const VectorX area = vertex_areas(mesh);
  const SurfaceAverage average(mesh, m.topology(), faces, area, depth_scale);
  Points smooth(mesh.vertex_count(), 3);
  for (int c = 0; c < 3; ++c) smooth.col(c) = average(mesh.positions.col(c).cwiseProduct(area));
  const Points normals = vertex_normals({smooth, mesh.triangles});
  return ((smooth - mesh.positions).array() * normals.array()).rowwise().sum();
}

Functions features(const MappedMesh& m, const std::string& which, int threads) {
  if (which == "curvature") return curvature(m, threads);
  if (which == "depth") return depth(m);
  Functions both(m.mesh().vertex_count(), 2);
  both << curvature(m, threads), depth(m);
  return both;
}

double at_share(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values[static_cast<size_t>(share * static_cast<double>(values.size() - 1))];
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Matches cortices by features, beside their registered spheres.");
  std::string from_path, to_path;
  double weight = 2;
  int threads = 0, points = 2000;
  std::vector<std::string> kinds{"curvature", "depth", "both"};
  app.add_option("from", from_path)->required();
  app.add_option("to", to_path)->required();
  app.add_option("--weight", weight);
  app.add_option("--threads", threads);
  app.add_option("--features", kinds);
  CLI11_PARSE(app, argc, argv);
  const MappedMesh from = load_mapped(from_path, {.map = {.threads = threads}});
  const MappedMesh to = load_mapped(to_path, {.map = {.threads = threads}});
  const SurfaceRoads roads(to.mesh(), to.topology());
  const VectorX area = vertex_areas(from.mesh());
  for (const std::string& kind : kinds) {
    MatchOptions options{.threads = threads};
    options.features = {features(from, kind, threads), features(to, kind, threads), weight};
    const Stopwatch watch;
    const Match match = match_surfaces(from, to, options);
    const double seconds = watch.seconds();
    const auto forth = match.map.forth(threads);
    Functions carried(from.mesh().vertex_count(), options.features->to.cols());
    for (Vertex v = 0; v < carried.rows(); ++v) {
      carried.row(v).setZero();
      for (int k = 0; k < 3; ++k)
        carried.row(v) += forth[size_t(v)].barycentric[k] *
                          options.features->to.row(to.mesh().triangles(forth[size_t(v)].face, k));
    }
    std::vector<double> errors;
    for (Vertex v = 0; v < from.mesh().vertex_count(); v += from.mesh().vertex_count() / points)
      errors.push_back(roads.distance(v, forth[size_t(v)]));
    double mean = 0;
    for (const double e : errors) mean += e / static_cast<double>(errors.size());
    std::printf(
        "%-10s w %g: correlation %.3f, registered %.3f; error mm median %.2f mean %.2f 90%% %.2f; "
        "energy %.3f, dist area %.3f angle %.3f, %.1f s\n",
        kind.c_str(), weight, correlation_of(options.features->from, carried, area),
        correlation_of(options.features->from, options.features->to, area), at_share(errors, 0.5),
        mean, at_share(errors, 0.9), match.energy,
        summarise(measure_distortion(match.map)).mean_abs_ln_area,
        summarise(measure_distortion(match.map)).mean_abs_ln_angle, seconds);
    std::fflush(stdout);
  }
  return 0;
}
