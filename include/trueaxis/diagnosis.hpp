// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trueaxis/effect.hpp"
#include "trueaxis/fit.hpp"
#include "trueaxis/inference.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {

/// A cause found in the data, refitted jointly with the surface and the other causes.
struct Finding : NamedFinding {
  TermValue term;  ///< of the best explanation: an effect of the catalogue, fitted
  std::vector<FitParameter> parameters;  ///< catalogue's names, edge units (mm, deg, s, Hz, 1)
  Estimate axis_shift;                   ///< mm; largest over Z, of leaving it out
  bool cosmetic = false;                 ///< improves the RMS, not the axis

  std::string effect() const { return term.id(); }
  /// The class: every id that fits the readings equally well, the named one first.
  std::vector<std::string> members() const { return members_beside(effect()); }
  bool may_be(std::string_view effect) const;  ///< whether the class holds it

  /// The estimate of this name. @throws ContractViolation if there is none.
  const Estimate& parameter(std::string_view name) const {
    return find_parameter(parameters, name);
  }
};

struct Unexplained : UnnamedPattern {
  TermValue term;  ///< a pattern, fitted
};

/// An effect that this plan cannot see at its typical size.
struct NotObservable : UnseenEffect {
  Estimate axis_bias_per_unit;  ///< shift of the axis per unit of the effect's parameter
  Estimate axis_bias_typical;   ///< shift at the largest typical size
};

/// What the standard deviation of a reading was had from.
enum class NoiseSource {
  none,
  extended_model,  ///< its residuals
  stationary_capture,
  repeated_passes,
  revolution_differences
};

const char* to_string(NoiseSource source);

/// Noise of one reading as the data show it.
struct NoiseReport {
  double sigma_mm = 0.0;  ///< standard deviation of a reading
  double u_sigma_mm = 0.0;
  NoiseSource source = NoiseSource::none;
  std::string note;                     ///< what speaks against it ("no source of its own: …")
  std::vector<double> autoregression;   ///< φ of ε_i = Σ φ_j ε_{i−j} + e_i; empty: white
  std::optional<double> stationary_mm;  ///< σ of each source that the data have
  std::optional<double> repeated_mm;
  std::optional<double> revolutions_mm;
  std::optional<double> stated_mm;      ///< sensor_noise of the stream or job
  std::vector<Rejected> masked;         ///< readings that were excluded, and why
  std::vector<std::string> gaps;        ///< missing sectors or lengths: where
  std::vector<Rejected> interruptions;  ///< keyways, holes: first row of each and its sector
};

struct Gain : Explained {
  std::string blocks;  ///< of revolutions or sections: what one is, and how many
  double noise_floor_mm = 0.0;
  Estimate axis_shift;         ///< mm, largest over Z between the baseline's axis and the extended
  Estimate coaxiality_before;  ///< mm, of the part that a correction from the baseline would cut
  Estimate coaxiality_after;   ///< mm, from the final axis
};

/// A run of the probe, C and Z linear in time.
struct ProbingRun {
  double from_mm = 0.0, to_mm = 0.0;  ///< Z; of a face X
  double turns = 0.0;                 ///< signed like C; 0: at standstill
  double seconds = 0.0;
  double readings = 0.0;
  bool rear = false;   ///< from the rear side
  double c_rad = 0.0;  ///< where C starts
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

/// A model that the axis is averaged over in addition to the named one.
struct AxisShare {
  std::string effect;      ///< id; empty: none
  std::string instead_of;  ///< id of the cause whose place it takes; empty: of none
  double probability = 0.0;
  Estimate axis_shift;  ///< mm; largest over Z, from the axis of the named model
};

/// A source of U of the axis.
struct AxisLimit {
  std::string effect;      ///< id of a cause that was not found; empty: noise, or see below
  std::string instead_of;  ///< id of a named cause: what else it may be
  double share = 0.0;      ///< of u², by which that would be smaller without this source
};

/// Standard deviations by which what is seen is off what is stated: 1 of 1000 that are right is.
constexpr double refuted_by = 3.29;

/// A statement that the readings refute: what it is by them, the stated value included.
struct RefutedStatement {
  Influence stated;
  Estimate seen;  ///< in the unit of the kind
};

/// What the model gets wrong.
struct Diagnosis : Conclusion {
  FitResult baseline;  ///< the ideal fit
  FitResult named;     ///< refitted with all causes as they are named
  /// Averaged over what may have caused the readings, each model by its probability: what is stated
  /// and cut. Its u holds what the data cannot tell.
  FitResult extended;
  std::vector<AxisShare> shares;  ///< what moves the average from the named model, largest first
  std::vector<AxisLimit> limits;  ///< what U comes from, the largest part first
  std::vector<RefutedStatement> refuted;
  /// A long delay of X that fits the readings as what was found does, s; NaN: no clock. It turns
  /// the axis by an angle that is then not known.
  std::optional<double> late_s;
  std::vector<Finding> findings;  ///< by axis_bias, the largest first
  std::vector<Unexplained> unexplained;
  std::vector<NotObservable> not_observable;
  NoiseReport noise;
  Gain gain;
  NextMeasurement next;
  std::vector<Separating> plans;  ///< every candidate measurement, best first
  /// One per plan: what was measured, and what is added; empty: it needs a hand at chuck or slide.
  std::vector<std::vector<ProbingRun>> runs;

  double z_mid_mm = 0.0, z_half_mm = 1.0;                     ///< u = (z − z_mid)/z_half
  std::vector<double> effect_mm;                              ///< of all terms, one per reading
  std::vector<double> residual_before_mm, residual_after_mm;  ///< one per reading
  std::vector<SpectrumBin> spectrum;

  std::vector<Influence> known;  ///< of the options: by their values the readings are corrected
  /// As in the options, which outlive this, or `entries`.
  std::span<const Effect> own_effects = {};
  /// If something is stated: those of the options, and entries of the catalogue as it is stated.
  std::shared_ptr<const std::vector<Effect>> entries = {};

  /// The entry of an id, of the catalogue or of one's own; nullptr: none has it.
  const Effect* entry(std::string_view id) const;
  /// The cause that is a slip of the part: the axes are then those before it, where the part no
  /// longer is. nullptr: there is none.
  const Finding* slip() const;
};

struct DiagnoseOptions {
  FitOptions fit;             ///< its influences: what is known, by whose values the readings are
                              ///< corrected already
  double false_alarm = 0.01;  ///< per stream, over all hypotheses
  int max_findings = 8;       ///< beyond that the surface is the wrong one
  int threads = 0;            ///< 0: as many as there are; the result does not depend on it
  /// Further effects that may be causes, with ids that the catalogue does not have; they outlive
  /// the result.
  std::span<const Effect> own_effects = {};
};

/// @throws InputError as fit() does; ContractViolation where an effect of one's own has an id of
/// the catalogue. Numerical outcomes are data: see extended.status.
Diagnosis diagnose(const ProbeStream& stream, const DiagnoseOptions& options);

/// The stream less what the stated values of its influences do to it, about the surface that is
/// fitted to the residuals. Delay and lag count in all orders, the others in the first. @throws
/// InputError as fit() does
ProbeStream corrected_by_known(ProbeStream stream, const FitOptions& options);

}  // namespace trueaxis
