// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "job/machine/part_displacement.hpp"
#include "machine/uncertainty.hpp"

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

/// What the uncertainty of the errors makes of the tip in a part that is probed where it is. Every
/// independent cause moves all tips; its displacement of the part as a whole, which the measurement
/// cannot tell, is subtracted (Eq. 221).
class ProbedTipUncertainty {
 public:
  /// @param part of these positions' nominal tips; very many are thinned evenly
  ProbedTipUncertainty(const MachineModel& model, const RigidFit& part,
                       const std::vector<Stand>& stands);

  /// Root of the trace of the tip's covariance.
  double u_mm(const Stand& stand) const;

 private:
  Eigen::Matrix3Xd causes(const Stand& stand) const;

  MachineModel model_;
  TipUncertainty uncertainty_;
  RigidFit part_;
  Eigen::MatrixXd bodies_;
};

/// For every position; if they were thinned, that of the last one before it that counts.
std::vector<double> u_mm_of(const ProbedTipUncertainty& uncertainty,
                            const std::vector<Stand>& stands);

}  // namespace trueaxis::machine_job
