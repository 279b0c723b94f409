// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trueaxis/influence.hpp"
#include "trueaxis/probe_stream.hpp"
#include "trueaxis/surface.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {

/// Loss of the association; the scale of the robust ones comes from the data (MAD).
enum class Loss {
  plain,  ///< least squares (Eq. 12 of Constantin et al.)
  huber,  ///< k = 1.345 σ: 95 % efficient on Gaussian noise
  tukey,  ///< c = 4.685 σ: 95 % efficient, readings beyond c have no weight at all
};

enum class FitStatus {
  converged,
  max_iterations,
  rank_deficient,
  too_few,
  implausible,  ///< no probe on this surface reads so, or no part has its radius: see message
};

/// What the standard deviation of a reading follows from.
enum class SigmaSource { none, residuals, robust_residuals, whitened_residuals, sensor };

struct FitOptions {
  SurfaceKind surface = SurfaceKind::cone;
  /// A surface of revolution of one's own in place of `surface`.
  std::shared_ptr<const RevolvedProfile> profile{};
  Loss loss = Loss::plain;
  bool bore = false;  ///< probed from inside: the sign of the ball's radius is reversed
  double ball_radius_mm =
      0.0;  ///< X_M is the ball's centre; 0: as the stream says, else the contact
  std::optional<double>
      noise_mm{};  ///< standard deviation of one reading if known apart from this fit
  std::vector<Influence> influences{};
  double coverage_factor = 2.0;  ///< k of U = k u; 2: about 95 % for a normal quantity (GUM 6.3.3)
  int max_iterations = 50;       ///< a good start needs 3 or 4; 50 tells trouble from slowness
};

struct Rejected {
  std::size_t row = 0;  ///< 1-based data row of the stream
  std::string why;      ///< e.g. "31.2 µm off, 9.1 σ"
};

/// One named parameter, mm, rad and 1; `at_edge` has angles in degrees.
struct FitParameter {
  std::string name;
  Estimate estimate;
};

/// The estimate of this name. @throws ContractViolation if there is none.
const Estimate& find_parameter(std::span<const FitParameter> parameters, std::string_view name);

/// A line of the uncertainty budget: what a source contributes to each parameter's u.
struct BudgetLine {
  std::string source;     ///< "noise of the readings", "probe height", …
  char type = 'A';        ///< GUM: 'A' from statistics, 'B' from other knowledge
  std::vector<double> u;  ///< in the order and unit of FitResult::parameters
};

/// A set-up of the stream, and the part as it was then.
struct SetUpFit {
  SetUp set_up;
  Root side = Root::front;               ///< as stated, or as the sign of X_M tells
  std::vector<FitParameter> parameters;  ///< in the order of the surface's catalogue line
  AxisEstimate axis;
  Revolved shape;
};

/// The associated feature. With several set-ups the parameters, their covariance and budget, what
/// is derived of them, axis and shape are those of the last set-up: so the part is clamped now,
/// when the correction is cut. `status` says whether the numbers may be used.
struct FitResult {
  SurfaceKind surface = SurfaceKind::cone;
  FitStatus status = FitStatus::too_few;
  std::string message;                      ///< what is wrong and what to do, empty when converged
  std::vector<std::string> not_determined;  ///< combinations of parameters the data leave free
  std::vector<std::string> notes;           ///< what a user should know of numbers that may be used
  /// What was assumed that the stream's file does not state, and what of it was not used.
  std::vector<std::string> input_notes;
  std::optional<XConvention> x_convention;  ///< of the stream, where it was read from a file
  Loss loss = Loss::plain;
  bool bore = false;
  double coverage_factor = 2.0;

  std::vector<FitParameter> parameters;  ///< in the order of the surface's catalogue line
  Covariance covariance;                 ///< of `parameters`, in their units
  std::vector<FitParameter> derived;     ///< radius_mid, axis offsets at the ends of the data, tilt
  std::vector<BudgetLine> budget;
  AxisEstimate axis;  ///< a plane: its normal through (0, 0, 0); all budget lines in it
  Revolved shape;     ///< lateral surfaces: the associated surface of the part

  /// In order of number. Those that the part was moved before (turned, shifted or clamped anew
  /// against the set-up before) have an axis of their own; all share radius and half angle, in one
  /// least-squares problem. A part shifted by z_shift has its apex at k + z_shift / n.
  std::vector<SetUpFit> set_ups;

  double rms_mm = 0.0;    ///< of the residuals that were not rejected
  double sigma_mm = 0.0;  ///< standard deviation of one reading, as used in u
  SigmaSource sigma_source = SigmaSource::none;
  double autocorrelation = 0.0;  ///< of neighbouring residuals (lag 1)
  double u_factor = 1.0;  ///< largest u of a parameter over that of white noise (1: uncorrelated)
  /// u of the noise, so that k u is what Student's t says where few readings show σ, over σ's own.
  double widened = 1.0;
  std::size_t points = 0;
  std::vector<Rejected> rejected;
  int iterations = 0;
  /// Z (or X of a face) of the data, of those since the part was last moved.
  double position_min_mm = 0.0, position_max_mm = 0.0;
  std::vector<double> residual_mm;  ///< measured minus model, one per reading
  std::string input_hash, source;

  /// The estimate of this name among `parameters` and `derived`: parameter("half_angle").
  /// @throws ContractViolation if there is none
  const Estimate& parameter(std::string_view name) const;

  /// Whether the axis may be used: the fit converged, and nothing withholds a parameter of it.
  bool axis_known() const;
};

/// Associates a surface with a stream, over all set-ups at once: starting values from the data
/// alone, Levenberg-Marquardt on the compressed normal matrix, robust loss, uncertainties.
/// @throws InputError if the stream cannot belong to the surface (a face for a cone, a relative
///         gauge without nominal radius). Numerical outcomes are data: see FitResult::status.
FitResult fit(const ProbeStream& stream, const FitOptions& options);

const char* to_string(FitStatus status);
const char* to_string(SigmaSource source);
const char* to_string(Loss loss);

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

  /// The same bits as fit() of the stream with these readings, without its check of plausibility.
  FitResult operator()(std::span<const double> reading_mm);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trueaxis
