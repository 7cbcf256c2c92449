#pragma once

#include <vector>

#include "embedding/newton/global_newton.h"

namespace sphparam {

/// What Newton steps on a level have gained, and from that what more of them would. Gains are
/// shares of the energy. Our own.
class Outlook {
 public:
  /// `rest`: what may be left.
  explicit Outlook(double rest) : rest_(rest) {}

  /// A step and its sweeps, and the energies before and after these.
  void note(const GlobalNewton::Step& made, double before, double after);

  /// Of the first step, or what it promised: a few triangles can block a step.
  double first_gain() const { return first_gain_; }

  /// Estimate of what more steps would gain.
  double left() const { return left_; }

  /// Is no more than the rest left, or do steps hardly move any longer?
  bool settled() const;

  /// By which Hessian a next step gets farthest, where the minimum itself is wanted: the exact one
  /// as soon as a step promises little, and then as long as its systems are solved and its steps
  /// not cut short.
  Curvature next() const { return next_; }

 private:
  double rest_, first_gain_ = 0, left_ = 1;
  std::vector<double> gains_;
  int idle_ = 0;  // steps in a row that gained next to nothing
  Curvature next_ = Curvature::Projected;
};

}  // namespace sphparam
