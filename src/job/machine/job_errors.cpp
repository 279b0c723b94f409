// SPDX-License-Identifier: Apache-2.0
#include "job/machine/job_errors.hpp"

#include <algorithm>
#include <cmath>

#include "calibrate/total_uncertainty.hpp"
#include "calibrate/unknown.hpp"
#include "machine/uncertainty.hpp"

namespace trueaxis::machine_job {
namespace {

/// Of the numbers of a finding, as amounts of errors of size 1.
ErrorCovariance covariance_of(const MachineFinding& found) {
  ErrorCovariance out;
  std::vector<std::size_t> at;
  for (std::size_t k = 0; k < found.errors.size(); ++k) {
    const double value = found.parameters[k].estimate.value;
    if (value == 0.0) continue;
    ErrorTerm unit = found.errors[k];
    unit.function = calibrate_detail::scaled(unit.function, 1.0 / value);
    out.amounts.push_back(calibrate_detail::amount_of(unit));
    at.push_back(k);
  }
  const std::size_t n = found.parameters.size();
  for (const std::size_t i : at)
    for (const std::size_t j : at)
      out.matrix.push_back(i * n + j < found.covariance.size() ? found.covariance[i * n + j]
                           : i == j ? std::pow(found.parameters[i].estimate.u, 2)
                                    : 0.0);
  return out;
}

/// Location errors of the diagnosis, correlated as those of the calibration before it.
ErrorCovariance covariance_of_locations(const MachineDiagnosis& diagnosis) {
  const Calibration& base = diagnosis.baseline;
  const std::size_t all = base.parameters.size();
  ErrorCovariance out;
  std::vector<std::size_t> at;
  std::vector<double> u;
  for (const CalibratedParameter& one : diagnosis.extended) {
    const auto name = parse_error_name(one.name);
    if (!name) continue;
    out.amounts.push_back({.name = *name});
    u.push_back(one.estimate.u);
    at.push_back(static_cast<std::size_t>(
        std::ranges::find(base.parameters, one.name, &CalibratedParameter::name) -
        base.parameters.begin()));
  }
  const auto covariance = [&](std::size_t i, std::size_t j) {
    return at[i] == all || at[j] == all ? 0.0 : base.covariance[at[i] * all + at[j]];
  };
  for (std::size_t i = 0; i < at.size(); ++i)
    for (std::size_t j = 0; j < at.size(); ++j) {
      const double scale = std::sqrt(covariance(i, i) * covariance(j, j));
      const double correlation = i == j ? 1.0 : scale > 0.0 ? covariance(i, j) / scale : 0.0;
      out.matrix.push_back(correlation * u[i] * u[j]);
    }
  return out;
}

}  // namespace

ErrorModel job_errors(const MachineJob& job, const MachineDiagnosis& diagnosis) {
  if (!diagnosis.unexplained.empty()) return diagnosis.errors;  // those of a calibration
  ErrorModel errors;
  if (std::ranges::none_of(diagnosis.findings,
                           [](const MachineFinding& found) { return found.errors.empty(); })) {
    CalibrationOptions options;
    options.errors = job.known;
    for (const MachineFinding& found : diagnosis.findings)
      options.errors.terms.insert(options.errors.terms.end(), found.errors.begin(),
                                  found.errors.end());
    errors = calibrate(job.machine, job.data, options).errors;
  } else {
    errors = diagnosis.errors;
    const ErrorCovariance located = covariance_of_locations(diagnosis);
    for (ErrorTerm& term : errors.terms)
      if (std::ranges::any_of(located.amounts, [&](const UncertainAmount& amount) {
            return amount.name == term.name && !term.name.component;
          }))
        term.u = 0.0;
    errors.covariance = job.known.covariance;
    add_covariance(errors.covariance, located);
  }
  for (const MachineFinding& found : diagnosis.findings)
    add_covariance(errors.covariance, covariance_of(found));
  return errors;
}

}  // namespace trueaxis::machine_job
