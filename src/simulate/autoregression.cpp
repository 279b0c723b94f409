// SPDX-License-Identifier: Apache-2.0
#include "simulate/autoregression.hpp"

#include <cmath>

#include "trueaxis/error.hpp"

namespace trueaxis::virtual_lathe {
namespace {

/// How an autoregression answers one impulse: until it has died out (then it is stationary).
struct ImpulseResponse {
  std::size_t length = 0;
  double energy = 0.0;  ///< variance of the series over that of its innovations
  bool dies_out = true;
};

ImpulseResponse impulse_response(const std::vector<double>& phi) {
  constexpr std::size_t most = 200000;
  ImpulseResponse out;
  std::vector<double> recent(phi.size(), 0.0);
  double now = 1.0, lately = 1.0;
  while (lately > 1e-20 * out.energy) {
    out.energy += now * now;
    if (++out.length > most || !(out.energy < 1e12)) {
      out.dies_out = false;
      return out;
    }
    std::shift_right(recent.begin(), recent.end(), 1);
    recent.front() = now;
    now = lately = 0.0;
    for (std::size_t j = 0; j < phi.size(); ++j) {
      now += phi[j] * recent[j];
      lately += recent[j] * recent[j];
    }
  }
  return out;
}

}  // namespace

bool is_stationary(const std::vector<double>& phi) {
  return phi.empty() || impulse_response(phi).dies_out;
}

Autoregression::Autoregression(const Noise& noise) : phi_(noise.autoregression) {
  if (phi_.empty()) {
    phi_ = {noise.rho};
    innovation_ = std::sqrt(1.0 - noise.rho * noise.rho);
  } else {
    const ImpulseResponse response = impulse_response(phi_);
    if (!response.dies_out)
      throw InputError("scenario", "noise: the autoregression is not stationary");
    innovation_ = 1.0 / std::sqrt(response.energy);
    run_in_ = response.length;
    begun_ = true;
  }
  recent_.assign(phi_.size(), 0.0);
}

}  // namespace trueaxis::virtual_lathe
