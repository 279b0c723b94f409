// SPDX-License-Identifier: Apache-2.0
#include "diagnose/explain/explanation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/threads.hpp"
#include "diagnose/explain/confounder_set.hpp"
#include "diagnose/explain/shared_scale.hpp"
#include "diagnose/refit/timing.hpp"
#include "diagnose/regression/size_prior.hpp"
#include "diagnose/search/causes.hpp"
#include "infer/classes.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

/// Eq. 85.
void add_axis_bias(const Joint& joint, std::size_t term, Estimate& shift, bool& cosmetic) {
  const Solution without = joint.without(term);
  const auto n = static_cast<Eigen::Index>(joint.equations.base().size());
  const double variance = joint.sigma_mm * joint.sigma_mm;
  const AxisShift moved =
      axis_shift(joint.equations.point(), joint.base() - without.coefficients.head(n),
                 variance * (joint.solution.inverse.topLeftCorner(n, n) -
                             without.inverse.topLeftCorner(n, n)));
  shift = {moved.value_mm, moved.u_mm, "mm", ""};
  const double u = axis_uncertainty(joint.equations.point(), joint.base_covariance()).u_mm;
  cosmetic = moved.value_mm < 2.0 * u;
}

double rms_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

Finding finding_of(const Problem& problem, const Model& model, const Joint& joint,
                   const ConfounderSet& found, std::size_t term) {
  Finding out;
  out.term = fitted(model.terms[term], joint.of(term), covariance_of(joint, term));
  out.rivals = found.rivals;
  out.probability = found.probability;
  out.parameters = parameters_of(problem, model, joint, term);
  out.alias = alias_of(model.terms[term], problem.resolution);
  out.p_value = model.p_values[term];
  add_axis_bias(joint, term, out.axis_shift, out.cosmetic);
  out.rms_mm = rms_of(joint.contribution_of(term));
  return out;
}

constexpr double ordinary = 3.0, possible = 8.0;  // spreads of the logarithm of a size

/// What no ordinary size would do: where its columns hold, the data tell such a cause, and beyond
/// they bend by its size over the radius, so that a good part of the cause is enough.
/// A cause that has a line or a shape to bend is improbable as one of many that were tried, not by
/// its size.
void add_improbable(const Problem& problem, const Joint& joint, const ConfounderSet& found,
                    std::size_t term, std::vector<AxisShare>& list) {
  for (const auto& [cause, probability, told] : found.dropped) {
    const Hypothesis& hypothesis = cause.hypothesis;
    if (hypothesis.effect->line || hypothesis.effect->refinement) continue;
    std::vector<Hypothesis> terms = joint.terms;
    terms[term] = hypothesis;
    const Joint instead(problem, joint.equations.autoregression(), terms, terms.size());
    const SizePrior prior = size_prior(hypothesis);
    if (!prior.allows(instead.of(term))) continue;
    const Eigen::ArrayXd size = instead.of(term).cwiseAbs().array();
    if ((size > prior.scale(possible).array()).any()) continue;
    if (told && (size < prior.scale(ordinary).array()).all()) continue;
    const AxisShift moved =
        axis_shift(problem.point, instead.base() - joint.base(), instead.base_covariance());
    list.push_back({hypothesis.id(),
                    joint.terms[term].id(),
                    probability,
                    {moved.value_mm, moved.u_mm, "mm", ""}});
  }
}

bool has_class(const Hypothesis& term, const Problem& problem) {
  return term.effect && !is_rounding(term, problem.point, problem.rounding_mm);
}

/// For all terms, on threads; empty where a term has none. About the part without the effects: the
/// second order of a large one, which its own column lacks about the ideal fit, looks like others.
/// The readings about a lag that was found hold its second order, which the search's do not: a
/// delay is one with it to the first, and stays in its class.
std::vector<ConfounderSet> classes_of(CoarseToFineSearch& search, const RelinearisedFit& fit) {
  Model model = search.model;
  model.phi = search.phi();
  std::vector<std::size_t> lags, others;
  for (std::size_t t = 0; t < model.terms.size(); ++t)
    if (has_class(model.terms[t], fit.problem()))
      (is_lag(model.terms[t]) ? lags : others).push_back(t);
  std::vector<ConfounderSet> out(model.terms.size());
  const auto tell = [&](Proposer& proposer, const std::vector<std::size_t>& terms) {
    proposer.prepare(model.phi);
    for_each_index(terms.size(), proposer.threads(), [&](std::size_t k) {
      out[terms[k]] =
          distinguish(proposer, model, terms[k], terms.size() > 1 ? 1 : proposer.threads());
    });
  };
  if (!lags.empty()) tell(search.proposer(), lags);
  model.terms = fit.joint().terms;
  if (!others.empty()) tell(search.about(fit.problem()), others);
  return out;
}

}  // namespace

