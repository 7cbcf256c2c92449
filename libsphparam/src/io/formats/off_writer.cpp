#include "io/formats/off_writer.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "io/attributes/appearance.h"
#include "io/files/text_buffer.h"

// One line a vertex, one a face. Comments come last: readers of few lines, as the MATLAB ones that
// everybody copies, take the second line for the counts.

namespace sphparam {
namespace {

constexpr int corner_count = 3;

std::vector<const Property*> find_colours(const std::vector<Property>& properties) {
  std::vector<const Property*> colours =
      find_all(properties, std::array{"red", "green", "blue", "alpha"});
  return colours.empty() ? find_all(properties, std::array{"red", "green", "blue"}) : colours;
}

/// Colours as OFF has them, all of them bytes or all fractions: which they are is told by a point
/// in one of them.
class WrittenColours {
 public:
  explicit WrittenColours(const std::vector<Property>& properties)
      : channels_(find_colours(properties)),
        are_bytes_(std::ranges::all_of(channels_, [](const Property* channel) {
          return brightest(channel->type) == brightest(ScalarType::Uint8) &&
                 std::ranges::all_of(channel->values, [](double value) {
                   return holds_exactly(ScalarType::Uint8, value);
                 });
        })) {}

  bool empty() const { return channels_.empty(); }

  void put(TextBuffer& text, Eigen::Index row) const {
    for (const Property* channel : channels_) {
      const double value = channel->values[row];
      text << ' ';
      if (are_bytes_)
        text << static_cast<int>(value);
      else
        put_fraction(text, static_cast<float>(value / brightest(channel->type)));
    }
  }

 private:
  static void put_fraction(TextBuffer& text, float value) {
    char digits[32];
    const auto [stop, error] = std::to_chars(digits, digits + sizeof digits, value);
    const std::string_view number(digits, static_cast<std::size_t>(stop - digits));
    text << number;
    if (number.find_first_of(".e") == std::string_view::npos) text << ".0";
  }

  std::vector<const Property*> channels_;
  bool are_bytes_;
};

}  // namespace

std::string serialise_off(const MeshFile& file) {
  const auto normals = find_all(file.vertex_properties, std::array{"nx", "ny", "nz"});
  const auto texcoords = find_all(file.vertex_properties, std::array{"s", "t"});
  const WrittenColours colours(file.vertex_properties), face_colours(file.face_properties);

  TextBuffer text(expected_text_bytes(file));
  text << (texcoords.empty() ? "" : "ST") << (colours.empty() ? "" : "C")
       << (normals.empty() ? "" : "N") << "OFF\n";
  text << file.mesh.vertex_count() << ' ' << file.mesh.face_count() << " 0\n";
  for (Eigen::Index v = 0; v < file.mesh.vertex_count(); ++v) {
    for (int axis = 0; axis < 3; ++axis) text << (axis ? " " : "") << file.mesh.positions(v, axis);
    for (const Property* normal : normals) text << ' ' << normal->values[v];
    colours.put(text, v);
    for (const Property* texcoord : texcoords) text << ' ' << texcoord->values[v];
    text << '\n';
  }
  for (Eigen::Index f = 0; f < file.mesh.face_count(); ++f) {
    text << '3';
    for (int k = 0; k < corner_count; ++k) text << ' ' << file.mesh.triangles(f, k);
    face_colours.put(text, f);
    text << '\n';
  }
  put_comments(text, file);
  return text.take();
}

}  // namespace sphparam
