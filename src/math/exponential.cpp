// SPDX-License-Identifier: Apache-2.0
#include "math/exponential.hpp"

#include <algorithm>
#include <cstddef>

#include "trueaxis/error.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "math/exponential.cpp"  // compiled once for every instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// After highway.h, as it is compiled once for every instruction set too.
#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace trueaxis::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void exp_all(const double* power, std::size_t count, double* out) {
  const hn::CappedTag<double, 8> tag;
  constexpr std::size_t most = 8;
  std::size_t i = 0;
  for (; i + hn::Lanes(tag) <= count; i += hn::Lanes(tag))
    hn::StoreU(hn::Exp(tag, hn::LoadU(tag, power + i)), tag, out + i);
  if (i == count) return;
  double last[most] = {};
  std::copy(power + i, power + count, last);
  hn::StoreU(hn::Exp(tag, hn::LoadU(tag, last)), tag, last);
  std::copy(last, last + (count - i), out + i);
}

}  // namespace trueaxis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trueaxis {

HWY_EXPORT(exp_all);

void exponential(std::span<const double> power, std::span<double> out) {
  expects(power.size() == out.size(), "two columns of one length");
  HWY_DYNAMIC_DISPATCH(exp_all)(power.data(), power.size(), out.data());
}

}  // namespace trueaxis
#endif
