#include <fcntl.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <stdexcept>

#include "io/files/child_process.h"

using namespace sphparam;

TEST_CASE("child process: what it makes comes back, also much of it") {
  CHECK(result_of_child([] { return std::string("made"); }) == "made");
  CHECK(result_of_child([] { return std::string(); }).empty());
  CHECK(result_of_child([] { return std::string(5'000'000, 'x'); }) == std::string(5'000'000, 'x'));
}

TEST_CASE("child process: no program that is started meanwhile has its pipe") {
  const auto descriptors_of_programs = [] {
    std::string found;
    for (int number = 0; number < 256; ++number) {
      const int flags = ::fcntl(number, F_GETFD);
      if (flags >= 0 && !(flags & FD_CLOEXEC)) found += std::to_string(number) + " ";
    }
    return found;
  };
  CHECK(result_of_child(descriptors_of_programs) == descriptors_of_programs());
}

TEST_CASE("child process: one that takes more time or memory than it may is an error") {
  const auto runs_on = []() -> std::string {
    for (volatile unsigned i = 0;;) i = i + 1;
  };
  CHECK_THROWS_WITH(result_of_child(runs_on, {.seconds = 1}), "takes more than 1 s");
#ifndef __SANITIZE_ADDRESS__
  const auto fills = [] { return std::string(std::size_t{256} << 20, 'x'); };
  CHECK_THROWS(result_of_child(fills, {.bytes = 16 << 20}));
  CHECK(result_of_child([] { return std::string(1000, 'x'); }, {.bytes = 64 << 20}).size() == 1000);
#endif
}

TEST_CASE("child process: errors keep their words, a crash is an error, and nothing here changes") {
  int here = 1;
  CHECK_THROWS_WITH(result_of_child([]() -> std::string { throw std::runtime_error("why"); }),
                    "why");
  CHECK_THROWS_AS(result_of_child([]() -> std::string {
                    std::raise(SIGSEGV);
                    return "";
                  }),
                  ChildEnded);
  CHECK_THROWS_AS(result_of_child([]() -> std::string { _exit(0); }), ChildEnded);
  CHECK_THROWS_AS(result_of_child([]() -> std::string { throw 1; }), ChildEnded);
  CHECK(result_of_child([&] {
          here = 2;
          return std::string("x");
        }) == "x");
  CHECK(here == 1);
}
