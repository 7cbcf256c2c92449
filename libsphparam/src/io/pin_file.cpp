#include "sphparam/io/pin_file.h"

#include <algorithm>
#include <numbers>
#include <unordered_map>

#include "io/files/file_bytes.h"
#include "io/files/text_scanner.h"
#include "sphere/distinct_directions.h"
#include "sphparam/sphere/spherical_coordinates.h"

namespace sphparam {

namespace {

/// One line. ϕ may miss π by what people print: 3.141593.
Landmark parse_pin(TextScanner& scanner, const FileNumbers& numbers) {
  constexpr double printed = 1e-5;
  const long number = scanner.integer();
  const Vertex vertex = numbers.vertex(number);
  if (vertex < 0) scanner.fail(numbers.absence(number));
  const double theta = scanner.real(), phi = scanner.real();
  if (!scanner.at_line_end()) scanner.fail("expected vertex, theta and phi, then nothing");
  if (phi < -printed || phi > std::numbers::pi + printed) {
    scanner.fail("phi is an angle from the north pole, 0 to pi, in radians");
  }
  return {vertex, {theta, std::clamp(phi, 0.0, std::numbers::pi)}};
}

}  // namespace

std::vector<Landmark> parse_pins(std::string_view text, const std::string& name,
                                 const FileNumbers& numbers) {
  const ReadOptions limits;
  TextScanner scanner(text, name, limits);
  scanner.require_text();
  std::vector<Landmark> pins;
  std::unordered_map<Vertex, long> lines;
  DistinctDirections places;
  while (scanner.next_filled_line()) {
    const Landmark pin = parse_pin(scanner, numbers);
    const auto [earlier, is_new] = lines.emplace(pin.vertex, scanner.line_number());
    if (!is_new) {
      scanner.fail("vertex " + std::to_string(numbers.number(pin.vertex)) +
                   " is pinned twice, first in line " + std::to_string(earlier->second));
    }
    if (const auto other = places.add(to_cartesian(pin.coordinates))) {
      scanner.fail("vertex " + std::to_string(numbers.number(pin.vertex)) +
                   " is pinned where that of line " +
                   std::to_string(lines.at(pins[static_cast<size_t>(*other)].vertex)) + " is");
    }
    pins.push_back(pin);
  }
  if (pins.empty()) throw ReadError(name, "there is no pin in it: a line is vertex theta phi");
  return pins;
}

std::vector<Landmark> read_pins(const std::string& path, const FileNumbers& numbers) {
  const FileBytes bytes(path, ReadOptions{}.max_file_bytes);
  return parse_pins(bytes.view(), bytes.name(), numbers);
}

}  // namespace sphparam
