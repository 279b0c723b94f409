// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "blind_machine/judge.hpp"

namespace trueaxis::blind_machine {

enum class Kind { silent, one, two, unknown, absorbed, advised };
std::string to_string(Kind kind);
std::vector<Kind> all_kinds();
double goal(Kind kind);

struct Wanted {
  Kind kind = Kind::silent;
  std::size_t layout = 0;
  std::string plan;
  std::uint64_t seed = 1;

  std::string id() const;  ///< KIND-LAYOUT-PLAN-SEED
};

struct Case {
  Wanted wanted;
  const Layout* layout = nullptr;
  Plan plan;
  Fault fault;                     ///< location errors, and what is hidden
  std::vector<std::string> truth;  ///< effects, or for an unknown kind what it is, in words
  std::vector<Effect> hidden;      ///< …as effects, with their coefficients taken in
  std::vector<double> lambda;      ///< of each after the base
};

/// Drawn from the seed alone. Sizes are plausible ones: 0.1 mm and 0.2 mrad at most.
Case make_case(const Wanted& wanted);

/// The readings of a plan with noise, as rows of docs/reference/calibration.md.
std::string measurement_text(const Case& one, const Plan& plan, std::uint64_t noise_seed);

}  // namespace trueaxis::blind_machine
