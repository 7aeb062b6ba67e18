#pragma once
// The few functions that depend on the instruction set: portable.hpp says what each computes, and
// arch/<target>/primitives.hpp has this target's. CMake chooses the target (FIRMTOUCH_ARCH). For
// the library's own translation units: a user's flags must not decide what is computed here.

// Not every compiler defines these macros: arithmetic_is_sound() checks the effect of the flags.
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__)
#error "Firmtouch promises the same bits everywhere: build it without -ffast-math and its parts"
#endif
#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ != 0
#error "Firmtouch refuses NaN by comparing it: build it without -ffinite-math-only"
#endif
#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0 && __FLT_EVAL_METHOD__ != 16
#error "Firmtouch needs float computed as float, not in a wider type (x86: -mfpmath=sse -msse2)"
#endif

#ifndef FIRMTOUCH_ARCH_HEADER  // "firmtouch/arch/<target>/primitives.hpp"
#define FIRMTOUCH_ARCH_HEADER "firmtouch/arch/portable/primitives.hpp"
#endif
#include FIRMTOUCH_ARCH_HEADER
