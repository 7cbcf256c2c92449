#include "io/attributes/remarks.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

#include "io/attributes/corner_colours.h"
#include "io/attributes/texture_pages.h"
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

bool has_a_place(const std::string& name) {
  static constexpr std::array<std::string_view, 19> names = {
      "sx",          "sy",        "sz",           "theta",
      "phi",         "nx",        "ny",           "nz",
      "s",           "t",         "red",          "green",
      "blue",        "alpha",     "material",     "source_vertex",
      "source_face", "texnumber", filler_property};
  return std::ranges::count(names, name) > 0 || is_corner_colour(name);
}

void add_names(std::vector<std::string>& words, const std::vector<Property>& properties,
               const std::string& whose) {
  std::vector<std::string> names;
  for (const Property& property : properties)
    if (!has_a_place(property.name)) names.push_back(property.name);
  if (!names.empty()) words.push_back(enumerated(names) + " of " + whose);
}

}  // namespace

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
