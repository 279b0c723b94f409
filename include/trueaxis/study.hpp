// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trueaxis/fit.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::study {

/// How a scenario of the virtual lathe is repeated and what is fitted to its readings.
struct RepeatOptions {
  std::optional<SurfaceKind> surface{};  ///< that of the part unless said: `section` for a circle
  Loss loss = Loss::plain;
  std::size_t repeats = 2000;  ///< the spread is then known to 1.6 % (one standard deviation)
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as there are; the result does not depend on it
};

/// What the repeats tell of one quantity, in its edge unit (mm, deg, 1); errors are estimate −
/// truth. A number that does not exist is NaN.
struct Spread {
  std::string name, unit;
  double truth = 0.0;
  double bias = 0.0, u_bias = 0.0;
  double sd = 0.0;
  double bound = 0.0;         ///< Cramér-Rao: the least sd of an unbiased estimate on this plan
  double coverage = 0.0;      ///< share of |error| ≤ U, k = 2
  std::size_t estimates = 0;  ///< repeats that gave the number
};

/// Probes a scenario again and again with other noise and fits each stream: bias and spread of all
/// quantities with their bound. @throws InputError when the scenario contradicts itself
std::vector<Spread> repeat(const virtual_lathe::Scenario& scenario, const RepeatOptions& options);

}  // namespace trueaxis::study
