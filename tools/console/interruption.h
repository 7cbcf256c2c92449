#pragma once

namespace sphparam::cli {

/// Makes SIGINT, SIGTERM and SIGHUP end the program with exit code 130, without temporary files:
/// at once, or in good order while an `OrderlyInterruption` lives.
void end_on_interruption();

/// Makes a full pipe's end, a limit on file sizes and an input that is cut while it is read end in
/// exit code 3 with a message, not in death by SIGPIPE, SIGXFSZ or SIGBUS.
void turn_signals_into_errors();

/// From the first one on, a signal only raises the flag that `interrupted` reads, so that the work
/// can be cancelled and temporary files removed. A second signal ends the program at once,
/// its temporary files removed.
class OrderlyInterruption {
 public:
  OrderlyInterruption();
  ~OrderlyInterruption();
  OrderlyInterruption(const OrderlyInterruption&) = delete;
  OrderlyInterruption& operator=(const OrderlyInterruption&) = delete;
};

/// Did a signal arrive?
bool interrupted();

}  // namespace sphparam::cli
