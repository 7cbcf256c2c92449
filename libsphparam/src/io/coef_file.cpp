#include "sphparam/io/coef_file.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/files/file_bytes.h"
#include "io/files/text_scanner.h"
#include "number_text.h"

namespace sphparam {
namespace {

/// What a coefficient of ours is multiplied by.
double factor(int m) {
  if (m == 0) return 1;
  return m % 2 == 0 ? std::numbers::sqrt2 : -std::numbers::sqrt2;
}

/// The orders of one degree as the file has them: 0, 1, −1, 2, −2, …
template <class Visit>
void for_each_order(int l, const Visit& visit) {
  visit(0);
  for (int m = 1; m <= l; ++m) {
    visit(m);
    visit(-m);
  }
}

int degree_of(const Functions& coefficients) {
  return static_cast<int>(std::lround(std::sqrt(double(coefficients.rows())))) - 1;
}

/// Numbers one after the other, wherever lines end.
double next(TextScanner& scanner) {
  while (scanner.at_line_end())
    if (!scanner.next_line()) scanner.fail("the file ends before its last coefficient");
  return scanner.real();
}

int degree_in(TextScanner& scanner) {
  const double count = next(scanner);
  const int degree = static_cast<int>(std::lround(std::sqrt(std::clamp(count, 0.0, 1e9)))) - 1;
  if (degree < 0 || degree > greatest_harmonic_degree || count != (degree + 1.0) * (degree + 1.0))
    scanner.fail(shortest(count) + " coefficients are no (L + 1)² with L up to " +
                 std::to_string(greatest_harmonic_degree));
  return degree;
}

}  // namespace

std::string to_coef(const Functions& coefficients) {
  std::string text = "{ " + std::to_string(coefficients.rows()) + ",";
  const int degree = degree_of(coefficients);
  for (int l = 0; l <= degree; ++l) {
    for_each_order(l, [&](int m) {
      const auto row = coefficients.row(harmonic_index(l, m)) * factor(std::abs(m));
      text += l == 0 ? "{" : ",\n{";
      text += shortest(row[0]) + ", " + shortest(row[1]) + ", " + shortest(row[2]) + "}";
    });
  }
  return text + "}";
}

Functions parse_coef(std::string_view text, const std::string& name) {
  std::string numbers(text);
  std::ranges::replace_if(
      numbers, [](char c) { return c == '{' || c == '}' || c == ','; }, ' ');
  const ReadOptions limits;
  TextScanner scanner(numbers, name, limits);
  scanner.require_text();
  if (text.find('{') == std::string_view::npos || !scanner.next_filled_line())
    throw ReadError(name,
                    "these are no coefficients as SPHARM-PDM writes them: { 169,{x, y, z}, …");
  const int degree = degree_in(scanner);
  Functions coefficients(Eigen::Index(degree + 1) * (degree + 1), 3);
  for (int l = 0; l <= degree; ++l) {
    for_each_order(l, [&](int m) {
      for (int k = 0; k < 3; ++k)
        coefficients(harmonic_index(l, m), k) = next(scanner) / factor(std::abs(m));
    });
  }
  if (!scanner.at_line_end() || scanner.next_filled_line())
    scanner.fail("there is more after the last coefficient");
  return coefficients;
}

Functions read_coef(const std::string& path) {
  const FileBytes bytes(path, ReadOptions{}.max_file_bytes);
  return parse_coef(bytes.view(), bytes.name());
}

}  // namespace sphparam
