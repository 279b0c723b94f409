// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "trueaxis/probe_stream.hpp"

/// Fits of one cone stream by the engine and by what a user would reach for otherwise. All minimise
/// Eq. 12 of Constantin et al. from raw columns (C, Z, X_M): sin and cos, the solver's set-up and
/// its release are inside the time.
namespace trueaxis::peer {

struct PeerFit {
  std::array<double, 6> p{};  ///< x0, y0, l, m, k, half angle (mm, rad)
  double solver_ms = 0.0;     ///< the solver's call alone; for the engine the whole fit
  int iterations = 0;         ///< as the solver counts them
  bool converged = false;
};

struct PeerCode {
  const char* name;
  PeerFit (*run)(const ProbeStream&);
};

/// Relative tolerances of every peer, tight enough for minima that agree to 1e-9 mm: change of the
/// cost, and change of the parameters.
inline constexpr double cost_tolerance = 1e-15;
inline constexpr double parameter_tolerance = 1e-13;
inline constexpr int most_iterations = 200;

/// The engine first, then the peers.
std::span<const PeerCode> peer_codes();

/// Eq. 12 at p, mm², summed in long double: one judge for all codes.
double cone_cost(const ProbeStream& stream, const std::array<double, 6>& p);

}  // namespace trueaxis::peer
