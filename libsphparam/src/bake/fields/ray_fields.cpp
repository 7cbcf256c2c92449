// One bundle of cosine-distributed rays a sample, from a point lifted off its triangle by the
// scene's clearance. They come in opposite pairs, so a mean over rays that nothing blocks is the
// normal itself, without noise.

#include "bake/fields/ray_fields.h"

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

#include "bake/bake_scene.h"
#include "bake/field_registry.h"
#include "bake/projected_surface.h"
#include "mesh/float32_size.h"
#include "number_text.h"
#include "rays/cosine_rays.h"
#include "rays/flat_normal.h"

namespace sphparam {

namespace {

/// Which way the rays go.
enum class Side { Outwards = 1, Inwards = -1 };

/// A point of the surface as rays start there.
struct Start {
  Vector3 origin;
  Eigen::Vector3f axis;   // of the rays: the smooth normal, outwards or inwards
  Eigen::Vector3f plane;  // the triangle's normal on that side
};

/// What all three fields share. One copy serves all threads.
struct RayCaster {
  std::shared_ptr<const RayScene> scene;
  const TriangleMesh& mesh;
  const Points& normals;
  CosineRays rays;
  double reach;
  std::shared_ptr<const CornerNormals> corner_normals;  // none: `normals` are those of corners too

  Vector3 corner_normal(Face f, int k) const {
    if (corner_normals) return corner_normals->row(3 * f + k);
    return normals.row(mesh.triangles(f, k));
  }

  Start start(const SurfaceSample& sample, Side side) const {
    const SurfacePoint& at = sample.point;
    const auto corners = mesh.triangles.row(at.face);
    const Vector3 a = mesh.position(corners[0]), b = mesh.position(corners[1]),
                  c = mesh.position(corners[2]);
    const Vector3& w = at.barycentric;
    const Vector3 smooth = w[0] * corner_normal(at.face, 0) + w[1] * corner_normal(at.face, 1) +
                           w[2] * corner_normal(at.face, 2);
    const Vector3 flat = flat_normal(a, b, c);
    const double sign = static_cast<double>(side) * (is_back(sample.found) ? -1 : 1);
    // Of a triangle without area only the smooth normal is known; of opposed normals only the flat.
    const Vector3 plane = sign * (flat.isZero(0) ? smooth.stableNormalized() : flat);
    const Vector3 axis = sign * (smooth.isZero(0) ? flat : smooth.stableNormalized());
    return {w[0] * a + w[1] * b + w[2] * c + scene->clearance() * plane, axis.cast<float>(),
            plane.cast<float>()};
  }
};

/// Rays of one thread, used again from sample to sample.
struct Bundle {
  explicit Bundle(const RayCaster& caster)
      : wanted(static_cast<size_t>(caster.rays.count())), cast(wanted.size()) {}

  void aim(const RayCaster& caster, const Start& start, std::uint64_t seed) {
    caster.rays.aim(start.axis, seed, wanted);
    for (size_t i = 0; i < wanted.size(); ++i) {
      const float height = wanted[i].dot(start.plane);
      cast[i] = height < 0 ? Eigen::Vector3f(wanted[i] - 2 * height * start.plane) : wanted[i];
    }
  }

  std::vector<Eigen::Vector3f> wanted;  // about the smooth normal
  std::vector<Eigen::Vector3f> cast;    // none of them into its own triangle
};

/// How many rays went inwards, and met nothing. Sums: the same in whatever order.
struct RayCounts {
  std::atomic<std::int64_t> cast = 0, missed = 0;

