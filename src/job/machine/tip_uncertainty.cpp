// SPDX-License-Identifier: Apache-2.0
#include "job/machine/tip_uncertainty.hpp"

#include <cmath>

#include "machine/algebra.hpp"

namespace trueaxis::machine_job {
namespace {

constexpr std::size_t most_looked_at = 4000;

std::size_t every_of(std::size_t stands) { return (stands + most_looked_at - 1) / most_looked_at; }

}  // namespace

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

ProbedTipUncertainty::ProbedTipUncertainty(const MachineModel& model, const RigidFit& part,
                                           const std::vector<Stand>& stands)
    : model_(model), uncertainty_(model), part_(part) {
  if (!uncertainty_.stated()) return;
  std::optional<RigidFit::Sums> sums;
  std::vector<Eigen::Vector3d> points;
  const std::size_t every = every_of(stands.size());
  for (std::size_t i = 0; i < stands.size(); i += every)
    points.push_back(nominal_tip(model_, stands[i]));
  part_ = RigidFit(points);
  for (std::size_t i = 0; i < stands.size(); i += every) {
    const Eigen::Matrix3Xd moved = causes(stands[i]);
    if (!sums) sums.emplace(part_, moved.cols());
    sums->add(points[i / every], moved);
  }
  if (sums) bodies_ = sums->bodies();
}

Eigen::Matrix3Xd ProbedTipUncertainty::causes(const Stand& stand) const {
  return eigen(stand.setting.bed_from_program.rotation) *
         uncertainty_.causes(stand.axes, stand.setting);
}

double ProbedTipUncertainty::u_mm(const Stand& stand) const {
  if (!uncertainty_.stated()) return 0.0;
  Eigen::Matrix3Xd left = causes(stand);
  if (bodies_.size() > 0) left -= part_.at(nominal_tip(model_, stand), bodies_);
  return left.norm();
}

std::vector<double> u_mm_of(const ProbedTipUncertainty& uncertainty,
                            const std::vector<Stand>& stands) {
  std::vector<double> all(stands.size());
  const std::size_t every = every_of(stands.size());
  for (std::size_t i = 0; i < stands.size(); ++i)
    all[i] = i % every == 0 ? uncertainty.u_mm(stands[i]) : all[i - 1];
  return all;
}

}  // namespace trueaxis::machine_job
