// SPDX-License-Identifier: Apache-2.0
#include "diagnose/explain/averaged_axis.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/regression/size_prior.hpp"
#include "diagnose/search/causes.hpp"
#include "diagnose/search/statistic.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr double present = 0.1;   // how often a stream has an effect, before it is looked at
constexpr double told = 1e-3;     // probability below which a model is not listed
constexpr double nothing = 1e-2;  // of u: a shift below is none

/// A model of the readings instead of the named one.
struct Alternative {
  double probability = 0.0;
  Eigen::VectorXd off;         ///< its base less that of the named model
  Eigen::MatrixXd covariance;  ///< what its term's own uncertainty adds to the base
};

/// Effects that might be there and were not found, though the plan would show them at their
/// largest. Harmonics of free order are left out: they are no neighbours of the axis, which is of
/// order one.
std::vector<Hypothesis> not_found(const Problem& problem, const std::vector<Hypothesis>& terms,
                                  const std::vector<AmbiguousFinding>& findings,
                                  const std::vector<Unobservable>& hidden) {
  std::vector<Hypothesis> list = preset_causes(problem);
  std::erase_if(list, [&](const Hypothesis& h) {
    const Effect* effect = h.effect;
    const auto is_it = [&](const Hypothesis& other) { return other.effect == effect; };
    if (has_free_order(*effect) || std::ranges::any_of(terms, is_it) ||
        std::ranges::any_of(hidden,
                            [&](const auto& u) { return u.typical.hypothesis.effect == effect; }))
      return true;
    return std::ranges::any_of(findings, [&](const AmbiguousFinding& f) {
      return std::ranges::any_of(f.found.members,
                                 [&](const Candidate& c) { return is_it(c.hypothesis); });
    });
  });
  return list;
}

class Averaging {
 public:
  Averaging(const Problem& problem, const Joint& joint,
            const std::vector<AmbiguousFinding>& findings, const std::vector<Unobservable>& hidden)
      : problem_(problem),
        terms_(joint.terms.size()),
        findings_(findings),
        beside_(not_found(problem, joint.terms, findings, hidden)),
        wide_(problem, joint.equations.autoregression(), all_of(joint), terms_),
        gram_(wide_.equations.total()),
        n_(static_cast<Eigen::Index>(wide_.equations.base().size())) {
    for (std::size_t t = 0; t < terms_; ++t) {
      const Projection beside = project(wide_.equations.total(), columns_without(t));
      const Weighed weighed = weigh_term(t, beside);
      for (std::size_t j = 0; j < wide_.places[t].size(); ++j) {
        const auto c = static_cast<Eigen::Index>(wide_.places[t][j]);
        gram_(c, c) += weighed.precision(static_cast<Eigen::Index>(j));
      }
    }
    named_ = solve(gram_, columns_without(terms_));
  }

  AveragedAxis average() {
    AveragedAxis out;
    out.within = wide_.sigma_mm * wide_.sigma_mm * named_.inverse.topLeftCorner(n_, n_);
    out.between = Eigen::MatrixXd::Zero(n_, n_);
    out.shift = named_.coefficients.head(n_) - wide_.base();
    std::size_t next = terms_;
    for (const AmbiguousFinding& finding : findings_) of_finding(finding, next, out);
    if (problem_.point.base.face) {  // of a face the named model stands, with what rivals would do
      out.within = wide_.base_covariance();
      out.shift.setZero();
    } else {
      of_not_found(next, out);
      const double u = axis_uncertainty(problem_.point, out.within + out.between).u_mm;
      if (axis_shift(problem_.point, out.shift, out.within).value_mm < nothing * u)
        out.shift.setZero();
    }
    std::ranges::stable_sort(out.shares, [](const AxisShare& a, const AxisShare& b) {
      return a.probability * a.axis_shift.value > b.probability * b.axis_shift.value;
    });
    return out;
  }

 private:
  std::vector<Hypothesis> all_of(const Joint& joint) const {
    std::vector<Hypothesis> all = joint.terms;
    for (const AmbiguousFinding& finding : findings_)
      for (std::size_t r = 1; r < finding.found.members.size(); ++r)
        all.push_back(finding.found.members[r].hypothesis);
    all.insert(all.end(), beside_.begin(), beside_.end());
    return all;
  }

  Columns columns_without(std::size_t term) const {
    Columns columns = wide_.equations.base();
    for (std::size_t t = 0; t < terms_; ++t)
      if (t != term) columns.insert(columns.end(), wide_.places[t].begin(), wide_.places[t].end());
    return columns;
  }

