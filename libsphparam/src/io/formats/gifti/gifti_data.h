#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/formats/gifti/gifti_xml.h"
#include "sphparam/io/scalar_type.h"

namespace sphparam {

/// The type of an array's numbers. Throws: ReadError for types that no mesh has.
ScalarType gifti_type(const GiftiArray& array, const std::string& name);

/// How many numbers the dimensions say. Throws: ReadError when that is more than the data can hold:
/// its own bytes, or `most_inflation` times those of compressed data.
std::int64_t gifti_count(const GiftiArray& array, std::int64_t most_inflation,
                         const std::string& name);

/// The numbers of an array, row by row whatever its order on disk: ASCII, Base64Binary or
/// GZipBase64Binary, of either byte order. Exactly as many as the dimensions say, or a ReadError.
/// Requires: `gifti_count` passed.
std::vector<double> decode_gifti(const GiftiArray& array, const std::string& name);

}  // namespace sphparam
