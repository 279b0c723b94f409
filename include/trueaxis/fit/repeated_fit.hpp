// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>

#include "trueaxis/fit/fit.hpp"

namespace trueaxis {

/// fit() again and again, with other readings at the same C and positions: what does not depend on
/// the readings is prepared once.
class RepeatedFit {
 public:
  /// The stream's readings are those of no call: they may be anything of the right size.
  /// @throws InputError as fit() does.
  RepeatedFit(ProbeStream stream, FitOptions options);
  ~RepeatedFit();
  RepeatedFit(RepeatedFit&&) noexcept;
  RepeatedFit& operator=(RepeatedFit&&) noexcept;

  /// The same bits as fit() of the stream with these readings.
  FitResult operator()(std::span<const double> reading_mm);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trueaxis
