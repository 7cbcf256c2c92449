// Any bytes are coefficients of spherical harmonics, by --json of spharm or by SPHARM-PDM, or a
// ReadError. What was read keeps the promises of harmonics_record.h, and comes back as it was
// written.

#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>

#include "expect.h"
#include "sphparam/records/harmonics_record.h"

namespace {

using namespace sphparam;
using sphparam::tests::expect;

void expect_promises(const HarmonicExpansion& read) {
  const Functions& coefficients = read.fit.coefficients;
  const auto degrees = static_cast<Eigen::Index>(std::lround(std::sqrt(coefficients.rows())));
  expect(degrees > 0 && degrees * degrees == coefficients.rows() &&
             degrees <= greatest_harmonic_degree + 1,
         "coefficients are of whole degrees");
  expect(std::ssize(read.functions) == coefficients.cols(), "each function has a column");
  expect(read.functions.size() >= 3 && read.functions[0] == "x" && read.functions[1] == "y" &&
             read.functions[2] == "z",
         "functions begin with x, y and z");
  expect(std::set<std::string>(read.functions.begin(), read.functions.end()).size() ==
             read.functions.size(),
         "no function is there twice");
}

void expect_round_trip(const HarmonicExpansion& read) {
  if (!read.told_coefficients().allFinite()) return;  // JSON has no such numbers
  const HarmonicExpansion again = parse_harmonics(to_json(read, "a.ply", read.map), "again.json");
  expect(again.functions == read.functions && again.normalisation == read.normalisation &&
             again.radius_about == read.radius_about,
         "what was read survives writing and reading");
  const auto size = read.fit.coefficients.array().abs();
  const auto change = (again.fit.coefficients - read.fit.coefficients).array().abs();
  constexpr double rounding = 1e-15, tiny = 1e-300;  // of a factor there and back
  expect(read.normalisation == HarmonicNormalisation::FourPi
             ? (change <= rounding * size + tiny).all()
             : (change == 0).all(),
         "coefficients survive writing and reading");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  for (const char* name : {"fuzzed.json", "fuzzed.coef"}) {
    try {
      const HarmonicExpansion read = parse_harmonics(text, name);
      expect_promises(read);
      expect_round_trip(read);
    } catch (const ReadError&) {
    }
  }
  return 0;
}
