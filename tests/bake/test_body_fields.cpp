#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <numbers>

#include "bake/field_registry.h"
#include "image/image_codec.h"
#include "rays/ray_scene.h"
#include "scenes.h"
#include "sphparam/bake/bake.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/planetocentric.h"
#include "sphparam/io/up_axis.h"
#include "sphparam/sphere/radial_directions.h"
#include "sphparam/sphere/spherical_coordinates.h"
#include "support/bytes_of.h"
#include "support/folder.h"
#include "support/test_meshes.h"

// Where texels lie on the body, against rays from its centre; and what geographic programs are
// told.

using namespace sphparam;
using namespace sphparam::tests;

namespace {

namespace fs = std::filesystem;
using Catch::Contains;

constexpr double pi = std::numbers::pi;

/// Small bodies, star-shaped about the origin: a bumpy ellipsoid, one with craters, a peanut.
TriangleMesh star_shaped(int which, int level) {
  TriangleMesh mesh = icosphere(level);
  for (Vertex v = 0; v < mesh.vertex_count(); ++v) {
    const Vector3 x = mesh.position(v);
    double r = 1 + 0.1 * std::sin(5 * x.x()) * std::cos(4 * x.y() + 1);
    if (which == 1) {
      r = 1 - 0.12 * std::exp(-20 * (x - Vector3(0.6, 0.64, 0.48)).squaredNorm()) -
          0.08 * std::exp(-60 * (x - Vector3(-1, 0, 0)).squaredNorm());
    }
    if (which == 2) r = std::sqrt(0.16 + x.x() * x.x());
    mesh.positions.row(v) = r * x;
    if (which == 0) mesh.positions.row(v) = mesh.position(v).cwiseProduct(Vector3(1.5, 1, 0.8));
  }
  return mesh;
}

MappedMesh mapped_radially(const TriangleMesh& mesh, const Vector3& centre = Vector3::Zero(),
                           double movement = 0) {
  MeshFile file;
  file.mesh = mesh;
  const auto text = [](double x) { return std::to_string(x); };
  return MappedMesh({.file = std::move(file),
                     .map = radial_directions(mesh, centre),
                     .provenance = {{"radial-centre", text(centre.x()) + " " + text(centre.y()) +
                                                          " " + text(centre.z())},
                                    {"radial-movement", text(movement)}},
                     .name = "stone.sph.ply"});
}

/// Values of a field in degrees of an image: by row and column, u = θ/2π.
struct Baked {
  int width, channels;
  std::vector<float> values;
  double at(int row, int column, int channel = 0) const {
    return static_cast<double>(
        values[static_cast<size_t>((row * width + column) * channels + channel)]);
  }
};

Baked baked(const MappedMesh& mesh, const std::string& field, BakeSettings settings = {},
            int width = 256) {
  settings.width = width;
  settings.interpolation = Interpolation::Sphere;
  Baked result{settings.width, 0, {}};
  bake_values(mesh, {field}, settings,
              [&](size_t, const BakedField& of, int first, int rows, const float* values) {
                result.channels = of.channels;
                const size_t line = static_cast<size_t>(settings.width * of.channels);
                REQUIRE(result.values.size() == static_cast<size_t>(first) * line);
                result.values.insert(result.values.end(), values,
                                     values + static_cast<size_t>(rows) * line);
              });
  return result;
}

Vector3 direction_of(int row, int column, int width) {
  return to_cartesian({(column + 0.5) / width * 2 * pi, (row + 0.5) / (width / 2.0) * pi});
}

/// What is between <NAME> and </NAME>, at its first place.
std::string element(const std::string& xml, const std::string& name) {
  const size_t open = xml.find("<" + name), from = xml.find('>', open) + 1;
  return xml.substr(from, xml.find("</" + name + ">", from) - from);
}

}  // namespace

TEST_CASE("radius: maps of star-shaped bodies agree with rays from the centre to 1e-4") {
  const TriangleMesh mesh = star_shaped(GENERATE(0, 1, 2), 6);
  const double mean = mesh.positions.rowwise().norm().mean();
  const RayScene scene(mesh);
  // Texels finer than triangles: larger ones are means of what lies in them.
  const Baked radius = baked(mapped_radially(mesh), "radius", {}, 1024);
  double worst = 0;
  for (int row = 0; row < radius.width / 2; ++row) {
    for (int column = 0; column < radius.width; ++column) {
      const RayHit hit =
          scene.first_hit(Vector3::Zero(), direction_of(row, column, radius.width), 10);
      REQUIRE(hit.face >= 0);
      worst = std::max(worst, std::abs(radius.at(row, column) - hit.distance));
    }
  }
  CHECK(worst < 1e-4 * mean);
}

