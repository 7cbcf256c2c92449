#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "specimens.h"

namespace sphparam::campaign {

/// What came of one specimen.
struct Outcome {
  std::string family;
  std::string made_by;  // the stage that made the map
  std::string error;    // what was thrown, if anything was
  bool certified = false;
  bool thread_dependent = false;  // other bytes with 2 or 4 threads than with one
  long faces = 0;
  long float32_folds = 0;  // of the map as `round_float32_safe` leaves it
  double seconds = 0;      // of the map, of processor time
  std::uint64_t hash = 0;  // of the map's bytes
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Outcome, family, made_by, error, certified, thread_dependent,
                                   faces, float32_folds, seconds, hash)

/// Maps a specimen by the default method on one thread, and certifies the map anew.
/// `compare_threads`: maps it with 2 and 4 threads too.
Outcome try_specimen(const Specimen& specimen, bool compare_threads);

}  // namespace sphparam::campaign
