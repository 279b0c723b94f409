// SPDX-License-Identifier: Apache-2.0
#include "diagnose/explain/averaged_axis.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/explain/form_class.hpp"
#include "diagnose/explain/not_found.hpp"
#include "diagnose/regression/size_prior.hpp"
#include "diagnose/search/causes.hpp"
#include "diagnose/search/local_forms.hpp"
#include "infer/classes.hpp"
#include "infer/significance.hpp"
#include "infer/size_posterior.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::diagnose_detail {
namespace {

// A form that no cause explains is known by the patterns that the data show of it, and may have as
// well what the surface takes: in the axis at each end, this share of the patterns' root mean
// square.
constexpr double discrepancy = 0.1;
constexpr double present = 0.2;         // how often a stream has an effect, before it is looked at
constexpr double moved_in_all = 0.9;    // how often a part that moved did so in all ways
constexpr double nothing = 1e-2;        // of u: a smaller shift does not count
constexpr std::size_t most_forms = 48;  // shapes of a local form that are averaged over
constexpr double finer_steps[] = {0.06, 0.02, 0.007};  // steps about the one that was found

/// The residual that no cause explains, mm.
double unexplained_rms(const Joint& joint) {
  double sum = 0.0;
  for (std::size_t t = 0; t < joint.terms.size(); ++t) {
    if (joint.terms[t].effect) continue;
    for (const double x : joint.contribution_of(t)) sum += x * x;
  }
  return std::sqrt(sum / static_cast<double>(joint.equations.point().size()));
}

class Averaging {
 public:
  Averaging(const Problem& problem, const Joint& joint,
            const std::vector<AmbiguousFinding>& findings)
      : problem_(problem),
        terms_(joint.terms.size()),
        findings_(findings),
        local_(local_shapes(problem, joint)),
        beside_(not_found(problem, joint.terms, findings)),
        slope_(slope_beside(problem, joint.terms)),
        wide_(problem, joint.equations.autoregression(), all_of(joint), terms_),
        gram_(wide_.equations.total()),
        n_(static_cast<Eigen::Index>(wide_.equations.base().size())) {
    for (std::size_t t = 0; t < terms_; ++t) {
      const Projection beside = project(wide_.equations.total(), wide_.besides(t));
      const Weighed weighed = weigh_term(t, beside);
      for (std::size_t j = 0; j < wide_.places[t].size(); ++j) {
        const auto c = static_cast<Eigen::Index>(wide_.places[t][j]);
        gram_(c, c) += weighed.precision(static_cast<Eigen::Index>(j));
      }
    }
    named_ = solve(gram_, wide_.besides(terms_));
  }

