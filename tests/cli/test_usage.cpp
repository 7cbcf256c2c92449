#include <catch2/catch.hpp>

#include "program.h"
#include "support/test_meshes.h"

namespace sphparam::tests {

namespace {

using Catch::Contains;
using Catch::StartsWith;

}  // namespace

TEST_CASE("program: --version says the version on standard output") {
  const Ended ended = sphparam_program({"--version"});
  CHECK(ended.code == 0);
  CHECK_THAT(ended.out, StartsWith("sphparam 0."));
  CHECK(ended.err.empty());
}

TEST_CASE("program: --help shows examples before options and documents the exit codes") {
  const Ended ended = sphparam_program({"--help"});
  CHECK(ended.code == 0);
  CHECK(ended.out.find("Examples:") < ended.out.find("Usage:"));
  CHECK_THAT(ended.out, Contains("130  interrupted"));
}

TEST_CASE("program: every subcommand has examples before its options") {
  for (const char* command : {"info", "map", "verify", "render", "compare", "measure"}) {
    const Ended ended = sphparam_program({command, "--help"});
    CHECK(ended.code == 0);
    CHECK(ended.out.find("Examples:") < ended.out.find("Usage:"));
  }
}

TEST_CASE("program: no arguments give a short help and the usage code") {
  const Ended ended = sphparam_program({});
  CHECK(ended.code == 2);
  CHECK(ended.out.empty());
  CHECK_THAT(ended.err, Contains("sphparam map"));
}

TEST_CASE("program: a mistyped subcommand or option is answered with the one that was meant") {
  const Ended command = sphparam_program({"mpa", "x.obj"});
  CHECK(command.code == 2);
  CHECK_THAT(command.err, Contains("unknown subcommand mpa") && Contains("did you mean map?"));

  const Ended option = sphparam_program({"map", "x.obj", "--tread", "2"});
  CHECK(option.code == 2);
  CHECK_THAT(option.err, Contains("unknown option --tread") && Contains("did you mean --threads?"));

  const Ended nonsense = sphparam_program({"map", "x.obj", "-o", "y.ply", "--xyzzy"});
  CHECK(nonsense.code == 2);
  CHECK_THAT(nonsense.err, !Contains("did you mean"));
}

TEST_CASE("program: command lines that make no sense end with code 2 and touch nothing") {
  const std::vector<std::vector<std::string>> senseless = {
      {"map"},
      {"map", "x.obj"},
      {"map", "x.obj", "-o", "y.ply", "--method", "magic"},
      {"map", "x.obj", "-o", "y.ply", "--poles", "3"},
      {"map", "x.obj", "-o", "y.ply", "--poles", "3,3"},
      {"map", "x.obj", "-o", "y.ply", "--poles", "3,4,5"},
      {"map", "x.obj", "-o", "y.ply", "--lambda", "-1"},
      {"map", "x.obj", "-o", "y.ply", "--lambda", "much"},
      {"map", "x.obj", "-o", "y.ply", "--epsilon", "0.1"},  // only the paper's method reads it
      {"map", "x.obj", "-o", "y.ply", "--method", "curvilinear", "--sweeps", "1"},
      {"map", "x.obj", "-o", "-", "--json", "-"},
      {"map", "x.obj", "-o", "y.obj"},
      {"map", "x.obj", "-o", "y.ply", "--sphere", "y.stl"},
      {"map", "x.obj", "-o", "y.ply", "--sphere", "y.ply"},
      {"info"},
      {"verify"},
      {"verify", "a", "b", "c"},
  };
  for (const auto& arguments : senseless) {
    std::string line;
    for (const std::string& argument : arguments) line += argument + " ";
    INFO(line);
    const Ended ended = sphparam_program(arguments);
    CHECK(ended.code == 2);
    CHECK(ended.out.empty());
    CHECK_THAT(ended.err, Contains("error:") && Contains("--help"));
  }
}

TEST_CASE("program: standard output that cannot be written ends with 3") {
  if (!fs::exists("/dev/full")) return;
  const std::string ball = obj_text(icosphere(1));
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"info", "-"}, {"verify", "-"}, {"map", "-", "-o", "-"}}) {
    CHECK(sphparam_program(arguments, ball, "/dev/full").code == 3);
  }
}

}  // namespace sphparam::tests
