// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trueaxis/effect.hpp"
#include "trueaxis/fit.hpp"
#include "trueaxis/units.hpp"

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

/// A cause that explains a finding as well, or nearly.
struct Rival {
  std::string effect;     ///< id
  double distance = 0.0;  ///< d of the finding's prediction from the rival's best fit, in σ
  double likelihood_ratio = 0.0;  ///< 2 ln(L_finding/L_rival), parameters paid for
  double probability = 0.0;       ///< of the rival, among the class
  bool structural = false;        ///< canonical correlation above 0.999: no amount of data helps
};

/// A cause found in the data, refitted jointly with the surface and the other findings.
struct Finding {
  TermValue term;             ///< of the best explanation: an effect of the catalogue, fitted
  std::vector<Rival> rivals;  ///< what explains it as well, the most probable first
  std::vector<FitParameter> parameters;  ///< catalogue's names, edge units (mm, deg, s, Hz, 1)
  std::string alias;                     ///< another order that the sampling cannot tell from it
  double p_value = 1.0;      ///< family-wise: all hypotheses that were tried are counted
  double probability = 0.0;  ///< of the named effect among its class
  double rms_mm = 0.0;       ///< of its contribution to the readings
  Estimate axis_shift;       ///< mm; largest over Z, of leaving it out
  bool cosmetic = false;     ///< improves the RMS, not the axis
  std::optional<Separating> separate_with;  ///< for a class of more than one

  std::string effect() const { return term.id(); }
  /// The class: every id that explains it as well, the named one first.
  std::vector<std::string> members() const;
  bool may_be(std::string_view effect) const;  ///< whether the class holds it

  /// The estimate of this name. @throws ContractViolation if there is none.
  const Estimate& parameter(std::string_view name) const {
    return find_parameter(parameters, name);
  }
};

/// A pattern that no catalogued cause explains; it stays in the model as it is.
struct Unexplained {
  TermValue term;      ///< a pattern, fitted
  Estimate amplitude;  ///< mm
  double p_value = 1.0;
};

/// An effect that this plan cannot see at its typical size.
struct NotObservable {
  std::string effect;
  std::string why;              ///< "absorbed by x0, y0 …", "needs a time column" …
  Estimate axis_bias_per_unit;  ///< shift of the axis per unit of the effect's parameter
  Estimate axis_bias_typical;   ///< shift at the largest typical size
  double detectable = 0.0;  ///< size of the parameter that would be found with power ½; inf: none
  std::string detectable_unit;
  std::optional<Separating> separate_with;
};

/// Noise of one reading as the data show it.
struct NoiseReport {
  double sigma_mm = 0.0;  ///< standard deviation of a reading
  double u_sigma_mm = 0.0;
  std::string source;  ///< "stationary capture", "repeated passes", "revolution differences",
                       ///< "residuals of the extended model"
  std::string note;    ///< what speaks against it ("no source of its own: …")
  std::vector<double> autoregression;   ///< φ of ε_i = Σ φ_j ε_{i−j} + e_i; empty: white
  std::optional<double> stationary_mm;  ///< σ of each source that the data have
  std::optional<double> repeated_mm;
  std::optional<double> revolutions_mm;
  std::optional<double> stated_mm;      ///< sensor_noise of the stream or job
  std::vector<Rejected> masked;         ///< readings that were left out, and why
  std::vector<std::string> gaps;        ///< missing sectors or lengths: where
  std::vector<Rejected> interruptions;  ///< keyways, holes: first row of each and its sector
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

struct Gain {
  double rms_before_mm = 0.0, rms_after_mm = 0.0;
  Interval held_out_before_mm, held_out_after_mm;  ///< blocks of revolutions or sections left out
  std::string blocks;                              ///< what one block is, and how many
  Interval held_out_ratio;                         ///< after / before, blocks paired
  double noise_floor_mm = 0.0;
  Estimate axis_shift;         ///< mm, largest over Z between the baseline's axis and the extended
  Estimate coaxiality_before;  ///< mm, of the part that a correction from the baseline would cut
  Estimate coaxiality_after;   ///< mm, from the extended model
};

struct NextMeasurement {
  std::string plan;  ///< code; empty: nothing to separate, or why_not
  std::string what;
  std::vector<std::string> separates;  ///< ids
  double power_before = 0.0, power_after = 0.0;
  double minutes = 0.0;
  std::string why_not;
};

/// A line or bin of the residuals' spectrum over the order (cycles per revolution).
struct SpectrumBin {
  double order = 0.0;
  double before_mm = 0.0, after_mm = 0.0;  ///< amplitude
};

/// A model that the axis is averaged over beside the named one.
struct AxisShare {
  std::string effect;      ///< id; empty: none
  std::string instead_of;  ///< id of the finding in whose place it stands; empty: beside all
  double probability = 0.0;
  Estimate axis_shift;  ///< mm; largest over Z, from the axis of the named model
};

enum class DiagnosisVerdict { ideal, effects, unexplained };

/// What the model gets wrong.
struct Diagnosis {
  DiagnosisVerdict verdict = DiagnosisVerdict::ideal;
  FitResult baseline;  ///< the ideal surface
  FitResult named;     ///< refitted with all findings as they are named
  /// Averaged over what may have caused the readings, each model by its probability: what is stated
  /// and cut. Its u holds what the data cannot tell.
  FitResult extended;
  std::vector<AxisShare> shares;  ///< what moves the average from the named model, largest first
  std::vector<Finding> findings;  ///< by axis_bias, the largest first
  std::vector<Unexplained> unexplained;
  std::vector<NotObservable> not_observable;
  std::vector<std::string> remarks;  ///< what might be taken for an effect and is none
  NoiseReport noise;
  std::vector<QualityCheck> checks;
  Gain gain;
  NextMeasurement next;
  std::vector<Separating> plans;  ///< every candidate measurement, best first

  double false_alarm = 0.01;          ///< family-wise level of the verdict
  std::size_t hypotheses = 0;         ///< columns tried one by one
  double effective_hypotheses = 0.0;  ///< independent tests they are worth at this level
  double threshold = 0.0;             ///< of a statistic with two degrees of freedom

  double z_mid_mm = 0.0, z_half_mm = 1.0;                     ///< u = (z − z_mid)/z_half
  std::vector<double> effect_mm;                              ///< of all terms, one per reading
  std::vector<double> residual_before_mm, residual_after_mm;  ///< one per reading
  std::vector<SpectrumBin> spectrum;

  std::span<const Effect> own_effects = {};  ///< as in the options; they outlive this

  /// The entry of an id, of the catalogue or of one's own; nullptr: none has it.
  const Effect* entry(std::string_view id) const;
  /// The finding that is a slip of the part: the axes are then those of before, and the part stands
  /// there no longer. nullptr: there is none.
  const Finding* slip() const;
};

struct DiagnoseOptions {
  FitOptions fit;
  double false_alarm = 0.01;  ///< per stream, over all hypotheses
  int max_findings = 8;       ///< beyond that the surface is the wrong one
  int threads = 0;            ///< 0: as many as there are; the result does not depend on it
  /// Effects beside the catalogue that may be causes too, ids of their own; they outlive the
  /// result.
  std::span<const Effect> own_effects = {};
};

/// @throws InputError as fit() does; ContractViolation where an effect of one's own has an id of
/// the catalogue. Numerical outcomes are data: see extended.status.
Diagnosis diagnose(const ProbeStream& stream, const DiagnoseOptions& options);

const char* to_string(DiagnosisVerdict verdict);

}  // namespace trueaxis
