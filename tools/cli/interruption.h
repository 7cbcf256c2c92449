#pragma once

namespace sphparam::tools {

/// Makes SIGINT and SIGTERM end the program with exit code 130: at once while there is nothing to
/// clean up (reading), in good order while an `OrderlyInterruption` lives.
void end_on_interruption();

/// While one lives, a signal only raises the flag that `interrupted` reads, so that the work can be
/// cancelled and temporary files removed. A second signal ends the program at once.
class OrderlyInterruption {
 public:
  OrderlyInterruption();
  ~OrderlyInterruption();
  OrderlyInterruption(const OrderlyInterruption&) = delete;
  OrderlyInterruption& operator=(const OrderlyInterruption&) = delete;
};

/// Did a signal arrive?
bool interrupted();

}  // namespace sphparam::tools