TEST_CASE("lonlat: texels of a radial map have their own longitude and latitude") {
  const Baked places = baked(mapped_radially(star_shaped(0, 6)), "lonlat");
  CHECK(places.channels == 3);
  double worst = 0;
  for (int row = 0; row < places.width / 2; ++row) {
    for (int column = 0; column < places.width; ++column) {
      const double theta = (column + 0.5) / places.width * 360;
      const double longitude = theta > 180 ? theta - 360 : theta;
      const double latitude = 90 - (row + 0.5) / (places.width / 2.0) * 180;
      const double off = std::remainder(places.at(row, column, 0) - longitude, 360) *
                         std::cos(latitude * pi / 180);
      worst = std::max({worst, std::abs(off), std::abs(places.at(row, column, 1) - latitude)});
      CHECK(places.at(row, column, 2) == 0);
    }
  }
  CHECK(worst < 1e-4);  // degrees: a ray from the centre meets the point
}

TEST_CASE("albedo: what vertices carry appears in the direction where they lie, to half a degree") {
  const TriangleMesh mesh = star_shaped(GENERATE(0, 2), 6);
  const MappedMesh plain = mapped_radially(mesh);
  MeshFile file = plain.file();
  for (int axis = 0; axis < 3; ++axis) {  // a colour that says which direction it is of
    const auto column = plain.map().points.col(axis);
    file.set_vertex_property({std::string(1, "xyz"[axis]) + "_albedo", ScalarType::Float64,
                              std::vector<double>(column.begin(), column.end())});
  }
  const MappedMesh painted(
      {.file = file, .map = plain.map(), .provenance = plain.provenance(), .name = "stone"});
  const Baked x = baked(painted, "scalar:x_albedo"), y = baked(painted, "scalar:y_albedo"),
              z = baked(painted, "scalar:z_albedo");
  double worst = 0;
  for (int row = 0; row < x.width / 2; ++row) {
    for (int column = 0; column < x.width; ++column) {
      const Vector3 seen(x.at(row, column), y.at(row, column), z.at(row, column));
      const double cosine = seen.normalized().dot(direction_of(row, column, x.width));
      worst = std::max(worst, std::acos(std::min(cosine, 1.0)) * 180 / pi);
    }
  }
  CHECK(worst < 0.5);
}

TEST_CASE("lon: never a mean across 180 degrees, with many samples and crowded texels too") {
  const MappedMesh mesh = mapped_radially(star_shaped(1, 6));
  BakeSettings settings;
  settings.samples = 3;
  for (const bool west : {false, true}) {
    settings.fields.positive_west = west;
    const Baked longitude = baked(mesh, "lon", settings);
    for (int row = 0; row < longitude.width / 2; ++row) {
      for (int column = 0; column < longitude.width; ++column) {
        const double theta = (column + 0.5) / longitude.width * 360;
        const double wanted = west ? -theta : theta;
        const double off = std::remainder(longitude.at(row, column) - wanted, 360);
        CHECK(std::abs(off) * std::sin((row + 0.5) / 128 * pi) < 0.05);
        CHECK(longitude.at(row, column) <= 180);
        CHECK(longitude.at(row, column) >= -180);
      }
    }
  }
}

TEST_CASE("lon: the date line is at 180 degrees, counted either way") {
  TriangleMesh octahedron;
  octahedron.positions =
      (Points(6, 3) << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1).finished();
  octahedron.triangles =
      (Triangles(8, 3) << 0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5)
          .finished();
  for (const bool west : {false, true}) {
    MeshFile file;
    file.mesh = octahedron;
    const auto scene =
        scene_of(std::move(file), SphereMap{octahedron.positions}, {.positive_west = west});
    const SurfaceField field = make_field("lon", *scene);
    const auto at = [&](const Vector3& weights) {
      const SurfaceSample sample{{1, weights}, 0};  // between +y, −x and +z
      float value = 0;
      field.evaluate(std::span(&sample, 1), &value);
      return value;
    };
    CHECK(at({0, 1, 0}) == 180);
    CHECK(at({1, 0, 0}) == (west ? -90 : 90));
    CHECK(at({0, 0, 1}) == 0);
    CHECK(at({0.5, 0.5, 0}) == (west ? -135 : 135));
  }
}

TEST_CASE("slope: 0 on a sphere about its centre, that of the plane on a cube's face") {
  const Baked none = baked(mapped_radially(icosphere(6)), "slope");
  CHECK(*std::ranges::max_element(none.values) < 1.2);  // a facet's own tilt
  TriangleMesh box = octahedron();                      // its faces: normals (±1, ±1, ±1)/√3
  const Baked slope = baked(mapped_radially(box), "slope");
  for (const auto& [row, column] : {std::pair(20, 30), {60, 100}, {100, 200}}) {
    const Vector3 x = direction_of(row, column, slope.width);
    const double wanted = std::acos(x.cwiseAbs().sum() / std::sqrt(3)) * 180 / pi;
    CHECK(slope.at(row, column) == Approx(wanted).margin(0.5));
  }
}

