#pragma once

#include <string>

#include "sphparam/sphere/certificate.h"

namespace sphparam::tools {

/// Throws NotCertifiedError unless the certificate says one-to-one: `what`, and the faces at fault.
void require_certified(const Certificate& certificate, const std::string& what);

}  // namespace sphparam::tools
