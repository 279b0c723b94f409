// SPDX-License-Identifier: Apache-2.0
#include "blind/size.hpp"

#include <cmath>

namespace trueaxis::blind {

double lambda(const Bench& bench, const Effect& effect, const std::vector<Effect>& others,
              double sigma_mm, bool protect_others) {
  std::vector<Effect> all = others;
  all.push_back(effect);
  const Eigen::VectorXd without = others.empty() ? bench.plain() : bench.clean(others);
  Subspace space = bench.surface();
  if (protect_others) {
    for (const Effect& other : others) space.add(columns(bench, other));
  }
  return space.residual(bench.clean(all) - without).squaredNorm() / (sigma_mm * sigma_mm);
}

Effect sized_for(const Bench& bench, Effect effect, double sigma_mm, double wanted) {
  for (int step = 0; step < 8; ++step) {
    const double now = lambda(bench, effect, {}, sigma_mm, false);
    if (!(now > 1e-9) || std::abs(now / wanted - 1.0) < 0.005) break;
    effect = scaled(std::move(effect), std::sqrt(wanted / now));
    if (over_typical(effect) > 100.0)
      break;  // out of the linear range: not to be seen by this plan
  }
  return effect;
}

}  // namespace trueaxis::blind
