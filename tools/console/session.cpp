#include "console/session.h"

#include "console/exit_codes.h"
#include "most_threads.h"
#include "number_text.h"

namespace sphparam::cli {

namespace {

Verbosity verbosity(const CommonArguments& arguments) {
  return arguments.quiet     ? Verbosity::Quiet
         : arguments.verbose ? Verbosity::Verbose
                             : Verbosity::Normal;
}

}  // namespace

int strict_code(const CommonArguments& arguments, int code) {
  if (!arguments.strict || code != Ok || arguments.complaints == 0) return code;
  print_error("--fail-on-warnings: " + counted(static_cast<long>(arguments.complaints), "warning") +
              " of what is odd or lost; all outputs are written");
  return LimitExceeded;
}

Session::Session(const CommonArguments& arguments)
    : console(verbosity(arguments), arguments.progress), arguments_(arguments) {
  keep_to_threads(arguments.threads);
}

Session::~Session() {
  arguments_.complaints += console.told().warnings.size() + console.told().losses.size();
}

Progress Session::progress() {
  return [this](std::string_view stage, double done) { return console.progress(stage, done); };
}

void Session::warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) console.warning(warning);
}

void Session::add_report(const std::function<std::string()>& report) {
  if (!arguments_.json.empty()) report_ = report();
}

void Session::publish() {
  hold_signals();  // a handler that ends at once would say 130 of files that have their names
  if (interrupted()) throw Cancelled();
  if (report_) files.add(arguments_.json, with_told(*report_, console.told()));
  files.publish();
  console.clear_progress();
}

}  // namespace sphparam::cli
