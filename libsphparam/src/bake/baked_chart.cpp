#include "bake/baked_chart.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "texture/baked_texts.h"

namespace sphparam {
namespace {

constexpr std::string_view interpolation = "sphparam:interpolation",
                           wedges = "sphparam:refine_poles", between_maps = "; ";

/// FNV-1a of the coordinates as float32, −0 as 0, little-endian: what differs less is one map,
/// written and read.
std::uint64_t hash_of(const Points& rays) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (Eigen::Index i = 0; i < rays.size(); ++i) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(rays.data()[i]) + 0.0F);
    for (int shift = 0; shift < 32; shift += 8)
      hash = (hash ^ (bits >> shift & 0xff)) * 0x100000001b3;
  }
  return hash;
}

std::string head_of_rays(const MappedMesh& mapped) {
  return std::to_string(mapped.map().points.rows()) + " rays, ";
}

std::string words_of_rays(const MappedMesh& mapped) {
  char digits[16];
  const auto end =
      std::to_chars(digits, digits + sizeof digits, hash_of(mapped.map().points), 16).ptr;
  return head_of_rays(mapped) + std::string(digits, end);
}

/// Whether of these maps one has as many rays, and none is this one.
bool says_another(std::string_view said, const MappedMesh& mapped) {
  const std::string head = head_of_rays(mapped);
  bool another = false;
  std::string own;
  while (!said.empty()) {
    const std::size_t end = std::min(said.find(between_maps), said.size());
    const std::string_view one = said.substr(0, end);
    said.remove_prefix(std::min(end + between_maps.size(), said.size()));
    if (!one.starts_with(head)) continue;
    if (own.empty()) own = words_of_rays(mapped);
    if (one == own) return false;
    another = true;
  }
  return another;
}

}  // namespace

ImageTexts texts_of_chart(bool linear_in_uv, int pole_wedges) {
  return {{std::string(interpolation), linear_in_uv ? "uv" : "sphere"},
          {std::string(wedges), std::to_string(pole_wedges)}};
}

ImageTexts texts_of_map(const MappedMesh& mapped, const MappedMesh* source) {
  std::string said = words_of_rays(mapped);
  if (source) said.append(between_maps).append(words_of_rays(*source));
  return {{std::string(rays_text), std::move(said)}};
}

std::string warning_of_other_map(const std::string& name, const ImageTexts& texts,
                                 const MappedMesh& mapped) {
  if (!says_another(baked_text(texts, rays_text), mapped)) return "";
  return name + " is baked on another map of this mesh than " + mapped.name() +
         " has, and stands elsewhere on it: `sphparam bake` with the map of " + mapped.name() +
         " makes the image anew, the mesh with the map that it was baked on shows it as it is";
}

std::optional<int> pole_wedges_of(const ImageTexts& texts) {
  if (baked_text(texts, interpolation) != "uv") return std::nullopt;
  const std::string_view text = baked_text(texts, wedges);
  int number = 1;  // what was baked before this was told
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

}  // namespace sphparam
