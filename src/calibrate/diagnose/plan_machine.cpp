// SPDX-License-Identifier: Apache-2.0
#include "calibrate/diagnose/advise.hpp"
#include "calibrate/diagnose/catalogue.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {

MachineDiagnosis plan_machine(const Machine& machine, const MachineDiagnoseOptions& options) {
  using namespace calibrate_detail;
  const auto first = first_plan(machine, options.calibration.errors, options.planned_noise_mm);
  if (!first)
    throw InputError(machine.name,
                     "has no rotary axis, or not three linear ones: no plan of a ball follows");
  MachineDiagnosis out;
  out.baseline.converged = true;
  out.baseline.coverage_factor = options.calibration.coverage_factor;
  out.errors = options.calibration.errors;
  out.false_alarm = options.false_alarm;
  out.typical_length_mm = options.typical_length_mm;
  out.typical_angle_rad = options.typical_angle_rad;
  TipFit fit{make_problem(machine, first->data, options.calibration.errors),
             location_unknowns(machine, options.calibration.largest_length_mm,
                               options.calibration.largest_angle_rad),
             {},
             options.calibration.errors};
  fit.solution.places = fit.problem.start;
  const Eigen::MatrixXd all =
      weighted_jacobian(fit.problem, fit.given, fit.unknowns, fit.problem.start);
  out.effects = machine_effects(fit.problem, true, options.own_effects);
  const auto terms = effect_terms(
      fit.problem, geometry_of(fit.problem, fit.given, fit.problem.start), out.effects);
  const infer::Dictionary dictionary = dictionary_of(terms, planned_base(all, fit.unknowns.size()),
                                                     fit.problem.weights, options.calibration);
  const infer::SearchOptions search{options.false_alarm, dictionary.tests()};
  out.hypotheses = static_cast<std::size_t>(search.tests);
  out.threshold = search.effects().single_level(options.false_alarm);
  advise({fit, first->data, options, search, 1.0}, dictionary, terms, out);
  MachinePlan plan = first->plan;
  for (const auto& term : terms)
    if (std::ranges::find(out.not_observable, term.effect(), &MachineNotObservable::effect) ==
            out.not_observable.end() &&
        std::ranges::find(plan.shows, term.effect()) == plan.shows.end())
      plan.shows.push_back(term.effect());
  plan.covariance = out.covariance;
  for (std::size_t i = 0; i < out.uncertain.size(); ++i)  // before it: the plausible sizes
    for (std::size_t j = 0; j < out.uncertain.size(); ++j)
      out.covariance(i, j) = i == j ? out.uncertain[i].prior * out.uncertain[i].prior : 0.0;
  out.plans.insert(out.plans.begin(), std::move(plan));
  out.next_plan = "B1";
  return out;
}

}  // namespace trueaxis
