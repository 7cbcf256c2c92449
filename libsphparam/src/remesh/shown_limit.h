#pragma once

#include <cstdint>

namespace sphparam {

/// A limit surface is shown and measured cut so fine that its flatness is not what is seen.
constexpr std::int64_t shown_pieces = 250'000;

}  // namespace sphparam
