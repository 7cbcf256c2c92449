#include <catch2/catch.hpp>
#include <cstdlib>
#include <set>
#include <sstream>

#include "program.h"

/// The manual page and the completions say what --help says.
namespace sphparam::tests {

namespace {

using Catch::Contains;
using Catch::StartsWith;

const std::vector<std::string> subcommands = {
    "info",         "map",        "match",     "group",        "repair",      "wrap",
    "survey",       "verify",     "render",    "compare",      "bake",        "paint",
    "remesh",       "unimage",    "measure",   "export",       "report",      "spharm",
    "batch",        "batch plan", "batch run", "batch status", "batch retry", "batch table",
    "batch report", "manual",     "completion"};

/// Every "--name" in a text.
std::set<std::string> long_options(const std::string& text) {
  std::set<std::string> names;
  for (size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at + 2)) {
    size_t end = at + 2;
    while (end < text.size() && (std::islower(text[end]) || text[end] == '-')) ++end;
    if (end > at + 3) names.insert(text.substr(at, end - at));
  }
  return names;
}

/// "batch plan" is two words.
std::string help_of(const std::string& command) {
  std::vector<std::string> words;
  std::stringstream split(command);
  for (std::string word; split >> word;) words.push_back(word);
  words.emplace_back("--help");
  return sphparam_program(words).out;
}

std::string without(std::string text, const std::string& part) {
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at)) {
    text.erase(at, part.size());
  }
  return text;
}

}  // namespace

TEST_CASE("manual: every option of every subcommand and every exit code is in it") {
  const Ended manual = sphparam_program({"manual"});
  REQUIRE(manual.code == 0);
  const std::string plain = without(manual.out, "\\");
  for (const std::string& command : subcommands) {
    CHECK_THAT(plain, Contains("sphparam " + command));
    for (const std::string& option : long_options(help_of(command))) {
      INFO(command << " " << option);
      CHECK_THAT(plain, Contains("fB" + option + "fR"));
    }
  }
  for (const char* code : {"0", "1", "2", "3", "4", "5", "6", "130"}) {
    CHECK_THAT(plain, Contains("fB" + std::string(code) + "fR\n"));
  }
  for (const char* section :
       {"NAME", "SYNOPSIS", "DESCRIPTION", "COMMANDS", "FILES", "ENVIRONMENT", "EXIT STATUS"}) {
    CHECK_THAT(plain, Contains(std::string(".SH ") + section + "\n"));
  }
}

TEST_CASE("manual: roff has nothing to complain about") {
  if (std::system("command -v groff >/dev/null") != 0) {
    WARN("skipped: no groff");
    return;
  }
  const Folder folder;
  write_bytes(folder / "page.1", sphparam_program({"manual"}).out);
  const std::string command = "groff -man -Tutf8 -ww " + (folder / "page.1") + " >" +
                              (folder / "text") + " 2>" + (folder / "complaints");
  CHECK(std::system(command.c_str()) == 0);
  CHECK(bytes_of(folder / "complaints").empty());
}

TEST_CASE("completion: every shell knows every option and word") {
  const std::string bash = sphparam_program({"completion", "bash"}).out;
  const std::string zsh = sphparam_program({"completion", "zsh"}).out;
  const std::string fish = sphparam_program({"completion", "fish"}).out;
  CHECK_THAT(zsh, StartsWith("#compdef sphparam\n"));
  for (const std::string& option : long_options(sphparam_program({"map", "--help"}).out)) {
    INFO(option);
    CHECK_THAT(bash, Contains(option));
    CHECK_THAT(zsh, Contains(option));
    CHECK_THAT(fish, Contains(" -l " + option.substr(2)));
  }
  for (const std::string& script : {bash, zsh, fish}) {
    for (const char* word : {"curvilinear", "equal-area", "symmetric-dirichlet", "checker"}) {
      CHECK_THAT(script, Contains(word));
    }
  }
  CHECK(sphparam_program({"completion", "tcsh"}).code == 2);
}

TEST_CASE("completion: bash completes subcommands, options and words") {
  const Folder folder;
  const auto completed = [&](const std::string& line) {
    std::stringstream split(line);
    std::string words, word;
    int count = 0;
    while (split >> word) words.append(" '").append(word).append("'"), ++count;
    if (line.back() == ' ') words += " ''", ++count;
    write_bytes(folder / "script", sphparam_program({"completion", "bash"}).out +
                                       "compopt() { :; }\n"
                                       "COMP_WORDS=(" +
                                       words + "); COMP_CWORD=" + std::to_string(count - 1) +
                                       "; _sphparam; echo \"${COMPREPLY[*]}\"\n");
    const std::string command = "bash " + (folder / "script") + " >" + (folder / "reply");
    REQUIRE(std::system(command.c_str()) == 0);
    return bytes_of(folder / "reply");
  };
  CHECK(completed("sphparam ver") == "verify\n");
  CHECK(completed("sphparam map --pol") == "--poles\n");
  CHECK(completed("sphparam map a.obj --method cur") == "curvilinear\n");
  CHECK(completed("sphparam map a.obj --poles ") == "auto none up\n");
  CHECK(completed("sphparam render m --view ") == "mesh sphere both\n");
  CHECK(completed("sphparam batch st") == "status\n");
  CHECK(completed("sphparam batch run --rehash --any") == "--any-program\n");
  CHECK(completed("sphparam completion ") == "bash zsh fish\n");
  CHECK(completed("sphparam -q --threads 2 map --pol") == "--poles\n");
  CHECK(completed("sphparam -q batch st") == "status\n");
  // Files, also where several may stand or the kind of file is said.
  const std::string begun = folder / "scri";
  for (const std::string line :
       {"map ", "map a.obj --data ", "report a.obj -o ", "batch table work -o "})
    CHECK(completed("sphparam " + line + begun) == begun + "pt\n");
  write_bytes(folder / "blank name", "");  // one word of the reply, not two
  const std::string script = bytes_of(folder / "script");
  const std::string asked = "cd " + (folder / "") +
                            "; COMP_WORDS=(sphparam map blan); COMP_CWORD=2; "
                            "_sphparam; echo \"${#COMPREPLY[@]} ${COMPREPLY[0]}\"\n";
  write_bytes(folder / "script", script.substr(0, script.rfind("COMP_WORDS=(")) + asked);
  REQUIRE(std::system(("bash " + (folder / "script") + " >" + (folder / "reply")).c_str()) == 0);
  CHECK(bytes_of(folder / "reply") == "1 blank name\n");
}

}  // namespace sphparam::tests
