#include "arguments/ends.h"

#include <charconv>
#include <limits>

#include "arguments/numbers.h"
#include "arguments/words.h"

namespace sphparam::cli {

std::optional<std::pair<double, double>> two_ends(const std::string& text) {
  const Words words = split(text);
  const auto read = [&words](size_t i, double& value) {
    const char* const first = words[i].data() + words[i].starts_with('+');
    std::from_chars(first, words[i].data() + words[i].size(), value);
    return complaint_of_number(words[i], Range<double>{std::numeric_limits<double>::lowest()})
        .empty();
  };
  std::pair<double, double> ends;
  if (words.size() != 2 || !read(0, ends.first) || !read(1, ends.second)) return std::nullopt;
  if (!(ends.first < ends.second)) return std::nullopt;
  return ends;
}

}  // namespace sphparam::cli
