#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "displace/displacement.h"
#include "displace/displacement_file.h"
#include "displace/interpolated_base.h"
#include "displace/rebuild.h"
#include "sphparam/measure/surface_distance.h"
#include "sphparam/remesh/displacement.h"
#include "sphparam/sphere/spherical_coordinates.h"
#include "support/instruction_limit.h"
#include "support/mapped.h"
#include "support/test_meshes.h"

using namespace sphparam;

namespace {

double bumps(const Vector3& q) { return 0.05 * std::sin(3 * q.x()) * std::cos(4 * q.y() + q.z()); }

/// A base and a mesh that stands over it by `height` of the direction.
struct Landscape {
  DirectedBase base;
  TriangleMesh mesh;
  SphereMap map;
  Topology topology;

  template <class Height>
  Landscape(const char* name, Scheme scheme, int cuts, const Height& height)
      : Landscape(make_grid(parse_grid(name)), scheme, cuts, height) {}

  Displacement displacement(int width, int threads = 0) const {
    return make_displacement(base, mesh, topology, SphereLocator(topology, map),
                             {.width = width, .height = width / 2, .threads = threads});
  }
  Displacement displacement(const TextureLattice& lattice, int threads = 0) const {
    return make_displacement(base, lattice, mesh, topology, SphereLocator(topology, map),
                             {.threads = threads});
  }

 private:
  template <class Height>
  Landscape(const SphereGrid& grid, Scheme scheme, int cuts, const Height& height)
      : base(grid, grid.directions, scheme),
        mesh(over(base, cuts, height)),
        map(directions(base, cuts)),
        topology(mesh) {}

  template <class Height>
  static TriangleMesh over(const DirectedBase& base, int cuts, const Height& height) {
    const Rebuilt flat = rebuild(base, Image(2, 1, 1), cuts);
    TriangleMesh mesh = flat.base;
    const Tessellation places =
        tessellate(base.faces(), static_cast<int>(base.surface().control().rows()), cuts);
    for (size_t v = 0; v < places.vertices.size(); ++v) {
      const auto row = static_cast<Eigen::Index>(v);
      const Vector3 normal = base.surface().evaluate(places.vertices[v]).normal();
      mesh.positions.row(row) += height(flat.map.points.row(row).transpose()) * normal;
    }
    return mesh;
  }
  static SphereMap directions(const DirectedBase& base, int cuts) {
    return rebuild(base, Image(2, 1, 1), cuts).map;
  }
};

TextureLattice lattice_of(const std::string& name, std::int64_t texels) {
  const GridSpec spec = parse_grid(name);
  return {spec, make_grid(spec), texture_layout(spec, texels)};
}

Vector3 centre(const Image& image, int column, int row) {
  return to_cartesian({2 * std::numbers::pi * (column + 0.5) / image.width,
                       std::numbers::pi * (row + 0.5) / image.height});
}

}  // namespace

TEST_CASE("displacement: what stands over a base by a function of direction is that function") {
  for (const auto& [name, scheme] : {std::pair("ico:2", Scheme::Loop),
                                     {"cube:6", Scheme::CatmullClark},
                                     {"uv:16x9", Scheme::CatmullClark}}) {
    INFO(name);
    const Landscape land(name, scheme, 24, bumps);
    const Displacement made = land.displacement(128);
    CHECK(made.figures.missed == 0);
    CHECK(made.figures.inexact == 0);
    CHECK(made.figures.walked + made.figures.cast == 128 * 64);
    double worst = 0;
    for (int row = 0; row < 64; ++row) {
      for (int column = 0; column < 128; ++column) {
        const double expected = bumps(centre(made.image, column, row)),
                     is = static_cast<double>(*made.image.pixel(column, row));
        worst = std::max(worst, std::abs(is - expected));
        CHECK(is >= made.figures.least - 1e-7);
        CHECK(is <= made.figures.greatest + 1e-7);
      }
    }
    CHECK(worst < 1e-3);
  }
}