TEST_CASE("elevation: above the sphere or ellipsoid of the body, in the mesh's unit") {
  TriangleMesh mesh = icosphere(6);  // in kilometres
  mesh.positions *= Vector3(17, 9, 6).asDiagonal();
  const MappedMesh mapped = mapped_radially(mesh);
  BakeSettings settings;
  settings.convention = Convention::Gis;
  settings.fields.body = body_of("17,9,6", 1000);
  const Baked nothing = baked(mapped, "elevation", settings);
  CHECK(std::abs(*std::ranges::max_element(nothing.values)) < 0.02);
  CHECK(std::abs(*std::ranges::min_element(nothing.values)) < 0.02);
  settings.fields.body = body_of("10", 1000);
  const Baked radius = baked(mapped, "radius", settings);
  const Baked above = baked(mapped, "elevation", settings);
  for (size_t i = 0; i < radius.values.size(); i += 97) {
    CHECK(above.values[i] == Approx(radius.values[i] - 10).margin(1e-5));
  }
  settings.fields.body.reset();
  CHECK_THROWS_AS(baked(mapped, "elevation", settings), FieldError);
}

TEST_CASE("radius: the centre is that of the radial map, or a given one") {
  const Vector3 centre(3, -1, 2);
  TriangleMesh mesh = icosphere(4);
  mesh.positions.rowwise() += centre.transpose();
  const Baked own = baked(mapped_radially(mesh, centre), "radius");
  CHECK(*std::ranges::max_element(own.values) <= 1 + 1e-6F);
  CHECK(*std::ranges::min_element(own.values) > 0.99F);
  BakeSettings settings;
  settings.fields.centre = Vector3::Zero();
  const Baked origin = baked(mapped_radially(mesh, centre), "radius", settings);
  CHECK(*std::ranges::max_element(origin.values) > 3);
}

TEST_CASE("body_of: names, radii and WKT, and what is none of them") {
  const Body vesta = body_of("vesta");
  CHECK(vesta.name == "Vesta");
  CHECK(vesta.iau_code == 200000400);
  CHECK(vesta.semi_axes == Vector3(255000, 255000, 255000));
  CHECK(body_of("0.25", 1000).semi_axes == Vector3(250, 250, 250));
  CHECK(body_of("3,2,1").semi_axes == Vector3(3, 2, 1));
  const Body given = body_of(
      "GEOGCRS[\"Ryugu\",DATUM[\"Ryugu\",ELLIPSOID[\"Ryugu\",448,0,LENGTHUNIT[\"metre\",1]]],"
      "CS[ellipsoidal,2],AXIS[\"latitude\",north],AXIS[\"longitude\",west],"
      "ANGLEUNIT[\"degree\",0.0174532925199433]]");
  CHECK(given.name == "Ryugu");
  CHECK(given.semi_axes == Vector3(448, 448, 448));
  CHECK(given.positive_west);
  const Body printed = body_of("\n  " + given.wkt + " \r\n");
  CHECK(printed.wkt == given.wkt);
  CHECK(body_of(" vesta\n").name == "Vesta");
  CHECK(body_of(" 3,2,1 ").semi_axes == Vector3(3, 2, 1));
  const Body old = body_of(
      "GEOGCS[\"Mars\",DATUM[\"Mars\",SPHEROID[\"Mars\",3396190,0]],"
      "PRIMEM[\"Airy-0\",0],UNIT[\"degree\",0.0174532925199433]]");
  CHECK(old.name == "Mars");
  CHECK_FALSE(old.positive_west);
  const Body flattened = body_of(
      "GEODCRS[\"Mars (2015) / "
      "Ocentric\",DATUM[\"Mars\",ELLIPSOID[\"Mars\",3396190,169.894447223612,"
      "LENGTHUNIT[\"metre\",1]]],CS[spherical,2],AXIS[\"planetocentric latitude (U)\",north],"
      "AXIS[\"planetocentric longitude (V)\",east],ID[\"IAU\",49902,2015]]");
  CHECK(flattened.semi_axes.z() == Approx(3376200).epsilon(1e-9));
  for (const char* text :
       {"vespa", "", "-3", "0", "1,2", "1,2,3,4", "1,,2", "nan", "3,2,inf", "GEOGCRS[\"x\"]",
        "GEOGCRS[\"x\",ELLIPSOID[\"x\",1,0]", "PROJCRS[]", "GEOGCRS[\",5,0,\",ELLIPSOID[]]"}) {
    INFO(text);
    CHECK_THROWS_AS(body_of(text), BodyError);
  }
  CHECK_THROWS_AS(body_of("vesta", 0), BodyError);
}