  AveragedAxis average() {
    AveragedAxis out;
    out.within = wide_.sigma_mm * wide_.sigma_mm * named_.inverse.topLeftCorner(n_, n_);
    out.between = Eigen::MatrixXd::Zero(n_, n_);
    out.shift = named_.coefficients.head(n_) - wide_.base();
    std::size_t next = terms_;
    for (const AmbiguousFinding& finding : findings_) of_finding(finding, next, out);
    for (std::size_t t = 0; t < terms_; ++t) of_slope(t, out);
    for (const LocalShapes& shapes : local_) of_local_form(shapes, next, out);
    of_not_found(next, out);
    if (problem_.point.base.face) {  // the named model stays, with what other causes would do
      out.within = wide_.base_covariance();
      out.between += out.shift * out.shift.transpose();
      out.shift.setZero();
    } else {
      if (terms_ == 0) {  // nothing was found: the ideal fit stays
        out.between += out.shift * out.shift.transpose();
        out.shift.setZero();
      }
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
  /// What a local form may be instead where few angles do not show its shape.
  struct LocalShapes {
    std::size_t term = 0;
    std::vector<Hypothesis> shapes;
  };
  static std::vector<LocalShapes> local_shapes(const Problem& problem, const Joint& joint) {
    std::vector<LocalShapes> out;
    if (!problem.resolution.sparse || std::ranges::none_of(joint.terms, is_local)) return out;
    const LocalForms forms(problem);
    for (std::size_t t = 0; t < joint.terms.size(); ++t) {
      if (!is_local(joint.terms[t])) continue;
      std::vector<Hypothesis> others = joint.terms;
      others.erase(others.begin() + static_cast<long>(t));
      LocalShapes& local = out.emplace_back(LocalShapes{t, {joint.terms[t]}});
      for (const double step : finer_steps)
        for (Hypothesis& near : neighbours(joint.terms[t], problem.point, step)) {
          keep_local(problem, near);
          local.shapes.push_back(std::move(near));
        }
      for (Hypothesis& form : forms.beside(others, most_forms, false))
        local.shapes.push_back(std::move(form));
    }
    return out;
  }

  std::vector<Hypothesis> all_of(const Joint& joint) const {
    std::vector<Hypothesis> all = joint.terms;
    for (const AmbiguousFinding& finding : findings_)
      for (std::size_t r = 1; r < finding.found.members.size(); ++r)
        all.push_back(finding.found.members[r].hypothesis);
    for (const LocalShapes& local : local_)
      all.insert(all.end(), local.shapes.begin(), local.shapes.end());
    all.insert(all.end(), beside_.begin(), beside_.end());
    if (slope_) all.push_back(*slope_);
    return all;
  }

  Weighed weigh_term(std::size_t place, const Projection& beside) const {
    return weigh(stated_prior(wide_.terms[place]), beside, wide_.places[place],
                 wide_.equations.count());
  }

  /// −2 ln of the odds of a term against none.
  double odds_of(std::size_t place, const Weighed& weighed, double often = present) const {
    return weighed.criterion + choice_of(wide_.terms[place]) -
           2.0 * std::log(often / (1.0 - often));
  }

  Alternative with(std::size_t place, const Solution& without, const Weighed& weighed) const {
    const Eigen::MatrixXd per_unit = base_per_unit(place, without);
    Alternative out;
    out.off =
        without.coefficients.head(n_) - per_unit * weighed.mean - named_.coefficients.head(n_);
    out.covariance = linear::propagated(per_unit, weighed.covariance);
    return out;
  }

  Eigen::MatrixXd base_per_unit(std::size_t place, const Solution& without) const {
    const Eigen::MatrixXd right = gram_(without.columns, wide_.places[place]);
    return (without.inverse * right).topRows(n_);
  }

  /// The same with the named model as the mixture over its sizes, of a probability in all.
  void add_sizes(std::size_t place, const Projection& beside, double probability,
                 std::vector<Alternative>& list) const {
    const Eigen::MatrixXd per_unit = base_per_unit(place, named_);
    for (const SizePart& part : size_posterior(stated_prior(wide_.terms[place]), beside,
                                               wide_.places[place], wide_.equations.count()))
      list.push_back({probability * part.weight, -per_unit * part.mean,
                      linear::propagated(per_unit, part.covariance)});
  }

  /// @param law the normals of the list; empty: they are those
  void add(std::vector<Alternative> list, const Effect* effect, const std::string& instead_of,
           AveragedAxis& out, std::vector<Alternative> law = {}) const {
    Eigen::VectorXd shift = Eigen::VectorXd::Zero(n_);
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n_, n_);
    for (const Alternative& a : list) {
      shift += a.probability * a.off;
      covariance += a.probability * (a.off * a.off.transpose() + a.covariance);
    }
    covariance -= shift * shift.transpose();
    out.between += covariance;
    out.shift += shift;
    if (law.empty()) law = std::move(list);
    out.sources.push_back({effect, instead_of, std::move(covariance), std::move(law)});
  }

  void tell(const std::string& effect, const std::string& instead_of, const Alternative& a,
            AveragedAxis& out) const {
    if (a.probability < infer::in_no_class) return;
    const AxisShift moved = axis_shift(problem_.point, a.off, a.covariance);
    out.shares.push_back(
        {effect, instead_of, a.probability, {moved.value_mm, moved.u_mm, "mm", ""}});
  }

  void of_finding(const AmbiguousFinding& finding, std::size_t& next, AveragedAxis& out) const {
    const Solution without = solve(gram_, wide_.besides(finding.term));
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
    add(list, nullptr, named, out);
  }

  /// The slope of a sensor that bends, as far as that is what was named.
  void of_slope(std::size_t term, AveragedAxis& out) const {
    if (!slope_ || !bends_about_a_place(wide_.terms[term])) return;
    const Columns& own = wide_.places.back();
    const Weighed bend = weigh_term(term, project(gram_, wide_.besides(term)));
    const Weighed slope =
        infer::weigh(slope_prior(wide_.terms[term], bend), project(gram_, named_.columns), own,
                     wide_.equations.count());
    const Eigen::MatrixXd per_unit = base_per_unit(wide_.places.size() - 1, named_);
    Alternative named{1.0, -per_unit * slope.mean, linear::propagated(per_unit, slope.covariance)};
    for (const AmbiguousFinding& f : findings_)
      if (f.term == term) named.probability = f.found.probability;
    add({named}, slope_->effect, wide_.terms[term].id(), out);
  }

  /// The shapes are alternatives to each other, and take the place of the one that was found.
  void of_local_form(const LocalShapes& local, std::size_t& next, AveragedAxis& out) const {
    const Solution without = solve(gram_, wide_.besides(local.term));
    const Projection beside = project(gram_, without.columns);
    std::vector<Alternative> list;
    std::vector<double> criterion;
    for (std::size_t k = 0; k < local.shapes.size(); ++k, ++next) {
      const Weighed weighed = weigh_term(next, beside);
      list.push_back(with(next, without, weighed));
      criterion.push_back(weighed.criterion);
    }
    if (list.empty()) return;
    const double best = std::ranges::min(criterion);
    double sum = 0.0;
    for (std::size_t k = 0; k < list.size(); ++k)
      sum += list[k].probability = std::exp(-0.5 * (criterion[k] - best));
    for (Alternative& a : list) a.probability /= sum;
    add(list, nullptr, wide_.terms[local.term].id(), out);
    // What its own size adds was counted with the noise already.
    out.between -= wide_.sigma_mm * wide_.sigma_mm *
                   (named_.inverse.topLeftCorner(n_, n_) - without.inverse.topLeftCorner(n_, n_));
  }

  /// One effect that was not found, its shapes being alternatives.
  struct Missed {
    std::vector<Alternative> shapes;  ///< the probability of each once it is there
    std::vector<std::size_t> places;  ///< of each
    double odds = 0.0;                ///< against the effect being absent
    const Effect* effect = nullptr;
  };

  /// @param shown the same without what the sizes of the terms may plausibly be: what the readings
  /// alone do not show is not in U
  Missed missed_from(std::size_t& k, std::size_t next, const Projection& beside,
                     const Projection& shown) const {
    Missed out;
    const Effect* effect = beside_[k].effect;
    const double often = is_step(effect->term) ? moved_in_all : present;
    out.effect = effect;
    double sum = 0.0;
    std::size_t shapes = 0;
    for (; k < beside_.size() && beside_[k].effect == effect; ++k, ++next) {
      if (!effect->stated && score(shown, wide_.places[next]).rank == 0) continue;
      const Weighed weighed = weigh_term(next, beside);
      const double odds =
          std::exp(-0.5 * std::clamp(odds_of(next, weighed, often), -1400.0, 1400.0));
      // Readings that ask for a size that cannot be show another thing.
      if (!effect->stated && !weighed.possible && odds > 1.0) continue;
      out.shapes.push_back(with(next, named_, weighed));
      out.places.push_back(next);
      out.shapes.back().probability = odds;
      sum += odds, ++shapes;
    }
    for (Alternative& a : out.shapes) a.probability /= sum;
    if (shapes > 0) out.odds = sum / static_cast<double>(shapes);
    return out;
  }

  /// Effects that are there more likely than not are taken as alternatives to each other, for they
  /// may explain the same; the others as independent. What is stated of one is there.
  void of_not_found(std::size_t next, AveragedAxis& out) const {
    const Eigen::MatrixXd of_readings = wide_.equations.total();
    const Projection beside = project(gram_, named_.columns),
                     shown = project(of_readings, named_.columns);
    std::vector<Missed> missed;
    for (std::size_t k = 0, first = 0; k < beside_.size(); first = k)
      missed.push_back(missed_from(k, next + first, beside, shown));
    double likely = 0.0;
    const auto competes = [](const Missed& m) { return m.odds > 1.0 && !m.effect->stated; };
    for (const Missed& m : missed)
      if (competes(m)) likely += m.odds;
    std::vector<Alternative> rivals, law_of_rivals;
    const Effect* first = nullptr;  // the likeliest of them
    double most_odds = 0.0;
    for (Missed& m : missed) {
      if (m.shapes.empty()) continue;
      const double p = m.effect->stated ? 1.0 : m.odds / (1.0 + (competes(m) ? likely : m.odds));
      for (Alternative& a : m.shapes) a.probability *= p;
      Alternative most = *std::ranges::max_element(m.shapes, {}, &Alternative::probability);
      std::vector<Alternative> law;
      std::vector<Alternative>& sizes = competes(m) ? law_of_rivals : law;
      for (std::size_t i = 0; i < m.shapes.size(); ++i)
        add_sizes(m.places[i], beside, m.shapes[i].probability, sizes);
      if (competes(m)) {
        rivals.insert(rivals.end(), m.shapes.begin(), m.shapes.end());
        if (m.odds > most_odds) first = m.effect, most_odds = m.odds;
      } else {
        add(m.shapes, m.effect, "", out, std::move(law));
      }
      most.probability = p;
      tell(std::string(m.effect->id), "", most, out);
    }
    if (!rivals.empty()) add(rivals, first, "", out, std::move(law_of_rivals));
  }

  const Problem& problem_;
  std::size_t terms_;
  const std::vector<AmbiguousFinding>& findings_;
  std::vector<LocalShapes> local_;
  std::vector<Hypothesis> beside_;
  std::optional<Hypothesis> slope_;  ///< of a sensor that bends
  Joint wide_;
  Eigen::MatrixXd gram_;  ///< with what the sizes of the terms may plausibly be
  Eigen::Index n_;
  Solution named_;
};

/// With what no cause explains.
AveragedAxis averaged(const Problem& problem, const Joint& joint,
                      const std::vector<AmbiguousFinding>& findings) {
  AveragedAxis out = Averaging(problem, joint, findings).average();
  if (problem.point.base.face) return out;
  set_interval(problem.point, out);
  const double left_mm = discrepancy * unexplained_rms(joint);
  out.between += covariance_of_ends(problem.point, out.between.rows(), left_mm);
  return out;
}

}  // namespace

AveragedAxis average_axis(const Problem& problem, const Joint& joint,
                          const std::vector<AmbiguousFinding>& findings,
                          const std::vector<Otherwise>& others) {
  AveragedAxis out = averaged(problem, joint, findings);
  if (others.empty()) return out;
  const Eigen::VectorXd named = out.shift;
  double probability = 1.0;
  for (const Otherwise& other : others) probability -= other.probability;
  for (AveragedAxis::Source& source : out.sources) {
    source.covariance *= probability;
    source.share *= probability;
  }
  out.shift *= probability, out.within *= probability;
  out.between = probability * (out.between + named * named.transpose());
  std::vector<AxisShare> shares;
  for (const Otherwise& o : others) {
    const Joint other(problem, joint.equations.autoregression(), o.terms, o.terms.size());
    const AveragedAxis rival = averaged(problem, other, {});
    const Eigen::VectorXd shift = other.base() + rival.shift - joint.base();
    out.shift += o.probability * shift;
    out.within += o.probability * rival.within;
    out.between += o.probability * (rival.between + shift * shift.transpose());
    const AxisShift moved = axis_shift(problem.point, shift - named, other.base_covariance());
    shares.push_back({form_words(o.terms),
                      form_words(joint.terms),
                      o.probability,
                      {moved.value_mm, moved.u_mm, "mm", ""}});
  }
  out.between -= out.shift * out.shift.transpose();
  out.shares.insert(out.shares.begin(), shares.begin(), shares.end());
  return out;
}

}  // namespace trueaxis::diagnose_detail
