// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "diagnose/explain/confounder_set.hpp"
#include "diagnose/refit/extended_fit.hpp"

namespace trueaxis::diagnose_detail {

/// What a diagnosis is of.
struct Given {
  const ProbeStream& stream;
  const FitOptions& options;
  double ball_mm = 0.0;
  const std::vector<Rejected>& masked;
};

/// Readings minus the point's surface, of a gauge less its zero, which the base takes out anyway.
std::vector<double> deviation_from(const ProbeStream& stream, const LinearisationPoint& point);

/// What the last fit is about: the part without the effects that were found, probed when the delay
/// that was found says. At 240/min 2 ms are 3°, and 3° of an eccentricity of 0.2 mm are 0.3 µm
/// beyond the first order.
struct About {
  std::vector<Hypothesis> terms;     ///< a lag at the time constant found
  std::optional<ProbeStream> moved;  ///< the stream at the spindle angles that a delay makes true
  LinearisationPoint point;
  std::vector<double> known_mm;   ///< what is known of the terms, added to the readings
  std::vector<double> turned_mm;  ///< X at the true less X at the recorded angles; or empty
  std::vector<double> deviation_mm;
};

/// Surface and terms fitted about the first extended model.
class RelinearisedFit {
 public:
  /// @param model terms that were found, and their noise
  RelinearisedFit(const Given& given, const Problem& whole, const Model& model);
  RelinearisedFit(const RelinearisedFit&) = delete;
  RelinearisedFit& operator=(const RelinearisedFit&) = delete;

  /// The extended surface again, with what other causes would make of its base.
  void widen(const Given& given, const Eigen::MatrixXd& between);

 private:
  About about_;
  std::vector<double> taken_off_mm_;  ///< of the readings, for the extended surface

 public:
  const Problem problem;
  const Joint joint;
  FitResult extended;
  std::vector<double> effect_mm;  ///< of all terms, one per reading
};

/// What the second order says of a lag and a delay, which are one in the first: the model holds the
/// better of the two.
struct Timing {
  std::size_t term = 0;
  double likelihood_ratio = 0.0;  ///< −2 ln of the other's likelihood over its own
};

/// The last fit; `model` is changed where the other of lag and delay does better.
std::unique_ptr<RelinearisedFit> relinearise(const Given& given, const Problem& whole, Model& model,
                                             std::optional<Timing>& timing);

}  // namespace trueaxis::diagnose_detail
