#include "sphparam/bake/body.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "lower_case.h"
#include "number_text.h"

namespace sphparam {
namespace {

/// Programs that print WKT begin with an empty line.
std::string trimmed(const std::string& text) {
  const char* const blanks = " \n\t\r";
  const size_t first = text.find_first_not_of(blanks);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

/// The number that a text begins with, and what follows it.
std::optional<std::pair<double, std::string_view>> leading_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{}) return std::nullopt;
  return std::pair(value, text.substr(static_cast<size_t>(end - text.data())));
}

/// The numbers of "a" or "a,b,c"; nothing for other texts.
std::optional<std::vector<double>> numbers_of(std::string_view text) {
  std::vector<double> numbers;
  for (;;) {
    const auto number = leading_number(text);
    if (!number) return std::nullopt;
    numbers.push_back(number->first);
    if (number->second.empty()) return numbers;
    if (number->second.front() != ',') return std::nullopt;
    text = number->second.substr(1);
  }
}

void require_length(double length, const std::string& text) {
  if (length > 0 && std::isfinite(length)) return;
  throw BodyError(text + ": radii of a body are finite numbers above 0");
}

Body with_radii(const std::vector<double>& radii, const std::string& text, double unit) {
  if (radii.size() != 1 && radii.size() != 3) {
    throw BodyError(text + ": a body has one radius, or three semi-axes with commas between");
  }
  for (const double radius : radii) require_length(radius * unit, text);
  const Vector3 axes(radii.front(), radii[radii.size() / 2], radii.back());
  return {.semi_axes = axes * unit, .unit = unit};
}

// --- WKT

bool is_projected(std::string_view text) {
  return text.starts_with("PROJCRS[") || text.starts_with("PROJCS[") ||
         text.starts_with("PROJECTEDCRS[");
}

bool is_wkt(std::string_view text) {
  return text.starts_with("GEOGCRS[") || text.starts_with("GEODCRS[") ||
         text.starts_with("GEOGCS[");
}

/// Where a keyword begins that is no part of another one, nor of a name in quotes.
size_t find_keyword(std::string_view wkt, std::string_view keyword) {
  bool quoted = false;
  for (size_t i = 0; i < wkt.size(); ++i) {
    if (wkt[i] == '"') quoted = !quoted;
    const bool in_word = i > 0 && wkt[i - 1] >= 'A' && wkt[i - 1] <= 'Z';
    if (!quoted && !in_word && wkt.substr(i).starts_with(keyword)) return i;
  }
  return std::string_view::npos;
}

/// From a keyword to behind its last bracket, names in quotes passed over; nothing where it has no
/// place.
std::string_view element_of(std::string_view wkt, std::string_view keyword) {
  const size_t place = find_keyword(wkt, keyword);
  if (place == std::string_view::npos) return {};
  wkt.remove_prefix(place);
  int depth = 0;
  bool quoted = false;
  for (size_t i = 0; i < wkt.size(); ++i) {
    if (wkt[i] == '"') quoted = !quoted;
    if (quoted) continue;
    if (wkt[i] == '[') ++depth;
    if (wkt[i] == ']' && --depth == 0) return wkt.substr(0, i + 1);
  }
  return wkt;
}

std::string_view behind(std::string_view wkt, std::string_view element) {
  return element.empty()
             ? wkt
             : wkt.substr(static_cast<size_t>(element.data() - wkt.data()) + element.size());
}

/// What follows `keyword["NAME",` at its first place; nothing where there is none.
std::optional<std::string_view> after_name(std::string_view wkt, std::string_view keyword) {
  const size_t place = find_keyword(wkt, keyword);
  if (place == std::string_view::npos) return std::nullopt;
  const size_t open = wkt.find('"', place);
  const size_t close = open == std::string_view::npos ? open : wkt.find('"', open + 1);
  if (close == std::string_view::npos || close + 1 >= wkt.size() || wkt[close + 1] != ',')
    return std::nullopt;
  const size_t value = wkt.find_first_not_of(" \n\t", close + 2);
  return value == std::string_view::npos ? std::nullopt : std::optional(wkt.substr(value));
}

/// Of the first of these keywords that has a place: how many metres, or radians, it has.
/// Nothing: none has. Throws: BodyError for what is no number.
std::optional<double> unit_in(std::string_view wkt,
                              std::initializer_list<std::string_view> keywords) {
  for (const std::string_view keyword : keywords) {
    if (find_keyword(wkt, keyword) == std::string_view::npos) continue;
    const auto factor = after_name(wkt, keyword);
    const auto number = factor ? leading_number(*factor) : std::nullopt;
    if (!number || !(number->first > 0) || !std::isfinite(number->first))
      throw BodyError("the WKT of the body has a unit that is no number above 0: " +
                      std::string(keyword) + "…]");
    return number->first;
  }
  return std::nullopt;
}

/// The whole of it, unit and all.
std::string_view ellipsoid_in(std::string_view wkt) {
  const std::string_view ellipsoid = element_of(wkt, "ELLIPSOID[");
  return ellipsoid.empty() ? element_of(wkt, "SPHEROID[") : ellipsoid;
}

/// Semi-major axis in metres, as it is where no unit is said, and inverse flattening, which is 0
/// for a sphere.
std::optional<std::pair<double, double>> ellipsoid_of(std::string_view wkt) {
  const std::string_view ellipsoid = ellipsoid_in(wkt);
  std::optional<std::string_view> text = after_name(ellipsoid, "ELLIPSOID[");
  if (!text) text = after_name(ellipsoid, "SPHEROID[");
  const auto axis = text ? leading_number(*text) : std::nullopt;
  if (!axis || !axis->second.starts_with(',')) return std::nullopt;
  std::string_view rest = axis->second.substr(1);
  rest.remove_prefix(std::min(rest.find_first_not_of(" \n\t"), rest.size()));
  const auto flattening = leading_number(rest);
  if (!flattening) return std::nullopt;
  const double metres = unit_in(ellipsoid, {"LENGTHUNIT[", "UNIT["}).value_or(1);
  return std::pair(axis->first * metres, flattening->first);
}

/// Files beside images count longitude and latitude in degrees. A prime meridian may have a unit of
/// its own, and so have heights, behind the angles.
void require_degrees(const std::string& wkt, const std::string& name) {
  constexpr double degree = std::numbers::pi / 180, rounding = 1e-3;  // files say 0.01745 as well
  std::string_view angles = behind(wkt, ellipsoid_in(wkt));
  angles = behind(angles, element_of(angles, "PRIMEM["));
  const auto unit = unit_in(angles, {"ANGLEUNIT[", "UNIT["});
  if (!unit || std::abs(*unit - degree) <= rounding * degree) return;
  throw BodyError("the WKT " + name +
                  " counts longitude and latitude in another unit than degrees, which images have: "
                  "ANGLEUNIT[\"degree\",0.0174532925199433] is needed in it");
}

bool brackets_match(std::string_view wkt) {
  return !wkt.empty() && wkt.back() == ']' &&
         std::ranges::count(wkt, '[') == std::ranges::count(wkt, ']') &&
         std::ranges::count(wkt, '"') % 2 == 0;
}

/// The body that the WKT's first code of the IAU is about, whose systems have codes from its own
/// on.
const IauBody* iau_body_of(std::string_view wkt) {
  constexpr long systems = 100;
  constexpr double beyond_codes = 1e12;
  const size_t place = wkt.find("ID[\"IAU\",");
  const size_t older = wkt.find("AUTHORITY[\"IAU");  // AUTHORITY["IAU","49901"], ["IAU_2015","…"]
  if (place == std::string_view::npos && older == std::string_view::npos) return nullptr;
  std::string_view code = wkt.substr(std::min(place, older));
  code.remove_prefix(std::min(code.find(','), code.size()));
  code.remove_prefix(std::min(code.find_first_of("0123456789"), code.size()));
  const auto number = leading_number(code);
  if (!number || !(number->first < beyond_codes)) return nullptr;
  const long base = static_cast<long>(number->first) / systems * systems;
  const auto found = std::ranges::find(iau_bodies(), base, &IauBody::code);
  return found == iau_bodies().end() ? nullptr : &*found;
}

/// What to type instead of a system whose latitudes a map has not.
std::string advice_for(std::string_view wkt) {
  const IauBody* const body = iau_body_of(wkt);
  if (!body) return "a geographic one on a sphere is needed, or a radius";
  return "a geographic one on a sphere is needed, as IAU_2015:" + std::to_string(body->code) +
         ", which is what the name " + in_lower_case(body->name) + " stands for";
}

/// Rows of maps are planetocentric; GEODCRS with spherical coordinates is so on ellipsoids too.
void require_planetocentric(const Body& body) {
  if (body.wkt.find("CS[Cartesian") != std::string::npos)
    throw BodyError("the WKT " + body.name +
                    " is of a geocentric system, in x, y and z, which has no latitudes: " +
                    advice_for(body.wkt));
  const Vector3 axes = body.semi_axes / body.unit;
  if (axes.x() == axes.z() || body.wkt.find("CS[spherical") != std::string::npos) return;
  throw BodyError("the WKT " + body.name +
                  " has planetographic latitudes, of its flattened ellipsoid, and those of maps "
                  "are planetocentric: " +
                  advice_for(body.wkt) + "; for heights above the ellipsoid, its semi-axes: " +
                  shortest(axes.x()) + "," + shortest(axes.y()) + "," + shortest(axes.z()));
}

Body of_wkt(const std::string& text, double unit) {
  const auto ellipsoid = ellipsoid_of(text);
  const size_t open = text.find('"'), close = text.find('"', open + 1);
  if (!ellipsoid || !brackets_match(text) || close == std::string::npos) {
    throw BodyError("the WKT of the body is not complete: it needs a name and an ellipsoid");
  }
  const auto [major, inverse] = *ellipsoid;
  require_length(major, "the WKT's ellipsoid");
  const double minor = inverse == 0 ? major : major * (1 - 1 / inverse);
  require_length(minor, "the WKT's ellipsoid");
  const std::string axes = in_lower_case(text);
  Body body = {.name = text.substr(open + 1, close - open - 1),
               .semi_axes = Vector3(major, major, minor),
               .wkt = text,
               .unit = unit,
               .positive_west = axes.find(",west") != std::string::npos};
  require_planetocentric(body);
  require_degrees(text, body.name);
  return body;
}

/// Comets, dwarf planets and asteroids, whose codes are above those of planets and moons.
std::string small_bodies() {
  constexpr long first = 100000000;
  std::vector<std::string> names;
  for (const IauBody& body : iau_bodies())
    if (body.code >= first) names.push_back(in_lower_case(body.name));
  return joined(names);
}

}  // namespace

Body body_of(const std::string& spaced_text, double unit) {
  require_length(unit, "the unit of the mesh");
  const std::string text = trimmed(spaced_text);
  if (is_wkt(text)) return of_wkt(text, unit);
  if (is_projected(text))
    throw BodyError("the WKT is of a projected system, in metres: " + advice_for(text));
  if (const auto radii = numbers_of(text)) return with_radii(*radii, text, unit);
  std::vector<std::string> known;
  for (const IauBody& body : iau_bodies()) {
    if (in_lower_case(body.name) == in_lower_case(text)) {
      return {.name = body.name,
              .semi_axes = Vector3::Constant(body.radius),
              .iau_code = body.code,
              .unit = unit};
    }
    known.push_back(in_lower_case(body.name));
  }
  throw BodyError("there is no body " + text +
                      " among those of the IAU, which are planets, moons and " + small_bodies() +
                      "; a radius, three semi-axes, or WKT say it too",
                  in_lower_case(text), std::move(known));
}

}  // namespace sphparam
