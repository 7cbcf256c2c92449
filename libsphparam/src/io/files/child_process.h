#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>

namespace sphparam {

/// The child ended otherwise than by the end of its work: by a signal, or for lack of memory
/// or time.
class ChildEnded : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a child may take: processor time, and memory beyond what is there when it begins. 0: no
/// limit. Whoever may take less here takes less there.
struct ChildLimits {
  std::uint64_t seconds = 0, bytes = 0;
};

/// What `work` returns, done in a process of its own: where code of others meets files of
/// strangers, its crash is an error here. The child ends with its parent, and by the signals that
/// interrupt. Throws: ChildEnded; std::runtime_error with the message of what `work` throws;
/// std::system_error where there can be no other process. Cost: a fork, and the bytes through a
/// pipe.
std::string result_of_child(const std::function<std::string()>& work,
                            const ChildLimits& limits = {});

}  // namespace sphparam
