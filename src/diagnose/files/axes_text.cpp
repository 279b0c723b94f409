// SPDX-License-Identifier: Apache-2.0
#include "diagnose/files/axes_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>

#include "base/number.hpp"
#include "diagnose/files/diagnosis_text.hpp"
#include "format/text_layout.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {

using namespace layout;
namespace {

constexpr std::size_t most_shares = 5;
constexpr double worth_a_line = 0.1;  // of u, or of its square

std::string place(const FitResult& fit, double k) {
  std::string text;
  for (const double z : {fit.position_min_mm, fit.position_max_mm}) {
    const auto at = fit.axis.axis.at(z);
    const double U_um = k * fit.axis.u_at(z) / mm_per_um;
    const int decimals = decimals_of(U_um, 1);
    text += fmt::format("{}({:.{}f}, {:.{}f}) ± {:.{}f} µm at Z {:.6g} mm",
                        text.empty() ? "" : "; ", at[0] / mm_per_um, decimals, at[1] / mm_per_um,
                        decimals, U_um, decimals, hundredths(z));
  }
  return text;
}

double u_of(const FitResult& fit) {
  return std::max(fit.axis.u_at(fit.position_min_mm), fit.axis.u_at(fit.position_max_mm));
}

/// What a share adds to the square of u.
double widens(const AxisShare& share) {
  const double shift = share.axis_shift.value, u = share.axis_shift.u;
  return share.probability * (shift * shift + u * u);
}

/// The axes of a diagnosis that has them, and what told: one line each.
std::string axes_lines(const Diagnosis& d) {
  const double k = d.extended.coverage_factor;
  const bool ideal = d.verdict == DiagnosisVerdict::ideal;
  std::string text =
      wrapped("  stated   ",
              place(d.extended, k) +
                  (ideal ? ": that of the ideal fit; its U includes causes too small to be found"
                         : ": the average over the possible causes"));
  if (!ideal)
    text += wrapped("  named    ", place(d.named, k) + ": if every cause is the one named");
  text += wrapped("  ideal    ", place(d.baseline, k) + ": if there is no cause");
  for (const AxisShare& share : telling_shares(d))
    text += wrapped("  why      ", share_text(share, k));
  return text;
}

}  // namespace

std::vector<AxisShare> telling_shares(const Diagnosis& d) {
  if (d.extended.surface == SurfaceKind::plane) return {};  // the named model stays
  const double u = u_of(d.extended);
  std::vector<AxisShare> list;
  std::ranges::copy_if(d.shares, std::back_inserter(list), [&](const AxisShare& share) {
    return share.probability * share.axis_shift.value > worth_a_line * u ||
           widens(share) > worth_a_line * u * u;
  });
  std::ranges::stable_sort(list, std::ranges::greater{}, widens);
  if (list.size() > most_shares) list.resize(most_shares);
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

std::string axes_text(const Diagnosis& d, const std::string& heading) {
  if (d.extended.status != FitStatus::converged || d.extended.surface == SurfaceKind::plane)
    return "";
  return heading + fmt::format(" (x, y); ± U (k = {:.3g})\n", d.extended.coverage_factor) +
         axes_lines(d);
}

}  // namespace trueaxis