  Weighed weigh_term(std::size_t place, const Projection& beside) const {
    return weigh(wide_.terms[place], beside, wide_.places[place], wide_.equations.count());
  }

  /// −2 ln of the odds of a term against none.
  double odds_of(std::size_t place, const Weighed& weighed) const {
    return weighed.criterion + choice_of(wide_.terms[place], weighed.mean) -
           2.0 * std::log(present / (1.0 - present));
  }

  Alternative with(std::size_t place, const Solution& without, const Weighed& weighed) const {
    const Eigen::MatrixXd right = gram_(without.columns, wide_.places[place]);
    const Eigen::MatrixXd per_unit = (without.inverse * right).topRows(n_);
    Alternative out;
    out.off =
        without.coefficients.head(n_) - per_unit * weighed.mean - named_.coefficients.head(n_);
    out.covariance = per_unit * weighed.covariance * per_unit.transpose();
    return out;
  }

  void add(const std::vector<Alternative>& list, AveragedAxis& out) const {
    Eigen::VectorXd shift = Eigen::VectorXd::Zero(n_);
    for (const Alternative& a : list) {
      shift += a.probability * a.off;
      out.between += a.probability * (a.off * a.off.transpose() + a.covariance);
    }
    out.between -= shift * shift.transpose();
    out.shift += shift;
  }

  void tell(const std::string& effect, const std::string& instead_of, const Alternative& a,
            AveragedAxis& out) const {
    if (a.probability < told) return;
    const AxisShift moved = axis_shift(problem_.point, a.off, a.covariance);
    out.shares.push_back(
        {effect, instead_of, a.probability, {moved.value_mm, moved.u_mm, "mm", ""}});
  }

  void of_finding(const AmbiguousFinding& finding, std::size_t& next, AveragedAxis& out) const {
    const Solution without = solve(gram_, columns_without(finding.term));
    const Projection beside = project(gram_, without.columns);
    const std::string named = wide_.terms[finding.term].id();
    const double odds = odds_of(finding.term, weigh_term(finding.term, beside));
    const double any = std::exp(-0.5 * std::clamp(odds, -1400.0, 1400.0)) /
                       std::max(finding.found.probability, 1e-12);
    const double none = 1.0 / (1.0 + any);
    std::vector<Alternative> list;
    for (const Rival& rival : finding.found.rivals) {
      list.push_back(with(next, without, weigh_term(next, beside)));
      list.back().probability = (1.0 - none) * rival.probability;
      tell(rival.effect, named, list.back(), out);
      ++next;
    }
    list.push_back({none, without.coefficients.head(n_) - named_.coefficients.head(n_),
                    Eigen::MatrixXd::Zero(n_, n_)});
    tell("", named, list.back(), out);
    add(list, out);
  }

  void of_not_found(std::size_t next, AveragedAxis& out) const {
    const Projection beside = project(gram_, named_.columns);
    for (std::size_t k = 0; k < beside_.size(); ++k, ++next) {
      if (score(beside, wide_.places[next]).rank == 0) continue;
      const Weighed weighed = weigh_term(next, beside);
      Alternative alternative = with(next, named_, weighed);
      alternative.probability =
          1.0 / (1.0 + std::exp(0.5 * std::clamp(odds_of(next, weighed), -1400.0, 1400.0)));
      tell(beside_[k].id(), "", alternative, out);
      add({alternative}, out);
    }
  }

  const Problem& problem_;
  std::size_t terms_;
  const std::vector<AmbiguousFinding>& findings_;
  std::vector<Hypothesis> beside_;
  Joint wide_;
  Eigen::MatrixXd gram_;  ///< with what the sizes of the terms may plausibly be
  Eigen::Index n_;
  Solution named_;
};

}  // namespace

AveragedAxis average_axis(const Problem& problem, const Joint& joint,
                          const std::vector<AmbiguousFinding>& findings,
                          const std::vector<Unobservable>& hidden) {
  const auto n = static_cast<Eigen::Index>(joint.equations.base().size());
  if (joint.terms.empty())
    return {Eigen::VectorXd::Zero(n), joint.base_covariance(), Eigen::MatrixXd::Zero(n, n), {}};
  return Averaging(problem, joint, findings, hidden).average();
}

}  // namespace trueaxis::diagnose_detail
