#include "embedding/newton/freed_memory.h"

#include <cstdlib>  // says whether this is glibc

#if defined(__GLIBC__)
#include <malloc.h>
#endif

// glibc keeps freed blocks between others that are alive. The levels of a hierarchy leave as many
// holes as there are levels, none of them large enough for the finest level's packs.

namespace sphparam {

void give_back_freed_memory() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

}  // namespace sphparam
