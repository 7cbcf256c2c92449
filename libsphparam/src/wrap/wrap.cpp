#include "sphparam/wrap/wrap.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "measure/enclosure.h"
#include "mesh/box.h"
#include "number_text.h"
#include "option_domain.h"
#include "rays/flat_normal.h"
#include "rays/ray_scene.h"
#include "sphparam/errors.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/parallel.h"
#include "wrap/carving.h"
#include "wrap/distance_field.h"
#include "wrap/drawing_in.h"
#include "wrap/level_surface.h"
#include "wrap/simplification.h"
#include "wrap/solid.h"

// Where the part of space near the soup is one ball already, its level set is the result; else the
// ball that is carved about it.

namespace sphparam {

namespace {

constexpr int usual_resolution = 128;
constexpr double usual_distance = 2;  // voxels
constexpr double most_points = 1e8;   // of a lattice: 0.5 to 0.9 GB
// Of the largest coordinate, so that lattices are regular.
constexpr double roundings_a_voxel = 1e6;
constexpr double largest_coordinate = 1e70, least_extent = 1e-60;  // fourth powers are doubles
constexpr double next_to_nothing = 0.01;   // of what is solid, that is hollow in the soup
constexpr std::int64_t samples = 100'000;  // of each surface, for their distance

/// The largest coordinate, on either side of the origin.
double farthest(const Box& box) { return std::max(-box.lower.minCoeff(), box.upper.maxCoeff()); }

std::vector<char> used_vertices(const TriangleMesh& soup) {
  std::vector<char> used(static_cast<size_t>(soup.vertex_count()), 0);
  for (Eigen::Index i = 0; i < soup.triangles.size(); ++i)
    used[static_cast<size_t>(soup.triangles.data()[i])] = 1;
  return used;
}

/// Throws: MeshError with what keeps distances from being taken.
void require_places(const TriangleMesh& soup) {
  const bool some = soup.face_count() > 0 && soup.vertex_count() > 0;
  if (some && soup.triangles.minCoeff() >= 0 && soup.triangles.maxCoeff() < soup.vertex_count() &&
      soup.positions.allFinite())
    return;
  std::vector<MeshDefect> defects = inspect_mesh(soup).defects;
  std::erase_if(defects, [](const MeshDefect& defect) {
    return defect.kind != DefectKind::Empty && defect.kind != DefectKind::IndexOutOfRange &&
           defect.kind != DefectKind::NonFinitePosition;
  });
  throw MeshError(std::move(defects));
}

Box box_of(const TriangleMesh& soup, const std::vector<char>& used) {
  Box box;
  for (Vertex v = 0; v < soup.vertex_count(); ++v) {
    if (used[static_cast<size_t>(v)]) box.add(soup.position(v));
  }
  return box;
}

void require_domain(const WrapOptions& options) {
  require_between("voxel", options.voxel, 0, largest_coordinate);
  require_at_least("resolution", options.resolution, 0);
  require_between("distance", options.distance, 0, largest_coordinate);
  require_between("gap", options.gap, 0, largest_coordinate);
  require_at_least("faces", static_cast<double>(options.faces), 0);
}

double chosen_voxel(const WrapOptions& options, const Box& box) {
  if (options.voxel > 0) return options.voxel;
  if (options.resolution > 0) return box.longest_side() / options.resolution;
  const double usual = box.longest_side() / usual_resolution;
  return options.distance > 0 ? std::min(usual, options.distance / usual_distance) : usual;
}

void require_regular(const Box& box, double voxel) {
  const double finest = roundings_a_voxel * std::numeric_limits<double>::epsilon() * farthest(box);
  if (farthest(box) >= largest_coordinate)
    throw UnmeasurableMesh("coordinates up to " + short_number(farthest(box)) +
                           " are too large to be wrapped: scale the mesh down");
  if (box.longest_side() > least_extent && voxel > finest) return;
  throw UnmeasurableMesh(
      box.longest_side() > least_extent
          ? "a voxel of " + short_number(voxel) + " is too small for coordinates up to " +
                short_number(farthest(box)) + ": make it larger, or move the mesh to the origin"
          : "this mesh has no extent: a surface about it would have no size of its own");
}

/// Of the surface, a layer of points about it, and one more.
double room(double voxel, double distance) { return std::ceil(distance / voxel) + 2; }

Vector3 points_of_lattice(const Box& box, double voxel, double distance) {
  const Vector3 inside = (box.upper - box.lower) / voxel;
  return (inside.array().ceil() + 2 * room(voxel, distance) + 1).matrix();
}

/// Is a voxel as large as it is because the distance is small?
bool follows_from_distance(const WrapOptions& options, double voxel) {
  return options.voxel == 0 && options.resolution == 0 &&
         usual_distance * voxel == options.distance;
}

/// Of those larger than one that is too small the first that is not, about.
double least_voxel(const Box& box, const WrapOptions& options, double voxel) {
  constexpr double step = 1.02;
  const bool distance_stays = options.distance > 0 && !follows_from_distance(options, voxel);
  const auto too_many = [&] {
    const double distance =
        distance_stays ? std::max(options.distance, voxel) : usual_distance * voxel;
    return points_of_lattice(box, voxel, distance).prod() > most_points;
  };
  while (too_many()) voxel *= step;
  return voxel;
}

/// "OPTION is VALUE: it must be about WANTED", of the option that a voxel comes from.
std::string wanted_for_voxel(const WrapOptions& options, double voxel, double least) {
  const auto say = [](const std::string& option, const std::string& value,
                      const std::string& wanted) {
    return option + " is " + value + ": it must be about " + wanted;
  };
  if (options.resolution > 0) {
    const auto most = static_cast<long>(options.resolution * voxel / least);
    return say("resolution", std::to_string(options.resolution), std::to_string(most) + " or less");
  }
  if (follows_from_distance(options, voxel))
    return say("distance", shortest(options.distance),
               short_number(usual_distance * least) + " or more");
  return say("voxel", shortest(voxel), short_number(least) + " or more");
}

[[noreturn]] void refuse_voxel(const Box& box, const WrapOptions& options, double voxel) {
  throw VoxelError(wanted_for_voxel(options, voxel, least_voxel(box, options, voxel)) +
                   " here, for a lattice of at most " + short_number(most_points / 1e6) +
                   " million points");
}

Lattice lattice_about(const Box& box, const WrapOptions& options, double voxel, double distance) {
  const Vector3 points = points_of_lattice(box, voxel, distance);
  if (points.prod() > most_points) refuse_voxel(box, options, voxel);
  const Vector3 first = Vector3::Constant(room(voxel, distance) * voxel);
  Lattice lattice = {box.lower - first, voxel, {}};
  for (int axis = 0; axis < 3; ++axis) lattice.points[axis] = static_cast<int>(points[axis]);
  return lattice;
}

std::int64_t volume(const Solid& solid) { return std::count(solid.begin(), solid.end(), 1); }

const Vector3 some_way = Vector3(0.36, 0.48, 0.8);

/// Whether a ray out of a face goes with its normal.
bool goes_out(const TriangleMesh& mesh, Face f, const Vector3& ray) {
  const auto corner = [&](int k) { return mesh.position(mesh.triangles(f, k)); };
  return flat_normal(corner(0), corner(1), corner(2)).dot(ray) > 0;
}

/// By the first face that a ray from the point meets.
bool encloses(const TriangleMesh& wrap, const RayScene& scene, const Vector3& point) {
  const RayHit hit = scene.first_hit(point, some_way, std::numeric_limits<double>::infinity());
  return hit.face >= 0 && goes_out(wrap, hit.face, some_way);
}

/// How many more faces of a soup a ray from the point leaves than it enters.
int windings(const TriangleMesh& soup, const RayScene& scene, Vector3 point) {
  int left = 0;
  for (;;) {
    const RayHit hit = scene.first_hit(point, some_way, std::numeric_limits<double>::infinity());
    if (hit.face < 0) return left;
    left += goes_out(soup, hit.face, some_way) ? 1 : -1;
    point += (hit.distance + scene.clearance()) * some_way;
  }
}

Vector3 place_of(std::int64_t point, const Lattice& lattice) {
  const auto [along_x, along_y, along_z] = lattice.points;
  return lattice.position(static_cast<double>(point % along_x),
                          static_cast<double>(point / along_x % along_y),
                          static_cast<double>(point / along_x / along_y));
}

/// Tells the insides of what is closed from other hollows.
void count_hollows(const TriangleMesh& soup, const Lattice& lattice,
                   const std::vector<std::int64_t>& hollows, Wrap& wrap) {
  if (hollows.empty()) return;
  const RayScene scene(soup);
  wrap.insides = std::ranges::count_if(hollows, [&](std::int64_t point) {
    return windings(soup, scene, place_of(point, lattice)) > 0;
  });
  wrap.cavities = std::ssize(hollows) - wrap.insides;
}

/// The ball that encloses what is near; tells what stood in its way.
Solid ball_about(const TriangleMesh& soup, const Lattice& lattice, const std::vector<float>& field,
                 const WrapOptions& options, Wrap& wrap) {
  std::vector<std::int64_t> hollows;
  Solid solid = surrounded(lattice, field, hollows);
  count_hollows(soup, lattice, hollows, wrap);
  wrap.skin = hollow_share(field, solid) < next_to_nothing && unclosed_edges(soup.triangles) > 0;
  const auto all = static_cast<double>(volume(solid));
  wrap.parts = static_cast<long>(parts_of(lattice, solid).size());
  if (options.largest && wrap.parts > 1) keep_largest(lattice, solid);
  const auto kept = static_cast<double>(volume(solid));
  wrap.kept_share = kept / all;
  const long parts = options.largest ? 1 : wrap.parts;
  wrap.handles = static_cast<long>(parts - euler_characteristic(lattice, solid));
  if (parts == 1 && wrap.handles == 0) return solid;
  Solid ball = carve_ball(lattice, field, solid, options.progress);
  const auto carved = static_cast<double>(volume(ball));
  wrap.added_share = (carved - kept) / carved;
  return ball;
}

TriangleMesh surface_about(const TriangleMesh& soup, const Lattice& lattice,
                           const WrapOptions& options, Wrap& wrap) {
  const std::vector<float> field =
      distance_field(soup, lattice, wrap.distance, options.threads, options.progress);
  return level_surface(lattice, field, ball_about(soup, lattice, field, options, wrap));
}

void count_outside(const TriangleMesh& soup, const std::vector<char>& used, int threads,
                   Wrap& wrap) {
  wrap.soup_vertices = std::count(used.begin(), used.end(), 1);
  const RayScene scene(wrap.mesh);
  wrap.outside = std::lround(
      parallel_sum(soup.vertex_count(), threads, [&](std::int64_t first, std::int64_t last) {
        double outside = 0;
        for (auto v = static_cast<Vertex>(first); v < last; ++v) {
          if (used[static_cast<size_t>(v)] && !encloses(wrap.mesh, scene, soup.position(v)))
            ++outside;
        }
        return outside;
      }));
}

void tell_sizes(const TriangleMesh& soup, Wrap& wrap) {
  const MeshInspection found = inspect_mesh(wrap.mesh);
  wrap.volume = found.volume;
  wrap.area = found.area;
  wrap.soup_area = inspect_mesh(soup).area;
}

SurfaceDistance distance_between(const TriangleMesh& wrap, const TriangleMesh& soup,
                                 const WrapOptions& options) try {
  return measure_distance(wrap, soup,
                          {.samples = samples,
                           .vertices = true,
                           .threads = options.threads,
                           .progress = options.progress});
} catch (const UnmeasurableSurface& error) {
  throw UnmeasurableMesh(std::string("how far the wrap is from this mesh cannot be told: ") +
                         error.what());
}

}  // namespace

Wrap wrap_soup(const TriangleMesh& soup, const WrapOptions& options) {
  require_domain(options);
  require_places(soup);
  const std::vector<char> used = used_vertices(soup);
  const Box box = box_of(soup, used);
  Wrap wrap;
  wrap.voxel = chosen_voxel(options, box);
  require_regular(box, wrap.voxel);
  wrap.distance = options.distance > 0 ? options.distance : usual_distance * wrap.voxel;
  require_at_least("distance", wrap.distance, wrap.voxel);
  wrap.gap = options.gap > 0 ? options.gap : wrap.distance;
  require_between("gap", wrap.gap, 0, wrap.distance);
  const Lattice lattice = lattice_about(box, options, wrap.voxel, wrap.distance);
  wrap.lattice = lattice.points;
  wrap.mesh = surface_about(soup, lattice, options, wrap);
  require_sphere(wrap.mesh, options.threads);
  wrap.lattice_faces = wrap.mesh.face_count();
  if (wrap.gap < wrap.distance)
    draw_in(wrap.mesh, soup,
            {wrap.distance, wrap.voxel, wrap.gap, options.threads, options.progress});
  if (options.faces > 0)
    wrap.mesh = simplified(std::move(wrap.mesh), options.faces, options.progress);
  count_outside(soup, used, options.threads, wrap);
  tell_sizes(soup, wrap);
  wrap.apart = distance_between(wrap.mesh, soup, options);
  return wrap;
}

}  // namespace sphparam
