#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "trial.h"

namespace sphparam::campaign {

/// Counts outcomes, and keeps the numbers of specimens that did not end as they should.
class Tally {
 public:
  void add(std::int64_t number, const Outcome& outcome, bool compared_threads);
  /// A specimen without an outcome: "signal 11", "over 60 s".
  void add_loss(std::int64_t number, const std::string& reason);

  /// Everything certified, nothing lost, thrown or thread-dependent.
  bool all_well() const;
  nlohmann::json json() const;
  /// The stage histogram, by family.
  std::string table() const;

 private:
  struct Counts {
    long count = 0, certified = 0, float32_folded = 0;
    double seconds = 0, slowest = 0;
    std::map<std::string, long> stages;
  };

  std::map<std::string, Counts> families_;
  Counts all_;
  long compared_ = 0;
  std::uint64_t hash_ = 0;  // of all maps; the order of outcomes does not matter
  nlohmann::json rescued_ = nlohmann::json::array();  // certified, but by a fallback
  nlohmann::json uncertified_ = rescued_, lost_ = rescued_, thrown_ = rescued_,
                 thread_dependent_ = rescued_;
};

}  // namespace sphparam::campaign
