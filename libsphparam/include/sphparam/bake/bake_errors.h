#pragma once

#include <stdexcept>
#include <string>

#include "sphparam/image/image_format.h"

namespace sphparam {

/// A setting outside its domain, or settings that do not go together.
class BakeSettingError : public std::invalid_argument {
 public:
  BakeSettingError(const char* setting, const std::string& message)
      : std::invalid_argument(std::string(setting) + ": " + message),
        setting_(setting),
        reason_(message) {}

  /// The member of `BakeSettings` or `BakeRequest` that it is about: "width".
  const std::string& setting() const { return setting_; }
  /// What is wrong with it: for who calls it by another name.
  const std::string& reason() const { return reason_; }

 private:
  std::string setting_, reason_;
};

/// A target on another sphere than the source's: every texel would show another place.
class OtherSphereError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A value that half precision cannot hold; float holds it.
class HalfRangeError : public ImageError {
 public:
  using ImageError::ImageError;
};

}  // namespace sphparam
