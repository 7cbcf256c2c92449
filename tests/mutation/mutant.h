#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>

/// Which mutant of those that `run` wrote into the sources is alive, if any; and which are reached.
namespace mutation {

/// SPHPARAM_MUTANT; 0, which is none, without it.
inline const int chosen = [] {
  const char* const number = std::getenv("SPHPARAM_MUTANT");
  return number ? std::atoi(number) : 0;
}();

/// A byte a mutant in the file SPHPARAM_REACHED, which processes share, also those that crash.
inline char* const reached = []() -> char* {
  constexpr size_t most_mutants = 65536;
  const char* const name = std::getenv("SPHPARAM_REACHED");
  const int file = name ? open(name, O_RDWR) : -1;
  if (file < 0) return nullptr;
  void* const bytes = mmap(nullptr, most_mutants, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  return bytes == MAP_FAILED ? nullptr : static_cast<char*>(bytes);
}();

inline bool on(int number) {
  if (reached) reached[number] = 1;
  return number == chosen;
}

inline double sign(int number) { return on(number) ? -1.0 : 1.0; }

}  // namespace mutation
