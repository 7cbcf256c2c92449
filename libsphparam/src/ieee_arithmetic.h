#pragma once

// For what proves signs by the rounding of each operation. Our own build says -fno-fast-math,
// whatever flags it is given; this is for others. A program may be linked with -ffast-math, which
// flushes subnormal numbers to zero: the proofs hold then too.
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || \
    defined(__ASSOCIATIVE_MATH__)
#error "sphparam needs arithmetic as written: add -fno-fast-math after -ffast-math or -Ofast"
#endif
