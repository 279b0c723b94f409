/* SPDX-License-Identifier: Apache-2.0 */
/* What sources of glibc's mathematics ask of glibc, included before each of them. */
#pragma once
#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>

/* Other names of a function, versions, and errors that the C of 1989 reported. */
#define attribute_hidden
#define libm_hidden_def(name)
#define libm_alias_double(name, alias)
#define libm_alias_finite(name, alias)
#define strong_alias(name, alias)
#define weak_alias(name, alias)
#define versioned_symbol(...)
#define LIBM_SVID_COMPAT 0
#define SHLIB_COMPAT(...) 0

/* The compiler and the processor. */
#define __always_inline inline __attribute__((always_inline))
#define __glibc_likely(x) __builtin_expect((x), 1)
#define __glibc_unlikely(x) __builtin_expect((x), 0)
#define __GNUC_PREREQ(major, minor) 1
#define DIAG_PUSH_NEEDS_COMMENT
#define DIAG_POP_NEEDS_COMMENT
#define DIAG_IGNORE_Os_NEEDS_COMMENT(version, option)
#define __set_errno(value) (errno = (value))
#define TOINT_INTRINSICS 0
#define FIX_INT_FP_CONVERT_ZERO 0
#define HIGH_ORDER_BIT_IS_SET_FOR_SNAN 0
#define LITTLE_ENDI 1
#define HIGH_HALF 1
#define LOW_HALF 0

/* Rounding is to nearest; nobody looks at the flags of exceptions. */
#define SET_RESTORE_ROUND(mode)
#define SET_RESTORE_ROUND_53BIT(mode)
#define math_narrow_eval(x) (x)
#define math_check_force_underflow(x) ((void)0)
#define math_check_force_underflow_nonneg(x) ((void)0)
#define math_force_eval(x) ((void)(x))
#define math_opt_barrier(x)        \
  ({                               \
    __typeof(x) value_ = (x);      \
    __asm__("" : "+x"(value_));    \
    value_;                        \
  })

/* The words of a double. */
typedef union {
  double value;
  struct {
    uint32_t low, high;
  } half;
  uint64_t word;
} words_of_double;
#define WITH_WORDS(d, ...)           \
  do {                               \
    words_of_double w_ = {(d)};      \
    __VA_ARGS__;                     \
  } while (0)
#define EXTRACT_WORDS(h, l, d) WITH_WORDS(d, (h) = w_.half.high; (l) = w_.half.low)
#define GET_HIGH_WORD(h, d) WITH_WORDS(d, (h) = w_.half.high)
#define GET_LOW_WORD(l, d) WITH_WORDS(d, (l) = w_.half.low)
#define EXTRACT_WORDS64(w, d) WITH_WORDS(d, (w) = w_.word)
#define INSERT_WORDS(d, h, l) WITH_WORDS(0, w_.half.high = (h); w_.half.low = (l); (d) = w_.value)
#define INSERT_WORDS64(d, w) WITH_WORDS(0, w_.word = (w); (d) = w_.value)
#define SET_HIGH_WORD(d, h) WITH_WORDS(d, w_.half.high = (h); (d) = w_.value)
#define SET_LOW_WORD(d, l) WITH_WORDS(d, w_.half.low = (l); (d) = w_.value)

/* What is compiled for several processors has the processor in its name. */
#ifdef PROCESSOR
#define JOINED(name, processor) name##processor
#define FOR(name, processor) JOINED(name, processor)
#define __ieee754_acos FOR(acos, PROCESSOR)
#define __ieee754_asin FOR(asin, PROCESSOR)
#define __ieee754_atan2 FOR(atan2, PROCESSOR)
#define __atan FOR(atan, PROCESSOR)
#define __cos FOR(cos, PROCESSOR)
#define __exp FOR(exp, PROCESSOR)
#define __expm1 FOR(expm1, PROCESSOR)
#define __log FOR(log, PROCESSOR)
#define __log1p FOR(log1p, PROCESSOR)
#define __pow FOR(pow, PROCESSOR)
#define __sin FOR(sin, PROCESSOR)
#define __sincos FOR(sincos, PROCESSOR)
#define __tan FOR(tan, PROCESSOR)
#else
#define __ieee754_atanh atanh
#define __ieee754_log10 log10
#define __ieee754_log log
#define __cbrt cbrt
#define __expm1 expm1
#define __frexp frexp
#define __hypot hypot
#define __ldexp ldexp
#define __log1p log1p
#define __tanh tanh
#endif
