#include "bake/baked_chart.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <optional>
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

/// Sums of the coordinates with signs by chance: of two maps they differ, root mean square and
/// divided by that of their number, by about as much as rays do (Johnson and Lindenstrauss 1984).
using SignedSums = std::array<double, 8>;

/// Source: splitmix64 (Steele, Lea and Flood 2014).
std::uint64_t scrambled(std::uint64_t number) {
  number += 0x9e3779b97f4a7c15;
  number = (number ^ (number >> 30)) * 0xbf58476d1ce4e5b9;
  number = (number ^ (number >> 27)) * 0x94d049bb133111eb;
  return number ^ (number >> 31);
}

SignedSums signed_sums(const Points& rays) {
  SignedSums sums{};
  for (Eigen::Index i = 0; i < rays.size(); ++i) {
    const std::uint64_t signs = scrambled(static_cast<std::uint64_t>(i));
    for (std::size_t k = 0; k < sums.size(); ++k)
      sums[k] += (signs >> k & 1) ? rays.data()[i] : -rays.data()[i];
  }
  return sums;
}

/// Sums as they are told: " 1.5 -0.25 …"; nothing where they are not.
std::optional<SignedSums> told_sums(std::string_view text) {
  SignedSums sums;
  for (double& sum : sums) {
    if (!text.starts_with(' ')) return std::nullopt;
    const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), sum);
    if (error != std::errc{}) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  return text.empty() ? std::optional(sums) : std::nullopt;
}

/// Whether rays are where these sums say, up to rounding in files, which no texel shows.
bool is_near(const SignedSums& told, const Points& rays) {
  constexpr double rounding = 1e-5;  // radians, root mean square
  const SignedSums own = signed_sums(rays);
  double squares = 0;
  for (std::size_t k = 0; k < own.size(); ++k) squares += (own[k] - told[k]) * (own[k] - told[k]);
  return squares <= rounding * rounding * static_cast<double>(own.size() * rays.rows());
}

std::string head_of_rays(const MappedMesh& mapped) {
  return std::to_string(mapped.map().points.rows()) + " rays, ";
}

std::string six_decimals(double number) {
  char digits[40];  // of less than 10²⁰
  return {digits,
          std::to_chars(digits, digits + sizeof digits, number, std::chars_format::fixed, 6).ptr};
}

std::string hash_words(const Points& rays) {
  char digits[16];
  return {digits, std::to_chars(digits, digits + sizeof digits, hash_of(rays), 16).ptr};
}

/// "642 rays, 1f0e…, 1.5 -0.25 …": how many, the hash, and the sums.
std::string words_of_rays(const MappedMesh& mapped) {
  const Points& rays = mapped.map().points;
  std::string words = head_of_rays(mapped) + hash_words(rays) + ",";
  for (const double sum : signed_sums(rays)) words += " " + six_decimals(sum);
  return words;
}

/// `said`: what of a map is told behind its number of rays.
bool is_this(std::string_view said, const Points& rays) {
  const std::size_t comma = std::min(said.find(','), said.size());
  if (said.substr(0, comma) == hash_words(rays)) return true;
  const auto sums = told_sums(said.substr(std::min(comma + 1, said.size())));
  return sums && is_near(*sums, rays);
}

/// Whether of these maps one has as many rays, and none is this one.
bool says_another(std::string_view said, const MappedMesh& mapped) {
  const std::string head = head_of_rays(mapped);
  bool another = false;
  while (!said.empty()) {
    const std::size_t end = std::min(said.find(between_maps), said.size());
    const std::string_view one = said.substr(0, end);
    said.remove_prefix(std::min(end + between_maps.size(), said.size()));
    if (!one.starts_with(head)) continue;
    if (is_this(one.substr(head.size()), mapped.map().points)) return false;
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
