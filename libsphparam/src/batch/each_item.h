#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "sphparam/batch/plan.h"
#include "sphparam/parallel.h"

namespace sphparam {

/// What `look` finds of each item of a plan, in their order; asked on up to `threads` threads,
/// `grain` items at once.
template <class Look>
auto of_each_item(const BatchPlan& plan, std::int64_t grain, int threads, const Look& look) {
  std::vector<std::invoke_result_t<Look, const BatchItem&>> found(plan.items.size());
  parallel_for(std::ssize(found), grain, threads, [&](std::int64_t first, std::int64_t last) {
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i)
      found[i] = look(plan.items[i]);
  });
  return found;
}

}  // namespace sphparam
