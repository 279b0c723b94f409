// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trueaxis/units.hpp"

/// What every diagnosis states, of a part on a lathe and of a machine alike.
namespace trueaxis {

/// What a measurement is to be taken for, and what it would do.
struct Separating {
  /// Another measurement that does it nearly as well.
  struct Other {
    std::string plan, what;
    double power = 0.0, minutes = 0.0;
  };
  std::string plan;           ///< code of a separator: "RC", "2W" …; empty: see why_not
  std::string what;           ///< in words, with its numbers
  double power_before = 0.0;  ///< probability of the right name with the data at hand
  double power = 0.0;         ///< with the measurement added
  double minutes = 0.0;       ///< it takes, setting up included
  std::string why_not;        ///< why none of the plans does it
  std::vector<Other> others;  ///< fastest first
};

/// A cause that fits the readings as well as the named one, or nearly.
struct Rival {
  std::string effect;     ///< id
  double distance = 0.0;  ///< d of the named cause's prediction from this one's best fit, in σ
  double log_likelihood_ratio = 0.0;  ///< ln(L_finding/L_rival), parameters paid for
  double probability = 0.0;           ///< of this cause, among the class
  bool structural = false;  ///< canonical correlation above 0.999: no amount of data helps
  /// Size that it has if it is the cause, over the largest that is usual, or over the least if
  /// smaller; 1: usual, 0: unknown. If d is small, the probability follows from it.
  double times_usual = 0.0;
};

/// A cause that was found, with all that explain the same as well.
struct NamedFinding {
  std::vector<Rival> rivals;  ///< the most probable first
  std::string alias;          ///< another order that the sampling cannot tell from it
  double p_value = 1.0;       ///< family-wise: all hypotheses that were tried are counted
  double probability = 0.0;   ///< of the named effect among its class
  double rms_mm = 0.0;        ///< of its contribution to the readings
  std::optional<Separating> separate_with;  ///< for a class of more than one

  /// The class: every id that fits the readings equally well, the name first.
  std::vector<std::string> members_beside(std::string_view name) const;
};

/// A pattern that no catalogued cause explains; it stays in the model as it is.
struct UnnamedPattern {
  Estimate amplitude;  ///< mm; of an angle rad
  double p_value = 1.0;
};

/// An effect that this plan cannot see at its typical size.
struct UnseenEffect {
  std::string effect;       ///< id
  std::string why;          ///< "absorbed by x0, y0 …", "needs a time column" …
  double detectable = 0.0;  ///< size of the parameter that would be found with power ½; inf: none
  std::string detectable_unit;
  std::optional<Separating> separate_with;
};

/// A check of the data's quality (probe.saturation …): estimated, handled, never a name for a form.
struct QualityCheck {
  std::string effect;  ///< id of the check
  bool found = false;
  std::string text;  ///< what was seen, with numbers and what was done
};

/// An interval of about 95 %.
struct Interval {
  double value = 0.0, low = 0.0, high = 0.0;
};

/// What the causes explain of the readings, and of blocks of them that were excluded in turn.
struct Explained {
  double rms_before_mm = 0.0, rms_after_mm = 0.0;
  Interval held_out_before_mm, held_out_after_mm;  ///< RMS
  Interval held_out_ratio;                         ///< after / before, blocks paired
};

enum class DiagnosisVerdict { ideal, effects, unexplained };
const char* to_string(DiagnosisVerdict verdict);

/// @param unexplained whether a pattern is that no effect explains
DiagnosisVerdict verdict_of(bool found, bool unexplained);

/// What a diagnosis concludes in addition to its causes.
struct Conclusion {
  DiagnosisVerdict verdict = DiagnosisVerdict::ideal;
  std::vector<std::string> remarks;  ///< what might be mistaken for an effect
  std::vector<QualityCheck> checks;
  double false_alarm = 0.01;          ///< family-wise level of the verdict
  std::size_t hypotheses = 0;         ///< tried one by one
  double effective_hypotheses = 0.0;  ///< independent tests they are worth at this level
  double threshold =
      0.0;  ///< of one test: its statistic with two degrees of freedom; of a machine p
};

}  // namespace trueaxis
