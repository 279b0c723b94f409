// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "calibrate/estimate/total_uncertainty.hpp"
#include "calibrate/estimate/unknown.hpp"
#include "job/machine/machine_job_steps.hpp"
#include "machine/uncertainty.hpp"

namespace trueaxis::machine_job {
namespace {

/// The covariance of the numbers of a cause, as amounts of errors of size 1.
ErrorCovariance covariance_of(const MachineFinding& found) {
  std::vector<UncertainAmount> amounts;
  std::vector<std::size_t> at;
  for (std::size_t k = 0; k < found.errors.size(); ++k) {
    const double value = found.parameters[k].estimate.value;
    if (value == 0.0) continue;
    ErrorTerm unit = found.errors[k];
    unit.function = calibrate_detail::scaled(unit.function, 1.0 / value);
    amounts.push_back(calibrate_detail::amount_of(unit));
    at.push_back(k);
  }
  ErrorCovariance out(std::move(amounts));
  for (std::size_t i = 0; i < at.size(); ++i)
    for (std::size_t j = 0; j < at.size(); ++j)
      out(i, j) = !found.covariance.empty() ? found.covariance(at[i], at[j])
                  : i == j                  ? std::pow(found.parameters[at[i]].estimate.u, 2)
                                            : 0.0;
  return out;
}

void add_errors_of_class(const MachineDiagnosis& diagnosis, const MachineFinding& found,
                         std::vector<ErrorName>& names) {
  for (const std::string& member : found.members()) {
    const auto effect = std::ranges::find(diagnosis.effects, member, &MachineEffect::id);
    if (effect != diagnosis.effects.end() && is_machine_error(effect->term))
      names.push_back(std::get<ErrorOfPosition>(effect->term).error);
  }
}

}  // namespace

ErrorModel job_errors(const MachineJob& job, const MachineDiagnosis& diagnosis) {
  const bool explained = diagnosis.unexplained.empty();
  const auto is_sure = [](const MachineFinding& found) {
    return found.errors.empty() || form_is_sure(found.cause.term);
  };
  CalibrationOptions options;
  options.errors = job.known;
  options.counts_held = true;
  if (explained) {
    for (const MachineFinding& found : diagnosis.findings) {
      if (is_sure(found))
        options.errors.terms.insert(options.errors.terms.end(), found.errors.begin(),
                                    found.errors.end());
      else
        add_errors_of_class(diagnosis, found, options.polynomials);
    }
  }
  ErrorModel errors = calibrate(job.machine, job.data, options).errors;
  if (!explained) return errors;
  if (std::ranges::any_of(diagnosis.findings,
                          [](const MachineFinding& found) { return found.errors.empty(); })) {
    // The diagnosis alone fits what is not an error of the machine (reversal, drift, slip); U
    // is that of the calibration, which counts what is not fitted too.
    ErrorCovariance counted = std::move(errors.covariance);
    errors = diagnosis.errors;
    for (ErrorTerm& term : errors.terms)
      if (std::ranges::any_of(counted.names(), [&](const UncertainAmount& amount) {
            return amount.name == term.name && !term.name.component;
          }))
        term.u = 0.0;
    errors.covariance = std::move(counted);
  }
  for (const MachineFinding& found : diagnosis.findings)
    if (is_sure(found)) add_covariance(errors.covariance, covariance_of(found));
  return errors;
}

ErrorModel to_be_weighed(const MachineJob& job, ErrorModel errors) {
  for (ErrorTerm& term : errors.terms) {
    const bool given =
        std::ranges::find(job.known.terms, term.name, &ErrorTerm::name) != job.known.terms.end();
    const bool along = std::ranges::any_of(job.data, [&](const MachineMeasurement& file) {
      return file.axis && index_of(*file.axis) == term.name.body;
    });
    if (!given && !along) term.known_over.reset();
  }
  return errors;
}

}  // namespace trueaxis::machine_job
