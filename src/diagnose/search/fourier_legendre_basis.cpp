// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/fourier_legendre_basis.hpp"

#include <algorithm>

namespace trueaxis::diagnose_detail {
namespace {

Hypothesis function_of(int order, int degree, bool spindle = false, bool in_time = false) {
  Hypothesis h;
  h.pattern = {.order = static_cast<double>(order),
               .spindle = spindle,
               .degree = degree,
               .in_time = in_time};
  return h;
}

}  // namespace

std::vector<Hypothesis> fourier_legendre_basis(const LinearisationPoint& point,
                                               const Resolution& resolution) {
  std::vector<Hypothesis> basis;
  for (int n = 0; n <= resolution.harmonics; ++n) {
    for (int l = 0; l <= resolution.degrees + (n == 0 && resolution.degrees > 3 ? 1 : 0); ++l)
      basis.push_back(function_of(n, l));
  }
  if (point.reindexed || point.two_sided) {
    for (int n = 2; n <= resolution.harmonics; ++n) {
      basis.push_back(function_of(n, 0, true));
      if (resolution.degrees > 0) basis.push_back(function_of(n, 1, true));
    }
  }
  if (point.has_time && !resolution.one_variable && !resolution.sections) {
    for (int n = 0; n <= std::min(resolution.harmonics, 3); ++n) {
      for (int l = 1; l <= 3; ++l) basis.push_back(function_of(n, l, true, true));
    }
  }
  return basis;
}

std::vector<Hypothesis> small_fourier_legendre_basis(const LinearisationPoint& point,
                                                     const Resolution& resolution) {
  std::vector<Hypothesis> basis;
  const std::size_t most = point.size() / 3;
  std::size_t columns = point.base.columns();
  const auto add = [&](int n, int l) {
    const std::size_t own = n == 0 ? 1 : 2;
    if (columns + own > most) return;
    columns += own;
    basis.push_back(function_of(n, l));
  };
  for (int n = 0; n <= resolution.harmonics; ++n) {
    add(n, 0);
    if (resolution.degrees > 0) add(n, 1);
    if (n == 0 || n == 2) {
      for (int l = 2; l <= resolution.degrees; ++l) add(n, l);
    }
  }
  // Between passes: machine terms seen from the rear, drift, backlash, latency.
  const auto add_machine = [&](int n, int l, bool in_time) {
    const std::size_t own = n == 0 ? 1 : 2;
    if (columns + own > most) return;
    columns += own;
    basis.push_back(function_of(n, l, true, in_time));
  };
  if (point.two_sided || point.reindexed) {
    for (int l = 0; l <= std::min(3, resolution.degrees); ++l) add_machine(0, l, false);
    for (int n = 2; n <= resolution.harmonics; ++n) {
      add_machine(n, 0, false);
      if (resolution.degrees > 0) add_machine(n, 1, false);
    }
  }
  if (point.has_time && !resolution.one_variable && !resolution.sections) {
    for (int n = 0; n <= 1; ++n)
      for (int l = 1; l <= 3; ++l) add_machine(n, l, true);
  }
  if (resolution.one_variable || resolution.sections) return basis;
  std::vector<const Effect*> shown;
  for (const Effect& effect : effect_catalogue()) {
    if (effect.between_passes > 0 && (!effect.needs.length || resolution.degrees > 0) &&
        (!effect.needs.time || point.has_time))
      shown.push_back(&effect);
  }
  std::ranges::sort(shown, {}, &Effect::between_passes);
  for (const Effect* effect : shown) {
    TermShape sensor;
    sensor.reference_x_mm = point.reference_x_mm;
    sensor.range_mm = point.range_x_mm;
    Hypothesis h = of_effect(*effect, sensor);
    columns += h.columns();
    if (columns <= most) basis.push_back(std::move(h));
  }
  return basis;
}

}  // namespace trueaxis::diagnose_detail
