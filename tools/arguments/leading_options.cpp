#include "arguments/leading_options.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace sphparam::cli {

namespace {

constexpr std::array<std::string_view, 5> flags = {"-q", "--quiet", "-v", "--verbose",
                                                   "--fail-on-warnings"};
constexpr std::array<std::string_view, 4> with_value = {"--progress", "--threads", "--max-memory",
                                                        "--limit"};

template <class Names>
bool is_among(const Names& names, std::string_view word) {
  return std::find(names.begin(), names.end(), word) != names.end();
}

/// How many words the option takes, with its value; 0: it is none of these.
int words_of_option(std::string_view word) {
  if (is_among(flags, word)) return 1;
  if (is_among(with_value, word)) return 2;
  return is_among(with_value, word.substr(0, word.find('='))) ? 1 : 0;
}

std::vector<std::string> steps;

}  // namespace

void put_subcommand_first(int argc, char** argv) {
  int at = 1;
  while (at < argc && words_of_option(argv[at]) > 0) at += words_of_option(argv[at]);
  if (at == 1 || at >= argc || argv[at][0] == '-') return;
  const int words = std::string_view(argv[at]) == "batch" && at + 1 < argc ? 2 : 1;
  std::rotate(argv + 1, argv + at, argv + at + words);
}

void take_steps(int& argc, char** argv) {
  const auto is = [&](int at, std::string_view word) { return at < argc && argv[at] == word; };
  if (!is(1, "batch") || !is(2, "plan")) return;
  for (int i = 3; i < argc; ++i) {
    if (!is(i, "--")) continue;
    steps.assign(argv + i, argv + argc);
    argc = i;
  }
}

const std::vector<std::string>& taken_steps() { return steps; }

}  // namespace sphparam::cli
