#pragma once

#include <cstdint>
#include <functional>

namespace sphparam {

/// How many threads to use when asked for `threads` (0 or less: all cores).
int resolve_threads(int threads);

/// Calls body(first, last) on disjoint chunks that cover [0, count), on up to `threads` threads.
///
/// Every chunk but the last has `grain` items wherever it runs, so a reduction that keeps one
/// partial result per chunk (index first / grain) and adds them in order gives the same bits for
/// any number of threads. Runs on the calling thread alone when there is only one chunk, or another
/// thread's loop runs as it begins.
/// Throws: the exception of the first chunk whose body threw, after all bodies have ended;
/// Cancelled, see stopped_by.h.
void parallel_for(std::int64_t count, std::int64_t grain, int threads,
                  const std::function<void(std::int64_t first, std::int64_t last)>& body);

/// Sum over [0, count) of term(i), in fixed chunks: the same bits for any number of threads.
double parallel_sum(std::int64_t count, int threads,
                    const std::function<double(std::int64_t first, std::int64_t last)>& chunk_sum);

}  // namespace sphparam
