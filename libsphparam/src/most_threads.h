#pragma once

namespace sphparam {

/// How many threads loops of this process have at most where they are asked for all cores; 0: all.
/// For a program whose user says once how many: what has no number of its own (a mesh that is
/// inspected as it is read) then keeps to it as well. Loops that are asked for a number have that.
void keep_to_threads(int most);

}  // namespace sphparam