TEST_CASE("body_of: WKT is in the units that it names, and angles in degrees") {
  const auto wkt = [](const std::string& ellipsoid, const std::string& angles) {
    return "GEOGCRS[\"X UNIT[ ELLIPSOID[ ]]\",DATUM[\"X\",ELLIPSOID[\"LENGTHUNIT[]\"," + ellipsoid +
           "]],PRIMEM[\"P\",0,ANGLEUNIT[\"grad\",0.0157079632679]],CS[ellipsoidal,3],AXIS[\"lat\","
           "north" +
           angles + "],AXIS[\"lon\",east],AXIS[\"h\",up,LENGTHUNIT[\"metre\",1]]]";
  };
  const std::string degrees = ",ANGLEUNIT[\"degree\",0.0174532925199433]";
  const Vector3 ten = Vector3::Constant(10000);
  CHECK(body_of(wkt("10,0,LENGTHUNIT[\"kilometre\",1000]", degrees), 1000).semi_axes == ten);
  CHECK(body_of(wkt("10,0,UNIT[\"kilometre\",1000]", degrees)).semi_axes == ten);
  CHECK(body_of(wkt("10000,0", "")).semi_axes == ten);
  CHECK(body_of(wkt("10000,0", ",UNIT[\"degree\",0.01745]")).semi_axes == ten);
  for (const char* bad : {",ANGLEUNIT[\"radian\",1]", ",UNIT[\"grad\",0.0157079632679]"})
    CHECK_THROWS_WITH(body_of(wkt("10000,0", bad)),
                      Contains("in another unit than degrees") &&
                          Contains("ANGLEUNIT[\"degree\",0.0174532925199433] is needed in it"));
  CHECK_THROWS_WITH(body_of(wkt("10,0,LENGTHUNIT[\"km\"]", degrees)),
                    Contains("a unit that is no number above 0: LENGTHUNIT[…]"));
  CHECK_THROWS_AS(body_of(wkt("10,0,LENGTHUNIT[\"km\",0]", degrees)), BodyError);
  CHECK_THROWS_WITH(body_of("GEOGCS[\"X\",DATUM[\"X\",SPHEROID[\"X\",10000,0]],PRIMEM[\"P\",0],"
                            "UNIT[\"radian\",1]]"),
                    Contains("in another unit than degrees"));
}

TEST_CASE("body_of: who asks for a body that is not known hears of those there are") {
  CHECK_THROWS_WITH(body_of("Bennu"),
                    Contains("which are planets, moons and borrelly, churyumov-") &&
                        Contains("ida, gaspra; a radius"));
}

TEST_CASE("body_of: WKT whose latitudes maps have not is refused, with what to give instead") {
  const std::string datum =
      "DATUM[\"Mars (2015)\",ELLIPSOID[\"Mars (2015)\",3396190,169.894447223612]],";
  const auto axes = [](const char* east) {
    return std::string(
               "CS[ellipsoidal,2],AXIS[\"geodetic latitude (Lat)\",north],AXIS[\"geodetic "
               "longitude (Lon)\",") +
           east + "]";
  };
  const std::string ographic = "GEOGCRS[\"Mars (2015) / Ographic\"," + datum + axes("west");
  CHECK_THROWS_WITH(body_of(ographic + ",ID[\"IAU\",49901,2015]]", 1000),
                    Contains("Mars (2015) / Ographic has planetographic latitudes") &&
                        Contains("IAU_2015:49900, which is what the name mars stands for") &&
                        Contains("3396.19,3396.19,3376.2"));
  CHECK_THROWS_WITH(body_of(ographic + "]"), Contains("a geographic one on a sphere is needed"));
  CHECK_THROWS_WITH(body_of("GEOGCS[\"Mars\",DATUM[\"Mars\",SPHEROID[\"Mars\",3396190,169.9]],"
                            "AUTHORITY[\"IAU\",\"49901\"]]"),
                    Contains("the name mars"));
  CHECK_THROWS_WITH(body_of("GEOGCS[\"Mars\",DATUM[\"Mars\",SPHEROID[\"Mars\",3396190,169.9]],"
                            "AUTHORITY[\"IAU\",\"1e300\"]]"),
                    Contains("a geographic one on a sphere is needed, or a radius"));
  CHECK_THROWS_WITH(
      body_of("GEODCRS[\"Mars\"," + datum + "CS[Cartesian,3],ID[\"IAU\",49902,2015]]"),
      Contains("is of a geocentric system") && Contains("the name mars") &&
          !Contains("planetographic"));
  CHECK_THROWS_WITH(
      body_of("PROJCRS[\"Eros (2015) - Sphere / Ocentric / Equirectangular\",BASEGEOGCRS[\"Eros\","
              "DATUM[\"Eros\",ELLIPSOID[\"Eros\",17000,0]],ID[\"IAU\",200043300,2015]],"
              "CONVERSION[\"Equirectangular\"],CS[Cartesian,2],ID[\"IAU\",200043310,2015]]"),
      Contains("is of a projected system, in metres") && Contains("the name eros"));
}

