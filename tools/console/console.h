#pragma once

#include <string>
#include <string_view>

#include "sphparam/records/told.h"

namespace sphparam::cli {

enum class Verbosity { Quiet, Normal, Verbose };
enum class ProgressStyle {
  Auto,  // one line that is rewritten, on a terminal only
  None,
  Json,  // one JSON object a line
};

/// Messages for people, all on standard error: standard output is for data.
class Console {
 public:
  Console(Verbosity verbosity, ProgressStyle progress);
  ~Console();

  void error(const std::string& text);    // always
  void warning(const std::string& text);  // unless quiet
  void say(const std::string& text);      // the result, unless quiet
  void detail(const std::string& text);   // when verbose
  void loss(const std::string& text);     // what an output does not carry: as `say`
  void note(const std::string& text);     // what is odd and harmless: as `detail`

  /// All warnings, notes and losses so far, shown or not. A warning that something is not carried
  /// is a loss.
  const Told& told() const { return so_far_; }

  /// Shows how far a stage is. Returns false once a signal asked the program to stop, as the
  /// library's progress callback does. `detail`: more of it for people, as a rate. As JSON a line
  /// is told when stage or percent change.
  bool progress(std::string_view stage, double fraction, const std::string& detail = "");
  /// Erases the progress line.
  void clear_progress();

 private:
  Verbosity verbosity_;
  ProgressStyle style_;
  bool rewrites_line_;
  std::string shown_;  // the line that is rewritten
  std::string told_;   // the last of the JSON lines
  Told so_far_;
};

/// Prints "sphparam: error: …", in red where the terminal wants colour.
void print_error(const std::string& text);

}  // namespace sphparam::cli
