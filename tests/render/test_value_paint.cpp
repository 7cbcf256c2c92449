#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "render/value_paint.h"
#include "sphparam/io/vertex_data.h"
#include "support/test_meshes.h"

using namespace sphparam;
using namespace sphparam::tests;

namespace {

MeshFile ball() {
  MeshFile file;
  file.mesh = icosphere(2);
  return file;
}

/// Values 0, 1, 2, … times the step.
Property ramp(const MeshFile& file, double step, double start = 0) {
  Property property{"ramp", ScalarType::Float64, {}};
  for (Vertex v = 0; v < file.mesh.vertex_count(); ++v) property.values.push_back(start + step * v);
  return property;
}

VertexData two_labels(const MeshFile& file) {
  VertexData data;
  data.name = "parts";
  data.kind = DataKind::Labels;
  data.columns.resize(1);
  for (Vertex v = 0; v < file.mesh.vertex_count(); ++v)
    data.columns[0].values.push_back(static_cast<double>(v % 4));
  data.labels = {
      {0, {{1, 1, 1, 0}}, "???"}, {1, {{1, 0, 0, 1}}, "red"}, {2, {{0, 0, 1, 1}}, "blue"}};
  return data;
}

}  // namespace

TEST_CASE(
    "value_paint: what is measured has a scale without its tails, the same on both sides of 0") {
  MeshFile file = ball();
  Property values = ramp(file, 1);
  values.values[5] = 1e9;
  file.set_vertex_property(values);
  const ValuePaint paint = value_paint(file, "ramp");
  REQUIRE(paint.scale);
  CHECK(paint.scale->low < 6);
  CHECK(paint.scale->high < 200);
  CHECK(paint.paint.blends);
  CHECK(paint.paint.colours[5] == heat_colour(*paint.scale, paint.scale->high));
  file.set_vertex_property(ramp(file, 1, -50));
  const HeatScale both = *value_paint(file, "ramp").scale;
  CHECK(both.diverges());
  CHECK(both.high > 100);
}

TEST_CASE("value_paint: the title of a scale is the name as it is") {
  MeshFile file = ball();
  Property values = ramp(file, 1);
  values.name = "T_surface";
  file.set_vertex_property(values);
  CHECK(value_paint(file, "T_surface").scale->title == "T_surface");
}

TEST_CASE("value_paint: a scale says whether values lie beyond it, and may be given") {
  MeshFile file = ball();
  file.set_vertex_property(ramp(file, 1));
  const double last = static_cast<double>(file.mesh.vertex_count() - 1);
  const HeatScale own = *value_paint(file, "ramp").scale;
  CHECK(own.below);
  CHECK(own.above);
  const ValuePaint all = value_paint(file, "ramp", std::pair(0.0, last));
  CHECK_FALSE(all.scale->below);
  CHECK_FALSE(all.scale->above);
  CHECK(all.scale->low == 0);
  CHECK(all.scale->high == last);
  CHECK(all.paint.colours.back() == heat_colour(*all.scale, last));
  const HeatScale part = *value_paint(file, "ramp", std::pair(-5.0, 5.0)).scale;
  CHECK(part.diverges());
  CHECK_FALSE(part.below);
  CHECK(part.above);
  MeshFile flat = ball();
  flat.set_vertex_property(ramp(flat, 0, 3));
  CHECK_FALSE(value_paint(flat, "ramp").scale->above);
}

TEST_CASE("value_paint: whole numbers without a table are labels, unmixed on a scale of all") {
  MeshFile file = ball();
  Property part{"part", ScalarType::Int32, std::vector<double>(162, 3)};
  part.values[0] = -2;
  part.values[1] = 90;
  file.set_vertex_property(part);
  const ValuePaint paint = value_paint(file, "part");
  CHECK_FALSE(paint.paint.blends);
  REQUIRE(paint.scale);
  CHECK(paint.scale->low == -2);
  CHECK(paint.scale->high == 90);
  CHECK(paint.paint.colours[1] == heat_colour(*paint.scale, 90));
  CHECK(paint.paint.colours[1] != paint.paint.colours[2]);
  CHECK_FALSE(value_paint(file, "part", std::pair(0.0, 5.0)).paint.blends);
}

TEST_CASE("value_paint: what faces have is seen as what vertices have, a colour a face") {
  MeshFile file = ball();
  Property heat{"heat", ScalarType::Float64, {}}, part{"part", ScalarType::Int16, {}};
  for (Face f = 0; f < file.mesh.face_count(); ++f) {
    heat.values.push_back(f);
    part.values.push_back(f % 3);
  }
  file.set_face_property(heat);
  file.set_face_property(part);
  const FaceValuePaint measured = face_value_paint(file, "heat", std::pair(0.0, 319.0));
  CHECK(measured.paint.colours.size() == 320);
  CHECK(measured.paint.colours[7] == heat_colour(*measured.scale, 7));
  CHECK(face_value_paint(file, "heat").scale->low == 6);  // without its tail
  const FaceValuePaint labels = face_value_paint(file, "part");
  CHECK(labels.scale->low == 0);
  CHECK(labels.scale->high == 2);
  file.comments = {"gifti label 1 0 1 0 1 green"};
  const FaceValuePaint named = face_value_paint(file, "part");
  CHECK_FALSE(named.scale);
  CHECK(named.paint.colours[1] == Rgb(0, 1, 0));
}

TEST_CASE("value_paint: numbers that are missing are grey and move no scale") {
  MeshFile file = ball();
  Property values = ramp(file, 1);
  const double high = [&] {
    file.set_vertex_property(values);
    return value_paint(file, "ramp").scale->high;
  }();
  values.values[3] = std::numeric_limits<double>::quiet_NaN();
  values.values[4] = std::numeric_limits<double>::infinity();
  file.set_vertex_property(values);
  const ValuePaint paint = value_paint(file, "ramp");
  CHECK(paint.scale->high == Approx(high).margin(2));
  CHECK(paint.paint.colours[3] == paint.paint.colours[4]);
  const Rgb grey = paint.paint.colours[3];
  CHECK(grey.maxCoeff() - grey.minCoeff() < 0.05F);
  for (double& value : values.values) value = values.values[3];
  file.set_vertex_property(values);
  CHECK(value_paint(file, "ramp").paint.colours[0] == grey);
}

TEST_CASE("value_paint: labels have the colours of their table, unmixed and without a scale") {
  MeshFile file = ball();
  attach_data(file, two_labels(file));
  const ValuePaint paint = value_paint(file, "parts");
  CHECK_FALSE(paint.scale);
  CHECK_FALSE(paint.paint.blends);
  CHECK(paint.paint.colours[1] == Rgb(1, 0, 0));
  CHECK(paint.paint.colours[6] == Rgb(0, 0, 1));
  CHECK(paint.paint.colours[0] == paint.paint.colours[3]);  // see-through, and of no label: grey
}

TEST_CASE("value_paint: a surface's own table names whole numbers, and nothing else") {
  MeshFile file = ball();
  file.comments = {"gifti label 1 0 1 0 1 green"};
  Property lobe{"lobe", ScalarType::Int32, std::vector<double>(162, 1)};
  file.set_vertex_property(lobe);
  CHECK(value_paint(file, "lobe").paint.colours[0] == Rgb(0, 1, 0));
  lobe.type = ScalarType::Float32;
  file.set_vertex_property(lobe);
  CHECK(value_paint(file, "lobe").scale);
}
