// SPDX-License-Identifier: Apache-2.0
#include "job/machine/tip_uncertainty.hpp"

#include <algorithm>
#include <cmath>

#include "calibrate/unknown.hpp"
#include "machine/algebra.hpp"

namespace trueaxis::machine_job {

using rigid::eigen;

Eigen::Vector3d nominal_tip(const MachineModel& model, const Stand& stand) {
  return rigid::motion(stand.setting.bed_from_program) *
         eigen(model.nominal(stand.axes, stand.setting).tip_mm);
}

Eigen::Vector3d displaced_tip(const MachineModel& model, const AxisPositions& axes,
                              const Stand& stand) {
  return eigen(stand.setting.bed_from_program.rotation) *
         (eigen(model.actual(axes, stand.setting).tip_mm) -
          eigen(model.nominal(stand.axes, stand.setting).tip_mm));
}

TipUncertainty::TipUncertainty(const MachineJob& job, const MachineDiagnosis& diagnosis) {
  const ErrorModel& all = diagnosis.errors;
  const auto machine_with = [&](const ErrorName& name, const ErrorFunction& function) {
    ErrorModel errors;
    errors.sign = all.sign;
    errors.reference_mm = all.reference_mm;
    errors.terms.push_back({name, function});
    one_u_.emplace_back(job.machine, errors);
  };
  for (const CalibratedParameter& one : diagnosis.extended)
    if (const auto name = parse_error_name(one.name))
      machine_with(*name, ConstantError{one.estimate.u});
  correlate(diagnosis);
  for (const MachineFinding& found : diagnosis.findings)
    for (std::size_t k = 0; k < found.errors.size(); ++k) {
      const Estimate& estimate = found.parameters[k].estimate;
      if (estimate.value == 0.0 || !std::isfinite(estimate.u)) continue;
      machine_with(found.errors[k].name,
                   calibrate_detail::scaled(found.errors[k].function, estimate.u / estimate.value));
    }
  for (const ErrorTerm& term : job.known.terms)
    if (term.u > 0.0) machine_with(term.name, ConstantError{term.u});
  const auto n = static_cast<Eigen::Index>(one_u_.size());
  const Eigen::MatrixXd located = correlation_;
  correlation_ = Eigen::MatrixXd::Identity(n, n);
  correlation_.topLeftCorner(located.rows(), located.cols()) = located;
}

/// Of the location errors, as the calibration has them; what was found beside them is searched in
/// what these leave (Eq. 178).
void TipUncertainty::correlate(const MachineDiagnosis& diagnosis) {
  const Calibration& base = diagnosis.baseline;
  const std::size_t all = base.parameters.size();
  std::vector<std::size_t> at;
  for (const CalibratedParameter& one : diagnosis.extended) {
    if (!parse_error_name(one.name)) continue;
    at.push_back(static_cast<std::size_t>(
        std::ranges::find(base.parameters, one.name, &CalibratedParameter::name) -
        base.parameters.begin()));
  }
  const auto n = static_cast<Eigen::Index>(at.size());
  correlation_ = Eigen::MatrixXd::Identity(n, n);
  const auto covariance = [&](std::size_t i, std::size_t j) {
    return base.covariance[at[i] * all + at[j]];
  };
  for (std::size_t i = 0; i < at.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (at[i] == all || at[j] == all) continue;
      const double scale = std::sqrt(covariance(i, i) * covariance(j, j));
      if (!(scale > 0.0)) continue;
      const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
      correlation_(row, column) = correlation_(column, row) = covariance(i, j) / scale;
    }
}

void TipUncertainty::take_off_part(const RigidFit& part, const std::vector<Stand>& stands) {
  bodies_.clear();
  Displacements moved(stands.size());
  for (const MachineModel& model : one_u_) {
    for (std::size_t i = 0; i < stands.size(); ++i)
      moved[i] = displaced_tip(model, stands[i].axes, stands[i]);
    bodies_.push_back(part.nearest(moved));
  }
}

double TipUncertainty::u_mm(const Stand& stand) const {
  Eigen::Matrix3Xd moved(3, static_cast<Eigen::Index>(one_u_.size()));
  for (std::size_t k = 0; k < one_u_.size(); ++k) {
    Eigen::Vector3d one = displaced_tip(one_u_[k], stand.axes, stand);
    if (!bodies_.empty()) one -= bodies_[k].at(nominal_tip(one_u_[k], stand));
    moved.col(static_cast<Eigen::Index>(k)) = one;
  }
  return std::sqrt(std::max(0.0, (moved * correlation_ * moved.transpose()).trace()));
}

}  // namespace trueaxis::machine_job
