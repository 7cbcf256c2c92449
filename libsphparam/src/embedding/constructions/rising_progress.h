#pragma once

#include <algorithm>
#include <string_view>

#include "sphparam/progress.h"

namespace sphparam {

/// The progress of an embedding that is made of several: it rises, part after part, under the name
/// of an embedding. Our own.
class RisingProgress {
 public:
  explicit RisingProgress(const Progress& told) : to_(told) {}

  /// From here on comes a part that is so much of what is left.
  void begin(double share) {
    begin_ = reached_;
    length_ = share * (1 - reached_);
  }
  Progress progress() {
    if (!to_) return {};
    return [this](std::string_view stage, double fraction) {
      if (stage == "embedding") reached_ = std::max(reached_, begin_ + length_ * fraction);
      if (begin_ == 0 && stage != "embedding") return to_(stage, fraction);
      return to_("embedding", reached_);  // nobody wants to know of a second hierarchy
    };
  }
  void end() { report(to_, "embedding", 1); }

 private:
  const Progress& to_;
  double begin_ = 0, length_ = 1, reached_ = 0;
};

}  // namespace sphparam
