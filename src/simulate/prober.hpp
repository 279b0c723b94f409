// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "simulate/body.hpp"
#include "simulate/chain.hpp"
#include "simulate/contact.hpp"
#include "simulate/timeline.hpp"

namespace trueaxis::virtual_lathe {

/// A noise-free reading: what the sensor shows before its lag, noise and limits.
struct CleanReading {
  double value_mm = 0.0;
  double tan_incidence = 0.0;  ///< only when asked for
};

/// Probes a body in one set-up, reading by reading.
class Prober {
 public:
  /// `angle_rad`: of the probe's line from +X towards +Y.
  Prober(const Scenario& scenario, const Chain& chain, const Body& body, const Chucking& setup,
         double angle_rad = 0.0);

  /// @throws InputError when the probe misses the part.
  CleanReading read(const Moment& moment, bool with_incidence = false) const;

  /// −1: readings grow towards the material (rear side, bores).
  double away() const { return outward_ * side_; }

 private:
  struct PartView;
  TrueState state_at(const Moment& moment) const;
  PartView view_at(const TrueState& state) const;
  template <class Gap>
  std::optional<double> contact(const Gap& gap, const Line& line, double centre) const;
  Crests crests(const Line& line, double centre, const Vec3& towards) const;
  template <class Gap>
  CleanReading read_on(const Gap& gap, const TrueState& state, bool with_incidence) const;

  const Chain& chain_;
  const Body& body_;
  Chucking setup_;
  RigidFrame frame_;
  Span span_;
  double outward_ = 1.0, side_ = 1.0, ball_mm_ = 0.0;
  double cos_tilt_ = 1.0, sin_tilt_ = 0.0;
  double cos_angle_, sin_angle_;
};

}  // namespace trueaxis::virtual_lathe
