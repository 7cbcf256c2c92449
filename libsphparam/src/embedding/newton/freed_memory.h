#pragma once

namespace sphparam {

/// Gives memory that has been freed back to the system, where the C library would keep it: called
/// before a stage that needs much at once, so that the peak is what is alive. Cost: some
/// microseconds, and what touching the pages again costs, about 0.1 ns a byte.
void give_back_freed_memory();

}  // namespace sphparam