  std::string remark() const {
    constexpr double harmless = 0.01;
    if (cast == 0) return "";
    const double share = static_cast<double>(missed) / static_cast<double>(cast);
    if (share <= harmless) return "";
    return "thickness: " + percent(share) +
           " of the rays met nothing, and count as the mesh's whole diagonal: it has holes there, "
           "or is inside out";
  }
};

RayCaster caster_of(std::shared_ptr<const RayScene> scene, const TriangleMesh& mesh,
                    const Points& normals, const RayFieldOptions& options) {
  const double reach = options.reach * scene->diagonal();
  return {std::move(scene), mesh, normals, CosineRays(options.rays), reach, options.corner_normals};
}

/// Calls visit(i, start, bundle, blocked) for every sample.
template <class Visit>
void cast_outwards(const RayCaster& caster, std::span<const SurfaceSample> samples,
                   const Visit& visit) {
  Bundle bundle(caster);
  std::vector<std::uint8_t> blocked(bundle.cast.size());
  for (size_t i = 0; i < samples.size(); ++i) {
    const Start start = caster.start(samples[i], Side::Outwards);
    bundle.aim(caster, start, samples[i].seed);
    caster.scene->find_blocked(start.origin, bundle.cast, caster.reach, blocked);
    visit(i, start, bundle, blocked);
  }
}

std::string reach_text(const RayFieldOptions& options) {
  char text[64];
  std::snprintf(text, sizeof text, "%d rays, reach %g of the diagonal", options.rays,
                options.reach);
  return text;
}

}  // namespace

SurfaceField occlusion_field(std::shared_ptr<const RayScene> scene, const TriangleMesh& mesh,
                             const Points& normals, const RayFieldOptions& options) {
  const RayCaster caster = caster_of(std::move(scene), mesh, normals, options);
  const auto evaluate = [caster](std::span<const SurfaceSample> samples, float* values) {
    cast_outwards(caster, samples,
                  [values](size_t i, const Start&, const Bundle&, const auto& hit) {
                    int open = 0;
                    for (const std::uint8_t blocked : hit) open += !blocked;
                    values[i] = static_cast<float>(open) / static_cast<float>(hit.size());
                  });
  };
  return {.name = "ao",
          .channels = 1,
          .kind = FieldKind::Data,
          .about = "share of the sky that is seen, cosine-weighted, " + reach_text(options),
          .range = {{0, 1}},
          .evaluate = evaluate};
}

SurfaceField bent_normal_field(std::shared_ptr<const RayScene> scene, const TriangleMesh& mesh,
                               const Points& normals, const RayFieldOptions& options) {
  const RayCaster caster = caster_of(std::move(scene), mesh, normals, options);
  const auto evaluate = [caster](std::span<const SurfaceSample> samples, float* values) {
    cast_outwards(caster, samples,
                  [values](size_t i, const Start& start, const Bundle& bundle, const auto& hit) {
                    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
                    // The directions wanted, not the mirrored ones: those would tilt with every
                    // facet.
                    for (size_t ray = 0; ray < hit.size(); ++ray) {
                      if (!hit[ray]) sum += bundle.wanted[ray];
                    }
                    const float length = sum.norm();
                    Eigen::Map<Eigen::Vector3f>(values + 3 * i) =
                        length > 0 ? sum / length : start.axis;
                  });
  };
  return {.name = "bent",
          .channels = 3,
          .kind = FieldKind::Direction,
          .about = "mean unblocked direction, object space, " + reach_text(options),
          .range = {{-1, 1}},
          .evaluate = evaluate};
}

SurfaceField thickness_field(std::shared_ptr<const RayScene> scene, const TriangleMesh& mesh,
                             const Points& normals, const RayFieldOptions& options) {
  const RayCaster caster = caster_of(std::move(scene), mesh, normals, options);
  const auto counts = std::make_shared<RayCounts>();
  const auto evaluate = [caster, counts](std::span<const SurfaceSample> samples, float* values) {
    Bundle bundle(caster);
    std::vector<float> distances(bundle.cast.size());
    const auto beyond = static_cast<float>(caster.reach * (1 - 1e-5));  // but for roundings
    for (size_t i = 0; i < samples.size(); ++i) {
      const Start start = caster.start(samples[i], Side::Inwards);
      bundle.aim(caster, start, samples[i].seed);
      caster.scene->find_distances(start.origin, bundle.cast, caster.reach, distances);
      double sum = 0;
      for (const float distance : distances) sum += distance;
      counts->cast += std::ssize(distances);
      counts->missed +=
          std::ranges::count_if(distances, [beyond](float way) { return way >= beyond; });
      values[i] = static_cast<float>(sum / static_cast<double>(distances.size()));
    }
  };
  return {.name = "thickness",
          .channels = 1,
          .kind = FieldKind::Data,
          .about = "mean way inwards, cosine-weighted, units of the mesh, " + reach_text(options),
          .evaluate = evaluate,
          .remark = [counts] { return counts->remark(); }};
}

namespace {

/// What rays meet: not what only closes holes.
std::shared_ptr<const RayScene> rays_on(const BakeSource& source) {
  if (source.surface) return {source.surface, &source.surface->rays()};
  const MappedMesh& mapped = *source.mapped;
  if (mapped.fillers().empty()) return std::make_shared<const RayScene>(mapped.mesh());
  struct Kept {
    TriangleMesh mesh;
    RayScene scene;
    explicit Kept(TriangleMesh surface) : mesh(std::move(surface)), scene(mesh) {}
  };
  const auto kept = std::make_shared<const Kept>(surface_in_place(mapped.mesh(), mapped.fillers()));
  return {kept, &kept->scene};
}

/// Those of the file; of a corner that has none, that of its vertex.
std::shared_ptr<const CornerNormals> corner_normals_of(const BakeSource& source) {
  if (!source.file().corner_normals) return nullptr;
  auto normals = std::make_shared<CornerNormals>(*source.file().corner_normals);
  const Triangles& triangles = source.mesh().triangles;
  for (Eigen::Index row = 0; row < normals->rows(); ++row) {
    const Vector3 own = normals->row(row);
    if (own.allFinite() && !own.isZero(0)) continue;
    normals->row(row) = source.normals.row(triangles(row / 3, row % 3));
  }
  return normals;
}

using MakeRayField = SurfaceField(std::shared_ptr<const RayScene>, const TriangleMesh&,
                                  const Points&, const RayFieldOptions&);

SurfaceField make_of_scene(MakeRayField* make, const BakeScene& scene, const std::string& argument,
                           double reach) {
  if (!argument.empty()) throw FieldError("no argument is known here: " + argument);
  const TriangleMesh& mesh = scene.source.mesh();
  return make(rays_on(scene.source), mesh, scene.source.normals,
              {.rays = scene.options.rays,
               .reach = reach,
               .corner_normals = corner_normals_of(scene.source)});
}

}  // namespace

SurfaceField make_occlusion(const BakeScene& scene, const std::string& argument) {
  return make_of_scene(occlusion_field, scene, argument, scene.options.max_ray_distance);
}

SurfaceField make_bent_normal(const BakeScene& scene, const std::string& argument) {
  return make_of_scene(bent_normal_field, scene, argument, scene.options.max_ray_distance);
}

SurfaceField make_thickness(const BakeScene& scene, const std::string& argument) {
  require_float32_size(scene.source.mesh().positions, "thickness");
  SurfaceField field = make_of_scene(thickness_field, scene, argument, 1);
  field.unit = unit_of_lengths(scene.options);
  return field;
}

}  // namespace sphparam