TEST_CASE("sidecars: coordinates, scale, offset and unit beside each image, or no file at all") {
  const Folder folder;
  BakeSettings settings;
  settings.width = 64;
  settings.convention = Convention::Gis;
  settings.interpolation = Interpolation::Sphere;
  settings.fields.body = body_of("Vesta", 1000);
  TriangleMesh mesh = star_shaped(0, 4);
  mesh.positions *= 255;
  const BakeReport report =
      bake(mapped_radially(mesh),
           {{"radius", folder / "r.tif"}, {"normal-object", folder / "n.png"}}, settings);
  CHECK(report.coordinate_system == "Vesta (2015) - Sphere / Ocentric");
  CHECK(report.warnings.empty());
  CHECK(report.images[0].sidecar == folder / "r.tif.aux.xml");
  const std::string radius = bytes_of(folder / "r.tif.aux.xml");
  CHECK(element(radius, "GeoTransform") == "-180, 5.625, 0, 90, 0, -5.625");
  CHECK(element(radius, "UnitType") == "km");
  const auto [least, greatest] = report.images[0].range.value();
  CHECK(std::stod(element(radius, "Offset")) == least);
  CHECK(std::stod(element(radius, "Scale")) == (greatest - least) / 65535);
  CHECK_THAT(element(radius, "SRS"), Contains("ID[&quot;IAU&quot;,200000400,2015]"));
  const std::string normal = bytes_of(folder / "n.png.aux.xml");
  CHECK(std::stod(element(normal, "Offset")) == -1);
  CHECK_THAT(normal, Contains("<PAMRasterBand band=\"3\">"));
}

TEST_CASE("sidecars: where kept holes are, floats for geographic programs are no numbers") {
  const Folder folder;
  BakeSettings settings;
  settings.width = 64;
  settings.convention = Convention::Gis;
  settings.depth = SampleType::Float;
  settings.fields.body = body_of("Vesta", 1000);
  MeshFile file;
  file.mesh = star_shaped(0, 4);
  FillerMarks fillers(static_cast<std::size_t>(file.mesh.face_count()), 0);
  std::fill_n(fillers.begin(), 400, 1);
  mark_fillers(file, fillers);
  SphereMap map{file.mesh.positions.rowwise().normalized()};
  const MappedMesh holed({.file = std::move(file), .map = std::move(map), .name = "holed"});
  const auto values = [&](const char* name) {
    bake(holed, {{"radius", folder / name}}, settings);
    return read_image(folder / name);
  };
  const Image exr = values("r.exr"), tif = values("r.tif");
  REQUIRE(tif.channels == 2);
  std::ptrdiff_t holes = 0;
  for (std::size_t i = 0; i < tif.pixels.size(); i += 2) {
    const bool in_hole = exr.pixels[i + 1] == 0;
    holes += in_hole;
    CHECK(tif.pixels[i + 1] == exr.pixels[i + 1]);
    CHECK((in_hole ? std::isnan(tif.pixels[i]) : tif.pixels[i] == exr.pixels[i]));
  }
  CHECK(holes == 86);
  const std::string bands = bytes_of(folder / "r.tif.aux.xml");
  const std::string alpha = bands.substr(bands.find("band=\"2\""));
  CHECK(element(bands, "NoDataValue") == "nan");
  CHECK_THAT(alpha, !Contains("NoDataValue"));
  settings.depth.reset();
  values("i.tif");
  CHECK_THAT(bytes_of(folder / "i.tif.aux.xml"), !Contains("NoDataValue"));
  settings.depth = SampleType::Float;
  settings.fields.body.reset();
  CHECK(values("plain.tif").pixels == exr.pixels);
}

TEST_CASE("sidecars: lonlat has two bands in degrees, and one of nothing") {
  const Folder folder;
  BakeSettings settings;
  settings.width = 64;
  settings.convention = Convention::Gis;
  settings.fields.body = body_of("Vesta");
  bake(mapped_radially(star_shaped(0, 3)), {{"lonlat", folder / "l.tif"}}, settings);
  const std::string bands = bytes_of(folder / "l.tif.aux.xml");
  const auto band = [&](int i) { return bands.substr(bands.find("band=\"" + std::to_string(i))); };
  CHECK(element(band(1), "Description") == "longitude");
  CHECK(element(band(2), "Description") == "latitude");
  CHECK(element(band(2), "UnitType") == "degree");
  CHECK(element(band(3), "Description") == "nothing");
  CHECK_THAT(band(3), !Contains("UnitType"));
}

