// SPDX-License-Identifier: Apache-2.0
#include "diagnose/files/axes_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "diagnose/files/diagnosis_text.hpp"
#include "format/text_layout.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {

using namespace layout;
namespace {

constexpr std::size_t most_shares = 5;
constexpr double worth_a_line = 0.1;  // of u

std::string place(const FitResult& fit, double k) {
  std::string text;
  for (const double z : {fit.position_min_mm, fit.position_max_mm}) {
    const auto at = fit.axis.axis.at(z);
    const double U_um = k * fit.axis.u_at(z) / mm_per_um;
    const int decimals = decimals_of(U_um, 1);
    text +=
        fmt::format("{}({:.{}f}, {:.{}f}) ± {:.{}f} µm at Z {:.4g} mm", text.empty() ? "" : "; ",
                    at[0] / mm_per_um, decimals, at[1] / mm_per_um, decimals, U_um, decimals, z);
  }
  return text;
}

double u_of(const FitResult& fit) {
  return std::max(fit.axis.u_at(fit.position_min_mm), fit.axis.u_at(fit.position_max_mm));
}

}  // namespace

std::vector<AxisShare> telling_shares(const Diagnosis& d) {
  std::vector<AxisShare> list;
  if (d.extended.surface == SurfaceKind::plane) return list;  // the named model stands
  for (const AxisShare& share : d.shares)
    if (list.size() < most_shares &&
        share.probability * share.axis_shift.value > worth_a_line * u_of(d.extended))
      list.push_back(share);
  return list;
}

std::string share_text(const AxisShare& share, double k) {
  const std::string what = share.effect.empty() ? "no " + share.instead_of + " at all"
                           : share.instead_of.empty()
                               ? share.effect + ", too small to be found,"
                               : share.effect + " instead of " + share.instead_of;
  return fmt::format("{} (probability {}) would move it by {}", what,
                     probability(share.probability),
                     plus_minus(share.axis_shift, k, 1.0 / mm_per_um, "µm"));
}

std::string axes_text(const Diagnosis& d) {
  if (d.extended.status != FitStatus::converged || d.extended.surface == SurfaceKind::plane)
    return "";
  const double k = d.extended.coverage_factor;
  std::string text = fmt::format("\nAxis (x, y); ± U (k = {:.3g})\n", k);
  text += wrapped("  stated   ",
                  place(d.extended, k) + ": the average over what may have caused the readings");
  if (d.verdict != DiagnosisVerdict::ideal)
    text += wrapped("  named    ", place(d.named, k) + ": were all causes those that are named");
  text += wrapped("  ideal    ", place(d.baseline, k) + ": were there no cause");
  for (const AxisShare& share : telling_shares(d))
    text += wrapped("  why      ", share_text(share, k));
  return text;
}

}  // namespace trueaxis
