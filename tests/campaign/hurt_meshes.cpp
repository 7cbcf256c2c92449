#include "hurt_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

#include "growth.h"
#include "support/test_meshes.h"

// A body and one to three things that are done to its positions. Connectivity is a sphere by
// construction, so whatever is done, there is a map.

namespace sphparam::campaign {
namespace {

using namespace sphparam::tests;

// --- bodies -------------------------------------------------------------------------------------

HurtMesh of(std::string story, TriangleMesh mesh) {
  return {std::move(story), std::move(mesh), {}, {}};
}

/// A cube, each side of n × n quads.
HurtMesh box_of_quads(int n) {
  HurtMesh box{"box of quads", {}, {}, {}};
  std::map<std::array<int, 3>, Vertex> number;
  std::vector<Vector3> points;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [found, is_new] = number.emplace(at, static_cast<Vertex>(points.size()));
    if (is_new) points.emplace_back(at[0], at[1], at[2]);
    return found->second;
  };
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const int side : {0, n}) {
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> at{};
            at[axis] = side;
            at[(axis + 1) % 3] = i + di;
            at[(axis + 2) % 3] = j + dj;
            return vertex(at);
          };
          std::vector<Vertex> quad = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
          if (side == 0) std::reverse(quad.begin(), quad.end());
          box.polygons.push_back(quad);
        }
      }
    }
  }
  box.mesh.positions.resize(std::ssize(points), 3);
  for (size_t v = 0; v < points.size(); ++v) {
    box.mesh.positions.row(static_cast<Eigen::Index>(v)) = points[v].array() - 0.5 * n;
  }
  box.mesh.triangles.resize(2 * std::ssize(box.polygons), 3);
  Eigen::Index row = 0;
  for (const std::vector<Vertex>& quad : box.polygons) {
    box.mesh.triangles.row(row++) << quad[0], quad[1], quad[2];
    box.mesh.triangles.row(row++) << quad[0], quad[2], quad[3];
  }
  return box;
}

HurtMesh some_body(Random& random) {
  const auto seed = static_cast<unsigned>(random.bits());
  switch (random.below(9)) {
    case 0:
      return of("tetrahedron", tetrahedron());
    case 1:
      return of("icosphere", icosphere(random.below(3)));
    case 2:
      return of("sphere of rings", uv_sphere(random.between(3, 20), random.between(1, 9)));
    case 3:
      return of("tube", tube(random.between(2, 40), random.between(3, 5)));
    case 4:
      return of("stack", with_stack(octahedron(), random.below(8), random.between(5, 60),
                                    static_cast<Stacking>(random.below(3)), random));
    case 5:
    case 6:
      return box_of_quads(random.between(1, 5));
    default:
      return of("random triangulation", random_sphere_mesh(random.between(5, 200), seed));
  }
}

// --- what is done to positions ------------------------------------------------------------------

constexpr double largest = std::numeric_limits<double>::max();
constexpr std::array sizes = {5e-324, 1e-310, 1e-200, 1e-160, 1e-100, 1e-60, 1e-30,  1e-20,
                              1e-10,  1e-3,   1e3,    1e10,   1e20,   1e30,  1e39,   1e60,
                              1e100,  1e155,  1e160,  1e200,  1e300,  1e308, largest};

double some_size(Random& random) { return sizes[static_cast<size_t>(random.below(sizes.size()))]; }

double clipped(double x) { return std::isnan(x) ? 0 : std::clamp(x, -largest, largest); }

template <class Change>
void change_each(Points& points, double share, Random& random, const Change& change) {
  for (Eigen::Index v = 0; v < points.rows(); ++v) {
    if (random.chance(share)) points.row(v) = change(Vector3(points.row(v))).transpose();
  }
}

Vector3 some_vertex(const Points& points, Random& random) {
  return points.row(random.below(static_cast<int>(points.rows())));
}

void in_one_point(Points& points, Random& random) {
  const Vector3 place = some_vertex(points, random);
  const double shares[] = {1, 1, 0.99, 0.9, 0.5, 0.1};
  change_each(points, shares[random.below(6)], random, [&](const Vector3&) { return place; });
}