TEST_CASE("sidecars: lengths and curvatures have units, what covers kept holes is no data") {
  const Folder folder;
  BakeSettings settings;
  settings.width = 64;
  settings.convention = Convention::Gis;
  settings.fields.body = body_of("Vesta", 1000);
  MeshFile file;
  file.mesh = star_shaped(0, 4);
  file.mesh.positions *= 255;
  FillerMarks fillers(static_cast<std::size_t>(file.mesh.face_count()), 0);
  std::fill_n(fillers.begin(), 40, 1);
  mark_fillers(file, fillers);
  SphereMap map{file.mesh.positions.rowwise().normalized()};
  const MappedMesh holed({.file = std::move(file), .map = std::move(map), .name = "holed"});
  bake(holed,
       {{"radius", folder / "r.tif"},
        {"thickness", folder / "t.tif"},
        {"curvature", folder / "c.tif"},
        {"curvature:gauss", folder / "g.tif"}},
       settings);
  CHECK(element(bytes_of(folder / "t.tif.aux.xml"), "UnitType") == "km");
  CHECK(element(bytes_of(folder / "c.tif.aux.xml"), "UnitType") == "1/km");
  CHECK(element(bytes_of(folder / "g.tif.aux.xml"), "UnitType") == "1/km^2");
  const std::string radius = bytes_of(folder / "r.tif.aux.xml");
  CHECK(element(radius, "Description") == "radius");
  const std::string cover = radius.substr(radius.find("band=\"2\""));
  CHECK(element(cover, "Description") == "surface");
  CHECK(element(cover, "ColorInterp") == "Alpha");
  CHECK_THAT(cover, !Contains("UnitType") && !Contains("Scale"));
  settings.fields.body = body_of("Vesta", 0.3);
  bake(holed, {{"curvature:gauss", folder / "g.tif"}}, settings);
  CHECK(element(bytes_of(folder / "g.tif.aux.xml"), "UnitType") == "1/(0.3 m)^2");
}

TEST_CASE("sidecars: longitudes are called planetocentric only where they are") {
  const Folder folder;
  BakeSettings settings;
  settings.width = 64;
  settings.convention = Convention::Gis;
  settings.interpolation = Interpolation::Sphere;
  settings.fields.body = body_of("Eros", 1000);
  TriangleMesh mesh = star_shaped(0, 3);
  mesh.positions *= 17;
  const auto system = [&](const MappedMesh& mapped) {
    const BakeReport report = bake(mapped, {{"radius", folder / "r.tif"}}, settings);
    const std::string srs = element(bytes_of(folder / "r.tif.aux.xml"), "SRS");
    CHECK((srs.find("200043300") != std::string::npos) ==
          (report.coordinate_system == "Eros (2015) - Sphere / Ocentric"));
    return report.coordinate_system;
  };
  CHECK(system(mapped_radially(mesh)) == "Eros (2015) - Sphere / Ocentric");
  CHECK_THAT(system(mapped_radially(mesh, Vector3::Zero(), 0.02)), Contains("within 1.15 degrees"));
  MeshFile file;
  file.mesh = mesh;
  CHECK(system(MappedMesh({.file = file, .map = radial_directions(mesh)})) ==
        "sphparam map of Eros");
  settings.fields.body->positive_west = true;
  CHECK(system(mapped_radially(mesh)) == "Eros (2015) - Sphere / Ocentric, positive west");
  CHECK(element(bytes_of(folder / "r.tif.aux.xml"), "GeoTransform") ==
        "180, -5.625, 0, 90, 0, -5.625");
}

TEST_CASE("sidecars: what a header says of longitudes counts where it is so, as measured") {
  const Folder folder;
  BakeSettings settings;
  settings.width = 64;
  settings.convention = Convention::Gis;
  settings.interpolation = Interpolation::Sphere;
  settings.fields.body = body_of("Eros", 1000);
  TriangleMesh mesh = star_shaped(0, 3);
  mesh.positions *= 17;
  const SphereMap map = radial_directions(mesh);
  const auto system = [&](const Points& positions, Provenance lines, const char* up = "") {
    MeshFile file;
    file.mesh = {positions, mesh.triangles};
    if (*up) file.comments = {std::string("up axis ") + up};
    lines.insert(lines.begin(), {{"radial-centre", "0 0 0"}, {"radial-movement", "0"}});
    return bake(MappedMesh({.file = file, .map = map, .provenance = lines}),
                {{"lon", folder / "l.tif"}}, settings)
        .coordinate_system;
  };
  const std::string ocentric = "Eros (2015) - Sphere / Ocentric", own = "sphparam map of Eros";
  const Points& x = mesh.positions;
  CHECK(system(x, {}) == ocentric);
  CHECK(system(x.cast<float>().cast<double>(), {}) == ocentric);
  CHECK(system(x.rowwise() + Eigen::RowVector3d(0.1, 0, 0), {}) == own);
  CHECK(system(x * Eigen::AngleAxisd(0.1, Vector3::UnitX()).toRotationMatrix(), {}) == own);
  CHECK(system(x, {{"anew", "nothing of the method's own map is left"}}) == own);
  // As glTF has it, y up: the body's north is where the file says.
  Eigen::Matrix3d upright;
  upright << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const Points turned = x * upright.transpose();
  CHECK(system(turned, {}, "y") == ocentric);
  CHECK(system(turned, {}) == own);
  CHECK(system(x, {}, "y") == own);
}

