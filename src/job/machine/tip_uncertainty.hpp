// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "job/machine/part_displacement.hpp"
#include "trueaxis/machine_job.hpp"

namespace trueaxis::machine_job {

/// A point of the program: positions of the axes, program frame and tool in force.
struct Stand {
  AxisPositions axes{};
  Setting setting;
};

/// The nominal tip in the workpiece's body (M, zero position).
Eigen::Vector3d nominal_tip(const MachineModel& model, const Stand& stand);

/// The tip of the machine with errors that is commanded to `axes`, against the nominal one of
/// `stand`, in the directions of the workpiece's body.
Eigen::Vector3d displaced_tip(const MachineModel& model, const AxisPositions& axes,
                              const Stand& stand);

/// What the uncertainty of the errors makes of the tip: every parameter that was estimated, and
/// every known error that states u, moves it by its u; the parts are added with their correlations
/// (Eq. 221), each without the displacement of the part as a whole, which the measurement cannot
/// tell.
class TipUncertainty {
 public:
  TipUncertainty(const MachineJob& job, const MachineDiagnosis& diagnosis);

  /// Takes off each parameter's displacement of the part: the nearest over these tips.
  void take_off_part(const RigidFit& part, const std::vector<Stand>& stands);
  /// Root of the trace of the tip's covariance.
  double u_mm(const Stand& stand) const;

 private:
  void correlate(const MachineDiagnosis& diagnosis);

  std::vector<MachineModel> one_u_;  ///< a machine with one parameter of the size of its u
  std::vector<RigidFit::Body> bodies_;
  Eigen::MatrixXd correlation_;
};

}  // namespace trueaxis::machine_job
