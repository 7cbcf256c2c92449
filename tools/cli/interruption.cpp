#include "cli/interruption.h"

#include <unistd.h>

#include <csignal>

#include "cli/exit_codes.h"

namespace sphparam::tools {

namespace {

volatile std::sig_atomic_t orderly = 0;
volatile std::sig_atomic_t arrived = 0;

void on_signal(int) {
  if (!orderly || arrived) _exit(Interrupted);
  arrived = 1;
}

}  // namespace

void end_on_interruption() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

OrderlyInterruption::OrderlyInterruption() { orderly = 1; }
OrderlyInterruption::~OrderlyInterruption() { orderly = 0; }

bool interrupted() { return arrived != 0; }

}  // namespace sphparam::tools