TEST_CASE("lon, lat: north is what the file says points up") {
  const TriangleMesh mesh = star_shaped(0, 3);
  Eigen::Matrix3d upright;
  upright << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  MeshFile file;
  file.mesh = {mesh.positions * upright.transpose(), mesh.triangles};
  file.comments = {"up axis y"};
  const Provenance lines = {{"radial-centre", "0 0 0"}, {"radial-movement", "0"}};
  const MappedMesh as_gltf({.file = file, .map = radial_directions(mesh), .provenance = lines});
  for (const char* field : {"lon", "lat", "slope", "radius"}) {
    INFO(field);
    const Baked here = baked(as_gltf, field), there = baked(mapped_radially(mesh), field);
    REQUIRE(here.values.size() == there.values.size());
    for (size_t i = 0; i < here.values.size(); ++i)
      if (std::abs(here.values[i] - there.values[i]) > 1e-3F) FAIL(i);
  }
}

TEST_CASE("bake: what only says that it is radial is not seen from its centre") {
  MeshFile file;
  file.mesh = star_shaped(0, 2);
  const SphereMap directions = radial_directions(file.mesh),
                  other = radial_directions(icosphere(2));
  const auto radius = [&](const SphereMap& map, const Provenance& lines) {
    return baked(MappedMesh({.file = file, .map = map, .provenance = lines}), "radius").values;
  };
  const Provenance radial = {{"radial-centre", "0 0 0"}, {"radial-movement", "0"}};
  CHECK(radius(other, radial) == radius(other, {}));
  Provenance anew = radial;
  anew.emplace_back("anew", "nothing of the method's own map is left");
  CHECK(radius(directions, anew) == radius(directions, {}));
  CHECK(radius(directions, radial) != radius(directions, {}));
}

TEST_CASE("body axes: longitude -90 is the front, which z up has too") {
  const auto axes = [](std::vector<std::string> comments) {
    MeshFile file;
    file.comments = std::move(comments);
    return body_axes(file);
  };
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  CHECK(axes({}) == identity);
  CHECK(axes({"up axis z"}) == identity);
  CHECK(axes({"front axis z"}) == identity);  // along what is up: none
  CHECK(axes({"up axis z", "front axis -y"}) == identity);
  for (const char* up : {"x", "y", "z"}) {
    for (const char* front : {"x", "-x", "y", "-y", "z", "-z"}) {
      INFO(up << " up, " << front << " in front");
      const Vector3 north = *direction_named(up), seen = *direction_named(front);
      if (north.dot(seen) != 0) continue;
      const Eigen::Matrix3d rows =
          axes({std::string("up axis ") + up, std::string("front axis ") + front});
      CHECK(rows * north == Vector3(0, 0, 1));
      CHECK(rows * seen == Vector3(0, -1, 0));
      CHECK(rows.determinant() == 1);
    }
  }
  MeshFile file, gltf;
  file.mesh = gltf.mesh = star_shaped(0, 2);
  file.comments = {"up axis z", "front axis x"};
  gltf.comments = {"up axis y", "front axis z"};
  gltf.mesh.positions *= upright_rotation(upright_axes(file)).transpose();
  CHECK(body_directions(gltf, Vector3::Zero()).points ==
        body_directions(file, Vector3::Zero()).points);
}

