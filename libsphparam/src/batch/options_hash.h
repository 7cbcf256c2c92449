#pragma once

#include <map>
#include <string>

#include "sphparam/batch/plan.h"

namespace sphparam {

/// The hashes of what runs for items: the words without the input's path, and the content
/// of files that words name. A file is read once.
class OptionsHash {
 public:
  explicit OptionsHash(const BatchPlan& plan) : plan_(plan) {}

  /// Throws: BatchInputError for an unknown placeholder; ReadError.
  std::string of(const BatchItem& item);

 private:
  std::string content_of(const std::string& word);
  std::string content_of_file(const std::string& path);

  const BatchPlan& plan_;
  std::map<std::string, std::string> contents_;  // by the path of the file; empty: none
};

}  // namespace sphparam
