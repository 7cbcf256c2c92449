#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "io/files/file_bytes.h"
#include "number_text.h"
#include "records/harmonic_bases.h"
#include "sphparam/errors.h"
#include "sphparam/io/coef_file.h"
#include "sphparam/io/paths.h"
#include "sphparam/records/harmonics_record.h"

namespace sphparam {
namespace {

/// Objects of strangers' files may have any number of keys, which ordered ones seek one by one.
using Document = nlohmann::json;

/// "radius", but not "a b", which no property of vertices is called.
bool is_name(const std::string& text) {
  const auto is_blank = [](unsigned char c) { return c <= ' ' || c == 127; };
  return !text.empty() && std::ranges::none_of(text, is_blank);
}

std::vector<std::string> function_names(const Document& functions, const std::string& file) {
  constexpr std::array axes{"x", "y", "z"};
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const Document& function : functions) {
    const auto name = function.at("name").get<std::string>();
    const bool is_expected =
        names.size() < axes.size() ? name == axes[names.size()] : is_name(name);
    if (!is_expected || !seen.insert(name).second)
      throw ReadError(file, "functions are x, y, z and then others, each once, not " +
                                joined(names) + (names.empty() ? "" : ", ") + one_line(name));
    names.push_back(name);
  }
  if (names.size() < axes.size()) throw ReadError(file, "there are no functions x, y and z");
  return names;
}

/// One function a column: no table is larger than what the file has.
Functions coefficient_table(const Document& functions, const std::string& file) {
  std::vector<std::vector<double>> columns;
  for (const Document& function : functions) {
    columns.push_back(function.at("coefficients").get<std::vector<double>>());
    if (columns.back().size() != columns.front().size())
      throw ReadError(file, "functions have not as many coefficients each");
  }
  const auto rows = static_cast<double>(columns.front().size());
  const double degree = std::round(std::sqrt(rows)) - 1;
  if (degree < 0 || degree > greatest_harmonic_degree || (degree + 1) * (degree + 1) != rows)
    throw ReadError(file, shortest(rows) + " coefficients are no (L + 1)² with L up to " +
                              std::to_string(greatest_harmonic_degree));
  Functions table(std::ssize(columns.front()), std::ssize(columns));
  for (size_t k = 0; k < columns.size(); ++k)
    table.col(static_cast<Eigen::Index>(k)) =
        Eigen::Map<const VectorX>(columns[k].data(), table.rows());
  return table;
}

HarmonicNormalisation normalisation_of(const Document& json, const std::string& file) {
  const auto basis = json.at("basis").get<std::string>();
  if (basis == geodetic_basis) return HarmonicNormalisation::FourPi;
  if (basis == orthonormal_basis) return HarmonicNormalisation::Orthonormal;
  throw ReadError(file, "its basis is none of ours: " + one_line(basis));
}

HarmonicAlignment alignment_of(const Document& json) {
  if (!json.contains("alignment")) return HarmonicAlignment::None;
  return json["alignment"].at("turned") == "sphere" ? HarmonicAlignment::Sphere
                                                    : HarmonicAlignment::SphereAndSurface;
}

Vector3 centre_of(const Document& numbers) {
  const auto centre = numbers.get<std::array<double, 3>>();
  return Vector3(centre.data());
}

/// Lines that a mesh of them tells again.
Provenance map_of(const Document& json) {
  Provenance lines;
  for (const auto& [key, value] : json.at("map").items())
    if (is_name(key) && value.is_string())
      lines.emplace_back(key, one_line(value.get<std::string>()));
  return lines;
}

HarmonicExpansion of_json(const Document& json, const std::string& file) {
  HarmonicExpansion expansion;
  const Document& functions = json.at("functions");
  expansion.functions = function_names(functions, file);
  expansion.fit.coefficients = coefficient_table(functions, file);
  expansion.normalisation = normalisation_of(json, file);
  if (expansion.normalisation == HarmonicNormalisation::FourPi)
    expansion.fit.coefficients *= std::sqrt(4 * std::numbers::pi);
  expansion.aligned = alignment_of(json);
  if (json.contains("centre") && expansion.functions.back() == "radius")
    expansion.radius_about = centre_of(json["centre"]);
  expansion.map = map_of(json);
  if (expansion.aligned != HarmonicAlignment::None)
    std::erase_if(expansion.map, [](const auto& line) { return line.first == "upright"; });
  return expansion;
}

}  // namespace

HarmonicExpansion parse_harmonics(std::string_view text, const std::string& name) try {
  if (extension_of(name) != ".coef") return of_json(Document::parse(text), name);
  HarmonicExpansion expansion;
  expansion.functions = {"x", "y", "z"};
  expansion.fit.coefficients = parse_coef(text, name);
  return expansion;
} catch (const Document::exception& error) {
  throw ReadError(name, "these are no coefficients as `sphparam spharm --json` writes them: " +
                            one_line(error.what()));
}

HarmonicExpansion read_harmonics(const std::string& path) {
  const FileBytes bytes(path, ReadOptions{}.max_file_bytes);
  return parse_harmonics(bytes.view(), bytes.name());
}

}  // namespace sphparam