TEST_CASE("sidecars: a map that is radial about another centre has not the body's longitudes") {
  const Folder folder;
  const Vector3 centre(100, -50, 20);
  TriangleMesh mesh = star_shaped(0, 3);
  mesh.positions *= 17;
  mesh.positions.rowwise() += centre.transpose();
  const MappedMesh mapped = mapped_radially(mesh, centre);
  BakeSettings settings;
  settings.width = 64;
  settings.convention = Convention::Gis;
  settings.interpolation = Interpolation::Sphere;
  settings.fields.body = body_of("Eros", 1000);
  const auto baked_about = [&](std::optional<Vector3> given) {
    settings.fields.centre = given;
    return bake(mapped, {{"lon", folder / "l.tif"}}, settings);
  };
  CHECK(baked_about({}).coordinate_system == "Eros (2015) - Sphere / Ocentric");
  const BakeReport typed = baked_about(centre + Vector3(1e-6, 0, -1e-6));
  CHECK(typed.coordinate_system == "Eros (2015) - Sphere / Ocentric");
  CHECK(typed.warnings.empty());
  for (const Vector3& other : {Vector3(101, -50, 20), Vector3(100, -50, 20.01)}) {
    const BakeReport report = baked_about(other);
    CHECK(report.coordinate_system == "sphparam map of Eros");
    REQUIRE(report.warnings.size() == 1);
    CHECK_THAT(report.warnings.front(),
               Contains("radial about (100, -50, 20)") && Contains("not about the body's centre"));
    CHECK(bytes_of(folder / "l.tif.aux.xml").find("200043300") == std::string::npos);
  }
}

TEST_CASE("sidecars: what is linear in (u, v) says by how much its longitudes are off") {
  const Folder folder;
  TriangleMesh mesh = star_shaped(2, 2);
  mesh.positions *= 17;
  const MappedMesh mapped = mapped_radially(mesh);
  BakeSettings settings;
  settings.width = 256;
  settings.convention = Convention::Gis;
  settings.interpolation = Interpolation::Uv;
  settings.fields.body = body_of("Eros", 1000);
  const std::string path = folder / "r.tif";
  const std::string name = bake(mapped, {{"radius", path}}, settings).coordinate_system;
  double off = 0;  // of latitudes alone
  bake_values(mapped, {"lat"}, settings,
              [&](size_t, const BakedField&, int first, int rows, const float* values) {
                for (int i = 0; i < rows * settings.width; ++i) {
                  const double row = first + i / settings.width + 0.5;
                  off = std::max(off, std::abs(values[i] - (90 - row / 128 * 180)));
                }
              });
  CHECK(off > 1);
  INFO(name << ", latitudes " << off);
  const size_t at = name.find("within ");
  REQUIRE(at != std::string::npos);
  const double told = std::stod(name.substr(at + 7));
  CHECK(told >= 0.99 * off);
  CHECK(told < 3 * off);
  CHECK(bytes_of(path + ".aux.xml").find("200043300") == std::string::npos);
  settings.interpolation = Interpolation::Sphere;
  CHECK(bake(mapped, {{"radius", path}}, settings).coordinate_system ==
        "Eros (2015) - Sphere / Ocentric");
  settings.from = mapped.file();  // found along normals, not from the centre
  CHECK_THAT(bake(mapped, {{"radius", path}}, settings).coordinate_system,
             Contains("planetocentric within ") && Contains("another surface"));
}

TEST_CASE("lon: another surface on a radial map is seen from the centre of that, too") {
  const Vector3 centre(100, -50, 20);
  TriangleMesh mesh = icosphere(5);
  mesh.positions.rowwise() += centre.transpose();
  const MappedMesh mapped = mapped_radially(mesh, centre);
  BakeSettings settings;
  settings.from = mapped.file();
  const Baked latitude = baked(mapped, "lat", settings, 64);
  for (int row = 0; row < 32; ++row)
    CHECK(latitude.at(row, 7) == Approx(90 - (row + 0.5) / 32 * 180).margin(1));
}

TEST_CASE("sidecars: what is odd is told: another unit, images without one, one left behind") {
  const Folder folder;
  BakeSettings settings;
  settings.width = 64;
  settings.convention = Convention::Gis;
  settings.fields.body = body_of("Eros");
  const MappedMesh mesh = mapped_radially(star_shaped(0, 3));
  const BakeReport other_unit = bake(mesh, {{"radius", folder / "r.tif"}}, settings);
  REQUIRE(other_unit.warnings.size() == 1);
  CHECK_THAT(other_unit.warnings.front(), Contains("another unit"));
  settings.fields.body = body_of("1");
  const BakeReport exr = bake(mesh, {{"radius", folder / "r.exr"}}, settings);
  REQUIRE(exr.warnings.size() == 1);
  CHECK_FALSE(fs::exists(folder / "r.exr.aux.xml"));
  settings.fields.body.reset();
  const BakeReport stale = bake(mesh, {{"radius", folder / "r.tif"}}, settings);
  REQUIRE(stale.warnings.size() == 1);
  CHECK_THAT(stale.warnings.front(), Contains("earlier image"));
  settings.fields.body = body_of("1");
  settings.convention = Convention::Sphparam;
  CHECK_THROWS_AS(bake(mesh, {{"radius", folder / "x.tif"}}, settings), BakeSettingError);
  CHECK_FALSE(fs::exists(folder / "x.tif"));
}
