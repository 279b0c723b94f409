// SPDX-License-Identifier: Apache-2.0
#include "form/order_evidence.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "form/order_evidence.cpp"  // compiled once for every instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// After highway.h, as it is compiled once for every instruction set too.
#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace trueaxis::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Coordinates whose factors 1 + τ²λ/σ² are multiplied, and their fractions brought to one
/// denominator, before the logarithm and the quotient. Each is below 1e35.
constexpr std::size_t at_once = 6;

void weigh(const double* values, const double* squares, std::size_t coordinates, const double* gain,
           std::size_t sizes, double variance, double* log_evidence) {
  const hn::CappedTag<double, form::sizes_at_once> tag;
  const auto one = hn::Set(tag, 1.0), half = hn::Set(tag, 0.5);
  const auto by_variance = hn::Set(tag, 1.0 / variance);
  for (std::size_t k = 0; k < sizes; k += hn::Lanes(tag)) {
    const auto g = hn::LoadU(tag, gain + k);
    auto square = hn::Zero(tag), log = hn::Zero(tag);
    for (std::size_t j = 0; j < coordinates;) {
      auto numerator = hn::Zero(tag), denominator = one;
      for (const std::size_t end = j + at_once; j < end && j < coordinates; ++j) {
        const auto grown = hn::MulAdd(g, hn::Set(tag, values[j]), one);
        numerator = hn::MulAdd(hn::Set(tag, squares[j]), denominator, hn::Mul(numerator, grown));
        denominator = hn::Mul(denominator, grown);
      }
      square = hn::Add(square, hn::Div(numerator, denominator));
      log = hn::Add(log, hn::Log(tag, denominator));
    }
    const auto twice = hn::MulSub(hn::Mul(g, by_variance), square, log);
    hn::StoreU(hn::Mul(half, twice), tag, log_evidence + k);
  }
}

}  // namespace trueaxis::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trueaxis {

HWY_EXPORT(weigh);

namespace form {

void weigh_sizes(std::span<const double> values, std::span<const double> squares,
                 std::span<const double> gain, double variance, double* log_evidence) {
  HWY_DYNAMIC_DISPATCH(weigh)
  (values.data(), squares.data(), values.size(), gain.data(), gain.size(), variance, log_evidence);
}

}  // namespace form
}  // namespace trueaxis
#endif
