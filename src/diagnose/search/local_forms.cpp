// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/local_forms.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/regression/size_prior.hpp"
#include "diagnose/search/causes.hpp"
#include "infer/fitted.hpp"
#include "math/linear_algebra.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

// Standard deviations in steps from angle to angle and from section to section: for what meets one
// reading, for what its neighbours see too, and for what several do.
constexpr double widths[] = {0.4, 0.9, 2.0, 3.0}, lengths[] = {0.4, 1.2, 3.0};
constexpr double widest_rad = two_pi / 12.0;            // a sixth of a turn: beyond it is lobes
constexpr double least_width = 0.3;                     // of the steps
constexpr double left_over = 1e-6;                      // share of a column that must be left
constexpr double smallest_mm = 1e-3, largest_mm = 0.2;  // of dents, flats, burrs
constexpr double odds_against = 4.0;      // before the data: one part in five, as of any effect
constexpr double neighbour_step = 0.005;  // of neighbours() for the bend of the likelihood

struct Spacing {
  double rad, mm;  ///< from angle to angle, and from section to section
};
Spacing spacing_of(const Problem& problem) {
  return {two_pi / problem.resolution.per_turn,
          2.0 * problem.point.z_half_mm / static_cast<double>(problem.mask.folds() - 1)};
}

}  // namespace

void keep_local(const Problem& problem, Hypothesis& form) {
  Pattern& p = form.pattern;
  p.width_rad = std::min(p.width_rad, widest_rad);
  if (!problem.resolution.sparse) return;
  const Spacing step = spacing_of(problem);
  p.width_rad = std::clamp(p.width_rad, std::min(least_width * step.rad, widest_rad), widest_rad);
  const double half = problem.point.z_half_mm, mid = problem.point.z_mid_mm;
  p.position_mm = std::clamp(p.position_mm, mid - half, mid + half);
  if (p.length_mm > 0.0) p.length_mm = std::clamp(p.length_mm, least_width * step.mm, 2.0 * half);
}

double shape_choice(const Problem& problem, const std::vector<double>& phi,
                    const std::vector<Hypothesis>& terms, std::size_t term) {
  const Hypothesis& form = terms[term];
  const Pattern& p = form.pattern;
  std::vector<Hypothesis> list = terms;
  const std::vector<Hypothesis> near = neighbours(form, problem.point, neighbour_step);
  list.insert(list.end(), near.begin(), near.end());
  NormalEquations equations(problem.point, problem.mask, problem.deviation_mm, phi, 1);
  const std::vector<Columns> places = equations.append(list);
  const Projection rest = project(
      equations.total(), infer::besides(equations.base(), {places.data(), terms.size()}, term));
  const auto freedom = static_cast<double>(equations.count() - rest.rank);
  const auto fit = [&](std::size_t k) {
    return freedom * std::log(std::max(rest.rss - score(rest, places[k]).gain, 1e-12 * rest.rss));
  };
  const Spacing step = spacing_of(problem);
  const double length = 2.0 * problem.point.z_half_mm, by = 8.0 * neighbour_step;
  // In the order of neighbours(): what the step is, and what the parameter may be before the data.
  const double steps[] = {by * p.width_rad, by, by * p.length_mm, by};
  const double ranges[] = {
      two_pi, std::log(widest_rad / std::min(least_width * step.rad, 0.5 * widest_rad)), length,
      std::log(length / (least_width * step.mm))};
  double sum = 2.0 * std::log(2.0 * odds_against);  // all along or not
  for (std::size_t k = 0; 2 * k < near.size(); ++k) {
    const double bend =
        (fit(terms.size() + 2 * k) - 2.0 * fit(term) + fit(terms.size() + 2 * k + 1)) /
        (steps[k] * steps[k]);
    if (bend > 0.0) sum += std::max(0.0, std::log(ranges[k] * ranges[k] * bend / (2.0 * two_pi)));
  }
  return sum;
}

