// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnose/files/diagnosis_screen.hpp"
#include "format/text_layout.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {

using namespace layout;
namespace {

/// "up to 5 ms", of the sizes that the catalogue calls typical.
std::string assumed(const Effect& effect) {
  for (const LinearParameter& one : linear_parameters(effect.term, {})) {
    const EffectParameter* size = size_for(effect, one);
    if (size == nullptr || !(size->high > 0.0)) continue;
    const bool milli = size->unit == "s", micro = size->unit == "mm" && size->high < 0.1;
    const Estimate shown = at_edge({size->high, 0.0, std::string(size->unit), ""});
    const std::string unit = milli ? "ms" : micro ? "µm" : shown.unit == "1" ? "" : shown.unit;
    const double factor = milli ? 1e3 : micro ? 1.0 / mm_per_um : 1.0;
    return fmt::format("up to {:.3g}{}{}", factor * shown.value, unit.empty() ? "" : " ", unit);
  }
  return "";
}

/// What shows a cause that was not found, or how it is stated.
std::string remedy(const Diagnosis& d, const Effect& effect) {
  const auto hidden =
      std::ranges::find(d.not_observable, std::string(effect.id), &NotObservable::effect);
  std::string text;
  if (hidden != d.not_observable.end() && hidden->separate_with) text = hidden->separate_with->what;
  if (effect.stated_as)
    text += (text.empty() ? "state " : ", or state ") +
            std::string(info_of(*effect.stated_as).stated) +
            (effect.stated ? " with a smaller u" : " with its u (--known)");
  return text.empty() ? "" : ": " + text;
}

/// An uncertainty has two digits.
std::string two_digits(double mm) {
  if (!(mm > 0.0)) return um(mm);
  const double step = std::pow(10.0, std::floor(std::log10(mm)) - 1.0);
  return um(step * std::round(mm / step));
}

}  // namespace

std::string limit_text(const Diagnosis& d) {
  const FitResult& fit = d.extended;
  if (d.limits.empty() || !fit.axis_known() || fit.surface == SurfaceKind::plane) return "";
  const double U_mm = fit.coverage_factor * std::max(fit.axis.u_at(fit.position_min_mm),
                                                     fit.axis.u_at(fit.position_max_mm));
  if (!std::isfinite(U_mm)) return "";
  const AxisLimit& most = d.limits.front();
  const auto would_be = [&](double share) {
    return fmt::format("U {} would be {} ", two_digits(U_mm),
                       two_digits(U_mm * std::sqrt(std::max(0.0, 1.0 - share))));
  };
  if (!most.instead_of.empty())
    return would_be(most.share) + "if it were sure what " + most.instead_of + " is" +
           (d.next.what.empty() ? "" : ": " + d.next.what);
  if (most.effect.empty())
    return would_be(0.75 * most.share) + "with four times as many readings: noise is the limit";
  const Effect* effect = d.entry(most.effect);
  if (effect == nullptr) return "";
  if (effect->stated)
    return would_be(most.share) + "if " + std::string(info_of(effect->stated->kind).name) +
           " were known exactly" + remedy(d, *effect);
  const std::string size = assumed(*effect);
  return would_be(most.share) + "without " + most.effect + ", which these readings do not show" +
         (size.empty() ? "" : " (" + size + " assumed)") + remedy(d, *effect);
}

std::string limit_screen(const Diagnosis& d) {
  const std::string text = limit_text(d);
  return text.empty() ? "" : "limit  " + text + "\n";
}

}  // namespace trueaxis
