// The whole of `sphparam map` on small meshes of any connectivity and any shape. Bytes are a
// recipe: options, then a triangulation grown from a tetrahedron by splits and flips, then
// positions of any size. The map must be certified, and still be after writing and reading.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "expect.h"
#include "recipe.h"
#include "sphparam/io/mesh_reader.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/io/sphere_file.h"
#include "sphparam/parameterize.h"
#include "sphparam/sphere/certificate.h"

namespace {

using namespace sphparam;
using namespace sphparam::tests;

bool is_held(const ParameterizeOptions& options, Vertex vertex) {
  if (options.poles && (vertex == options.poles->north || vertex == options.poles->south))
    return true;
  return std::ranges::any_of(options.pins,
                             [&](const Landmark& pin) { return pin.vertex == vertex; });
}

/// Anywhere, but no two at one point.
void add_pins(ParameterizeOptions& options, Recipe& recipe, int vertices) {
  const unsigned pins = recipe.byte() % 5;
  for (unsigned i = 0; i < pins; ++i) {
    const int vertex = static_cast<int>(recipe.byte()) % vertices;
    const SphericalCoordinates at{recipe.byte() / 41.0, 0.01 * i + recipe.byte() / 85.0};
    if (!is_held(options, vertex)) options.pins.push_back({vertex, at});
  }
}

/// Any triangles but all.
void add_fillers(ParameterizeOptions& options, Recipe& recipe, int vertices) {
  options.filler_share = (1 + recipe.byte() % 64) / 64.0;
  const int faces = 2 * vertices - 4;
  for (int f = 0; f < faces; ++f) options.fillers.push_back(recipe.byte() % 4 == 3 ? 1 : 0);
  options.fillers.back() = 0;
}

ParameterizeOptions options_of(Recipe& recipe, int vertices) {
  ParameterizeOptions options;
  const unsigned what = recipe.byte();
  constexpr Method methods[] = {Method::Progressive, Method::Curvilinear, Method::Paper,
                                Method::Radial};
  options.method = methods[what % 4];
  options.repair_paper = true;
  options.threads = 1;
  if (what & 8) options.centre = Vector3(0.25, -3, 1e-9);
  if (what & 16 && options.method != Method::Radial) {
    SphereMap there{Points(vertices, 3)};
    for (int v = 0; v < vertices; ++v) {
      there.points.row(v) = Vector3(std::cos(1.0 * v), std::sin(2.0 * v), 0.1 * recipe.byte());
    }
    options.align_to = std::move(there);
    return options;
  }
  if (what & 64 && options.method != Method::Radial) {
    const int north = static_cast<int>(recipe.byte()) % vertices;
    const int south = static_cast<int>(recipe.byte()) % vertices;
    if (north != south) options.poles = Poles{north, south};
  }
  if (what & 32) {
    const unsigned held = recipe.byte();
    if (held & 1 && options.method != Method::Radial) add_pins(options, recipe, vertices);
    if (held & 2) add_fillers(options, recipe, vertices);
  }
  if (what & 128) {
    constexpr double lambdas[] = {1e-8, 1e-2, 0.3, 2, 30, 1000};
    options.energy.lambda = lambdas[recipe.byte() % std::size(lambdas)];
    const unsigned taste = recipe.byte();
    options.balance = static_cast<Balance>(taste % 3);
    options.quality = static_cast<Quality>(taste / 4 % 3);
    options.energy.kind = taste & 128 ? EnergyKind::SymmetricDirichlet : EnergyKind::AngleAndArea;
  }
  return options;
}

void expect_certified(const TriangleMesh& mesh, const Parameterization& result) {
  expect(result.certificate.bijective(), "the map is certified");
  MeshFile file;
  file.mesh = mesh;
  const std::string bytes = serialise_ply(attach_map(file, result.map, {{"version", "fuzz"}}));
  const MeshFile again = read_mesh(bytes, "again.ply", {});
  expect(certify(Topology(again.mesh), read_sphere(again).value(), 1).bijective(),
         "what was written is certified");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Recipe recipe({data, size});
  const TriangleMesh mesh = recipe.sphere_mesh();
  expect_certified(mesh,
                   parameterize(mesh, options_of(recipe, static_cast<int>(mesh.vertex_count()))));
  return 0;
}
