// SPDX-License-Identifier: Apache-2.0
#include "job/slip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "job/references.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr const char* remedy = ": clamp it again and probe again";

bool is_slip(const Diagnosis& diagnosis, std::string_view id) {
  const Effect* effect = diagnosis.entry(id);
  return effect && is_step(effect->term);
}

Estimate parameter_of(const Finding& finding, std::string_view name) {
  for (const FitParameter& p : finding.parameters) {
    if (p.name == name) return p.estimate;
  }
  return {};
}

/// "19.7 ± 0.9 µm"
std::string plus_minus(double value, double U, const char* unit) {
  const int decimals = decimals_of(U, 1);
  return fmt::format("{:.{}f} ± {:.{}f}{}", value, decimals, U, decimals, unit);
}

/// Length of the vector of two parameters, its u along its own direction; none without both.
Estimate length_of(const Estimate& x, const Estimate& y) {
  if (!x.determined() || !y.determined()) return {};
  const double length = std::hypot(x.value, y.value);
  return {length, length > 0.0 ? std::hypot(x.value * x.u, y.value * y.u) / length : x.u, x.unit,
          ""};
}

/// Step across and along the axis, tilt and turn, as far as the readings show each.
std::string how_far(const Finding& finding, double k) {
  std::string text;
  const auto add = [&](const Estimate& e, double edge, const char* unit, const char* what) {
    if (!e.determined()) return;
    text += (text.empty() ? "" : " and ") + plus_minus(e.value / edge, k * e.u / edge, unit) + what;
  };
  const auto of = [&](std::string_view name) { return parameter_of(finding, name); };
  add(length_of(of("dx"), of("dy")), mm_per_um, " µm", "");
  add(of("dz"), mm_per_um, " µm", " along Z");
  add(length_of(of("tilt_x"), of("tilt_y")), 1.0, "°", " of tilt");
  add(of("turn"), 1.0, "°", "");
  add(of("dr"), mm_per_um, " µm", " of radius");
  add(of("taper"), 1.0, "°", " of taper");
  return text;
}

std::string named(const Finding& finding, double k) {
  std::string text = "the part slipped in the chuck";
  const Estimate onset = parameter_of(finding, "onset");
  if (onset.determined() && onset.unit == "s") text += fmt::format(" at {:.1f} s", onset.value);
  if (onset.determined() && onset.unit != "s")
    text += fmt::format(" at reading {:.0f}", onset.value + 1.0);
  const std::string by = how_far(finding, k);
  return text + (by.empty() ? "" : " by " + by);
}

/// As a member of the class of another name; empty: it is none.
std::string possible(const Diagnosis& diagnosis, const Finding& finding) {
  for (const Rival& rival : finding.rivals) {
    if (!is_slip(diagnosis, rival.effect)) continue;
    return fmt::format(
        "the part may have slipped in the chuck, which the data cannot tell from {} "
        "(probability of the slip {:.2g})",
        finding.effect(), rival.probability);
  }
  return "";
}

}  // namespace

bool is_sure_slip(const Diagnosis& diagnosis) {
  const Finding* slip = diagnosis.slip();
  if (!slip || !slip->rivals.empty() || !diagnosis.unexplained.empty()) return false;
  if (std::ranges::any_of(slip->parameters,
                          [](const FitParameter& p) { return !p.estimate.determined(); }))
    return false;
  return std::ranges::none_of(diagnosis.findings, [&](const Finding& finding) {
    return &finding != slip && std::ranges::any_of(finding.members(), [&](const std::string& id) {
      return is_slip(diagnosis, id);
    });
  });
}

std::string slip_objection(const JobResult& result) {
  std::string perhaps;
  for (std::size_t i = 0; i < result.diagnoses.size(); ++i) {
    if (!result.diagnoses[i] || is_sure_slip(*result.diagnoses[i])) continue;
    const Diagnosis& diagnosis = *result.diagnoses[i];
    if (const Finding* slip = diagnosis.slip())
      return of_reference(result, i) + named(*slip, diagnosis.baseline.coverage_factor) + remedy;
    for (const Finding& finding : diagnosis.findings) {
      const std::string maybe = possible(diagnosis, finding);
      if (perhaps.empty() && !maybe.empty()) perhaps = of_reference(result, i) + maybe + remedy;
    }
  }
  return perhaps;
}

std::string moved_part(const JobResult& result) {
  std::string text;
  for (std::size_t i = 0; i < result.diagnoses.size(); ++i) {
    if (!result.diagnoses[i] || !is_sure_slip(*result.diagnoses[i])) continue;
    text += (text.empty() ? "" : "; ") + of_reference(result, i) +
            named(*result.diagnoses[i]->slip(), result.fits[i].coverage_factor) +
            ": the axis is that of the part as it now stands";
  }
  return text;
}

}  // namespace trueaxis