TEST_CASE("displacement: of the base itself it is zero, of a parallel surface it is constant") {
  for (const double height : {0.0, 0.1, -0.1}) {
    const Landscape land("ico:2", Scheme::Loop, 24, [&](const Vector3&) { return height; });
    const Displacement made = land.displacement(64);
    CHECK(made.figures.least == Approx(height).margin(1e-3));
    CHECK(made.figures.greatest == Approx(height).margin(1e-3));
  }
}

TEST_CASE("displacement: the same bytes for any number of threads, by any instructions") {
  const Landscape land("cube:4", Scheme::CatmullClark, 8, bumps);
  CHECK(land.displacement(96, 1).image.pixels == land.displacement(96, 3).image.pixels);
  const TextureLattice lattice = lattice_of("cube:4", 20000);
  CHECK(land.displacement(lattice, 1).image.pixels == land.displacement(lattice, 3).image.pixels);
  const Landscape triangles("ico:3", Scheme::Loop, 8, bumps);
  const auto pixels = land.displacement(96).image.pixels,
             others = triangles.displacement(96).image.pixels;
  for (const InstructionSet set : {InstructionSet::Baseline, InstructionSet::Avx2}) {
    const tests::InstructionLimit limit(set);
    CHECK(land.displacement(96).image.pixels == pixels);
    CHECK(triangles.displacement(96).image.pixels == others);
  }
}

TEST_CASE(
    "displacement: in the layout of a grid, rims too, it is the height at what a texel shows") {
  for (const auto& [name, scheme] : {std::pair("ico:2", Scheme::Loop),
                                     {"octa:9", Scheme::Loop},
                                     {"cube:6", Scheme::CatmullClark},
                                     {"uv:16x9", Scheme::CatmullClark}}) {
    INFO(name);
    const Landscape land(name, scheme, 24, bumps);
    const TextureLattice lattice = lattice_of(name, 20000);
    const Displacement made = land.displacement(lattice);
    CHECK(made.figures.missed == 0);
    CHECK(made.figures.walked + made.figures.cast ==
          std::int64_t{made.image.width} * made.image.height);
    double worst = 0, worst_rim = 0;
    for (int row = 0; row < made.image.height; ++row) {
      for (int column = 0; column < made.image.width; ++column) {
        const LimitPlace place = land.base.on_patches(lattice.place(column, row));
        const Vector3 direction = land.base.directions().evaluate(place).position.normalized();
        const double off =
            std::abs(static_cast<double>(*made.image.pixel(column, row)) - bumps(direction));
        worst = std::max(worst, off);
        if (!lattice.closed() && column < lattice.layout().gutter)
          worst_rim = std::max(
              worst_rim,
              std::abs(static_cast<double>(*made.image.pixel(column, row) -
                                           *made.image.pixel(lattice.layout().gutter, row))));
      }
    }
    CHECK(worst < 1e-3);
    CHECK((lattice.closed() || worst_rim > 1e-4));  // the rim goes on rather than repeats
  }
}

TEST_CASE("displacement: looked up by the coordinates of faces, both sides of a cut get the same") {
  for (const auto& [name, scheme] : {std::pair("ico:1", Scheme::Loop),
                                     {"octa:5", Scheme::Loop},
                                     {"cube:3", Scheme::CatmullClark}}) {
    INFO(name);
    const Landscape land(name, scheme, 12, bumps);
    const TextureLattice lattice = lattice_of(name, 20000);
    const Displacement made = land.displacement(lattice);
    const PatchNet& net = land.base.net();
    const int degree = net.degree();
    double worst = 0;
    for (int patch = 0; patch < net.patch_count(); ++patch) {
      for (int step = 0; step <= 16; ++step) {
        const LimitPlace here{patch, step / 16.0, 0};
        LimitPlace beyond = net.cross({patch, here.s, -1e-13});
        beyond = clamped(beyond, degree);
        worst =
            std::max(worst, std::abs(displacement_at(made.image, lattice, lattice.point(here)) -
                                     displacement_at(made.image, lattice, lattice.point(beyond))));
      }
    }
    CHECK(worst < 1e-6);
  }
}

