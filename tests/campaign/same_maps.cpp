// Maps listed shapes in every way that the library knows, and prints 64 bits of each result: what
// two builds must agree on. Made of the library's public headers alone, so that it is built by
// whatever compiler for whatever machine; `same_bytes` does that.
//
//     same_maps LIST [EVERY [MOST]]     every EVERYth shape of a list of same_shapes, of at most
//     MOST
//                                       triangles
//
// A line a result: the shape, what was made, the bits. What throws says so in place of them.

#include <bit>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "shape_list.h"
#include "sphparam/baselines/brechbuehler.h"
#include "sphparam/baselines/conformal.h"
#include "sphparam/baselines/curvature_flow.h"
#include "sphparam/baselines/hemispheres.h"
#include "sphparam/baselines/stereographic.h"
#include "sphparam/baselines/tangential.h"
#include "sphparam/chart/spherical_chart.h"
#include "sphparam/mesh/curvature.h"
#include "sphparam/mesh/mesh_defects.h"
#include "sphparam/parameterize.h"
#include "sphparam/sphere/distortion.h"
#include "sphparam/sphere/float_rounding.h"
#include "sphparam/sphere/spherical_harmonics.h"

using namespace sphparam;
using namespace sphparam::campaign;

namespace {

constexpr long large = 5000;  // triangles: such meshes go the default way alone

/// Of numbers, not of their bytes: the same for any order of bytes.
class Digest {
 public:
  template <class... Tables>
  explicit Digest(const Tables&... tables) {
    (add(tables), ...);
  }

  std::uint64_t bits() const { return bits_; }

 private:
  template <class Table>
  void add(const Table& table) {
    for (Eigen::Index i = 0; i < table.rows(); ++i) {
      for (Eigen::Index j = 0; j < table.cols(); ++j) add_number(table(i, j));
    }
  }
  template <class Number>
  void add_number(Number number) {
    if constexpr (std::is_floating_point_v<Number>) {
      add_word(std::bit_cast<std::uint64_t>(double(number)));
    } else {
      add_word(static_cast<std::uint64_t>(number));
    }
  }
  void add_word(std::uint64_t word) {
    bits_ = (bits_ ^ word) * 0x9e3779b97f4a7c15;
    bits_ ^= bits_ >> 29;
  }

  std::uint64_t bits_ = 0;
};

/// The places of the vertices, by one way to map.
struct Way {
  const char* name;
  std::function<Points(const TriangleMesh&, const Topology&)> map;
};

Way by_ours(const char* name, ParameterizeOptions options) {
  options.threads = 1;
  return {name, [options](const TriangleMesh& mesh, const Topology& topology) {
            return parameterize(mesh, topology, options).map.points;
          }};
}

/// Three vertices at given places, far from each other.
Way pinned() {
  return {"pinned", [](const TriangleMesh& mesh, const Topology& topology) {
            const auto at = [&](int third) { return Vertex(mesh.vertex_count() * third / 3); };
            const ParameterizeOptions options{
                .pins = {{at(0), {0.5, 1}}, {at(1), {2.5, 1.5}}, {at(2), {4.5, 2}}}, .threads = 1};
            return parameterize(mesh, topology, options).map.points;
          }};
}

template <class Method>
Way by_others(const char* name, const Method& method) {
  return {name, [method](const TriangleMesh& mesh, const Topology& topology) {
            const BaselineResult result = method(mesh, topology);
            return result.map ? result.map->points : Points();
          }};
}
#define BY_OTHERS(method)                                                     \
  by_others(#method, [](const TriangleMesh& mesh, const Topology& topology) { \
    return method(mesh, topology, {.threads = 1});                            \
  })

const std::vector<Way> ways{by_ours("draft", {.quality = Quality::Draft}),
                            by_ours("best", {.quality = Quality::Best}),
                            by_ours("conformal", {.balance = Balance::Conformal}),
                            by_ours("equal-area", {.balance = Balance::EqualArea}),
                            by_ours("curvilinear", {.method = Method::Curvilinear}),
                            by_ours("paper", {.method = Method::Paper}),
                            by_ours("radial", {.method = Method::Radial}),
                            pinned(),
                            BY_OTHERS(map_tangential),
                            BY_OTHERS(map_hemispheres),
                            BY_OTHERS(map_brechbuehler),
                            BY_OTHERS(map_stereographic),
                            BY_OTHERS(map_conformal),
                            BY_OTHERS(map_flow)};
constexpr std::size_t turns = 5;  // each shape goes every fifth way, the next shape the next ones

class Shape {
 public:
  explicit Shape(const ListedShape& shape)
      : name_(shape.name), mesh_(shape.mesh), topology_(require_sphere(shape.mesh)) {}

  void map_in_turn(std::size_t turn) const {
    map_and_use();
    if (mesh_.face_count() > large) return;
    for (std::size_t i = turn % turns; i < ways.size(); i += turns) {
      tell(ways[i].name, [&] { return Digest(ways[i].map(mesh_, topology_)); });
    }
  }

 private:
  /// One line.
  template <class Make>
  void tell(const char* what, const Make& make) const {
    std::string made;
    try {
      char text[17];
      std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(make().bits()));
      made = text;
    } catch (const std::exception& e) {
      made = std::string("throws ") + e.what();
    }
    std::printf("%s %s %s\n", name_.c_str(), what, made.c_str());
  }

  void map_and_use() const {
    SphereMap map;
    tell("normal", [&] {
      map = parameterize(mesh_, topology_, {.threads = 1}).map;
      return Digest(map.points);
    });
    if (map.points.rows() == 0) return;
    tell("chart", [&] {
      const SphericalChart chart = spherical_chart(mesh_, topology_, map, 1);
      return Digest(chart.uv, chart.points, chart.wedges);
    });
    tell("float32", [&] { return Digest(round_to_float(topology_, map, 1).map.points); });
    tell("distortion", [&] {
      const Distortion d = measure_distortion(mesh_, map, 1);
      return Digest(d.area_ratio, d.angle_ratio, d.sigma_max, d.sigma_min);
    });
    tell("harmonics", [&] {
      const Functions xyz = mesh_.positions;
      return Digest(fit_harmonics(topology_, map, xyz, {.degree = 8, .threads = 1}).coefficients);
    });
    tell("curvature", [&] {
      const Curvature c = measure_curvature(mesh_, topology_, 0.1 * equal_area_radius(mesh_, 1), 1);
      return Digest(c.mean, c.gauss);
    });
  }

  std::string name_;
  const TriangleMesh& mesh_;
  Topology topology_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::puts("same_maps LIST [EVERY [MOST]]"), 2;
  const long every = argc > 2 ? std::stol(argv[2]) : 1,
             most = argc > 3 ? std::stol(argv[3]) : 1L << 40;
  std::ifstream list(argv[1]);
  if (!list) return 2;
  ListedShape shape;
  for (long number = 0; read_shape(list, shape); ++number) {
    if (number % every != 0 || shape.mesh.face_count() > most) continue;
    Shape(shape).map_in_turn(static_cast<std::size_t>(number / every));
    std::fflush(stdout);
  }
  return 0;
}
