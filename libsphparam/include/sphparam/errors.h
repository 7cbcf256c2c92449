#pragma once

#include <stdexcept>

namespace sphparam {

/// A linear or nonlinear system that could not be solved, naming the system.
class SolveError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The user's progress callback asked to stop.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

/// A map that is not what it should be: not one-to-one, or not at the places asked for.
class NotCertifiedError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A mesh that lengths cannot be taken of: without area, or of a size whose powers doubles cannot
/// hold.
class UnmeasurableMesh : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace sphparam
