#pragma once

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

// Whether the ICC profile of an image is that of sRGB, by what it says of colours, not by its name.
// Layout: ICC.1:2010, 7.2, 7.3, 10.5, 10.15, 10.27.

namespace sphparam {

class IccProfile {
 public:
  explicit IccProfile(std::string_view bytes) : bytes_(bytes) {}

  /// Primaries and a curve within what roundings of writers leave.
  bool is_srgb() const {
    constexpr std::array<double, 3> primaries[] = {
        {0.4360, 0.2225, 0.0139}, {0.3851, 0.7169, 0.0971}, {0.1431, 0.0606, 0.7139}};
    constexpr std::string_view names[] = {"rXYZ", "gXYZ", "bXYZ"};
    for (size_t i = 0; i < 3; ++i)
      if (!is_near(xyz(names[i]), primaries[i])) return false;
    return has_curve("rTRC") && has_curve("gTRC") && has_curve("bTRC");
  }
  /// Of a profile of greys.
  bool is_srgb_grey() const { return has_curve("kTRC"); }

 private:
  double number(size_t at, size_t size) const {
    double value = 0;
    for (size_t i = 0; i < size; ++i)
      value =
          256 * value + (at + i < bytes_.size() ? static_cast<unsigned char>(bytes_[at + i]) : 0);
    return value;
  }

  double fixed(size_t at) const {  // s15Fixed16
    const double value = number(at, 4);
    return (value < 2147483648.0 ? value : value - 4294967296.0) / 65536;
  }

  std::optional<size_t> tag(std::string_view name) const {
    constexpr size_t table = 128, entry = 12, most = 1000;
    const size_t count = std::min(most, static_cast<size_t>(number(table, 4)));
    for (size_t at = table + 4; at < table + 4 + entry * count && at < bytes_.size(); at += entry)
      if (bytes_.substr(at, 4) == name) return static_cast<size_t>(number(at + 4, 4));
    return std::nullopt;
  }

  std::optional<std::array<double, 3>> xyz(std::string_view name) const {
    const std::optional<size_t> at = tag(name);
    if (!at) return std::nullopt;
    return std::array{fixed(*at + 8), fixed(*at + 12), fixed(*at + 16)};
  }

  static bool is_near(const std::optional<std::array<double, 3>>& found,
                      const std::array<double, 3>& meant) {
    constexpr double rounding = 0.004;
    return found && std::ranges::equal(*found, meant, [](double a, double b) {
             return std::abs(a - b) < rounding;
           });
  }

  static bool is_near(double found, double meant, double rounding) {
    return std::abs(found - meant) < rounding;
  }

  /// sRGB's curve, or its power of 2.2.
  bool has_curve(std::string_view name) const {
    const std::optional<size_t> at = tag(name);
    if (!at) return false;
    if (bytes_.substr(std::min(*at, bytes_.size()), 4) == "para")
      return is_srgb_curve(static_cast<int>(number(*at + 8, 2)), *at + 12);
    const auto count = static_cast<size_t>(number(*at + 8, 4));
    if (count < 2) return count == 1 && is_power(number(*at + 12, 2) / 256);
    const double below = number(*at + 12 + 2 * ((count - 1) / 2), 2),
                 above = number(*at + 12 + 2 * (count / 2), 2);
    return is_near((below + above) / 2 / 65535, 0.2152, 0.006);  // of a half; the power has 0.2176
  }

  static bool is_power(double g) { return is_near(g, 2.2, 0.04); }

  /// Y = (a X + b)^g and more, of the types 1 to 4; X^g of type 0.
  bool is_srgb_curve(int type, size_t at) const {
    const double g = fixed(at), a = fixed(at + 4), b = fixed(at + 8);
    if (type == 0) return is_power(g);
    const bool plain = is_near(a, 1, 0.002) && is_near(b, 0, 0.002);
    const bool scaled = is_near(a, 1 / 1.055, 0.002) && is_near(b, 0.055 / 1.055, 0.002);
    return (plain && is_power(g)) || (scaled && is_near(g, 2.4, 0.02));
  }

  std::string_view bytes_;
};

/// The name of the profile that an image's colours are in; empty: none, or that of sRGB.
inline std::string other_profile(const OIIO::ImageSpec& spec) {
  const OIIO::ParamValue* const found = spec.find_attribute("ICCProfile");
  if (!found || found->type().basetype != OIIO::TypeDesc::UINT8) return "";
  const IccProfile profile(
      {static_cast<const char*>(found->data()), static_cast<size_t>(found->datasize())});
  if (profile.is_srgb() || profile.is_srgb_grey()) return "";
  const std::string name(spec.get_string_attribute("ICCProfile:profile_description"));
  return name.empty() ? "without a name" : name;
}

}  // namespace sphparam
