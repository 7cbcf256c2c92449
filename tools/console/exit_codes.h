#pragma once

#include <stdexcept>

#include "sphparam/errors.h"

namespace sphparam::cli {

/// What the program answers to its caller. Documented in `sphparam --help`: never renumber.
enum ExitCode : int {
  Ok = 0,             // for `map`: what is on disk is certified
  InternalError = 1,  // a fault of ours, or out of memory or threads
  UsageError = 2,     // the command line makes no sense
  FileError = 3,      // a file cannot be read, parsed or written
  MeshUnusable = 4,   // the mesh is not a closed genus-0 manifold, or cannot be measured
  NotCertified = 5,   // the map is not one-to-one
  LimitExceeded = 6,  // a measured limit was exceeded, or with --fail-on-warnings something told
  Interrupted = 130,  // SIGINT or SIGTERM
};

/// A command line that CLI11 accepts and that makes no sense all the same.
class UsageMistake : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What people read about them, in --help and in the manual.
struct ExitMeaning {
  ExitCode code;
  const char* meaning;
};
inline constexpr ExitMeaning exit_meanings[] = {
    {Ok, "done; for map: what is on disk is certified one-to-one"},
    {InternalError, "internal error, or out of memory or threads"},
    {UsageError, "the command line makes no sense"},
    {FileError, "a file cannot be read, parsed or written"},
    {MeshUnusable,
     "the mesh is not a closed genus-0 manifold; or has no area; or, where lengths matter, no "
     "sensible size"},
    {NotCertified,
     "the map is not one-to-one, or a pin, pole or meridian is not at its place; no map written "
     "but with --keep-folded"},
    {LimitExceeded,
     "what was measured exceeds the limit; with --fail-on-warnings: something was warned of or "
     "lost; all outputs are written"},
    {Interrupted, "interrupted"},
};

}  // namespace sphparam::cli
