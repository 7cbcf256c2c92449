#include "io/attributes/remarks.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

#include "io/attributes/corner_colours.h"
#include "io/attributes/texture_pages.h"
#include "io/attributes/whole_vector.h"
#include "sphparam/io/fillers.h"
#include "sphparam/io/losses.h"

namespace sphparam {
namespace {

bool says_of_file(std::string_view comment) {
  static constexpr std::array<std::string_view, 7> heads = {
      "sphparam ", "up axis ",        "front axis ",       "source_vertices ",
      "data ",     "base colour of ", texture_page_comment};
  const auto begins = [&](std::string_view head) { return comment.starts_with(head); };
  const bool of_material =
      comment.starts_with("material ") && comment.find(": unfiltered texels of ") != comment.npos;
  return of_material || std::ranges::any_of(heads, begins);
}

bool has_a_place(const std::string& name, const std::vector<Property>& properties) {
  static constexpr std::array<std::string_view, 10> names = {
      "sx",          "sy",        "sz",           "theta", "phi", "material", "source_vertex",
      "source_face", "texnumber", filler_property};
  return std::ranges::count(names, name) > 0 || is_corner_colour(name) ||
         is_of_whole_vector(name, properties);
}

void add_names(std::vector<std::string>& words, const std::vector<Property>& properties,
               const std::string& whose) {
  std::vector<std::string> names;
  for (const Property& property : properties)
    if (!has_a_place(property.name, properties)) names.push_back(property.name);
  if (!names.empty()) words.push_back(enumerated(names) + " of " + whose);
}

/// In small letters, without what stands between them.
std::vector<std::string> small_words_of(std::string_view text) {
  std::vector<std::string> words(1);
  for (const char c : text) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool is_digit = c >= '0' && c <= '9';
    if (is_letter || is_digit) {
      words.back() += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

}  // namespace

bool is_tally(std::string_view comment) {
  static constexpr std::array<std::string_view, 25> known = {
      "vertex", "vertices", "verts",  "face",  "faces",     "triangles", "quads",
      "edges",  "points",   "point",  "lines", "line",      "polygons",  "normals",
      "normal", "texture",  "coords", "coord", "materials", "groups",    "uvs",
      "list",   "end",      "of",     "file"};
  const auto is_number = [](const std::string& word) {
    return word.find_first_not_of("0123456789") == word.npos;
  };
  const std::vector<std::string> words = small_words_of(comment);
  const auto numbers = std::ranges::count_if(words, is_number);
  const auto others = std::ranges::count_if(
      words, [&](const std::string& word) { return std::ranges::count(known, word) > 0; });
  return numbers + others == std::ssize(words) && (words.empty() || others > 0);
}

std::vector<std::string> remarks_of(const MeshFile& file) {
  std::vector<std::string> remarks;
  std::ranges::remove_copy_if(file.comments, std::back_inserter(remarks), says_of_file);
  return remarks;
}

std::vector<std::string> numbers_not_shown(const MeshFile& file) {
  std::vector<std::string> words;
  add_names(words, file.vertex_properties, "vertices");
  add_names(words, file.face_properties, "faces");
  return words;
}

}  // namespace sphparam
