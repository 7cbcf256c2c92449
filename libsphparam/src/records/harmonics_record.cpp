#include "sphparam/records/harmonics_record.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "csv_field.h"
#include "number_text.h"
#include "place_text.h"
#include "records/harmonic_bases.h"
#include "records/json_parts.h"
#include "sphere/solid_angle.h"
#include "sphparam/io/file_numbers.h"
#include "sphparam/version.h"
#include "sphparam/words.h"

namespace sphparam {

namespace {

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

/// Else coefficients are known, and no more.
bool is_measured(const HarmonicExpansion& expansion) { return expansion.fit.rms.size() > 0; }

void add_fit(Json& json, const HarmonicExpansion& expansion) {
  json["fit"] = expansion.least_squares ? "least-squares" : "quadrature";
  json["iterations"] = expansion.fit.iterations;
  json["converged"] = expansion.fit.converged;
  json["decided_degree"] = expansion.fit.decided_degree.value_or(expansion.degree());
  if (expansion.fit.decided_change) json["decided_change"] = *expansion.fit.decided_change;
  json["position_rms"] = expansion.position_rms();
  json["position_rms_relative"] = expansion.position_rms() / expansion.diagonal;
  json["position_rms_unweighted"] = expansion.plain_position_rms();
  json["rms"] = rms_meaning;
  if (!expansion.least_squares) json["quadrature"] = quadrature_json(expansion.fit);
}

Json functions_json(const HarmonicExpansion& expansion) {
  const Functions coefficients = expansion.told_coefficients();
  const Functions power = power_per_degree(coefficients);
  Json functions = Json::array();
  for (size_t k = 0; k < expansion.functions.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    Json function = {{"name", expansion.functions[k]}};
    if (is_measured(expansion)) {
      function["rms_residual"] = expansion.fit.rms[i];
      function["rms_residual_unweighted"] = expansion.plain_rms[i];
    }
    function["power_per_degree"] = column(power, i);
    function["coefficients"] = column(coefficients, i);
    functions.push_back(std::move(function));
  }
  return functions;
}

std::string quadrature_line(const HarmonicFit& fit) {
  const std::string line = "integral by " + std::to_string(fit.quadrature_degree + 1) + " × " +
                           std::to_string(2 * fit.quadrature_degree + 2) + " nodes";
  if (!fit.quadrature_change) return line;
  return line + "; the last doubling changed the coefficients by " +
         percent(*fit.quadrature_change) + " of what the functions vary";
}

}  // namespace

std::string to_json(const HarmonicExpansion& expansion, const std::string& mesh,
                    const Provenance& map) {
  Json json = {{"sphparam", version},
               {"command", "spharm"},
               {"mesh", mesh},
               {"map", pairs_json(map)},
               {"degree", expansion.degree()},
               {"basis", is_geodetic(expansion) ? geodetic_basis : orthonormal_basis}};
  if (is_measured(expansion)) add_fit(json, expansion);
  if (expansion.radius_about) {
    json["centre"] = vector_json(*expansion.radius_about);
    json["reference_radius"] = mean_radius(expansion);
  }
  if (expansion.degree() >= 1) {
    json["first_order_ellipsoid"] =
        vector_json(first_order_ellipsoid(expansion.fit.coefficients.leftCols(3)));
  }
  if (expansion.alignment) json["alignment"] = alignment_json(expansion);
  json["functions"] = functions_json(expansion);
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

std::string heavy_vertices_line(const MappedMesh& mapped) {
  constexpr double least_share = 0.01, least_times = 20;
  const VectorX shares =
      vertex_solid_angles(mapped.topology(), mapped.map()) / (4 * std::numbers::pi);
  std::vector<double> sorted(shares.begin(), shares.end());
  const auto middle = sorted.begin() + std::ssize(sorted) / 2;
  std::ranges::nth_element(sorted, middle);
  const double median = *middle;
  const auto heavy = (shares.array() >= std::max(least_share, least_times * median)).eval();
  if (!heavy.any()) return "";
  Eigen::Index heaviest = 0;
  const double most = shares.maxCoeff(&heaviest);
  const double all = heavy.select(shares.array(), 0.0).sum();
  return counted(heavy.count(), "vertex stands", "vertices stand") + " for " + percent(all) +
         " of the sphere, as on the rim of a gap without vertices: what these carry decides the "
         "coefficients, and so does its noise; vertex " +
         std::to_string(FileNumbers(mapped.file()).number(static_cast<Vertex>(heaviest))) +
         " for " + percent(most) + ", " + short_number(most / median) + " times the median";
}

std::string decided_change_line(const HarmonicExpansion& expansion) {
  constexpr double nothing = 1e-3;
  const double change = expansion.fit.decided_change.value_or(0);
  if (change < nothing) return "";
  const std::string degree = std::to_string(expansion.fit.decided_degree.value());
  return "coefficients up to degree " + degree + " are other ones than those of a fit of degree " +
         degree + ", too, of one degree by " + percent(change) + " of their size";
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