TEST_CASE("displacement: a place on a face is found on the patches and back, at poles too") {
  for (const auto& [name, scheme] : {std::pair("uv:8x5", Scheme::CatmullClark),
                                     {"cube:2", Scheme::CatmullClark},
                                     {"ico:1", Scheme::Loop}}) {
    INFO(name);
    const SphereGrid grid = make_grid(parse_grid(name));
    const DirectedBase base(grid, grid.directions, scheme);
    for (int f = 0; f < grid.faces.count(); ++f) {
      for (const double s : {0.05, 0.3, 0.45, 0.6, 0.9}) {
        for (const double t : {0.05, 0.35, 0.55}) {
          if (grid.faces.degree(f) == 3 && s + t > 1) continue;
          const LimitPlace there = base.on_patches({f, s, t}), back = base.on_face(there);
          REQUIRE(base.net().beyond(there) < 1e-12);
          REQUIRE(back.patch == f);
          REQUIRE(back.s == Approx(s));
          REQUIRE(back.t == Approx(t));
          // What is smooth is near what is straight.
          const Vector3 direction = base.directions().evaluate(there).position.normalized();
          const auto corners = grid.faces.polygon(f);
          const auto corner = [&](size_t k) -> Vector3 { return grid.directions.row(corners[k]); };
          const Vector3 flat =
              corners.size() == 3 ? Vector3((1 - s - t) * corner(0) + s * corner(1) + t * corner(2))
                                  : Vector3((1 - t) * ((1 - s) * corner(0) + s * corner(1)) +
                                            t * ((1 - s) * corner(3) + s * corner(2)));
          REQUIRE((direction - flat.normalized()).norm() < 0.25);
        }
      }
    }
  }
}

TEST_CASE("rebuild: base and displacement in the layout of the grid give the mesh") {
  for (const auto& [name, scheme] : {std::pair("ico:2", Scheme::Loop),
                                     {"cube:6", Scheme::CatmullClark},
                                     {"uv:16x9", Scheme::CatmullClark}}) {
    INFO(name);
    const Landscape land(name, scheme, 24, bumps);
    const TextureLattice lattice = lattice_of(name, 100000);
    const Displacement made = land.displacement(lattice);
    const Rebuilt rebuilt = rebuild(
        land.base,
        [&](const LimitPlace& place, const Vector3&) {
          return displacement_at(made.image, lattice, lattice.point(land.base.on_face(place)));
        },
        24);
    CHECK(measure_distance(land.mesh, rebuilt.mesh, {.samples = 20000}).rms() < 3e-4);
    CHECK(measure_distance(land.mesh, rebuilt.base, {.samples = 20000}).rms() > 3e-3);
  }
}

TEST_CASE("displacement: cancelling ends it") {
  const Landscape land("ico:1", Scheme::Loop, 4, bumps);
  const auto cancel = [](std::string_view, double) { return false; };
  CHECK_THROWS_AS(
      make_displacement(land.base, land.mesh, land.topology, SphereLocator(land.topology, land.map),
                        {.width = 16, .height = 8, .progress = cancel}),
      Cancelled);
}

TEST_CASE("rebuild: base and displacement give the source, however rough") {
  // Waves that a base of 642 points cannot follow.
  TriangleMesh source = tests::icosphere(6);
  const SphereMap map{source.positions};
  const auto radius = [](const Vector3& q) { return 1 + 0.02 * std::sin(25 * q.x() + 20 * q.z()); };
  for (Eigen::Index v = 0; v < source.vertex_count(); ++v)
    source.positions.row(v) *= radius(source.positions.row(v).transpose());
  const SphereGrid grid = make_grid(parse_grid("ico:3"));
  Points targets = grid.directions;
  for (Eigen::Index v = 0; v < targets.rows(); ++v)
    targets.row(v) *= radius(targets.row(v).transpose());
  const DirectedBase base(grid, tests::interpolating_control(grid, targets, Scheme::Loop),
                          Scheme::Loop);
  const Topology topology(source);
  const Displacement made = make_displacement(base, source, topology, SphereLocator(topology, map),
                                              {.width = 1024, .height = 512});
  const Rebuilt rebuilt = rebuild(base, made.image, 12);
  const double alone = measure_distance(source, rebuilt.base, {.samples = 20000}).rms(),
               with = measure_distance(source, rebuilt.mesh, {.samples = 20000}).rms();
  CHECK(alone > 0.005);
  CHECK(with < alone / 10);
}

