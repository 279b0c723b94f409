/* SPDX-License-Identifier: Apache-2.0 */
/* The functions for the processor that is there: fused multiply-add where glibc would use it. */
static int is_fused(void) {
  return __builtin_cpu_supports("fma") && __builtin_cpu_supports("avx2");
}

#define OF_ONE(name)                              \
  double name##_sse2(double), name##_fma(double); \
  double name(double x) { return is_fused() ? name##_fma(x) : name##_sse2(x); }
#define OF_TWO(name)                                              \
  double name##_sse2(double, double), name##_fma(double, double); \
  double name(double x, double y) { return is_fused() ? name##_fma(x, y) : name##_sse2(x, y); }

OF_ONE(acos)
OF_ONE(asin)
OF_ONE(atan)
OF_ONE(cos)
OF_ONE(exp)
OF_ONE(expm1)
OF_ONE(log)
OF_ONE(log1p)
OF_ONE(sin)
OF_ONE(tan)
OF_TWO(atan2)
OF_TWO(pow)

long double sinl(long double), cosl(long double);
void sincosl(long double x, long double* sine, long double* cosine) {  /* or sincos of Windows comes with its own */
  *sine = sinl(x);
  *cosine = cosl(x);
}

void sincos_sse2(double, double*, double*), sincos_fma(double, double*, double*);
void sincos(double x, double* sine, double* cosine) {
  (is_fused() ? sincos_fma : sincos_sse2)(x, sine, cosine);
}
