#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <set>
#include <stdexcept>

#include "remesh/limit_subject.h"
#include "remesh/subdivision/limit_stencils.h"
#include "remesh/subdivision/limit_vertices.h"
#include "remesh/subdivision/patch_net.h"
#include "remesh/subdivision/stencil_least_squares.h"
#include "sphparam/io/fillers.h"
#include "sphparam/measure/surface_distance.h"
#include "sphparam/parameterize.h"
#include "sphparam/remesh/remesh.h"
#include "sphparam/remesh/subdivision.h"
#include "support/mapped.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam;

namespace {

const std::vector<LimitSubject> subjects = {{"ico:2", Scheme::Loop},
                                            {"octa:9", Scheme::Loop},
                                            {"cube:4", Scheme::CatmullClark},
                                            {"uv:12x7", Scheme::CatmullClark},
                                            {"healpix:2", Scheme::CatmullClark}};

/// A grid, and stencils at `along`² places of each of its patches.
struct Fitting {
  SphereGrid grid;
  LimitTopology topology;
  LimitStencils stencils;
  explicit Fitting(const LimitSubject& subject, int along = 3)
      : grid(subject.grid()),
        topology(grid.faces, static_cast<int>(grid.directions.rows()), subject.scheme),
        stencils(topology, middles_of_pieces(subject.scheme, along), 1) {}

  std::int64_t samples() const { return stencils.patch_count() * std::ssize(stencils.places()); }
};

Points random_rows(std::int64_t count, double least, double most, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> number(least, most);
  Points rows(count, 3);
  for (Eigen::Index i = 0; i < rows.size(); ++i) rows.data()[i] = number(engine);
  return rows;
}

Points random_normals(std::int64_t count) {
  return random_rows(count, -1, 1, 5).rowwise().normalized();
}

Eigen::VectorXd random_weights(std::int64_t count) { return random_rows(count, 0.1, 3, 9).col(0); }

constexpr double sliding = 0.1;

/// What is minimised, written down as it stands in the header.
double energy(const Fitting& fitting, const Eigen::VectorXd& weights, const Points& normals,
              const Points& points, const Points& targets) {
  double sum = 0;
  for (std::int64_t i = 0; i < fitting.samples(); ++i) {
    const Vector3 off = points.row(i) - targets.row(i), n = normals.row(i);
    sum += weights[i] * (sliding * off.squaredNorm() + (1 - sliding) * std::pow(n.dot(off), 2));
  }
  return sum;
}

TriangleMesh bumpy_sphere(int level) {
  TriangleMesh mesh = icosphere(level);
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 q = mesh.position(v);
    mesh.positions.row(v) = q * (1 + 0.2 * std::sin(3 * q.x()) * std::cos(2 * q.y() + q.z()));
  }
  return mesh;
}

/// RMS distances from a mesh, of the plain resampled mesh and of the fitted surface.
struct Distances {
  double plain, fitted;
};
Distances distances(const TriangleMesh& mesh, const SphereMap& map, const LimitSubject& subject) {
  const SphereGrid grid = subject.grid();
  const SubdivisionFit fit =
      fit_subdivision(mapped(mesh, map), grid, {.scheme = subject.scheme, .threads = 2});
  const Tessellation pieces = tessellate(grid.faces, static_cast<int>(fit.control.rows()), 6);
  TriangleMesh fine;
  const auto points = LimitSurface(fit.topology, fit.control).evaluate_all(pieces.vertices);
  fine.positions.resize(std::ssize(points), 3);
  for (size_t v = 0; v < points.size(); ++v) {
    fine.positions.row(static_cast<Eigen::Index>(v)) = points[v].position;
  }
  fine.triangles = triangulate(fine.positions, pieces.faces).triangles;
  const TriangleMesh plain = remesh(mapped(mesh, map), grid).mesh();
  const DistanceOptions options{.samples = 20'000};
  return {measure_distance(mesh, plain, options).rms(),
          measure_distance(mesh, fine, options).rms()};
}

}  // namespace

