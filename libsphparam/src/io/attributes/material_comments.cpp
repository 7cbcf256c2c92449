#include "io/attributes/material_comments.h"

#include <algorithm>
#include <charconv>

#include "io/attributes/appearance.h"
#include "io/attributes/texture_pages.h"
#include "number_text.h"

namespace sphparam {
namespace {

constexpr std::string_view diffuse_mark = ", Kd ";

std::string texture_head(const std::string& material) {
  return "base colour of " + material + ": texture ";
}

std::string nearest_head(std::size_t material) {
  return "material " + std::to_string(material) + ": unfiltered texels of ";
}

/// The comment that begins so; empty where there is none.
std::string_view comment_of(const MeshFile& file, const std::string& head) {
  const auto found = std::ranges::find_if(
      file.comments, [&](const std::string& comment) { return comment.starts_with(head); });
  return found == file.comments.end() ? std::string_view() : std::string_view(*found);
}

}  // namespace

void note_texture(MeshFile& file, const std::string& material, const std::string& image,
                  const std::array<double, 3>& diffuse) {
  const auto& [red, green, blue] = diffuse;
  std::string comment = texture_head(material) + image;
  if (diffuse != std::array<double, 3>{1, 1, 1})
    comment +=
        std::string(diffuse_mark) + joined({shortest(red), shortest(green), shortest(blue)}, " ");
  file.comments.push_back(std::move(comment));
}

std::optional<std::array<double, 3>> diffuse_beside_texture(const MeshFile& file,
                                                            const std::string& material) {
  const std::string_view comment = comment_of(file, texture_head(material));
  const std::size_t mark = comment.rfind(diffuse_mark);
  if (mark == std::string_view::npos) return std::nullopt;
  std::array<double, 3> diffuse{};
  const char* at = comment.data() + mark + diffuse_mark.size();
  const char* const end = comment.data() + comment.size();
  for (double& channel : diffuse) {
    const auto [stop, error] = std::from_chars(at, end, channel);
    if (error != std::errc{}) return std::nullopt;
    at = stop < end ? stop + 1 : stop;
  }
  return diffuse;
}

std::string left_behind_texture(const MeshFile& file) {
  if (!file.base_colours.empty() || !has_texcoords(file)) return "";
  const auto names_image = [](std::string_view comment) {
    return comment.starts_with("base colour of ") || comment.starts_with(texture_page_comment);
  };
  const auto found = std::ranges::find_if(file.comments, names_image);
  return found == file.comments.end() ? "" : *found;
}

void note_nearest(MeshFile& file, std::size_t material, const std::vector<std::string>& textures) {
  if (!textures.empty()) file.comments.push_back(nearest_head(material) + joined(textures, ", "));
}

bool is_noted_nearest(const MeshFile& file, std::size_t material, std::string_view texture) {
  return comment_of(file, nearest_head(material)).find(texture) != std::string_view::npos;
}

}  // namespace sphparam
