// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "trueaxis/probe_stream.hpp"
#include "trueaxis/virtual_lathe.hpp"

/// What a fit estimates, as numbers of the virtual lathe.
namespace trueaxis::study {

/// @throws InputError of `who` where set-ups of one clamping have axes of their own.
void refuse_moving_axis(const virtual_lathe::Scenario& scenario, const ProbeStream& probed,
                        const char* who);

/// Numbers of a scenario that one parameter of the fit moves together, and a step of it that moves
/// readings by some µm.
struct EstimatedParameter {
  std::vector<double*> numbers;
  double step;
  bool is_length = true;  ///< mm; else an angle or a direction cosine
};

/// A scenario written so that everything that is estimated is a number of its own: every clamping
/// (the set-ups from one move of the part to the next, as the metadata tells) has its axis, and a
/// cone is given by its radius in the middle of all readings.
class Estimable {
 public:
  /// Nothing if set-ups of one clamping have axes of their own: no surface of the model is that.
  static std::optional<Estimable> of(const virtual_lathe::Scenario& scenario,
                                     const ProbeStream& probed, SurfaceKind surface);

  const virtual_lathe::Scenario& scenario() const { return scenario_; }

  /// Axis (section: centre) or face of every clamping, then radius and half angle of the part,
  /// which all share. A relative gauge does not show the radius.
  std::vector<EstimatedParameter> estimated_parameters();

  /// Clamping of every reading where the gauge's zero is estimated, one a clamping; else empty.
  const std::vector<std::size_t>& gauge_zero_of() const { return gauge_zero_of_; }
  std::size_t clampings() const { return set_ups_.size(); }

 private:
  void place_radius(const ProbeStream& probed);

  virtual_lathe::Scenario scenario_;
  SurfaceKind surface_ = SurfaceKind::cone;
  std::vector<std::vector<int>> set_ups_;  ///< numbers, clamping by clamping
  std::vector<std::size_t> gauge_zero_of_;
};

}  // namespace trueaxis::study
