#include "sphparam/records/harmonics_record.h"

#include <nlohmann/json.hpp>

#include "records/json_parts.h"
#include "sphparam/version.h"
#include "number_text.h"

namespace sphparam {

namespace {

constexpr char basis[] =
    "real, orthonormal on the unit sphere, without the Condon-Shortley phase; row l*l + l + m; "
    "m > 0: cos(m theta), m < 0: sin(|m| theta); Y_11, Y_1-1, Y_10 = sqrt(3/(4 pi)) (x, y, z)";

constexpr char rms_meaning[] =
    "of what is left at the vertices, each weighted by its solid angle on the sphere, as the least "
    "squares are; unweighted: each vertex counts the same";

Json column(const Functions& values, Eigen::Index k) {
  Json result = Json::array();
  for (Eigen::Index i = 0; i < values.rows(); ++i) result.push_back(values(i, k));
  return result;
}

}  // namespace

std::string to_json(const HarmonicExpansion& expansion, const std::string& mesh,
                    const Provenance& map) {
  const Functions power = power_per_degree(expansion.fit.coefficients);
  Json functions = Json::array();
  for (size_t k = 0; k < expansion.functions.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    functions.push_back({{"name", expansion.functions[k]},
                         {"rms_residual", expansion.fit.rms[i]},
                         {"rms_residual_unweighted", expansion.plain_rms[i]},
                         {"power_per_degree", column(power, i)},
                         {"coefficients", column(expansion.fit.coefficients, i)}});
  }
  Json json = {{"sphparam", version},
               {"mesh", mesh},
               {"map", pairs_json(map)},
               {"degree", expansion.degree()},
               {"basis", basis},
               {"fit", expansion.least_squares ? "least-squares" : "quadrature"},
               {"iterations", expansion.fit.iterations},
               {"position_rms", expansion.position_rms()},
               {"position_rms_relative", expansion.position_rms() / expansion.diagonal},
               {"position_rms_unweighted", expansion.plain_position_rms()},
               {"rms", rms_meaning}};
  if (expansion.degree() >= 1) {
    json["first_order_ellipsoid"] =
        vector_json(first_order_ellipsoid(expansion.fit.coefficients.leftCols(3)));
  }
  json["functions"] = functions;
  return text_of(json, 1);
}

std::string to_csv(const HarmonicExpansion& expansion) {
  std::string text = "l,m";
  for (const std::string& name : expansion.functions) text += "," + name;
  text += "\n";
  for (int l = 0; l <= expansion.degree(); ++l) {
    for (int m = -l; m <= l; ++m) {
      text += std::to_string(l) + "," + std::to_string(m);
      for (Eigen::Index k = 0; k < expansion.fit.coefficients.cols(); ++k) {
        text += ",";
        text += shortest(expansion.fit.coefficients(harmonic_index(l, m), k));
      }
      text += "\n";
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

std::vector<std::string> further_lines(const HarmonicExpansion& expansion) {
  std::vector<std::string> lines;
  if (expansion.degree() >= 1) {
    const Vector3 axes = first_order_ellipsoid(expansion.fit.coefficients.leftCols(3));
    lines.push_back("first-order ellipsoid: semi-axes " + short_number(axes[0], 6) + ", " +
                    short_number(axes[1], 6) + ", " + short_number(axes[2], 6));
  }
  for (size_t k = 3; k < expansion.functions.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    lines.push_back(expansion.functions[k] + ": RMS residual, weighted, " +
                    short_number(expansion.fit.rms[i]) + ", unweighted " +
                    short_number(expansion.plain_rms[i]));
  }
  return lines;
}

}  // namespace sphparam
