#include <algorithm>
#include <string>
#include <vector>

#include "sphparam/errors.h"
#include "sphparam/sphere/certificate.h"

namespace sphparam {

namespace {

constexpr size_t ids_shown = 10;  // the JSON lists them all

/// "3 folded faces: 4, 17, 18"
std::string ids_line(const std::string& what, const std::vector<int>& ids) {
  if (ids.empty()) return "";
  std::string line = "  " + std::to_string(ids.size()) + " " + what + ": ";
  for (size_t i = 0; i < std::min(ids.size(), ids_shown); ++i) {
    line += (i ? ", " : "") + std::to_string(ids[i]);
  }
  return line + (ids.size() > ids_shown ? ", …\n" : "\n");
}

}  // namespace

std::string verdict(const Certificate& certificate) {
  if (certificate.bijective()) return "one-to-one";
  if (!certificate.unusable_points.empty()) {
    return "unusable points " + std::to_string(certificate.unusable_points.size());
  }
  if (certificate.fold_count() > 0) return "folded " + std::to_string(certificate.fold_count());
  return "degree " + std::to_string(certificate.degree);
}

std::string complaint(const Certificate& certificate) {
  std::string lines =
      ids_line("points that are not finite, zero or too far", certificate.unusable_points) +
      ids_line("folded faces", certificate.folded) +
      ids_line("faces without area on the sphere", certificate.degenerate) +
      ids_line("vertices whose faces wind more than once", certificate.branch_vertices);
  const bool counted = certificate.unusable_points.empty() && certificate.fold_count() == 0;
  if (counted && certificate.degree != 1) {
    lines += "  the sphere is covered " + std::to_string(certificate.degree) + " times\n";
  }
  return lines;
}

void require_certified(const Certificate& certificate, const std::string& what) {
  if (certificate.bijective()) return;
  throw NotCertifiedError(what + ": the map is not one-to-one: " +
                          (certificate.reversed
                               ? "its sphere is seen from inside"
                               : verdict(certificate) + "\n" + complaint(certificate)));
}

}  // namespace sphparam
