#pragma once

#include "image/oiio_module.h"

/// As `SphparamImageTable::encode_webp`.
int encode_webp(const SphparamWebp* image, SphparamBytesSink bytes, void* context,
                SphparamBytesSink error, void* error_context);
