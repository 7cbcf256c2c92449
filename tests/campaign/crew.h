#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace sphparam::campaign {

struct Assignment {
  std::int64_t first, last;  // items first … last − 1
  int jobs;                  // processes at a time
  double time_limit;         // seconds an item, of processor time; ten times that of wall time
  std::int64_t batch = 200;  // items that a child gets at once
};

/// Works through items in child processes, so that one that crashes or hangs costs only itself.
///
/// work: in a child; the result of an item as one line of text, without the newline.
/// on_result: in the parent, in no particular order.
/// on_loss: the same for items without a result, with the reason ("signal 11", "over 60 s").
/// Throws: std::runtime_error, if the system has no more processes or pipes.
void run_crew(const Assignment& assignment, const std::function<std::string(std::int64_t)>& work,
              const std::function<void(std::int64_t, const std::string&)>& on_result,
              const std::function<void(std::int64_t, const std::string&)>& on_loss);

}  // namespace sphparam::campaign
