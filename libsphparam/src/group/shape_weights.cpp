#include "group/shape_weights.h"

#include <cmath>
#include <stdexcept>

#include "number_text.h"

namespace sphparam {
namespace {

// Shares of areas, divided by their sum and added again, are off by far less.
constexpr double rounding = 1e-9;

}  // namespace

void require_weights(const VectorX& weights) {
  if (!(weights.array() >= 0).all())
    throw std::invalid_argument("weights: one is less than 0, or no number");
  const double sum = weights.sum();
  if (!(std::abs(sum - 1) <= rounding))
    throw std::invalid_argument("weights: they sum to " + shortest(sum) + ": it must be 1");
}

}  // namespace sphparam
