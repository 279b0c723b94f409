// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "diagnose/refit/behind_play.hpp"
#include "diagnose/refit/extended_fit.hpp"
#include "diagnose/regression/joint.hpp"
#include "diagnose/search/ideal_model.hpp"
#include "diagnose/search/search.hpp"

namespace trueaxis::diagnose_detail {

/// N ln RSS + k ln N (Schwarz 1978); what shapes a term, as the date of a slip, counts in k.
double criterion_of(const Joint& joint);

/// Surface and terms fitted about the first solution of both: about the part without the effects
/// that were found, probed when the delay that was found says. At 240/min 2 ms are 3°, and 3° of an
/// eccentricity of 0.2 mm are 0.3 µm beyond the first order.
class RelinearisedFit {
 public:
  /// @param ideal outlives this
  /// @param model terms that were found, and their noise
  RelinearisedFit(const IdealModel& ideal, const Model& model);
  RelinearisedFit(const RelinearisedFit&) = delete;
  RelinearisedFit& operator=(const RelinearisedFit&) = delete;

  const Problem& problem() const { return *problem_; }
  const Joint& joint() const { return *joint_; }
  /// The sum of all terms, one per reading.
  const std::vector<double>& effect_mm() const { return effect_mm_; }
  /// About the part itself.
  double criterion() const { return criterion_of(*joint_); }
  /// Readings minus surface and terms, one a reading, mm.
  std::vector<double> residual_mm() const;
  /// Fits the surface without the terms: before `take_named` and `shifted`.
  void fit_surface() { cleaned_ = cleaned(taken_off_mm()); }
  /// The surface of the model that is named; asked for once, and last.
  FitResult take_named() {
    return extended_fit(std::move(cleaned_), problem_->point, uncertainty_of(*joint_));
  }
  /// The surface whose base is off that of the named model, with covariances of its own, but for
  /// the noise of a reading.
  FitResult shifted(const Eigen::VectorXd& shift, BaseUncertainty base) const;

 private:
  /// Where part and probe are, as far as it was found.
  struct Place {
    std::vector<Clamping> after{}, before{};  ///< of the part: in the end, and before its steps
    double height_mm = 0.0;                   ///< of the probe
  };
  LinearisationPoint point_at(const ProbeStream& stream, const Place& place) const;
  void relinearise(const Model& model);
  void place(const Eigen::VectorXd& found, const FitResult& extended);
  void solve_about(const std::vector<double>& phi);
  bool is_far() const;
  Eigen::VectorXd coefficients_of_terms() const;
  std::vector<double> taken_off_mm() const;
  CleanedFit cleaned(std::vector<double> taken_off_mm) const;
  void turn(const Eigen::VectorXd& found, const Place& place);
  BehindPlay behind_play_on(const LinearisationPoint& way, const Eigen::VectorXd& found) const;
  void take_up_play(const Eigen::VectorXd& found, const Place& place);
  void note_moved(const Eigen::VectorXd& found, const Place& place);

  const IdealModel& ideal_;
  std::vector<Hypothesis> terms_;     ///< a lag at the time constant found
  std::optional<ProbeStream> moved_;  ///< the stream at the spindle angles that a delay makes true
  SharedColumn play_side_;            ///< TermContext; or empty
  std::optional<LinearisationPoint> point_;  ///< none: the first
  std::vector<double> known_mm_;   ///< what is known of the terms, added to the readings; or empty
  std::vector<double> moved_mm_;   ///< known of steps and height, added to the readings; or empty
  std::vector<double> beyond_mm_;  ///< what steps and height do to X, beyond the first order
  std::vector<double> turned_mm_;  ///< X at the true less X at the recorded angles; or empty
  Eigen::VectorXd placed_at_;      ///< sizes that part and probe are moved by; or empty
  std::vector<double> deviation_mm_;
  std::optional<Problem> problem_;
  std::optional<Joint> joint_;
  std::vector<double> effect_mm_;
  CleanedFit cleaned_;
};

/// The part after the first step that was found, and nothing else: the ideal fit lies between the
/// places of a part that moved, where whatever varies along Z looks like more of the move. And the
/// part at the time and the height of the probe that were found, if the second order of the model
/// is worth a term (ln N). Empty: neither.
/// @param fit of the model
std::vector<std::unique_ptr<RelinearisedFit>> about_what_moves(const IdealModel& ideal,
                                                               const Model& model,
                                                               const RelinearisedFit& fit);

/// Whether a term is a delay, a lag or a height of the probe.
bool moves_probe(const Hypothesis& h);

/// Whether a term is a play.
bool plays(const Hypothesis& h);

/// What the second order says of a lag and a delay, which are one in the first: the model holds the
/// better of the two.
struct Timing {
  std::size_t term = 0;
  double twice_log_ratio = 0.0;  ///< 2 ln of its likelihood over the other's
};

/// The last fit; `model` is changed where the other of lag and delay does better.
std::unique_ptr<RelinearisedFit> relinearise(const IdealModel& ideal, Model& model,
                                             std::optional<Timing>& timing);

}  // namespace trueaxis::diagnose_detail