TEST_CASE("limit stencils: weights sum to 1 and give the points of the limit surface") {
  for (const LimitSubject& subject : subjects) {
    INFO(subject.name);
    const Fitting fitting(subject);
    const Points control = random_rows(fitting.grid.directions.rows(), -1, 1, 3);
    const LimitSurface surface(fitting.grid.faces, control, subject.scheme);
    REQUIRE(fitting.stencils.patch_count() == surface.topology().patch_count());
    for (int p = 0; p < fitting.stencils.patch_count(); ++p) {
      const auto controls = fitting.stencils.controls(p);
      const auto& weights = fitting.stencils.weights(p);
      REQUIRE(weights.cols() == std::ssize(controls));
      for (size_t i = 0; i < fitting.stencils.places().size(); ++i) {
        const auto row = weights.row(static_cast<Eigen::Index>(i));
        CHECK(row.sum() == Approx(1).epsilon(1e-12));
        Vector3 point = Vector3::Zero();
        for (size_t k = 0; k < controls.size(); ++k) {
          point += row[static_cast<Eigen::Index>(k)] * control.row(controls[k]).transpose();
        }
        const auto& place = fitting.stencils.places()[i];
        CHECK((point - surface.evaluate({p, place.x(), place.y()}).position).norm() < 1e-12);
      }
    }
  }
}

TEST_CASE("limit stencils: places are the middles of equal pieces of a patch") {
  for (const int n : {1, 2, 5}) {
    for (const Scheme scheme : {Scheme::Loop, Scheme::CatmullClark}) {
      const auto places = middles_of_pieces(scheme, n);
      REQUIRE(std::ssize(places) == n * n);
      Eigen::Vector2d mean = Eigen::Vector2d::Zero();
      for (const auto& place : places) {
        CHECK(place.minCoeff() > 0);
        CHECK((scheme == Scheme::Loop ? place.sum() : place.maxCoeff()) < 1);
        mean += place / static_cast<double>(places.size());
      }
      const double middle = scheme == Scheme::Loop ? 1.0 / 3 : 0.5;
      CHECK((mean - Eigen::Vector2d(middle, middle)).norm() < 1e-14);
    }
  }
}

TEST_CASE("least squares: control points are found again from points of their surface") {
  for (const LimitSubject& subject : subjects) {
    INFO(subject.name);
    const Fitting fitting(subject);
    const Points control = random_rows(fitting.grid.directions.rows(), 99, 101, 1);
    StencilLeastSquares squares(fitting.stencils, fitting.grid.faces,
                                random_weights(fitting.samples()), 2);
    CHECK(squares.thin_count() == 0);
    const Points targets = squares.evaluate(control);
    Points found = fitting.grid.directions;
    squares.minimise(targets, found, 1e-12, {});
    CHECK((found - control).cwiseAbs().maxCoeff() < 1e-7);
    squares.set_metric(random_normals(fitting.samples()), sliding);
    found = fitting.grid.directions;
    squares.minimise(targets, found, 1e-12, {});
    CHECK((found - control).cwiseAbs().maxCoeff() < 1e-7);
  }
}

TEST_CASE("least squares: where there is nothing to do nothing is done") {
  const Fitting fitting(subjects[0]);
  const StencilLeastSquares squares(fitting.stencils, fitting.grid.faces,
                                    random_weights(fitting.samples()), 1);
  Points control = Points::Zero(fitting.grid.directions.rows(), 3);
  const auto outcome = squares.minimise(squares.evaluate(control), control, 1e-12, {});
  CHECK(outcome.steps == 0);
  CHECK(outcome.reduction == 0);
  CHECK(control.isZero(0));
}

TEST_CASE("least squares: from the minimum every way leads up, by the same both ways") {
  for (const LimitSubject& subject : subjects) {
    INFO(subject.name);
    const Fitting fitting(subject);
    const Eigen::VectorXd weights = random_weights(fitting.samples());
    const Points normals = random_normals(fitting.samples()),
                 targets = random_rows(fitting.samples(), -1, 1, 2);
    StencilLeastSquares squares(fitting.stencils, fitting.grid.faces, weights, 2);
    squares.set_metric(normals, sliding);
    Points control = fitting.grid.directions;
    squares.minimise(targets, control, 1e-10, {});
    const auto at = [&](const Points& c) {
      return energy(fitting, weights, normals, squares.evaluate(c), targets);
    };
    const double least = at(control);
    for (unsigned seed = 1; seed <= 5; ++seed) {
      const Points way = random_rows(control.rows(), -0.1, 0.1, seed);
      const double forth = at(control + way) - least, back = at(control - way) - least;
      CHECK(forth > 0);
      CHECK(forth == Approx(back).epsilon(1e-6));
    }
  }
}

