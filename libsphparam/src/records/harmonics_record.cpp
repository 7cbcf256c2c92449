#include "sphparam/records/harmonics_record.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <stdexcept>

#include "csv_field.h"
#include "io/files/file_bytes.h"
#include "number_text.h"
#include "place_text.h"
#include "records/json_parts.h"
#include "sphparam/io/coef_file.h"
#include "sphparam/io/paths.h"
#include "sphparam/version.h"

namespace sphparam {

namespace {

constexpr char orthonormal_basis[] =
    "real, orthonormal on the unit sphere, without the Condon-Shortley phase; row l*l + l + m; "
    "m > 0: cos(m theta), m < 0: sin(|m| theta); Y_11, Y_1-1, Y_10 = sqrt(3/(4 pi)) (x, y, z)";

constexpr char geodetic_basis[] =
    "real, 4pi-normalised, without the Condon-Shortley phase, as in geodesy; row l*l + l + m; "
    "m >= 0: C_lm of cos(m theta), m < 0: S_l|m| of sin(|m| theta); Y_11, Y_1-1, Y_10 = sqrt(3) "
    "(x, y, z)";

bool is_geodetic(const HarmonicExpansion& expansion) {
  return expansion.normalisation == HarmonicNormalisation::FourPi;
}

constexpr char rms_meaning[] =
    "of what is left at the vertices, each weighted by its solid angle on the sphere, as the least "
    "squares are; unweighted: each vertex counts the same";

/// As E23.16 of FORTRAN has it: 17 digits, which come back exactly.
std::string fortran_number(double value) {
  char digits[32];
  const auto end =
      std::to_chars(digits, digits + sizeof digits, value, std::chars_format::scientific, 16).ptr;
  std::string text(digits, end);
  std::ranges::replace(text, 'e', 'E');
  return std::string(24 - std::min<size_t>(text.size(), 24), ' ') + text;
}

std::string right_aligned(int number) {
  const std::string text = std::to_string(number);
  return std::string(5 - std::min<size_t>(text.size(), 5), ' ') + text;
}

/// C_00 of geodesy.
double mean_radius(const HarmonicExpansion& expansion) {
  return expansion.fit.coefficients.topRightCorner(1, 1).value() / std::sqrt(4 * std::numbers::pi);
}

Json rows_json(const Eigen::Matrix3d& matrix) {
  Json rows = Json::array();
  for (int k = 0; k < 3; ++k) rows.push_back(vector_json(matrix.row(k).transpose()));
  return rows;
}

Json alignment_json(const HarmonicExpansion& expansion) {
  const FirstOrderAlignment& alignment = *expansion.alignment;
  const bool surface = expansion.aligned == HarmonicAlignment::SphereAndSurface;
  Json json = {{"turned", surface ? "sphere and surface" : "sphere"},
               {"first_order", "x = (-a u_x, -b u_y, c u_z), a >= b >= c; u on the turned sphere"},
               {"semi_axes", vector_json(alignment.semi_axes)},
               {"sphere_rotation", rows_json(alignment.sphere)}};
  if (surface) {
    json["surface_rotation"] = rows_json(alignment.object);
    json["centre"] = vector_json(alignment.centre);
  }
  json["skewness"] = vector_json(alignment.skewness);
  json["half_turn_by"] = alignment.by_skewness ? "skewness" : "template";
  json["undecided"] = alignment.undecided;
  json["confidence"] = alignment.confidence;
  json["reversed"] = alignment.reversed;
  return json;
}

Json quadrature_json(const HarmonicFit& fit) {
  Json json = {{"rows", fit.quadrature_degree + 1}, {"columns", 2 * fit.quadrature_degree + 2}};
  if (fit.quadrature_change) json["change"] = *fit.quadrature_change;
  return json;
}

Json column(const Functions& values, Eigen::Index k) {
  Json result = Json::array();
  for (Eigen::Index i = 0; i < values.rows(); ++i) result.push_back(values(i, k));
  return result;
}

std::string quadrature_line(const HarmonicFit& fit) {
  const std::string line = "integral by " + std::to_string(fit.quadrature_degree + 1) + " × " +
                           std::to_string(2 * fit.quadrature_degree + 2) + " nodes";
  if (!fit.quadrature_change) return line;
  return line + "; the last doubling changed the coefficients by " +
         percent(*fit.quadrature_change) + " of what the functions vary";
}

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

std::string to_json(const HarmonicExpansion& expansion, const std::string& mesh,
                    const Provenance& map) {
  const Functions coefficients = expansion.told_coefficients();
  const Functions power = power_per_degree(coefficients);
  const bool is_measured = expansion.fit.rms.size() > 0;
  Json functions = Json::array();
  for (size_t k = 0; k < expansion.functions.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    Json function = {{"name", expansion.functions[k]}};
    if (is_measured) {
      function["rms_residual"] = expansion.fit.rms[i];
      function["rms_residual_unweighted"] = expansion.plain_rms[i];
    }
    function["power_per_degree"] = column(power, i);
    function["coefficients"] = column(coefficients, i);
    functions.push_back(std::move(function));
  }
  Json json = {{"sphparam", version},
               {"command", "spharm"},
               {"mesh", mesh},
               {"map", pairs_json(map)},
               {"degree", expansion.degree()},
               {"basis", is_geodetic(expansion) ? geodetic_basis : orthonormal_basis}};
  if (is_measured) {
    json["fit"] = expansion.least_squares ? "least-squares" : "quadrature";
    json["iterations"] = expansion.fit.iterations;
    json["converged"] = expansion.fit.converged;
    json["decided_degree"] = expansion.fit.decided_degree.value_or(expansion.degree());
    json["position_rms"] = expansion.position_rms();
    json["position_rms_relative"] = expansion.position_rms() / expansion.diagonal;
    json["position_rms_unweighted"] = expansion.plain_position_rms();
    json["rms"] = rms_meaning;
  }
  if (is_measured && !expansion.least_squares) json["quadrature"] = quadrature_json(expansion.fit);
  if (expansion.radius_about) {
    json["centre"] = vector_json(*expansion.radius_about);
    json["reference_radius"] = mean_radius(expansion);
  }
  if (expansion.degree() >= 1) {
    json["first_order_ellipsoid"] =
        vector_json(first_order_ellipsoid(expansion.fit.coefficients.leftCols(3)));
  }
  if (expansion.alignment) json["alignment"] = alignment_json(expansion);
  json["functions"] = functions;
  return text_of(json, 1);
}

std::string to_csv(const HarmonicExpansion& expansion, char separator) {
  std::string text = std::string("l") + separator + "m";
  const Functions coefficients = expansion.told_coefficients();
  for (const std::string& name : expansion.functions)
    text += separator + csv_field(name + (is_geodetic(expansion) ? " (4pi)" : ""));
  text += "\n";
  for (int l = 0; l <= expansion.degree(); ++l) {
    for (int m = -l; m <= l; ++m) {
      text += std::to_string(l) + separator + std::to_string(m);
      for (Eigen::Index k = 0; k < coefficients.cols(); ++k) {
        text += separator;
        text += shortest(coefficients(harmonic_index(l, m), k));
      }
      text += "\n";
    }
  }
  return text;
}

std::string to_shadr(const HarmonicExpansion& expansion, const std::string& function) {
  const auto found = std::ranges::find(expansion.functions, function);
  if (found == expansion.functions.end()) {
    throw std::invalid_argument("to_shadr: " + function + " was not expanded");
  }
  const VectorX c = expansion.fit.coefficients.col(found - expansion.functions.begin()) /
                    std::sqrt(4 * std::numbers::pi);
  const std::string zero = fortran_number(0), degree = right_aligned(expansion.degree());
  std::string text = fortran_number(c[0]) + "," + zero + "," + zero + "," + degree + "," + degree +
                     "," + right_aligned(1) + "," + zero + "," + zero + "\r\n";
  for (int l = 0; l <= expansion.degree(); ++l) {
    for (int m = 0; m <= l; ++m) {
      const double s = m == 0 ? 0 : c[harmonic_index(l, -m)];
      text += right_aligned(l) + "," + right_aligned(m) + "," +
              fortran_number(c[harmonic_index(l, m)]) + "," + fortran_number(s) + "," + zero + "," +
              zero + "\r\n";
    }
  }
  return text;
}

std::string residual_line(const HarmonicExpansion& expansion) {
  return "degree " + std::to_string(expansion.degree()) +
         ", RMS distance at the vertices, weighted by solid angle, " +
         short_number(expansion.position_rms()) + " (" +
         percent(expansion.position_rms() / expansion.diagonal) + " of the diagonal), unweighted " +
         short_number(expansion.plain_position_rms());
}

std::string undecided_line(const HarmonicExpansion& expansion) {
  if (!expansion.fit.decided_degree) return "";
  const Eigen::Index count = expansion.fit.coefficients.rows(), vertices = expansion.values.rows();
  const std::string numbers = count > vertices ? std::to_string(count) + " coefficients for " +
                                                     std::to_string(vertices) + " vertices: "
                                               : "";
  return numbers + "the vertices decide harmonics up to degree " +
         std::to_string(*expansion.fit.decided_degree) +
         ", and what they leave open beyond is near the integral's";
}

std::vector<std::string> further_lines(const HarmonicExpansion& expansion) {
  std::vector<std::string> lines;
  if (!expansion.least_squares) lines.push_back(quadrature_line(expansion.fit));
  if (expansion.degree() >= 1) {
    const Vector3 axes = first_order_ellipsoid(expansion.fit.coefficients.leftCols(3));
    lines.push_back("first-order ellipsoid: semi-axes " + short_number(axes[0], 6) + ", " +
                    short_number(axes[1], 6) + ", " + short_number(axes[2], 6));
  }
  if (expansion.alignment) {
    const Vector3& skewness = expansion.alignment->skewness;
    lines.push_back(std::string(expansion.aligned == HarmonicAlignment::Sphere
                                    ? "sphere"
                                    : "sphere and surface") +
                    " turned onto its axes; skewness along them " + short_number(skewness[0]) +
                    ", " + short_number(skewness[1]) + ", " + short_number(skewness[2]));
  }
  for (size_t k = 3; k < expansion.functions.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const bool is_radius = expansion.radius_about && k + 1 == expansion.functions.size();
    lines.push_back(
        expansion.functions[k] +
        (is_radius ? " about " + place_text(*expansion.radius_about, expansion.diagonal) : "") +
        ": RMS residual, weighted, " + short_number(expansion.fit.rms[i]) + ", unweighted " +
        short_number(expansion.plain_rms[i]));
  }
  return lines;
}

}  // namespace sphparam