void in_few_points(Points& points, Random& random) {
  std::vector<Vector3> places;
  for (int i = random.between(2, 5); i > 0; --i) places.push_back(some_vertex(points, random));
  change_each(points, 1, random, [&](const Vector3&) {
    return places[static_cast<size_t>(random.below(static_cast<int>(places.size())))];
  });
}

void on_a_line(Points& points, Random& random) {
  const Vector3 from = random.in_cube(), along = random.direction();
  const double width = random.chance(0.5) ? 0.0 : random.logarithmic(1e-18, 1e-3);
  change_each(points, 1, random, [&](const Vector3& p) -> Vector3 {
    return from + p.dot(along) * along + width * random.in_cube();
  });
}

void in_a_plane(Points& points, Random& random) {
  const double factors[] = {0, 0, 1e-3, 1e-9, 1e-17, -1};
  points.col(random.below(3)) *= factors[random.below(6)];
}

void one_far_away(Points& points, Random& random) {
  const Vector3 direction = random.chance(0.5) ? random.direction() : Vector3(Vector3::UnitX());
  const Vector3 place = (direction * some_size(random)).unaryExpr(&clipped);
  points.row(random.below(static_cast<int>(points.rows()))) = place.transpose();
}

void sized(Points& points, Random& random) {
  const double size = some_size(random);
  const double unit = std::max(1.0, points.cwiseAbs().maxCoeff());
  if (random.chance(0.8)) {
    points = (points / unit * size).unaryExpr(&clipped).eval();
  } else {
    const int axis = random.below(3);
    points.col(axis) = (points.col(axis) / unit * size).unaryExpr(&clipped).eval();
  }
}

void far_from_the_origin(Points& points, Random& random) {
  const Vector3 way = random.direction() * some_size(random);
  points = (points.rowwise() + way.transpose()).unaryExpr(&clipped).eval();
}

void slivers(Points& points, Random& random) {
  const double height = random.chance(0.5) ? 0.0 : random.logarithmic(1e-17, 1e-3);
  change_each(points, random.uniform(0.05, 1), random, [&](const Vector3&) -> Vector3 {
    const Vector3 a = some_vertex(points, random), b = some_vertex(points, random);
    return a + random.uniform(-0.5, 1.5) * (b - a) + height * random.in_cube();
  });
}

void signs_flipped(Points& points, Random& random) {
  change_each(points, random.uniform(0.01, 1), random, [&](Vector3 p) {
    p[random.below(3)] *= -1;
    return p;
  });
}

void scattered(Points& points, Random& random) {
  change_each(points, random.uniform(0.01, 1), random,
              [&](const Vector3&) { return random.in_cube(); });
}

/// Each coordinate of a size of its own.
void of_all_sizes(Points& points, Random& random) {
  change_each(points, random.uniform(0.05, 1), random, [&](Vector3 p) -> Vector3 {
    for (double& x : p) x = clipped(x * some_size(random));
    return p;
  });
}

void whole_numbers(Points& points, Random& random) {
  const double step = random.uniform(0.1, 2);
  points = (points / step).array().round().matrix().eval();
}

void needles(Points& points, Random& random) {
  points.col(random.below(3)) *= random.logarithmic(1e2, 1e12);
}

void doubled(Points& points, Random& random) {
  change_each(points, random.uniform(0.05, 0.9), random,
              [&](const Vector3&) { return some_vertex(points, random); });
}

struct Hurt {
  const char* name;
  void (*apply)(Points&, Random&);
};

constexpr std::array hurts = {Hurt{"in one point", in_one_point},
                              Hurt{"in few points", in_few_points},
                              Hurt{"on a line", on_a_line},
                              Hurt{"in a plane", in_a_plane},
                              Hurt{"one far away", one_far_away},
                              Hurt{"sized", sized},
                              Hurt{"far from the origin", far_from_the_origin},
                              Hurt{"slivers", slivers},
                              Hurt{"signs flipped", signs_flipped},
                              Hurt{"scattered", scattered},
                              Hurt{"of all sizes", of_all_sizes},
                              Hurt{"whole numbers", whole_numbers},
                              Hurt{"needles", needles},
                              Hurt{"doubled", doubled}};