TEST_CASE("rebuild: a constant image moves every vertex along its normal by that much") {
  const SphereGrid grid = make_grid(parse_grid("cube:5"));
  const DirectedBase base(grid, 3 * grid.directions, Scheme::CatmullClark);
  Image constant(8, 4, 1);
  constant.pixels.assign(32, 0.25F);
  const Rebuilt rebuilt = rebuild(base, constant, 3);
  CHECK(rebuilt.mesh.vertex_count() == 6 * 25 * 9 + 2);
  for (Eigen::Index v = 0; v < rebuilt.mesh.vertex_count(); ++v) {
    const Vector3 moved = rebuilt.mesh.positions.row(v) - rebuilt.base.positions.row(v);
    REQUIRE(moved.norm() == Approx(0.25));
    REQUIRE(moved.normalized().dot(rebuilt.map.points.row(v)) > 0.9);
  }
}

TEST_CASE("rebuild: as many vertices as asked for, and no coarser than two cuts an edge") {
  const SphereGrid grid = make_grid(parse_grid("ico:2"));
  const DirectedBase base(grid, grid.directions, Scheme::Loop);
  CHECK(cuts_for(base, 1) == 2);
  const int cuts = cuts_for(base, 10000);
  CHECK(rebuild(base, Image(2, 1, 1), cuts).mesh.vertex_count() >= 10000);
  CHECK(rebuild(base, Image(2, 1, 1), cuts - 1).mesh.vertex_count() < 10000);
}

TEST_CASE("rebuild: an image is read between the middles of texels, around and over the poles") {
  Image image(4, 2, 1);
  image.pixels = {1, 2, 3, 4, 5, 6, 7, 8};
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 4; ++column)
      CHECK(displacement_in(image, centre(image, column, row)) ==
            Approx(*image.pixel(column, row)));
  }
  CHECK(displacement_in(image, to_cartesian({0, std::numbers::pi / 4})) == Approx(2.5));
  CHECK(displacement_in(image, Vector3::UnitX()) == Approx(4.5));
  // At a pole: half this column, half the one opposite.
  CHECK(displacement_in(image, Vector3::UnitZ()) == Approx((2.5 + 2.5) / 2));
  const double near_pole = displacement_in(image, to_cartesian({std::numbers::pi / 4, 1e-9}));
  CHECK(near_pole == Approx((1 + 3) / 2.0));
}

TEST_CASE("rebuild: beyond a pole an image of an odd width is half a turn away too") {
  Image image(3, 1, 1);
  image.pixels = {1, 2, 4};
  // Above the middle of the first texel; the middle between the others is opposite.
  CHECK(displacement_in(image, to_cartesian({std::numbers::pi / 3, 1e-9})) == Approx(2));
  CHECK(displacement_in(image, to_cartesian({std::numbers::pi / 3, std::numbers::pi - 1e-9})) ==
        Approx(2));
}

TEST_CASE("displacement file: what is read back is what was written, as near as the depth can") {
  const Landscape land("ico:1", Scheme::Loop, 8, bumps);
  const Displacement made = land.displacement(32);
  const double range = made.figures.greatest - made.figures.least;
  for (const auto& [depth, error] : {std::pair(ImageDepth::Float, 0.0),
                                     {ImageDepth::Half, range / 2048},
                                     {ImageDepth::Uint16, range / 65535 * 0.51}}) {
    const std::vector<char> bytes = encode_displacement(made, depth, "ico:1", "loop");
    const Image read = decode_displacement({bytes.data(), bytes.size()}, "d");
    REQUIRE(read.pixels.size() == made.image.pixels.size());
    for (size_t i = 0; i < read.pixels.size(); ++i)
      REQUIRE(std::abs(static_cast<double>(read.pixels[i] - made.image.pixels[i])) <=
              error + 1e-8 * (error > 0));
    ImageTexts texts;
    decode_image(bytes, "d", {}, &texts);
    const auto has = [&](const char* name, const std::string& value) {
      return std::find(texts.begin(), texts.end(), std::pair(std::string(name), value)) !=
             texts.end();
    };
    CHECK(has("sphparam:map", "displacement"));
    CHECK(has("sphparam:grid", "ico:1"));
    CHECK(has("sphparam:scheme", "loop"));
  }
}