TEST_CASE("least squares: a control point that no sample sees lies amid its neighbours") {
  const Fitting fitting({"ico:2", Scheme::Loop});
  constexpr int unseen = 100;
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(fitting.samples());
  const std::int64_t m = std::ssize(fitting.stencils.places());
  for (int p = 0; p < fitting.stencils.patch_count(); ++p) {
    for (const int v : fitting.stencils.controls(p)) {
      if (v == unseen) weights.segment(p * m, m).setZero();
    }
  }
  const StencilLeastSquares squares(fitting.stencils, fitting.grid.faces, weights, 1);
  CHECK(squares.thin_count() >= 1);
  Points control = 5 * fitting.grid.directions;
  squares.minimise(squares.evaluate(fitting.grid.directions), control, 1e-10, {});
  Vector3 sum = Vector3::Zero();
  int count = 0;
  for (std::int64_t f = 0; f < fitting.grid.faces.count(); ++f) {
    const auto corners = fitting.grid.faces.polygon(f);
    for (size_t k = 0; k < 3; ++k) {
      if (corners[k] != unseen) continue;
      sum += control.row(corners[(k + 1) % 3]);
      ++count;
    }
  }
  CHECK((control.row(unseen).transpose() - sum / count).norm() < 0.05);
}

TEST_CASE("subdivision fit: smooth shapes are met at least three times nearer than by flat faces") {
  const TriangleMesh mesh = bumpy_sphere(5);
  const SphereMap map{icosphere(5).positions};
  for (const LimitSubject& subject :
       {LimitSubject{"ico:2", Scheme::Loop}, LimitSubject{"cube:8", Scheme::CatmullClark}}) {
    INFO(subject.name);
    const Distances off = distances(mesh, map, subject);
    CHECK(3 * off.fitted < off.plain);
  }
}

// An odd cube: the vertices of an even one lie on the octahedron's edges, where flat faces are
// exact.
TEST_CASE("subdivision fit: protrusions and edges are never met worse than by flat faces") {
  for (const TriangleMesh& mesh : {tube(40, 8), tube(5, 100), octahedron()}) {
    const SphereMap map = parameterize(mesh, {.threads = 1}).map;
    for (const LimitSubject& subject :
         {LimitSubject{"ico:2", Scheme::Loop}, LimitSubject{"cube:7", Scheme::CatmullClark}}) {
      INFO(subject.name);
      const Distances off = distances(mesh, map, subject);
      CHECK(off.fitted < off.plain);
    }
  }
}

TEST_CASE("subdivision fit: a sphere has a sphere's normals and curvatures") {
  const TriangleMesh mesh = icosphere(5);
  const SphereMap map{mesh.positions};
  TriangleMesh large = mesh;
  large.positions = (2 * mesh.positions).rowwise() + Eigen::RowVector3d(7, 8, 9);
  for (const LimitSubject& subject : subjects) {
    INFO(subject.name);
    const SphereGrid grid = subject.grid();
    const SubdivisionFit fit =
        fit_subdivision(mapped(large, map), grid, {.scheme = subject.scheme});
    const LimitVertices limit =
        limit_at_vertices(LimitSurface(fit.topology, fit.control), grid.faces);
    CHECK(fit.max < 0.06);
    CHECK(fit.rms <= fit.max);
    for (Eigen::Index v = 0; v < grid.directions.rows(); ++v) {
      CHECK(limit.normals.row(v).norm() == Approx(1));
      CHECK(limit.normals.row(v).dot(grid.directions.row(v)) > 0.99);
    }
    CHECK(limit.mean.mean() == Approx(0.5).epsilon(0.1));
    CHECK(limit.gauss.mean() == Approx(0.25).epsilon(0.2));
  }
}