Explanation explain(CoarseToFineSearch& search, const RelinearisedFit& fit,
                    const std::optional<Timing>& timing) {
  const Model& model = search.model;
  const Joint& joint = fit.joint();
  const std::vector<ConfounderSet> classes = classes_of(search, fit);
  Explanation out;
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    if (!model.terms[t].effect) {
      out.unexplained.push_back(unexplained_of(joint, t));
      out.unexplained.back().p_value = model.p_values[t];
      continue;
    }
    if (!has_class(model.terms[t], fit.problem())) continue;
    ConfounderSet found = classes[t];
    if (timing && timing->term == t) narrow(found, timing->twice_log_ratio);
    out.ambiguous.push_back({t, std::move(found)});
  }
  share_scales(out.ambiguous);
  for (const auto& [t, found] : out.ambiguous) {
    out.findings.push_back(finding_of(fit.problem(), model, joint, found, t));
    if (!fit.problem().point.base.face)
      add_improbable(fit.problem(), joint, found, t, out.improbable);
  }
  return out;
}

std::optional<Model> with_likeliest_rival(const Model& model, const Explanation& explanation) {
  const auto least = std::ranges::min_element(
      explanation.ambiguous, {}, [](const AmbiguousFinding& f) { return f.found.probability; });
  if (least == explanation.ambiguous.end() || least->found.probability >= infer::in_no_class)
    return {};
  const ConfounderSet& found = least->found;
  const auto rival = std::ranges::max_element(found.rivals, {}, &Rival::probability);
  if (rival == found.rivals.end()) return {};
  Model out = model;
  out.terms[least->term] =
      found.members[static_cast<std::size_t>(rival - found.rivals.begin()) + 1].hypothesis;
  return out;
}

namespace {

// The crudest measured tube has ten times the largest ovality of the catalogue.
constexpr double beyond_usual = 20.0;

/// The largest typical amplitude, mm; 0: its size is not a length.
double largest_usual_mm(const Effect& effect) {
  double largest = 0.0;
  for (const LinearParameter& one : linear_parameters(effect.term, {})) {
    const EffectParameter* size = size_for(effect, one);
    if (size == nullptr || size->unit != "mm") return 0.0;
    largest = std::max(largest, size->high);
  }
  return largest;
}

/// The largest of a class; 0: one of it may have any size.
double largest_of_class_mm(const Diagnosis& diagnosis, const Finding& finding) {
  double largest = 0.0;
  for (const std::string& id : finding.members()) {
    const Effect* effect = diagnosis.entry(id);
    const double own = effect && !is_step(effect->term) ? largest_usual_mm(*effect) : 0.0;
    if (!(own > 0.0)) return 0.0;
    largest = std::max(largest, own);
  }
  return largest;
}

}  // namespace

std::string implausible_size(const Diagnosis& diagnosis) {
  for (const Finding& finding : diagnosis.findings) {
    const double amplitude_mm = std::numbers::sqrt2 * finding.rms_mm;
    const double most_mm = largest_of_class_mm(diagnosis, finding);
    if (!(most_mm > 0.0) || amplitude_mm <= beyond_usual * most_mm) continue;
    return fmt::format(
        "the readings contain a regular pattern of {:.3g} µm. Only {} ({}) could cause it, which "
        "is at most {:.3g} µm: X_M is probably not the reading of a probe on this part. Check the "
        "recording",
        amplitude_mm / mm_per_um, finding.term.effect->title, finding.effect(),
        most_mm / mm_per_um);
  }
  return "";
}

}  // namespace trueaxis::diagnose_detail
