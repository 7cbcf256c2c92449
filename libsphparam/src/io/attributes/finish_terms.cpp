#include "io/attributes/finish_terms.h"

#include <algorithm>

#include "number_text.h"
#include "parsed_number.h"

namespace sphparam {
namespace {

constexpr double any = 1e9;

using Finish = MaterialFinish;

FinishTerm number(const char* extension, const char* key, double Finish::*number, double least = 0,
                  double most = 1) {
  return {extension, key, number, nullptr, least, most};
}
FinishTerm colour(const char* extension, const char* key, Finish::Colour Finish::*colour,
                  double most = 1) {
  return {extension, key, nullptr, colour, 0, most};
}

std::vector<std::string_view> pieces(std::string_view text, char between) {
  std::vector<std::string_view> found;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(between, at), text.size());
    if (end > at) found.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return found;
}

/// Empty where one of them is no number.
std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  for (const std::string_view word : pieces(text, ',')) {
    const std::optional<double> value = parsed<double>(word);
    if (!value) return {};
    numbers.push_back(*value);
  }
  return numbers;
}

bool says_something(const FinishTerm& term, const Finish& finish) {
  return numbers_of(term, finish) != numbers_of(term, Finish());
}

/// Of a coat without strength nobody sees how rough it is.
Finish without_effectless(Finish finish) {
  const Finish none;
  if (finish.clearcoat == 0) finish.clearcoat_roughness = none.clearcoat_roughness;
  if (finish.sheen == none.sheen) finish.sheen_roughness = none.sheen_roughness;
  if (finish.iridescence == 0) {
    finish.iridescence_ior = none.iridescence_ior;
    finish.iridescence_thickness = none.iridescence_thickness;
  }
  // Light must go in to be absorbed or spread.
  if (finish.transmission == 0) finish.thickness = 0;
  if (finish.thickness == 0) {
    finish.attenuation_distance = none.attenuation_distance;
    finish.attenuation_colour = none.attenuation_colour;
    finish.dispersion = none.dispersion;
  }
  if (finish.attenuation_distance == 0) finish.attenuation_colour = none.attenuation_colour;
  return finish;
}

}  // namespace

const std::vector<FinishTerm>& finish_terms() {
  static const std::vector<FinishTerm> terms = {
      number("clearcoat", "clearcoatFactor", &Finish::clearcoat),
      number("clearcoat", "clearcoatRoughnessFactor", &Finish::clearcoat_roughness),
      colour("sheen", "sheenColorFactor", &Finish::sheen),
      number("sheen", "sheenRoughnessFactor", &Finish::sheen_roughness),
      number("transmission", "transmissionFactor", &Finish::transmission),
      number("ior", "ior", &Finish::ior, 0, any),
      number("specular", "specularFactor", &Finish::specular),
      colour("specular", "specularColorFactor", &Finish::specular_colour, any),
      number("iridescence", "iridescenceFactor", &Finish::iridescence),
      number("iridescence", "iridescenceIor", &Finish::iridescence_ior, 1, any),
      number("iridescence", "iridescenceThicknessMaximum", &Finish::iridescence_thickness, 0, any),
      number("volume", "thicknessFactor", &Finish::thickness, 0, any),
      number("volume", "attenuationDistance", &Finish::attenuation_distance, 0, any),
      colour("volume", "attenuationColor", &Finish::attenuation_colour),
      number("dispersion", "dispersion", &Finish::dispersion, 0, any)};
  return terms;
}

std::vector<double> numbers_of(const FinishTerm& term, const MaterialFinish& finish) {
  if (term.number) return {finish.*term.number};
  const MaterialFinish::Colour& colour = finish.*term.colour;
  return {colour.begin(), colour.end()};
}

void set_numbers(const FinishTerm& term, const std::vector<double>& numbers,
                 MaterialFinish& finish) {
  const auto allowed = [&](double x) { return x >= term.least && x <= term.most; };
  const bool is_speed = term.number == &MaterialFinish::ior;  // no light is faster than in a vacuum
  if (numbers.size() != (term.number ? 1U : 3U) || !std::ranges::all_of(numbers, allowed) ||
      (is_speed && numbers[0] > 0 && numbers[0] < 1))
    return;
  if (term.number)
    finish.*term.number = numbers[0];
  else
    std::ranges::copy(numbers, (finish.*term.colour).begin());
}

std::vector<std::string> extensions_of(const MaterialFinish& finish) {
  const MaterialFinish seen = without_effectless(finish);
  std::vector<std::string> names;
  for (const FinishTerm& term : finish_terms()) {
    const std::string name = std::string("KHR_materials_") + term.extension;
    if (says_something(term, seen) && (names.empty() || names.back() != name))
      names.push_back(name);
  }
  return names;
}

std::string to_text(const MaterialFinish& finish) {
  const MaterialFinish seen = without_effectless(finish);
  std::string text;
  for (const FinishTerm& term : finish_terms()) {
    if (!says_something(term, seen)) continue;
    text.append(text.empty() ? "" : " ").append(term.key).append("=");
    std::string numbers;
    for (const double x : numbers_of(term, seen))
      numbers.append(numbers.empty() ? "" : ",").append(shortest(x));
    text += numbers;
  }
  return text;
}

MaterialFinish finish_in(std::string_view text) {
  MaterialFinish finish;
  for (const std::string_view word : pieces(text, ' ')) {
    const std::size_t equals = std::min(word.find('='), word.size());
    for (const FinishTerm& term : finish_terms())
      if (word.substr(0, equals) == term.key && equals < word.size())
        set_numbers(term, numbers_in(word.substr(equals + 1)), finish);
  }
  return finish;
}

}  // namespace sphparam
