// SPDX-License-Identifier: Apache-2.0
#include "job/verified_cut.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <set>

#include "job/doubts.hpp"
#include "job/machine_motion.hpp"
#include "math/linear_algebra.hpp"
#include "measure/passes.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
using Matrix42 = Eigen::Matrix<double, 4, 2>;
using Matrix24 = Eigen::Matrix<double, 2, 4>;

/// Of two independent normal numbers the mean square.
constexpr double freedom = 2.0;

void add_causes(const Diagnosis& diagnosis, std::set<std::string>& ids) {
  for (const Finding& finding : diagnosis.findings) {
    const Slot slot = finding.term.effect->slot;
    if (slot == Slot::arguments || slot == Slot::probe_line || slot == Slot::sensor)
      ids.insert(finding.effect());
  }
}

std::vector<std::string> listed(const std::set<std::string>& ids) {
  return {ids.begin(), ids.end()};
}

FitOptions options_of_cut(const Job& job) {
  FitOptions options = job.references.front().fit;
  options.surface =
      job.target->kind == TargetKind::cone ? SurfaceKind::cone : SurfaceKind::cylinder;
  options.bore = job.target->bore;
  return options;
}

/// What the readings alone leave of an axis: without the causes that they do not show.
const FitResult& by_readings(const Diagnosis& diagnosis) {
  return diagnosis.verdict == DiagnosisVerdict::ideal ? diagnosis.baseline : diagnosis.named;
}

/// The ratio of the axis of the cut to the target axis that fits best over both ends, and its
/// logarithm with u (Eq. 322). The residual is of this part: it widens u.
LoopObservation ratio(const Axis& target, const AxisEstimate& cut) {
  const double z_mm = cut.axis.z_ref_mm;
  const auto [x, y] = target.at(z_mm);
  Matrix42 design;
  design << x, -y, y, x, target.slope_x, -target.slope_y, target.slope_y, target.slope_x;
  const Eigen::Vector4d seen(cut.axis.x_mm, cut.axis.y_mm, cut.axis.slope_x, cut.axis.slope_y);
  const Eigen::MatrixXd covariance = Eigen::Map<const Matrix4>(cut.covariance.data());
  const Eigen::Matrix<double, 4, 2> weighted =
      linear::solve_normal(covariance, Eigen::MatrixXd(design));
  const Eigen::Matrix2d information = design.transpose() * weighted;
  const Eigen::Vector2d best = information.inverse() * (weighted.transpose() * seen);
  const Eigen::Vector4d left = seen - design * best;
  const double wider = std::max(1.0, linear::weighed_square(left, covariance) / freedom);
  const std::complex<double> r(best(0), best(1)), log = std::log(r), turn = 1.0 / r;
  Eigen::Matrix2d to_log;
  to_log << turn.real(), -turn.imag(), turn.imag(), turn.real();
  const Eigen::Matrix2d u2 = wider * to_log * information.inverse() * to_log.transpose();
  const Matrix24 of_scatter = to_log * information.inverse() * weighted.transpose();
  const double per_mm = of_scatter.leftCols<2>().norm() / std::sqrt(2.0);
  return {log.real(), log.imag(), std::sqrt(u2(0, 0)), std::sqrt(u2(1, 1)), per_mm, {}};
}

}  // namespace

std::vector<std::string> corrected_causes(const JobResult& result) {
  std::set<std::string> ids;
  for (const auto& diagnosis : result.diagnoses)
    if (diagnosis) add_causes(*diagnosis, ids);
  return listed(ids);
}

double probing_speed(const std::vector<ProbeStream>& streams) {
  double sum = 0.0, readings = 0.0;
  for (const ProbeStream& stream : streams)
    for (const Pass& pass : find_passes(stream)) {
      const auto count = static_cast<double>(pass.end - pass.begin);
      sum += count * pass.speed_rad_per_s, readings += count;
    }
  return readings > 0.0 ? sum / readings : 0.0;
}

VerifiedCut verified_cut(const JobResult& result, const ProbeStream& probed_again,
                         const ProbeStream* form) {
  const TargetSurface& target = *result.job.target;
  DiagnoseOptions options;
  options.fit = options_of_cut(result.job);
  const ProbeStream stream = corrected_by_known(probed_again, options.fit);
  const Diagnosis diagnosis = diagnose(stream, options);
  // An inverted servo leaves what an inverted gauge does; the response that is seen says so.
  const auto unknown = why_axis_unknown(stream, diagnosis);
  if (!diagnosis.extended.axis_known() || (unknown && unknown->code != ReasonCode::column_reversed))
    throw Refusal("the readings do not tell the axis of the cut: probe the cut seat again");
  std::set<std::string> of_cut;
  add_causes(diagnosis, of_cut);
  const Axis& wanted = result.target_axis->axis.axis;
  const AxisEstimate cut = by_readings(diagnosis).axis;
  VerifiedCut out{ratio(wanted, cut), listed(of_cut)};
  for (const double z_mm : {target.z_start_mm, target.z_end_mm}) {
    const auto [x, y] = cut.axis.at(z_mm);
    const auto [x0, y0] = wanted.at(z_mm);
    const double off_mm = std::hypot(x - x0, y - y0);
    if (off_mm < out.off_mm) continue;
    out.off_mm = off_mm, out.U_off_mm = options.fit.coverage_factor * cut.u_at(z_mm);
  }
  if (!(out.seen.u_gain < 1.0 && out.seen.u_lag_rad < 1.0))
    throw Refusal(
        "the target axis is so near the spindle axis that the cut shows neither gain nor lag: take "
        "[verification] out for this part");
  if (form != nullptr) out.seen.motion = motion_of_form(*form, options.fit);
  return out;
}

}  // namespace trueaxis
