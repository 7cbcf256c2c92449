// Three kinds of reader: a person at a terminal gets a line that is rewritten and coloured marks, a
// log file gets plain lines, a program gets JSON lines.

#include "console/console.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "console/interruption.h"
#include "sphparam/io/losses.h"

namespace sphparam::cli {

namespace {

bool is_terminal() {
  const char* term = std::getenv("TERM");
  return isatty(STDERR_FILENO) && !(term && std::string_view(term) == "dumb");
}

/// https://no-color.org: any non-empty value means no.
bool wants_colour() {
  const char* no_colour = std::getenv("NO_COLOR");
  return is_terminal() && !(no_colour && *no_colour);
}

void print_line(const std::string& text) { std::fprintf(stderr, "%s\n", text.c_str()); }

std::string coloured(const char* code, const std::string& text) {
  return wants_colour() ? "\033[" + std::string(code) + "m" + text + "\033[0m" : text;
}

}  // namespace

void print_error(const std::string& text) {
  print_line("sphparam: " + coloured("31", "error:") + " " + text);
}

Console::Console(Verbosity verbosity, ProgressStyle progress)
    : verbosity_(verbosity),
      style_(progress),
      rewrites_line_(progress == ProgressStyle::Auto && verbosity != Verbosity::Quiet &&
                     is_terminal()) {}

Console::~Console() { clear_progress(); }

void Console::error(const std::string& text) {
  clear_progress();
  print_error(text);
}

void Console::warning(const std::string& text) {
  (losses_among({text}).empty() ? so_far_.warnings : so_far_.losses).push_back(text);
  if (verbosity_ == Verbosity::Quiet) return;
  clear_progress();
  print_line("sphparam: " + coloured("33", "warning:") + " " + text);
}

void Console::say(const std::string& text) {
  if (verbosity_ == Verbosity::Quiet) return;
  clear_progress();
  print_line(text);
}

void Console::detail(const std::string& text) {
  if (verbosity_ != Verbosity::Verbose) return;
  clear_progress();
  print_line(text);
}

void Console::loss(const std::string& text) {
  so_far_.losses.push_back(text);
  say("  " + text);
}

void Console::note(const std::string& text) {
  so_far_.notes.push_back(text);
  detail("  note: " + text);
}

bool Console::progress(std::string_view stage, double fraction, const std::string& detail) {
  const int percent = static_cast<int>(100 * std::clamp(fraction, 0.0, 1.0));
  const std::string name(stage);
  if (style_ == ProgressStyle::Json) {
    const std::string line =
        "{\"stage\":\"" + name + "\",\"percent\":" + std::to_string(percent) + "}";
    if (line != told_) print_line(line);
    told_ = line;
  } else if (rewrites_line_) {
    const std::string line = name + " " + std::to_string(percent) + " %" + detail;
    if (line != shown_) {
      std::fprintf(stderr, "\r\033[K%s", line.c_str());
      std::fflush(stderr);
      shown_ = line;
    }
  }
  return !interrupted();
}

void Console::clear_progress() {
  if (shown_.empty()) return;
  std::fprintf(stderr, "\r\033[K");
  std::fflush(stderr);
  shown_.clear();
}

}  // namespace sphparam::cli
