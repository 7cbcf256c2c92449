#pragma once

#include <string>
#include <utility>

#include "sphparam/baselines/baseline_result.h"
#include "sphparam/errors.h"
#include "sphparam/stopwatch.h"

namespace sphparam {

/// Writes a result down while a method runs.
class Outcome {
 public:
  void finish_stage(std::string name, int iterations = 0) {
    result_.iterations += iterations;
    result_.stages.push_back({std::move(name), watch_.lap(), iterations});
  }

  BaselineResult take(SphereMap map, BaselineEnd end, std::string statement) {
    if (!map.points.allFinite()) return no_result("the map has points that are not finite");
    result_.map = std::move(map);
    result_.end = end;
    result_.statement = std::move(statement);
    return std::move(result_);
  }

  BaselineResult no_result(std::string statement) {
    result_.end = BaselineEnd::NoResult;
    result_.statement = std::move(statement);
    return std::move(result_);
  }

 private:
  BaselineResult result_;
  Stopwatch watch_;
};

/// method(outcome), with a system that cannot be solved as a statement instead of an exception.
template <class Method>
BaselineResult run_rival(Method&& method) {
  Outcome outcome;
  try {
    return method(outcome);
  } catch (const SolveError& error) {
    return outcome.no_result(error.what());
  }
}

}  // namespace sphparam
