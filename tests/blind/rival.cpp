// SPDX-License-Identifier: Apache-2.0
#include "blind/rival.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include "blind/by_entry.hpp"

namespace trueaxis::blind {
namespace {

std::optional<Refinement> refinement(const Bench& bench, const Effect& shaped) {
  const auto bin = [](const Eigen::VectorXd& x) {
    return 0.125 * 2.0 * std::numbers::pi / (x.maxCoeff() - x.minCoeff());
  };
  const auto of_period = [&](const char* name, const Eigen::VectorXd& x) {
    return Refinement{name, bin(x) * shaped.parameters.at(name) / (2.0 * std::numbers::pi), true};
  };
  const std::string& id = shaped.id;
  if (const ByEntry* known = known_by_entry(id)) return refinement(bench, *known, shaped);
  if (id == "spindle.asynchronous") return Refinement{"order", bin(bench.c_rad()), false};
  if (id == "environment.vibration") {
    return Refinement{"frequency_hz", bin(bench.time_s()) / (2.0 * std::numbers::pi), false};
  }
  if (id == "part.waviness") return of_period("wavelength_mm", bench.z_mm());
  if (id == "slide.leadscrew_periodic") return of_period("pitch_mm", bench.z_mm());
  if (id == "part.feed_marks") return of_period("feed_mm_per_rev", bench.z_mm());
  if (id == "probe.cyclic") return of_period("period_mm", bench.plain());
  if (id == "part.chuck_lobing") return Refinement{"decay_length_mm", 6.0, true};
  if (id == "thermal.drift") return Refinement{"time_constant_s", 2.5, true};
  if (id == "part.creep") return Refinement{"settling_s", 2.5, true};
  if (id == "part.slip") {
    return Refinement{"time_s", bench.time_s().maxCoeff() / 120.0, false};
  }
  if (id == "spindle.tilt_synchronous") return Refinement{"bearing_mm", 120.0, false};
  return std::nullopt;
}

// The lathe's defaults are not there for a shape: sizes and what is not searched.
Effect completed(Effect shaped, const std::string& id) {
  for (const Size& size : family(id).sizes) {
    shaped.parameters.try_emplace(std::string(size.name), size.typical_most);
  }
  return shaped;
}

// Smallest value of f on [low, high] by golden section, down to `enough`.
double smallest(const std::function<double(double)>& f, double low, double high, double enough) {
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double at_a = f(a), at_b = f(b);
  for (int step = 0; step < 12 && std::min(at_a, at_b) > enough; ++step) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      a = high - golden * (high - low), at_a = f(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + golden * (high - low), at_b = f(b);
    }
  }
  return std::min(at_a, at_b);
}

}  // namespace

Residue residue(const Bench& bench, const TrueEffect& truth) {
  Residue of{bench.surface(), {}};
  for (const Effect& other : truth.others) of.taken.add(columns(bench, other));
  std::vector<Effect> all = truth.others;
  all.push_back(truth.effect);
  const Eigen::VectorXd without = truth.others.empty() ? bench.plain() : bench.clean(truth.others);
  of.left = of.taken.residual(bench.clean(all) - without);
  return of;
}

double distance(const Bench& bench, const TrueEffect& truth, const std::string& rival,
                double enough) {
  const Residue of = residue(bench, truth);
  const auto d = [&](const Effect& shaped) {
    Subspace space = of.taken;
    space.add(columns(bench, shaped));
    return space.residual(of.left).norm() / truth.sigma_mm;
  };
  std::vector<std::pair<double, Effect>> tried;
  for (const Effect& shape : mimics(bench, rival, of)) {
    const Effect shaped = completed(shape, rival);
    tried.emplace_back(d(shaped), shaped);
    if (tried.back().first <= enough) return tried.back().first;
  }
  std::ranges::sort(tried, [](const auto& a, const auto& b) { return a.first < b.first; });
  double best = tried.front().first;
  for (std::size_t k = 0; k < std::min<std::size_t>(2, tried.size()) && best > enough; ++k) {
    Effect shaped = tried[k].second;
    const std::optional<Refinement> by = refinement(bench, shaped);
    if (!by) break;
    const double centre = shaped.parameters.at(by->name);
    const auto at = [&](double x) {  // −1 … 1
      shaped.parameters[by->name] =
          by->relative ? centre * std::pow(1.0 + by->span, x) : centre + by->span * x;
      return d(shaped);
    };
    best = std::min(best, smallest(at, -1.0, 1.0, enough));
  }
  return best;
}

}  // namespace trueaxis::blind
