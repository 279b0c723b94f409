// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "blind/bench.hpp"
#include "blind/families.hpp"
#include "blind/plans.hpp"

namespace trueaxis::blind {

enum class Kind { null, one, two, three, unknown, absorbed, gaps, typical };

std::string to_string(Kind kind);
Kind kind_from(std::string_view text);  ///< @throws std::invalid_argument
std::vector<Kind> all_kinds();          ///< those with a goal: all but `typical`

/// What a null case's noise is: "white", "AR(1) 0.5", "AR(1) 0.8", "Student t 4", "outliers".
std::vector<std::string> null_noises();

/// What is asked for; the rest is drawn from `seed`.
struct Wanted {
  Kind kind = Kind::null;
  PlanId plan = PlanId::p1;
  SurfaceId surface = SurfaceId::cone;
  std::uint64_t seed = 1;
  std::optional<Effect> effect = {};  ///< of kind one: this cause instead of a drawn one
  std::optional<double> lambda = {};  ///< instead of a drawn one
};

/// A measurement whose cause is known to the judge alone.
struct BlindCase {
  Wanted wanted;
  std::string id;  ///< "one-P3-cone-1234": kind, plan, surface and seed make it again
  std::string noise = "white";
  virtual_lathe::Scenario scenario;  ///< with effects, noise and the lathe's seed
  std::vector<std::size_t> rows;     ///< kept readings; empty: all
  std::vector<double> lambdas;       ///< of the effects, of the surface
  std::shared_ptr<const Bench> bench;
};

/// Sizes may be this many times the upper end of the typical range to reach the wanted λ; a cause
/// that would need more is not asked for with this plan.
inline constexpr double largest_stretch = 3.0;

/// An effect counts as absorbed where λ at the upper end of its typical range is below this: to be
/// found with probability ½ it needs ten times as much, even if it were the only hypothesis.
inline constexpr double absorbed_lambda = 2.0;

/// @throws std::runtime_error when nothing fits in 400 draws.
BlindCase make_case(const Wanted& wanted);

/// The stream of the case: noisy readings of the kept rows, sensor noise not stated.
ProbeStream make_stream(const BlindCase& blind_case);

}  // namespace trueaxis::blind