LocalForms::LocalForms(const Problem& problem) : problem_(problem) {
  const LinearisationPoint& point = problem.point;
  const ObservationMask& mask = problem.mask;
  for (std::size_t i = 0; i < point.size(); ++i)
    if (mask.used[i]) used_.push_back(i);
  const auto angles = static_cast<std::size_t>(std::lround(problem.resolution.per_turn));
  const auto [step_rad, step_mm] = spacing_of(problem);
  PointRoom room;
  const PointPart all = point.all(room);
  for (const double width : widths) {
    if (!forms_.empty() && forms_.back().pattern.width_rad >= widest_rad) break;
    const double width_rad = std::min(width * step_rad, widest_rad);
    for (int l = -1; l < static_cast<int>(std::size(lengths)); ++l, ++sizes_) {
      for (std::size_t f = 0; f < (l < 0 ? 1 : mask.folds()); ++f) {
        for (std::size_t half = 0; half < 2 * angles; ++half) {
          Hypothesis h;
          h.pattern.kind = Pattern::Kind::bump;
          h.pattern.angle_rad = std::remainder(
              all.theta.front() + 0.5 * step_rad * static_cast<double>(half), two_pi);
          h.pattern.width_rad = width_rad;
          h.pattern.position_mm = l < 0 ? point.z_mid_mm : all.s[mask.fold_begin[f]];
          h.pattern.length_mm = l < 0 ? 0.0 : lengths[l] * step_mm;
          forms_.push_back(std::move(h));
          size_.push_back(sizes_);
        }
      }
    }
  }
  tests_ = static_cast<double>(2 * angles * (mask.folds() + 1));
  for (Hypothesis& h : forms_) {
    h.tests = odds_against * tests_;
    h.smallest_mm = smallest_mm, h.largest_mm = largest_mm;
  }
  columns_ = rows_of(forms_, false);
  deviation_.resize(static_cast<Eigen::Index>(used_.size()));
  for (std::size_t k = 0; k < used_.size(); ++k)
    deviation_(static_cast<Eigen::Index>(k)) = problem.deviation_mm[used_[k]];
}

Eigen::MatrixXd LocalForms::rows_of(const std::vector<Hypothesis>& terms, bool with_base) const {
  const LinearisationPoint& point = problem_.point;
  const std::size_t base = with_base ? point.base.columns() : 0;
  Eigen::MatrixXd all(static_cast<Eigen::Index>(point.size()),
                      static_cast<Eigen::Index>(base + columns_of(terms)));
  std::vector<double*> places;
  for (Eigen::Index j = 0; j < all.cols(); ++j) places.push_back(all.col(j).data());
  const std::span<double* const> list(places);
  PointRoom room;
  const PointPart at = point.all(room);
  if (with_base) point.fill_base(at, list.first(base));
  std::size_t next = base;
  for (const Hypothesis& h : terms) {
    fill(h, point, at, list.subspan(next, h.columns()));
    next += h.columns();
  }
  return all(used_, Eigen::all);
}

std::vector<Hypothesis> LocalForms::beside(const std::vector<Hypothesis>& terms, std::size_t most,
                                           bool one_of_each) const {
  const Eigen::MatrixXd taken = rows_of(terms, true);
  const Eigen::MatrixXd q = linear::orthonormal_basis(taken);
  const Eigen::VectorXd left = linear::beside(q, deviation_);
  const Eigen::VectorXd norm2 = columns_.colwise().squaredNorm();
  const Eigen::VectorXd free2 =
      norm2 - Eigen::VectorXd((q.transpose() * columns_).colwise().squaredNorm());
  const Eigen::VectorXd right = columns_.transpose() * left;
  const double rss = left.squaredNorm(), freedom = static_cast<double>(taken.rows() - q.cols());
  struct Found {
    double criterion;
    std::size_t form;
  };
  std::vector<Found> found;
  for (std::size_t k = 0; k < forms_.size(); ++k) {
    const auto j = static_cast<Eigen::Index>(k);
    if (!(free2(j) > left_over * norm2(j))) continue;
    const Weighed weighed = weigh(size_prior(forms_[k]), Eigen::MatrixXd::Constant(1, 1, free2(j)),
                                  Eigen::VectorXd::Constant(1, right(j)),
                                  Eigen::VectorXd::Constant(1, norm2(j)), rss, freedom);
    found.push_back({weighed.criterion, k});
  }
  std::ranges::sort(found, {}, &Found::criterion);
  std::vector<Hypothesis> out;
  std::vector<char> had(sizes_, 0);
  for (const Found& f : found) {
    if (out.size() == most) break;
    if (one_of_each && had[size_[f.form]]) continue;
    had[size_[f.form]] = 1;
    out.push_back(forms_[f.form]);
  }
  return out;
}

}  // namespace trueaxis::diagnose_detail
