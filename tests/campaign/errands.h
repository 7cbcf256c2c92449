#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace sphparam::campaign {

/// What is asked of the program in one folder: files that are there before, and command lines, one
/// after the other as long as each ends with 0.
struct Errand {
  std::string story;
  std::vector<std::pair<std::string, std::string>> files;  // names and contents
  std::vector<std::vector<std::string>> commands;          // without the program's name
};

/// The subcommands that errands are made for.
const std::vector<std::string>& errand_names();

/// The errand with a given number for a subcommand: a hurt mesh, mapped before or by the subcommand
/// itself, and options by chance, all of which make sense. `picture`: a PNG twice as wide as high.
/// Ensures: the same for the same arguments.
Errand make_errand(const std::string& command, std::uint64_t seed, std::uint64_t number,
                   const std::string& picture);

}  // namespace sphparam::campaign
