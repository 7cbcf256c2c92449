#include "console/interruption.h"

#include <unistd.h>

#include <csignal>

#include "console/exit_codes.h"
#include "io/files/temporary_file.h"

namespace sphparam::cli {

namespace {

volatile std::sig_atomic_t orderly = 0;
volatile std::sig_atomic_t arrived = 0;

void on_signal(int) {
  if (orderly && !arrived) {
    arrived = 1;
    return;
  }
  remove_temporaries_on_signal();
  _exit(Interrupted);
}

/// Input files are mapped into memory: this is how one tells that it was cut while it was read.
void on_lost_file(int) {
  constexpr char message[] =
      "sphparam: error: a file was cut while it was read, or its disk fails\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, message, sizeof message - 1);
  remove_temporaries_on_signal();
  _exit(FileError);
}

void handle(int number, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(number, &action, nullptr);
}

bool is_ignored(int number) {
  struct sigaction action = {};
  return sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void end_on_interruption() {
  // Who started the program may have it ignore some: nohup, and scripts for what runs beside them.
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    if (!is_ignored(number)) handle(number, on_signal);
}

void turn_signals_into_errors() {
  handle(SIGPIPE, SIG_IGN);
  handle(SIGXFSZ, SIG_IGN);
  handle(SIGBUS, on_lost_file);
}

OrderlyInterruption::OrderlyInterruption() { orderly = 1; }

// What is written is there: it is no failure when a signal comes as the program ends.
OrderlyInterruption::~OrderlyInterruption() = default;

bool interrupted() { return arrived != 0; }

}  // namespace sphparam::cli
