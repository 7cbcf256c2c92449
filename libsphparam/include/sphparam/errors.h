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

}  // namespace sphparam
