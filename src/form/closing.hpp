// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "form/section_model.hpp"
#include "form/sections.hpp"
#include "form/uncertainty.hpp"

namespace trueaxis::form {

/// What a reading differs from that of the same angle one revolution earlier.
struct Closing {
  double step_mm = 0.0, u_mm = 0.0;
};

/// The step from a line through the first readings to one through the last, half a wave at the
/// cut-off each. The section has one to two revolutions. u is the RMS of such a step at all other
/// places, which holds form and noise of the neighbours. Nothing: too few readings.
std::optional<Closing> closing_of(const SectionReadings& section, double high_upr);

/// The sections that do not close, by more than 3 u, and the step of each.
class Unclosed {
 public:
  Unclosed(const Sections& sections, double high_upr);

  /// What half the revolutions moved counts as u: it is not known when what drifts was at its zero.
  double u_of_radius(std::size_t section) const;
  /// Adds what a drift of that size changes in the values, as one u of it.
  /// @param of_profiles all values of these profiles of the sections
  using OfProfiles =
      std::function<std::vector<NamedValue>(const std::vector<std::vector<double>>& profiles_mm)>;
  void add_to(std::vector<Spread>& spread, const std::vector<SectionModel>& models,
              const std::vector<std::vector<double>>& measured_mm,
              const OfProfiles& of_profiles) const;
  /// Says so if there are any.
  void note_in(std::vector<std::string>& notes, const char* of) const;

 private:
  const Sections& sections_;
  std::vector<std::optional<Closing>> steps_;  ///< of every section
};

}  // namespace trueaxis::form
