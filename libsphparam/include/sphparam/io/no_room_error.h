#pragma once

#include "sphparam/io/safe_file.h"

namespace sphparam {

/// The machine takes no more bytes, of whatever file: a disk, a quota or a limit is full, a file
/// system is read-only or broken. `batch` ends with it, where another WriteError is an item's own.
class NoRoomError : public WriteError {
 public:
  using WriteError::WriteError;
};

}  // namespace sphparam
