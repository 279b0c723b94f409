// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "diagnose/geometry/hypothesis.hpp"
#include "job/part_form_steps.hpp"
#include "trueaxis/effect.hpp"

namespace trueaxis {
namespace {

using namespace diagnose_detail;

/// A surface that is off the ideal one; a slip moves the part and changes no surface.
bool is_form(const Effect* effect) {
  return effect != nullptr && effect->slot == Slot::part && !is_step(effect->term);
}

LinearisationPoint point_of(const DiagnosedStream& diagnosed, double ball_mm) {
  const FitResult& fit = diagnosed.diagnosis->named;
  const std::vector<Clamping> clampings = clampings_of(fit, ball_mm);
  return linearise_at(diagnosed.stream, clampings, base_of(diagnosed.stream, fit, clampings),
                      fit.bore);
}

}  // namespace

std::vector<MotionColumns> motion_columns(const DiagnosedStream& diagnosed,
                                          std::span<const Finding* const> findings,
                                          double ball_mm) {
  std::vector<MotionColumns> out;
  if (findings.empty()) return out;
  const LinearisationPoint point = point_of(diagnosed, ball_mm);
  for (const Finding* finding : findings) {
    Hypothesis whole = of_effect(*finding->term.effect, finding->term.shape);
    const std::vector<double>& linear = finding->term.linear;
    const Covariance& covariance = finding->term.covariance;
    const std::size_t count = linear.size();
    MotionColumns made{finding,
                       is_of(*diagnosed.diagnosis, *finding),
                       contribution(point, {&whole, 1}, linear),
                       {},
                       {}};
    std::vector<double> u(count, 0.0);
    for (std::size_t j = 0; j < count && !covariance.empty(); ++j)
      u[j] = std::sqrt(std::max(0.0, covariance(j, j)));
    std::vector<std::size_t> moved;
    for (std::size_t j = 0; j < count; ++j)
      if (u[j] > 0.0) moved.push_back(j);
    for (const std::size_t j : moved) {
      std::vector<double> one(count, 0.0);
      one[j] = u[j];
      made.columns_mm.push_back(contribution(point, {&whole, 1}, one));
      for (const std::size_t i : moved)
        made.correlation.push_back(covariance(j, i) / (u[i] * u[j]));
    }
    out.push_back(std::move(made));
  }
  return out;
}

std::vector<double> local_forms_mm(const DiagnosedStream& diagnosed, double ball_mm) {
  std::vector<Hypothesis> local;
  std::vector<double> amplitudes;
  for (const Unexplained& one : diagnosed.diagnosis->unexplained) {
    if (!is_local_form(one)) continue;
    local.emplace_back().pattern = one.term.pattern;
    amplitudes.insert(amplitudes.end(), one.term.linear.begin(), one.term.linear.end());
  }
  if (local.empty()) return {};
  return contribution(point_of(diagnosed, ball_mm), local, amplitudes);
}

FindingIsOf is_of(const Diagnosis& diagnosis, const Finding& finding) {
  bool part = false, motion = false;
  for (const std::string& id : finding.members())
    (is_form(diagnosis.entry(id)) ? part : motion) = true;
  return part && motion ? FindingIsOf::open : part ? FindingIsOf::part : FindingIsOf::motion;
}

}  // namespace trueaxis
