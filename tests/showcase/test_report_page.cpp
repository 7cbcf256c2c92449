#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "showcase/page_entry.h"
#include "showcase/report_page.h"
#include "showcase/tables.h"
#include "sphparam/errors.h"
#include "sphparam/io/mesh_writer.h"
#include "sphparam/report/report_page.h"
#include "support/folder.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;
using namespace sphparam;
using Catch::Matchers::Contains;

namespace {

MeshFile ball(int level = 2) {
  MeshFile file;
  file.mesh = icosphere(level);
  return file;
}

PageEntry page_entry_of(const std::string& name, const MeshFile& file, const SphereMap& map) {
  return make_page_entry(entry_of_map(name, name + ".sph.ply", file.mesh, map, 0),
                         {{"method", "by hand"}}, file);
}

PageEntry good(const std::string& name, const MeshFile& file) {
  return page_entry_of(name, file, normalised(file.mesh.positions));
}

PageEntry folded(const std::string& name, const MeshFile& file) {
  SphereMap map = normalised(file.mesh.positions);
  map.points.row(0) = -map.points.row(0);
  return page_entry_of(name, file, map);
}

/// Small pictures, and something in the viewer's place.
ReportOptions quick() {
  ReportOptions options;
  options.viewer = ViewerScript{"customElements; // viewer", "Its licence"};
  options.look.size = 32;
  options.image_width = 64;
  return options;
}

long count(const std::string& text, const std::string& what) {
  long n = 0;
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

}  // namespace

TEST_CASE("report page: one map has a model, heat maps, charts, tables, provenance and a licence") {
  const MeshFile file = ball();
  const std::string page = report_page("ball", file, {good("ball", file)}, quick());
  CHECK(count(page, "<model-viewer ") == 1);
  CHECK(count(page, "data:model/gltf-binary;base64,") == 1);
  CHECK(count(page, "data:image/svg+xml;base64,") == 6);  // two disks and a histogram, twice
  CHECK_THAT(page, Contains("Certified one-to-one") && Contains("id=\"morph\"") &&
                       Contains("by hand") && Contains("Its licence") &&
                       Contains("Area distortion of ball over the whole sphere"));
  for (const char* name : {"checker", "axes", "area", "angle", "baked"}) {
    CHECK_THAT(page, Contains(std::string("name=\"surface\" value=\"") + name + "\""));
  }
}

TEST_CASE("report page: loads nothing from anywhere, and tells browsers so") {
  const MeshFile file = ball();
  const std::string page =
      report_page("ball", file, {good("one", file), good("two", file)}, quick());
  for (const char* attribute : {"src=\"", "href=\""}) {
    for (size_t at = page.find(attribute); at != std::string::npos;
         at = page.find(attribute, at + 1)) {
      CHECK(page.compare(at + std::string(attribute).size(), 5, "data:") == 0);
    }
  }
  CHECK_THAT(page, !Contains("http://") && !Contains("https://") && !Contains("@import"));
  CHECK_THAT(page, Contains("default-src 'none'"));
}

TEST_CASE("report page: every picture and control has words, and every input a label") {
  const MeshFile file = ball();
  const std::string page = report_page("ball", file, {good("ball", file)}, quick());
  CHECK(count(page, "<img") == count(page, " alt=\"") - count(page, "<model-viewer "));
  CHECK(count(page, "alt=\"\"") == 0);
  CHECK(count(page, "type=\"radio\"") == count(page, "<label>"));
  CHECK_THAT(page, Contains("<html lang=\"en\">") && Contains("for=\"morph\"") &&
                       Contains("role=\"status\"") && Contains("<legend>Surface</legend>"));
}

TEST_CASE("report page: names with markup stay text, and a script cannot be ended by another") {
  const MeshFile file = ball(1);
  const std::string bad = "</script><script>alert(1)</script>\"<b>";
  ReportOptions options = quick();
  options.viewer->code = "const text = '</script><!--';";
  options.viewer->licence = bad;
  options.facts = {{bad, bad}};
  const std::string page = report_page(bad, file, {good(bad, file), folded(bad, file)}, options);
  CHECK(count(page, "alert(1)</script>") == 0);
  CHECK(count(page, "<b>") == 0);
  CHECK(count(page, "<script") == count(page, "</script>"));
  CHECK_THAT(page, Contains("const text = '<\\/script><\\!--';"));
}

TEST_CASE("report page: the same bytes for the same maps, on any number of threads") {
  const MeshFile file = ball();
  const std::vector<PageEntry> entries = {good("one", file), folded("two", file)};
  ReportOptions options = quick();
  options.threads = 1;
  const std::string page = report_page("ball", file, entries, options);
  options.threads = 3;
  CHECK(report_page("ball", file, entries, options) == page);
}

TEST_CASE("report page: maps that fold are shown as pictures, beside models of those that do not") {
  const MeshFile file = ball();
  const std::string page =
      report_page("ball", file, {folded("paper", file), good("ours", file)}, quick());
  CHECK(count(page, "<model-viewer ") == 1);
  CHECK_THAT(page, Contains("class=\"still\"") && Contains("The sphere of paper: ") &&
                       Contains("name=\"surface\" value=\"area\""));
  const std::string alone = report_page("ball", file, {folded("paper", file)}, quick());
  CHECK_THAT(alone, !Contains("<model-viewer ") && !Contains("id=\"morph\"") &&
                        !Contains("<script") && Contains("Not one-to-one"));
}

TEST_CASE("report page: without the viewer it says so and has no script") {
  const MeshFile file = ball();
  ReportOptions options = quick();
  options.viewer.reset();
  const std::string page = report_page("ball", file, {good("ball", file)}, options);
  CHECK_THAT(page, !Contains("<script") && !Contains("<model-viewer ") &&
                       Contains("without the 3D viewer") && Contains("class=\"still\"><img"));
}

TEST_CASE("report page: without the viewer the mesh and the sphere of each map are seen") {
  const MeshFile file = ball();
  ReportOptions options = quick();
  options.viewer.reset();
  const std::string still = "class=\"still\"><img";
  const std::string one = report_page("ball", file, {good("one", file)}, options);
  CHECK(count(one, still) == 2);
  CHECK_THAT(one, Contains("alt=\"The mesh ball\"") && Contains("The sphere of one: "));
  const std::string three = report_page(
      "ball", file, {good("one", file), good("two", file), folded("three", file)}, options);
  CHECK(count(three, still) == 4);
  CHECK_THAT(three, Contains("The sphere of two: ") && Contains("The sphere of three: "));
}

TEST_CASE("report page: who misses the viewer is told how builds get it, who wants none is not") {
  const MeshFile file = ball(1);
  ReportOptions options = quick();
  options.viewer.reset();
  CHECK_THAT(report_page("ball", file, {good("ball", file)}, options),
             !Contains("SPHPARAM_VIEWER"));
  options.viewer_is_missing = true;
  CHECK_THAT(report_page("ball", file, {good("ball", file)}, options),
             Contains("without the 3D viewer") && Contains("-DSPHPARAM_VIEWER=FOLDER"));
}

TEST_CASE("report page: the pictures show the texture, one for all materials or one for each") {
  MeshFile file = ball(1);
  file.corner_texcoords = CornerTexcoords::Constant(file.mesh.triangles.size(), 2, 0.5);
  Property material{"material", ScalarType::Int32, {}};
  for (Face f = 0; f < file.mesh.face_count(); ++f) material.values.push_back(f % 2);
  file.set_face_property(material);
  ReportOptions options = quick();
  options.viewer.reset();
  const auto page = [&](const MeshTextures& textures, const PageEntry& page_entry) {
    options.textures = textures;
    const std::string html = report_page("ball", file, {page_entry}, options);
    return html.substr(0, html.find("<h2>"));  // what is above the heat maps
  };
  const auto colour = [](float red, float green) {
    return SourceTexture{.factor = {red, green, 0, 1}};
  };
  for (const PageEntry& page_entry : {good("good", file), folded("folded", file)}) {
    const std::string none = page({}, page_entry);
    const std::string red = page({{colour(1, 0)}, true}, page_entry);
    const std::string each = page({{colour(1, 0), colour(0, 1)}}, page_entry);
    CHECK(none != red);
    CHECK(red != each);
    CHECK(none != each);
    CHECK(red == page({{colour(1, 0), colour(0, 1)}, true}, page_entry));
  }
}

TEST_CASE("report page: a mesh with colours shows them first, one without its directions last") {
  MeshFile file = ball(1);
  const std::string plain = report_page("ball", file, {good("ball", file)}, quick());
  CHECK_THAT(plain, Contains("value=\"checker\" checked") && Contains("<span>Directions</span>"));
  for (const char* name : {"red", "green", "blue"}) {
    file.set_vertex_property(
        {name, ScalarType::Uint8,
         std::vector<double>(static_cast<size_t>(file.mesh.vertex_count()), 200)});
  }
  const std::string coloured = report_page("ball", file, {good("ball", file)}, quick());
  CHECK_THAT(coloured, Contains("value=\"baked\" checked") && Contains("<span>Own colours</span>"));
}

TEST_CASE("report page: progress may cancel it") {
  const MeshFile file = ball(1);
  ReportOptions options = quick();
  options.progress = [](std::string_view, double) { return false; };
  CHECK_THROWS_AS(report_page("ball", file, {good("ball", file)}, options), Cancelled);
}

TEST_CASE("page_entry: only one-to-one maps get a chart") {
  const MeshFile file = ball();
  CHECK(good("a", file).chart()->certificate.one_to_one());
  CHECK_FALSE(folded("b", file).chart());
  CHECK(chart_table({folded("b", file)}).rows.empty());
}

TEST_CASE("page_entry: tables have a column a map, and a dash where a map has no such figure") {
  const MeshFile file = ball();
  const std::vector<PageEntry> entries = {good("a", file), folded("b", file)};
  for (const PageTable& table : {distortion_table(entries), certificate_table(entries),
                                 chart_table(entries), provenance_table(entries)}) {
    REQUIRE_FALSE(table.rows.empty());
    CHECK(table.header[1] == "a");
    CHECK(table.header[2] == "b");
    for (const auto& row : table.rows) CHECK(row.size() == table.header.size());
  }
  CHECK(chart_table(entries).rows[0][2] == "–");
  CHECK(certificate_table(entries).rows[0][1] == "one-to-one");
}

TEST_CASE("report page: red alone is no colour") {
  MeshFile file = ball();
  file.set_vertex_property({"red", ScalarType::Uint8, std::vector<double>(162, 9)});
  const std::string page = report_page("ball", file, {good("ball", file)}, quick());
  CHECK_THAT(page, Contains("Directions"));
}

TEST_CASE("painted surfaces: can be cancelled while they are baked") {
  ReportOptions options = quick();
  options.progress = [](std::string_view stage, double) { return stage != "bake"; };
  const MeshFile file = ball();
  CHECK_THROWS_AS(report_page("ball", file, {good("ball", file)}, options), Cancelled);
}

TEST_CASE("make_report: a program gets the page of a mapped mesh, or of several maps") {
  const MeshFile file = ball();
  const PageOptions options{.viewer = false, .size = 64};
  const SphereMap map = normalised(file.mesh.positions);
  const std::string one =
      make_report(MappedMesh({.file = file, .map = map, .name = "ball.obj"}), options);
  CHECK_THAT(one, Contains("Spherical map of ball") && Contains("Certified one-to-one"));
  const std::string two = make_report(
      "ball", file, {{.name = "good", .map = map}, {.name = "bad", .map = {-map.points}}}, options);
  CHECK_THAT(two, Contains("2 maps of one mesh"));
  CHECK_THROWS_AS(make_report("ball", file, {}, options), std::invalid_argument);
}

TEST_CASE("make_report: a size or a map that cannot be is refused before any work") {
  const MeshFile file = ball(1);
  const SphereMap map{file.mesh.positions}, few{map.points.topRows(5)};
  PageOptions options{.viewer = false, .progress = [](std::string_view stage, double) {
                        FAIL("work was begun: " << stage);
                        return false;
                      }};
  CHECK_THROWS_AS(make_report("ball", file, {{"good", map}, {"few", few}}, options),
                  std::invalid_argument);
  for (const int size : {-1, 0, 63, 8193}) {
    options.size = size;
    CHECK_THROWS_AS(make_report("ball", file, {{"good", map}}, options), std::invalid_argument);
  }
}

TEST_CASE("page entries: maps of files are told apart, a mesh without a map is mapped now") {
  namespace fs = std::filesystem;
  const Folder folder;
  fs::create_directory(folder / "other");
  const MeshFile file = ball(1);
  const SphereMap map = normalised(file.mesh.positions);
  const std::string mesh = folder / "ball.obj", mapped = folder / "ball.sph.ply",
                    other = folder / "other/ball.obj";
  write_mesh(mesh, file);
  write_mesh(other, file);
  write_mesh(mapped, attach_map(file, map, {{"method", "by hand"}}));
  const auto names = [](const std::vector<PageEntry>& entries) {
    std::vector<std::string> all;
    for (const PageEntry& entry : entries) all.push_back(entry.entry.name);
    return all;
  };
  std::vector<std::string> made;
  const auto tell = [&](const PageEntry& entry) { made.push_back(entry.entry.name); };
  const std::vector<PageEntry> of_map =
      load_page_entries(read_source(mapped), {.others = {other, mapped}}, {}, tell);
  CHECK(names(of_map) == std::vector<std::string>{"ball", "ball (2)", "ball (3)"});
  CHECK(of_map[0].provenance == Provenance{{"method", "by hand"}});
  CHECK(of_map[1].entry.source == "ball.obj");
  CHECK(made.empty());

  const std::vector<PageEntry> of_mesh = load_page_entries(read_source(mesh), {}, {}, tell);
  CHECK(made == std::vector<std::string>{"ball"});
  CHECK(of_mesh[0].entry.seconds);
  CHECK(of_mesh[0].provenance[1].second == "progressive");
  const std::vector<PageEntry> beside =
      load_page_entries(read_source(mesh), {.sphere = mapped}, {}, tell);
  CHECK(beside[0].entry.name == "ball");
  CHECK(beside[0].entry.source == "ball.sph.ply");
  CHECK(made.size() == 1);
}
