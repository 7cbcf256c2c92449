#pragma once

#include <string>
#include <vector>

#include "sphparam/batch/plan.h"

namespace sphparam {

/// A reason without what differs from shape to shape: its names and its numbers.
struct ReasonWording {
  std::string kind;                  // equal of reasons that are alike
  std::vector<std::string> numbers;  // that it lacks, in order
};
ReasonWording wording_of(const std::string& reason, const BatchItem& item);

/// Reasons of one kind, in one line for people.
class AlikeReasons {
 public:
  void add(const std::string& reason, const BatchItem& item, const ReasonWording& wording);

  /// Of one reason, and of equal ones, that; else with NAME for what a shape is called, numbers
  /// that differ from the least to the greatest, "2 to 12", and * for those within a word.
  std::string text() const;

 private:
  struct Range {
    std::string least, greatest;
  };

  std::string first_, kind_;
  bool has_first_ = false, equal_ = true;
  std::vector<Range> ranges_;
};

}  // namespace sphparam
