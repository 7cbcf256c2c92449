#include "sphparam/io/coarse_coordinates.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "mesh/box.h"
#include "number_text.h"
#include "sphparam/io/scalar_type.h"

namespace sphparam {
namespace {

constexpr std::string_view prefix = "coordinates: so far from the origin, numbers of 32 bits are ";

bool are_floats(const Points& positions) {
  const double* const first = positions.data();
  return std::all_of(first, first + positions.size(),
                     [](double value) { return holds_exactly(ScalarType::Float32, value); });
}

/// How far apart the numbers of 32 bits are there; 0 without points.
double float_step(const Box& box) {
  const double most = std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
  if (!(most > 0) || !std::isfinite(most)) return 0;
  return std::ldexp(1.0, std::ilogb(most) - (std::numeric_limits<float>::digits - 1));
}

/// Whether some number as large as the largest ends in the last digit that a float has there: what
/// all end before it is as exact as it was written, as whole metres are.
bool use_last_digit(const Points& positions, double step) {
  const double* const first = positions.data();
  return std::any_of(first, first + positions.size(),
                     [&](double value) { return std::fmod(std::abs(value) / step, 2) == 1; });
}

/// Of all sides of triangles. Faces name vertices that are there: readers see to it.
double mean_edge(const TriangleMesh& mesh) {
  double sum = 0;
  for (Face f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k)
      sum += (mesh.position(mesh.triangles(f, k)) - mesh.position(mesh.triangles(f, (k + 1) % 3)))
                 .norm();
  return sum / (3 * std::max<double>(1, static_cast<double>(mesh.face_count())));
}

}  // namespace

std::string coarse_coordinates(const TriangleMesh& mesh) {
  constexpr double much = 0.1;  // of an edge; area and volume are wrong by some per mille there
  if (!are_floats(mesh.positions)) return {};
  const Box box = surface_box(mesh);
  const double step = float_step(box), length = box.longest_side(), edge = mean_edge(mesh);
  if (!(edge > 0) || !std::isfinite(edge) || step <= much * edge) return {};
  if (!use_last_digit(mesh.positions, step)) return {};
  return std::string(prefix) + short_number(step) + " apart, " + percent(step / length) +
         " of the mesh's length and " + percent(step / edge) +
         " of its mean edge: area, volume and distances are rough; export it in doubles, or moved "
         "nearer";
}

std::vector<std::string> coarse_coordinates_among(const std::vector<std::string>& notes) {
  std::vector<std::string> found;
  std::copy_if(notes.begin(), notes.end(), std::back_inserter(found),
               [](const std::string& note) { return note.starts_with(prefix); });
  return found;
}

}  // namespace sphparam
