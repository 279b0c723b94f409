// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <boost/math/special_functions/legendre.hpp>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>
#include <tuple>

#include "simulate/chain.hpp"
#include "trueaxis/units.hpp"

/// The catalogue of the virtual lathe: what an effect is and how it enters the chain.
namespace trueaxis::virtual_lathe {

/// Calls with the effect's parameter of a name.
class Values {
 public:
  explicit Values(const Effect& effect) : effect_(effect) {}
  double operator()(std::string_view name) const { return parameter(effect_, name); }

  /// All of them, in the order of the catalogue.
  template <std::size_t count>
  std::array<double, count> all() const {
    std::array<double, count> values{};
    const auto parameters = find_effect_kind(effect_.id).parameters;
    for (std::size_t i = 0; i < count; ++i) values[i] = (*this)(parameters[i].name);
    return values;
  }

 private:
  const Effect& effect_;
};

using Enters = void (*)(const Values&, Chain&);

struct EffectEntry {
  std::string_view id, what;
  LatheParameter parameters[11];  ///< those after the last have no name
  Enters enter;
};

template <class Formula, class Out, class At, class... Numbers>
std::function<Out(At)> with_values(Formula formula, Out (Formula::*)(At, Numbers...) const,
                                   const Values& of) {
  return [formula, values = of.all<sizeof...(Numbers)>()](At at) {
    return std::apply([&](Numbers... numbers) { return formula(at, numbers...); }, values);
  };
}

inline constexpr auto form = &Chain::form;
inline constexpr auto machine = &Chain::machine;
inline constexpr auto response = &Chain::response;

/// A formula in a slot of the chain. Its arguments are what the slot is about, then the effect's
/// parameters, in the order of its entry.
template <auto slot, class Formula>
constexpr Enters in(Formula) {
  return [](const Values& of, Chain& chain) {
    (chain.*slot).push_back(with_values(Formula{}, &Formula::operator(), of));
  };
}

/// A wave of the surface, a cos(2π s/wavelength + turns θ + phase).
template <int turns>
void enter_wave(const Values& of, Chain& chain) {
  const auto [a, wavelength, phase] = of.all<3>();
  chain.form.push_back([a, k = two_pi / wavelength, phase](const SurfacePoint& p) {
    return a * std::cos(k * p.s_mm + turns * p.theta_rad + phase);
  });
  chain.waves_mm += std::abs(a);
  chain.shortest_mm = std::min(chain.shortest_mm, std::abs(wavelength));
}

/// Legendre polynomial P_l, also a little outside [−1, 1], where a probe may overrun.
inline double legendre(double degree, double u) {
  double before = 1.0, now = u;
  if (degree == 0.0) return before;
  for (unsigned l = 1; l < static_cast<unsigned>(degree); ++l) {
    const double next = boost::math::legendre_next(l, u, now, before);
    before = now;
    now = next;
  }
  return now;
}

/// Slot C: what the part's surface is, in the part's own frame.
std::span<const EffectEntry> part_effects();

/// Slots A and D: where spindle and slides really are against what is recorded, and when. What the
/// encoder says comes first: the errors of the spindle follow its true angle.
std::span<const EffectEntry> machine_effects();

/// Slots B and E: the probe's line and the sensor's response.
std::span<const EffectEntry> probe_effects();

/// What no catalogue has: forms and motions for tests that must end with "unknown", then patterns
/// without a cause, which play back what a diagnosis leaves unexplained.
std::span<const EffectEntry> extra_effects();
/// What a face shows: its form, axial motion, the X slide.
std::span<const EffectEntry> face_effects();

}  // namespace trueaxis::virtual_lathe
