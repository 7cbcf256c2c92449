#include "io/formats/off_writer.h"

#include <array>
#include <charconv>
#include <cmath>

#include "io/files/text_buffer.h"

// One line a vertex, one a face.

namespace sphparam {
namespace {

constexpr int corner_count = 3;

std::vector<const Property*> find_colours(const std::vector<Property>& properties) {
  std::vector<const Property*> colours =
      find_all(properties, std::array{"red", "green", "blue", "alpha"});
  return colours.empty() ? find_all(properties, std::array{"red", "green", "blue"}) : colours;
}

/// Bytes stay whole numbers; fractions get a point, which is what tells them apart in OFF.
void put_off_colour(TextBuffer& text, const Property& colour, Eigen::Index row) {
  const double value = colour.values[row];
  if (colour.type == ScalarType::Uint8 && value == std::rint(value)) {
    text << ' ' << static_cast<int>(value);
    return;
  }
  char digits[32];
  const auto [stop, error] =
      std::to_chars(digits, digits + sizeof digits, static_cast<float>(value));
  const std::string_view number(digits, static_cast<std::size_t>(stop - digits));
  text << ' ' << number;
  if (number.find_first_of(".e") == std::string_view::npos) text << ".0";
}

}  // namespace

std::string serialise_off(const MeshFile& file) {
  const auto normals = find_all(file.vertex_properties, std::array{"nx", "ny", "nz"});
  const auto texcoords = find_all(file.vertex_properties, std::array{"s", "t"});
  const auto colours = find_colours(file.vertex_properties);
  const auto face_colours = find_colours(file.face_properties);

  TextBuffer text(expected_text_bytes(file));
  text << (texcoords.empty() ? "" : "ST") << (colours.empty() ? "" : "C")
       << (normals.empty() ? "" : "N") << "OFF\n";
  put_comments(text, file);
  text << file.mesh.vertex_count() << ' ' << file.mesh.face_count() << " 0\n";
  for (Eigen::Index v = 0; v < file.mesh.vertex_count(); ++v) {
    for (int axis = 0; axis < 3; ++axis) text << (axis ? " " : "") << file.mesh.positions(v, axis);
    for (const Property* normal : normals) text << ' ' << normal->values[v];
    for (const Property* colour : colours) put_off_colour(text, *colour, v);
    for (const Property* texcoord : texcoords) text << ' ' << texcoord->values[v];
    text << '\n';
  }
  for (Eigen::Index f = 0; f < file.mesh.face_count(); ++f) {
    text << '3';
    for (int k = 0; k < corner_count; ++k) text << ' ' << file.mesh.triangles(f, k);
    for (const Property* colour : face_colours) put_off_colour(text, *colour, f);
    text << '\n';
  }
  return text.take();
}

}  // namespace sphparam
