#include "cli/certified.h"

#include "cli/exit_codes.h"
#include "cli/wording.h"

namespace sphparam::tools {

void require_certified(const Certificate& certificate, const std::string& what) {
  if (certificate.bijective()) return;
  throw NotCertifiedError(what + ": the map is not one-to-one: " +
                          (certificate.reversed
                               ? "its sphere is seen from inside"
                               : verdict(certificate) + "\n" + complaint(certificate)));
}

}  // namespace sphparam::tools
