// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trueaxis/probe_stream.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {

/// Of what a diagnosis was made.
struct DiagnosisInput {
  std::string file, hash;
};

/// @param path of the text, for messages
/// @throws InputError when the text is no trueaxis.diagnosis/1.
DiagnosisInput diagnosis_input(std::string_view json, const std::string& path);

/// A diagnosis as the virtual lathe plays it at the readings of its stream (see simulate_at). Both
/// have the stream's set-ups and the diagnosis' noise (σ, autoregression).
struct DiagnosedScenarios {
  virtual_lathe::Scenario before;  ///< the ideal surface as first fitted, no effect
  virtual_lathe::Scenario after;   ///< the extended fit with every finding and unexplained pattern
  std::vector<bool> masked;        ///< readings that the diagnosis left out
  /// The first fit's own residuals, a check that the readings were understood as then.
  std::vector<bool> rejected;
  double rms_mm = 0.0;  ///< of those that were not rejected
};

/// @param stream the measured one: its set-ups, gauge and clock
/// @param ball_radius_mm as given to the diagnosis; 0: what the stream says
/// @throws InputError when the diagnosis is of another stream (hash), its fit did not converge, or
/// the text is malformed.
DiagnosedScenarios diagnosed_scenarios(std::string_view json, const std::string& path,
                                       const ProbeStream& stream, double ball_radius_mm = 0.0);

}  // namespace trueaxis