TEST_CASE("displacement file: no displacement is told from one, and too large ones for half") {
  CHECK_THROWS_AS(decode_displacement("nothing", "d"), ImageError);
  const std::vector<char> plain =
      encode_image(Image(2, 1, 1), ImageFormat::Exr, {.sample_type = SampleType::Float});
  CHECK_THROWS_AS(decode_displacement({plain.data(), plain.size()}, "d"), ImageError);
  const std::vector<char> coloured =
      encode_image(Image(2, 1, 3), ImageFormat::Exr,
                   {.sample_type = SampleType::Float,
                    .metadata = {{"sphparam:scale", "1"}, {"sphparam:midlevel", "0"}}});
  CHECK_THROWS_WITH(decode_displacement({coloured.data(), coloured.size()}, "d"),
                    "d: no displacement: it has several channels");
  Displacement huge{.image = Image(2, 1, 1), .figures = {.least = 0, .greatest = 1e6}};
  CHECK_THROWS_AS(encode_displacement(huge, ImageDepth::Half, "ico:1", "loop"), std::range_error);
  for (const double size : {1e40, 1e-40}) {  // beyond the floats that the image holds
    const Displacement odd{.image = Image(2, 1, 1), .figures = {.least = 0, .greatest = size}};
    for (const ImageDepth depth : {ImageDepth::Uint16, ImageDepth::Half, ImageDepth::Float})
      CHECK_THROWS_AS(encode_displacement(odd, depth, "ico:1", "loop"), std::range_error);
  }
  Displacement level{.image = Image(2, 1, 1), .figures = {.least = 2, .greatest = 2}};
  level.image.pixels = {2, 2};
  const std::vector<char> bytes = encode_displacement(level, ImageDepth::Uint16, "ico:1", "loop");
  CHECK(decode_displacement({bytes.data(), bytes.size()}, "d").pixels == level.image.pixels);
}

TEST_CASE("displacement: sizes, names and layouts that do not fit are refused before any work") {
  const TriangleMesh ball = tests::icosphere(2);
  const MappedMesh source = tests::mapped(ball, {ball.positions});
  const Remeshed control = remesh(source, parse_grid("ico:1"));
  const SubdivisionFit fit = fit_subdivision(source, control.grid());
  PendingFiles files;
  const auto refused = [&](const DisplacementFiles& paths, DisplacementOptions options = {}) {
    INFO(paths.image << " " << paths.rebuilt);
    options.progress = [](std::string_view, double) { return false; };
    CHECK_THROWS_AS(add_displacement(files, paths, source, control, fit, options),
                    std::invalid_argument);
  };
  refused({.image = "d.jpg"});
  refused({.image = "d.png", .depth = ImageDepth::Float});
  refused({.image = "d.exr", .depth = ImageDepth::Uint16});
  refused({.image = "d.exr", .rebuilt = "r.off"});
  refused({.image = "d.exr"}, {.width = 0});
  refused({.image = "d.exr"}, {.height = -1});
  refused({.image = "d.exr"}, {.width = 1 << 20, .height = 1 << 20});
  const int too_many = (1 << 28) + 1;
  CHECK_THROWS_WITH(add_displacement(files, {.image = "d.exr"}, source, control, fit,
                                     {.width = too_many, .height = 1}),
                    Catch::StartsWith("width is 268435457"));
  CHECK_THROWS_WITH(add_displacement(files, {.image = "d.exr"}, source, control, fit,
                                     {.width = 1, .height = too_many}),
                    Catch::StartsWith("height is 268435457"));
  const Remeshed centres = remesh(source, parse_grid("healpix:2"));
  const SubdivisionFit on_centres =
      fit_subdivision(source, centres.grid(), {.scheme = Scheme::CatmullClark});
  CHECK_THROWS_AS(add_displacement(files, {.image = "d.exr"}, source, centres, on_centres,
                                   {.width = 64, .height = 32, .layout = DisplacementLayout::Grid}),
                  std::invalid_argument);
}
