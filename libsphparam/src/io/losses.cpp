#include "sphparam/io/losses.h"

#include <algorithm>
#include <iterator>

namespace sphparam {
namespace {

constexpr std::string_view prefix = "not carried: ";

}  // namespace

void add_loss(std::vector<std::string>& notes, const std::string& what) {
  notes.push_back(std::string(prefix) + one_line(what));
}

std::vector<std::string> losses_among(const std::vector<std::string>& notes) {
  std::vector<std::string> losses;
  std::copy_if(notes.begin(), notes.end(), std::back_inserter(losses),
               [](const std::string& note) { return note.starts_with(prefix); });
  return losses;
}

std::string enumerated(const std::vector<std::string>& words) {
  constexpr std::size_t most_listed = 8;
  const std::size_t listed = words.size() > most_listed ? most_listed - 1 : words.size();
  std::string text;
  for (std::size_t i = 0; i < listed; ++i) {
    const bool last = i + 1 == words.size();
    text += (i == 0 ? "" : last ? " and " : ", ") + words[i];
  }
  if (listed < words.size()) text += " and " + std::to_string(words.size() - listed) + " others";
  return text;
}

}  // namespace sphparam
