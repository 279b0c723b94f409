// SPDX-License-Identifier: Apache-2.0
#include "diagnose/explain/form_class.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "diagnose/regression/size_prior.hpp"
#include "diagnose/search/local_forms.hpp"
#include "infer/classes.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr int tried[] = {12, 16, 20, 24, 30, 36, 48, 60, 72, 90, 120};

bool is_lobes(const Hypothesis& h) {
  return h.effect ? has_free_order(*h.effect) && std::holds_alternative<Harmonic>(h.effect->term)
                  : h.pattern.kind == Pattern::Kind::fourier_legendre && h.pattern.order > 1.0;
}

double order_of(const Hypothesis& h) { return h.effect ? h.shape.order : h.pattern.order; }

std::string place_of(const Pattern& p) {
  const std::string around = fmt::format("a local form at {:.0f}° (± {:.0f}°)",
                                         p.angle_rad / rad_per_deg, p.width_rad / rad_per_deg);
  if (!(p.length_mm > 0.0)) return around + " all along";
  return around + fmt::format(", Z {:.4g} mm (± {:.3g} mm)", p.position_mm, p.length_mm);
}

/// The same sections with other angles, even and over the whole turn.
ProbeStream sections_of(const Problem& problem, int angles) {
  const LinearisationPoint& point = problem.point;
  ProbeStream out;
  for (std::size_t f = 0; f < problem.mask.folds(); ++f)
    for (int k = 0; k < angles; ++k) {
      out.c_rad.push_back(point.c.front() +
                          two_pi * (static_cast<double>(f) + static_cast<double>(k) / angles));
      out.position_mm.push_back(point.z[problem.mask.fold_begin[f]]);
      out.reading_mm.push_back(0.0);
    }
  return out;
}

/// Both phases of lobes, of which the angles at hand may show one.
std::vector<Hypothesis> whole(std::vector<Hypothesis> terms) {
  for (Hypothesis& h : terms)
    if (is_lobes(h) && h.free.size() == 1) h.free = {0, 1};
  return terms;
}

/// d² of what the terms do from base and the best of other terms (Eq. 87). Without terms there is
/// nothing to tell apart.
double distance2(const LinearisationPoint& point, const Joint& of,
                 const std::vector<Hypothesis>& other) {
  if (of.terms.empty()) return std::numeric_limits<double>::infinity();
  const auto count = static_cast<Eigen::Index>(columns_of(of.terms));
  const Eigen::VectorXd linear = of.solution.coefficients.tail(count);
  const std::vector<double> done = contribution(point, of.terms, span_of(linear));
  const ObservationMask mask = make_observation_mask(point);
  NormalEquations equations(point, mask, done, {}, 1);
  Columns taken = equations.base();
  for (const Columns& own : equations.append(whole(other)))
    taken.insert(taken.end(), own.begin(), own.end());
  return project(equations.total(), taken).rss / (of.sigma_mm * of.sigma_mm);
}

}  // namespace

std::string form_words(const std::vector<Hypothesis>& terms) {
  std::vector<std::string> words;
  std::vector<double> orders;
  for (const Hypothesis& h : terms) {
    if (is_local(h)) words.push_back(place_of(h.pattern));
    if (is_lobes(h)) orders.push_back(order_of(h));
    if (h.effect && bends_reading(h.effect->term)) words.emplace_back(h.effect->title);
  }
  std::ranges::sort(orders);
  const auto [first, last] = std::ranges::unique(orders);
  orders.erase(first, last);
  if (!orders.empty()) words.push_back(fmt::format("lobes of order {:g}", fmt::join(orders, ", ")));
  return words.empty() ? "no form" : fmt::format("{}", fmt::join(words, " and "));
}

int angles_that_tell(const Problem& problem, const Joint& named, const Joint& other) {
  const LinearisationPoint& point = problem.point;
  for (const int angles : tried) {
    if (angles <= problem.resolution.per_turn) continue;
    const LinearisationPoint more =
        linearise_at(sections_of(problem, angles), point.clampings, point.base, point.bore);
    const double d2 =
        std::min(distance2(more, named, other.terms), distance2(more, other, named.terms));
    if (d2 >= sure_distance * sure_distance) return angles;
  }
  return 0;
}

std::vector<std::string> form_class_remark(const Problem& problem, const Joint& joint,
                                           const std::vector<Otherwise>& others) {
  if (others.empty()) return {};
  std::vector<std::pair<std::string, double>> members{{form_words(joint.terms), 1.0}};
  int angles = 0;
  bool tell = true;
  for (const Otherwise& o : others) {
    members.front().second -= o.probability;
    const std::string words = form_words(o.terms);
    const auto same = std::ranges::find(members, words, &std::pair<std::string, double>::first);
    if (same == members.end())
      members.emplace_back(words, o.probability);
    else
      same->second += o.probability;
    if (!problem.resolution.sparse) continue;
    const Joint other(problem, joint.equations.autoregression(), o.terms, o.terms.size());
    const int needed = angles_that_tell(problem, joint, other);
    tell &= needed > 0;
    angles = std::max(angles, needed);
  }
  std::vector<std::string> list;
  for (const auto& [words, probability] : members)
    list.push_back(fmt::format("{} (probability {:.2g})", words, probability));
  if (!problem.resolution.sparse)
    return {
        fmt::format("{}: these readings cannot tell, and the axis is averaged over both; jog X "
                    "by a known amount and probe again",
                    fmt::join(list, " or "))};
  return {
      fmt::format("{}: {:.0f} angles a section cannot tell, and the axis is averaged over all; {}",
                  fmt::join(list, " or "), problem.resolution.per_turn,
                  tell ? fmt::format("{} angles a section would tell", angles)
                       : "no number of angles up to 120 would")};
}

std::vector<std::string> alias_remark(const Resolution& resolution) {
  if (!resolution.sparse) return {};
  const auto m = static_cast<int>(std::lround(resolution.per_turn));
  return {fmt::format(
      "with {0} even angles per section, lobes of the orders n and k {0} ± n look alike. Orders "
      "{1}, {2}, {3}, {4} … look like eccentricity and move the axis by their amplitude; orders "
      "{0}, {5} … look like another radius; {6} angles separate all orders up to {2}",
      m, m - 1, m + 1, 2 * m - 1, 2 * m + 1, 2 * m, 2 * m + 3)};
}

}  // namespace trueaxis::diagnose_detail