TEST_CASE("subdivision fit: a mesh elsewhere and larger has the same fit there") {
  const TriangleMesh mesh = bumpy_sphere(3);
  TriangleMesh moved = mesh;
  moved.positions = (8 * mesh.positions).rowwise() + Eigen::RowVector3d(64, -32, 16);
  const SphereMap map{icosphere(3).positions};
  const SphereGrid grid = make_grid(parse_grid("ico:2"));
  const Points here = fit_subdivision(mapped(mesh, map), grid).control,
               there = fit_subdivision(mapped(moved, map), grid).control;
  const Points back = (there.rowwise() - Eigen::RowVector3d(64, -32, 16)) / 8;
  CHECK((here - back).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("subdivision fit: quads are cut as a reader of the new positions would cut them") {
  MeshFile file;
  file.mesh = bumpy_sphere(4);
  const SphereMap map{icosphere(4).positions};
  FillerMarks cap;
  CornerTexcoords texcoords(3 * file.mesh.face_count(), 2);
  for (Face f = 0; f < file.mesh.face_count(); ++f) {
    cap.push_back(file.mesh.positions(file.mesh.triangles(f, 0), 2) > 0.9);
    for (int k = 0; k < 3; ++k)
      texcoords.row(3 * f + k) = map.points.row(file.mesh.triangles(f, k)).head<2>();
  }
  mark_fillers(file, cap);
  file.corner_texcoords = texcoords;
  const MappedMesh source = mapped(file, map);
  for (const char* name : {"cube:8", "uv:12x7", "healpix:4"}) {
    INFO(name);
    const SphereGrid grid = make_grid(parse_grid(name));
    const SubdivisionFit fit =
        fit_subdivision(source, grid, {.scheme = Scheme::CatmullClark, .threads = 2});
    const Remeshed flat = remesh(source, grid), control = control_mesh(flat, fit),
                   limit = limit_mesh(control, fit);
    CHECK(control.mesh().triangles != flat.mesh().triangles);
    const auto marked = [](const Remeshed& mesh) {  // faces of the grid
      std::set<double> faces;
      const auto& of = mesh.file().find_face_property("source_face")->values;
      for (size_t t = 0; t < of.size(); ++t)
        if (mesh.fillers()[t]) faces.insert(of[t]);
      return faces;
    };
    CHECK_FALSE(marked(flat).empty());
    for (const Remeshed* made : {&control, &limit}) {
      const Triangulation cut = triangulate(made->mesh().positions, grid.faces);
      CHECK(made->mesh().triangles == cut.triangles);
      CHECK(marked(*made) == marked(flat));
      REQUIRE(made->file().corner_texcoords);
      for (Eigen::Index i = 0; i < cut.triangles.size(); ++i) {
        const Vertex v = cut.triangles.data()[i];
        const Eigen::RowVector2d off =
            made->file().corner_texcoords->row(i) - grid.directions.row(v).head<2>();
        CHECK(off.norm() < 0.02);
      }
    }
  }
}

TEST_CASE("subdivision fit: the same bytes for any number of threads") {
  const TriangleMesh mesh = random_sphere_mesh(200, 6);
  const SphereMap map = parameterize(mesh, {.threads = 1}).map;
  for (const LimitSubject& subject : subjects) {
    INFO(subject.name);
    const SphereGrid grid = subject.grid();
    const SubdivisionFit one = fit_subdivision(mapped(mesh, map), grid,
                                               {.scheme = subject.scheme, .threads = 1}),
                         three = fit_subdivision(mapped(mesh, map), grid,
                                                 {.scheme = subject.scheme, .threads = 3});
    CHECK(one.control == three.control);
    CHECK(one.rms == three.rms);
    CHECK(one.max == three.max);
  }
}

TEST_CASE("subdivision fit: it stops when asked, and refuses faces that a scheme does not take") {
  const TriangleMesh mesh = icosphere(2);
  const SphereMap map{mesh.positions};
  CHECK_THROWS_AS(fit_subdivision(mapped(mesh, map), make_grid(parse_grid("ico:2")),
                                  {.progress = [](std::string_view, double) { return false; }}),
                  Cancelled);
  CHECK_THROWS_AS(fit_subdivision(mapped(mesh, map), make_grid(parse_grid("cube:2"))),
                  std::invalid_argument);
}

TEST_CASE("subdivision fit: options outside of their domains are refused before any work") {
  const TriangleMesh mesh = icosphere(1);
  const MappedMesh source = mapped(mesh, SphereMap{mesh.positions});
  const SphereGrid grid = make_grid(parse_grid("ico:1"));
  const auto refused = [&](SubdivisionFitOptions options) {
    options.progress = [](std::string_view, double) { return false; };
    CHECK_THROWS_AS(fit_subdivision(source, grid, options), std::invalid_argument);
  };
  for (const double bad : {0.0, 1.0, 2.0, -1.0, std::nan("")}) refused({.reduction = bad});
  refused({.rounds = -1});
  for (const int bad : {-1, most_samples_along_edge + 1}) refused({.samples_along_edge = bad});
  refused({.scheme = static_cast<Scheme>(2)});
}
