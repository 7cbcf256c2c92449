#pragma once

#include <string>
#include <vector>

namespace sphparam {

/// What a run told people beside its results, a line each.
struct Told {
  std::vector<std::string> warnings = {};  // what may be wrong with what was made
  std::vector<std::string> notes = {};     // what was odd about files, and harmless
  std::vector<std::string> losses = {};    // what files carry and what was made of them does not
};

/// A record of JSON, an object, with `warnings`, `notes` and `losses`: what it says itself under
/// these keys, then what was told and it does not say. Ensures: the three lists are there; all else
/// is as it was. Throws: nlohmann's parse_error for what is no JSON.
std::string with_told(const std::string& record, const Told& told);

}  // namespace sphparam
