#include "io/attributes/texture_pages.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <system_error>
#include <vector>

#include "io/attributes/appearance.h"
#include "io/attributes/named_file.h"
#include "sphparam/io/losses.h"

namespace sphparam {
namespace {

namespace fs = std::filesystem;

bool names_page(std::string_view comment) { return comment.starts_with(texture_page_comment); }

bool is_ours(const MeshFile& file) {
  return !file.materials.empty() ||
         std::ranges::any_of(file.comments, [](const std::string& comment) {
           return comment.starts_with("sphparam ");
         });
}

void take_coordinates_of_vertices(MeshFile& file) {
  if (has_texcoords(file)) return;
  const auto find = [&](std::string_view name) {
    return std::ranges::find(file.vertex_properties, name, &Property::name);
  };
  const auto u = find("texture_u"), v = find("texture_v"), end = file.vertex_properties.end();
  if (u == end || v == end || find("s") != end || find("t") != end) return;
  u->name = "s";
  v->name = "t";
}

/// −1 where a number is that of no image.
std::vector<double> page_of_faces(const MeshFile& file, std::size_t pages) {
  const Property* const numbers = file.find_face_property("texnumber");
  if (!numbers) return std::vector<double>(static_cast<std::size_t>(file.mesh.face_count()), 0);
  std::vector<double> values = numbers->values;
  for (double& number : values) {
    const bool is_page = number >= 0 && number < static_cast<double>(pages);
    number = is_page && number == std::floor(number) ? number : -1;
  }
  return values;
}

MaterialTexture texture_of(const NamedFile& image, const fs::path& folder) {
  MaterialTexture texture;
  texture.image = texture.path = image.path.string();
  texture.folder = folder.string();
  texture.problem = image.problem;
  return texture;
}

/// The images of the materials that a file of ours names; none where they cannot be told.
std::vector<NamedFile> images_of_materials(const MeshFile& file,
                                           const std::vector<std::string>& pages,
                                           const std::vector<NamedFile>& images) {
  std::vector<NamedFile> result;
  for (const std::string& material : file.materials) {
    const auto page = std::ranges::find(pages, material);
    if (page == pages.end() && pages.size() > 1) return {};
    result.push_back(images[page == pages.end() ? 0 : static_cast<size_t>(page - pages.begin())]);
  }
  return result;
}

bool is_there(const NamedFile& image, const fs::path& folder) {
  std::error_code hidden;
  return fs::exists(folder / image.path, hidden);
}

/// What a page says of light: that it is the colour of what is rough and no metal.
MaterialChannels plain_channels() { return {.metallic = {.factor = {0, 1, 1, 1}}}; }

void set_materials(MeshFile& file, const std::vector<NamedFile>& images, const fs::path& folder) {
  for (const NamedFile& image : images) file.base_colours.push_back(texture_of(image, folder));
  file.channels.assign(images.size(), plain_channels());
}

}  // namespace

bool has_texture_pages(const MeshFile& file) {
  return std::ranges::any_of(file.comments, names_page);
}

std::vector<std::string> texture_pages(const MeshFile& file) {
  constexpr std::string_view head = texture_page_comment, blanks = " \t\r";
  std::vector<std::string> pages;
  for (const std::string& comment : file.comments) {
    if (!names_page(comment)) continue;
    std::string_view name = std::string_view(comment).substr(head.size());
    name.remove_prefix(std::min(name.find_first_not_of(blanks), name.size()));
    name = name.substr(0, name.find_last_not_of(blanks) + 1);
    if (!name.empty()) pages.emplace_back(name);
  }
  return pages;
}

bool has_textures(const MeshFile& file) {
  return has_texture_pages(file) ||
         std::ranges::any_of(file.base_colours,
                             [](const MaterialTexture& texture) { return !texture.image.empty(); });
}

void remove_textures(MeshFile& file) {
  std::erase_if(file.comments, names_page);
  file.base_colours.clear();
  file.channels.clear();
}

void take_texture_pages(MeshFile& file, const std::optional<fs::path>& folder) {
  const std::vector<std::string> pages = texture_pages(file);
  if (pages.empty() || !folder || file.mesh.face_count() == 0) return;
  take_coordinates_of_vertices(file);
  if (!has_texcoords(file)) {
    if (!is_ours(file))
      add_loss(file.notes,
               "the texture " + enumerated(pages) + ": there are no coordinates for it");
    return;
  }
  std::vector<NamedFile> images;
  std::vector<std::string> taken;
  for (const std::string& page : pages) {
    images.push_back(file_below(*folder, {}, page));
    if (!images.back().taken.empty()) taken.push_back(images.back().taken);
  }
  const bool all_there =
      std::ranges::all_of(images, [&](const NamedFile& image) { return is_there(image, *folder); });
  if (is_ours(file) && !all_there) return;
  if (file.materials.empty()) {
    file.set_face_property({"material", ScalarType::Int32, page_of_faces(file, pages.size())});
    file.materials = pages;
    set_materials(file, images, *folder);
  } else {
    set_materials(file, images_of_materials(file, pages, images), *folder);
  }
  note_taken_names(file, taken);
}

}  // namespace sphparam
