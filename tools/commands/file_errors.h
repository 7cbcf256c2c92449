#pragma once

#include <stdexcept>
#include <string>

#include "sphparam/io/paths.h"
#include "sphparam/io/read_options.h"
#include "sphparam/io/safe_file.h"

namespace sphparam::cli {

/// Makes assets and adds their files: positions beyond float32 are the input's fault, more than a
/// .glb holds the output's. Throws: ReadError; WriteError; whatever the work throws else.
template <class Work>
void with_file_errors(const std::string& input, const std::string& output, const Work& work) try {
  work();
} catch (const std::range_error& error) {
  throw ReadError(display_name(input), error.what());
} catch (const std::length_error& error) {
  throw WriteError(output_name(output), error.what());
}

}  // namespace sphparam::cli
