#include "sphparam/io/planetocentric.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

#include "number_text.h"

namespace sphparam {
namespace {

constexpr std::string_view centre_key = "radial-centre", movement_key = "radial-movement";

/// Numbers with blanks between, all of the text and finite.
template <size_t Count>
std::optional<std::array<double, Count>> numbers(std::string_view text) {
  std::array<double, Count> values;
  const char *at = text.data(), *const end = at + text.size();
  for (double& value : values) {
    while (at != end && *at == ' ') ++at;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
    at = next;
  }
  return at == end ? std::optional(values) : std::nullopt;
}

const std::string* value_of(const Provenance& provenance, std::string_view key) {
  for (const auto& [name, value] : provenance)
    if (name == key) return &value;
  return nullptr;
}

}  // namespace

Provenance planetocentric_lines(const Parameterization& result) {
  if (!result.radial) return {};
  const Vector3& c = result.radial->centre;
  return {
      {std::string(centre_key), shortest(c.x()) + " " + shortest(c.y()) + " " + shortest(c.z())},
      {std::string(movement_key), shortest(result.radial->largest_movement)}};
}

bool is_planetocentric(const std::string& key) { return key == centre_key || key == movement_key; }

std::optional<Planetocentric> planetocentric(const Provenance& provenance) {
  const std::string* const centre = value_of(provenance, centre_key);
  const std::string* const movement = value_of(provenance, movement_key);
  if (!centre || !movement) return std::nullopt;
  const auto c = numbers<3>(*centre);
  const auto radians = numbers<1>(*movement);
  if (!c || !radians || radians->front() < 0) return std::nullopt;
  return Planetocentric{{(*c)[0], (*c)[1], (*c)[2]}, radians->front()};
}

Vector3 body_centre(const std::optional<Planetocentric>& radial,
                    const std::optional<Vector3>& given) {
  return given.value_or(radial ? radial->centre : Vector3(0, 0, 0));
}

bool is_about(const Planetocentric& radial, const Vector3& centre, const TriangleMesh& mesh) {
  constexpr double rounding = 1e-6;  // of positions in float32, of centres as they are typed
  const double radius =
      (mesh.positions.rowwise() - radial.centre.transpose()).rowwise().norm().mean();
  return (centre - radial.centre).norm() <= rounding * radius;
}

}  // namespace sphparam