Eigen::MatrixX2d some_texcoords(Eigen::Index count, Random& random) {
  Eigen::MatrixX2d texcoords(count, 2);
  const double size = random.chance(0.8) ? 1.0 : some_size(random);
  for (double& x : texcoords.reshaped()) x = clipped(size * random.uniform(-0.1, 1.1));
  return texcoords;
}

// --- files --------------------------------------------------------------------------------------

template <class... Numbers>
void print(std::string& text, const char* format, Numbers... numbers) {
  char line[128];
  std::snprintf(line, sizeof line, format, numbers...);
  text += line;
}

void print_points(std::string& text, const char* before, const TriangleMesh& mesh) {
  for (const auto& p : mesh.positions.rowwise()) {
    text += before;
    print(text, "%.17g %.17g %.17g\n", p[0], p[1], p[2]);
  }
}

std::vector<std::vector<Vertex>> faces_of(const HurtMesh& hurt) {
  if (!hurt.polygons.empty()) return hurt.polygons;
  std::vector<std::vector<Vertex>> faces;
  for (const auto& t : hurt.mesh.triangles.rowwise()) faces.push_back({t[0], t[1], t[2]});
  return faces;
}

std::string as_off(const HurtMesh& hurt) {
  const auto faces = faces_of(hurt);
  std::string text = "OFF\n";
  print(text, "%d %d 0\n", static_cast<int>(hurt.mesh.vertex_count()),
        static_cast<int>(faces.size()));
  print_points(text, "", hurt.mesh);
  for (const std::vector<Vertex>& face : faces) {
    print(text, "%d", static_cast<int>(face.size()));
    for (const Vertex v : face) print(text, " %d", v);
    text += '\n';
  }
  return text;
}

std::string as_obj(const HurtMesh& hurt) {
  std::string text;
  print_points(text, "v ", hurt.mesh);
  for (const auto& uv : hurt.texcoords.rowwise()) print(text, "vt %.17g %.17g\n", uv[0], uv[1]);
  for (const std::vector<Vertex>& face : faces_of(hurt)) {
    text += 'f';
    for (const Vertex v : face) {
      print(text, " %d", v + 1);
      if (hurt.texcoords.rows() > 0) print(text, "/%d", v + 1);
    }
    text += '\n';
  }
  return text;
}

std::string as_ply(const HurtMesh& hurt) {
  const auto faces = faces_of(hurt);
  std::string text = "ply\nformat ascii 1.0\n";
  print(text, "element vertex %d\n", static_cast<int>(hurt.mesh.vertex_count()));
  text +=
      "property double x\nproperty double y\nproperty double z\nproperty uchar red\n"
      "property uchar green\nproperty uchar blue\nproperty double depth\n";
  print(text, "element face %d\n", static_cast<int>(faces.size()));
  text += "property list uchar int vertex_indices\nend_header\n";
  int v = 0;
  for (const auto& p : hurt.mesh.positions.rowwise()) {
    print(text, "%.17g %.17g %.17g %d %d 200 %.17g\n", p[0], p[1], p[2], v % 256, 7 * v % 256,
          p[2]);
    ++v;
  }
  for (const std::vector<Vertex>& face : faces) {
    print(text, "%d", static_cast<int>(face.size()));
    for (const Vertex corner : face) print(text, " %d", corner);
    text += '\n';
  }
  return text;
}

}  // namespace

HurtMesh make_hurt_mesh(Random& random) {
  HurtMesh hurt = some_body(random);
  const int times = random.chance(0.1) ? 0 : random.chance(0.7) ? 1 : random.between(2, 3);
  for (int i = 0; i < times; ++i) {
    const Hurt& what = hurts[static_cast<size_t>(random.below(hurts.size()))];
    hurt.story += std::string(", ") + what.name;
    what.apply(hurt.mesh.positions, random);
    hurt.mesh.positions = hurt.mesh.positions.unaryExpr(&clipped).eval();
  }
  if (random.chance(0.4)) hurt.texcoords = some_texcoords(hurt.mesh.vertex_count(), random);
  return hurt;
}

std::string as_file(const HurtMesh& mesh, const std::string& extension) {
  if (extension == ".obj") return as_obj(mesh);
  return extension == ".ply" ? as_ply(mesh) : as_off(mesh);
}

}  // namespace sphparam::campaign
