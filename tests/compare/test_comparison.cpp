#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

#include "compare/comparison.h"
#include "sphparam/report/compare.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam;
using Catch::Matchers::Contains;

namespace {

MeshFile ball(int level) {
  MeshFile file;
  file.mesh = icosphere(level);
  return file;
}

/// A sphere with one triangle turned over.
SphereMap folded(const TriangleMesh& mesh) {
  SphereMap map = normalised(mesh.positions);
  map.points.row(0) = -map.points.row(0);
  return map;
}

}  // namespace

TEST_CASE("entry: a sphere made elsewhere is certified as it is, whatever its radius") {
  const TriangleMesh mesh = icosphere(2);
  const Entry good = entry_of_map("peer", "peer.obj", mesh, {7 * mesh.positions}, 0);
  CHECK(good.certificate.bijective());
  CHECK(good.figures->mean_abs_ln_angle < 0.1);
  CHECK_FALSE(good.seconds);
  CHECK(short_verdict(good) == "one-to-one");
  const Entry bad = entry_of_map("peer", "peer.obj", mesh, folded(mesh), 0);
  CHECK_FALSE(bad.certificate.bijective());
  CHECK(short_verdict(bad) == std::to_string(bad.certificate.fold_count()) + " folds");
  SphereMap unusable = folded(mesh);
  unusable.points.row(3).setZero();
  const Entry none = entry_of_map("peer", "peer.obj", mesh, unusable, 0);
  CHECK_FALSE(none.distortion);
  CHECK(short_verdict(none) == "1 unusable point");
}

TEST_CASE("entry: the table has a row each, with as many cells as its header") {
  const TriangleMesh mesh = icosphere(2);
  SphereMap unusable = folded(mesh);
  unusable.points.row(3).setZero();
  const PageTable table =
      comparison_table({entry_of_method(Method::Progressive, mesh, {}),
                        entry_of_map("folded", "", mesh, folded(mesh), 0),
                        entry_of_map("unusable", "", mesh, unusable, 0), Entry{"none", ""}});
  REQUIRE(table.rows.size() == 4);
  for (const auto& row : table.rows) CHECK(row.size() == table.header.size());
  CHECK(table.rows[0][4] == "yes");
  CHECK(table.rows[1][4] == "no");
  CHECK(table.rows[3][4] == "no map");
}

TEST_CASE("comparison: the page names every file beside it, and nothing else") {
  const MeshFile file = ball(2);
  const std::vector<Entry> entries = {
      entry_of_method(Method::Progressive, file.mesh, {}),
      entry_of_map("peer", "peer.obj", file.mesh, folded(file.mesh), 0)};
  FolderFiles files = comparison_files("ball", file, entries, {.look = {.size = 32}});
  const auto page = std::find_if(files.begin(), files.end(),
                                 [](const auto& f) { return f.first == "index.html"; });
  REQUIRE(page != files.end());
  long named = 0;
  for (const auto& [name, bytes] : files) {
    if (name == "index.html") continue;
    INFO(name);
    CHECK_THAT(page->second, Contains("src=\"" + name + "\""));
    CHECK_FALSE(bytes.empty());
    ++named;
  }
  CHECK(named == 5 + 2);  // mesh, two spheres, two heat maps; area and angle
  const std::string& html = page->second;
  CHECK(std::count(html.begin(), html.end(), '\n') > 10);
  CHECK_THAT(html, Contains("progressive against peer"));
  CHECK(comparison_files("ball", file, entries, {.pictures = false}).size() == 2 + 1);
}

TEST_CASE("pictures: folds are red, all else has the mesh's colours") {
  const MeshFile file = ball(1);
  CHECK(std::holds_alternative<VertexPaint>(shape_paint(file, {})));
  const FacePaint paint = std::get<FacePaint>(shape_paint(file, {5}));
  REQUIRE(paint.colours.size() == static_cast<size_t>(file.mesh.face_count()));
  CHECK(paint.colours[5].x() > 3 * paint.colours[5].y());
  CHECK_FALSE(paint.colours[4] == paint.colours[5]);
}

TEST_CASE("compare_maps: a program names methods and adds maps of its own") {
  const MeshFile file = ball(2);
  const CompareOptions options{.pictures = false};
  const auto files = compare_maps("ball", file, {"progressive"},
                                  {{.name = "peer", .map = {file.mesh.positions}}}, options);
  const auto page =
      std::ranges::find(files, "index.html", &std::pair<std::string, std::string>::first);
  REQUIRE(page != files.end());
  CHECK_THAT(page->second, Contains("progressive") && Contains("peer"));
  CHECK(method_names().front() == "progressive");
  CHECK_THROWS_AS(compare_maps("ball", file, {"none"}, {}, options), std::invalid_argument);
  CHECK_THROWS_AS(compare_maps("ball", file, {}, {}, options), std::invalid_argument);
}

TEST_CASE("compare_maps: what cannot be is refused before any work") {
  const MeshFile file = ball(1);
  const auto refused = [&](const std::vector<std::string>& methods,
                           const std::vector<NamedMap>& others, int size = 16) {
    CompareOptions options{.pictures = false, .size = size};
    options.progress = [](std::string_view stage, double) {
      FAIL("work was begun: " << stage);
      return false;
    };
    CHECK_THROWS_AS(compare_maps("ball", file, methods, others, options), std::invalid_argument);
  };
  const auto named = [&](const std::string& name) {
    return NamedMap{.name = name, .map = {file.mesh.positions}};
  };
  refused({"progressive", "progressive"}, {});
  refused({"progressive"}, {named("progressive")});
  refused({"progressive"}, {named("peer"), named("peer")});
  for (const char* name : {"", "a/b", "a#b", "50%", "my map", "..", "-b"})
    refused({}, {named(name)});
  refused({"progressive"}, {{.name = "few", .map = {file.mesh.positions.topRows(5)}}});
  for (const int size : {15, 0, -1, 4097}) refused({}, {named("peer")}, size);
  const CompareOptions small{.size = 16};
  CHECK(compare_maps("ball", file, {}, {named("Peer-1.5_b")}, small).size() == 4);
}

TEST_CASE("entries: each is told as it is there, the methods' first") {
  const MeshFile file = ball(1);
  std::vector<std::string> told;
  const auto tell = [&](const Entry& entry) { told.push_back(entry.name); };
  const std::vector<NamedMap> others = {{.name = "peer", .map = {file.mesh.positions}}};
  const std::vector<Entry> entries = make_entries(file, {"progressive"}, others, {}, tell);
  CHECK(told == std::vector<std::string>{"progressive", "peer"});
  REQUIRE(entries.size() == 2);
  CHECK(entries[0].seconds);
  CHECK_FALSE(entries[1].seconds);
  told.clear();
  CHECK_THROWS_AS(make_entries(file, {"progressive", "none"}, {}, {}, tell), std::invalid_argument);
  CHECK(told.empty());
}
