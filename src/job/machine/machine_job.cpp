// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/machine_job.hpp"

#include <utility>

#include "job/machine/machine_doubts.hpp"
#include "job/machine/machine_job_steps.hpp"
#include "machine/algebra.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace machine_job {
namespace {

/// The cutting moves of the program, or all if it has rapid moves only.
std::vector<ProgramEnd> cutting(const std::vector<ProgramEnd>& ends) {
  std::vector<ProgramEnd> cuts;
  for (const ProgramEnd& end : ends)
    if (!end.rapid) cuts.push_back(end);
  return cuts.empty() ? ends : cuts;
}

PartDisplacement displacement_of(const RigidFit::Body& body) {
  return {rigid::array(body.about_mm), rigid::array(body.shift_mm), rigid::array(body.turn_rad)};
}

void take_largest(double value_mm, std::size_t line, double& largest_mm, std::size_t& at) {
  if (at != 0 && value_mm <= largest_mm) return;
  largest_mm = value_mm;
  at = line;
}

/// Tips before and after without the displacement of the part, and their uncertainty.
class ProgramTips {
 public:
  ProgramTips(const MachineModel& model, std::vector<ProgramEnd> ends)
      : model_(model), ends_(std::move(ends)) {
    std::vector<Eigen::Vector3d> points;
    for (const ProgramEnd& end : ends_) {
      stands_.push_back({end.commanded, end.setting});
      points.push_back(nominal_tip(model_, stands_.back()));
      before_.push_back(displaced_tip(model_, end.commanded, stands_.back()));
      after_.push_back(displaced_tip(model_, end.written, stands_.back()));
    }
    rigid_.emplace(points);
    part_ = rigid_->nearest(before_);
  }

  const std::vector<Stand>& stands() const { return stands_; }
  const RigidFit& rigid() const { return *rigid_; }
  const RigidFit::Body& part() const { return part_; }

  std::vector<ProgramTip> take(const ProbedTipUncertainty& uncertainty,
                               MachineJobVerdict& v) const {
    const Displacements before = rigid_->without(before_, part_),
                        after = rigid_->without(after_, rigid_->nearest(after_));
    const std::vector<double> u_mm = u_mm_of(uncertainty, stands_);
    std::vector<ProgramTip> tips;
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      tips.push_back({ends_[i].line, model_.nominal(stands_[i].axes, stands_[i].setting).tip_mm,
                      rigid::array(before[i]), rigid::array(after[i]), u_mm[i]});
      take_largest(before[i].norm(), ends_[i].line, v.before_mm, v.before_line);
      take_largest(after[i].norm(), ends_[i].line, v.after_mm, v.after_line);
      v.U_mm = std::max(v.U_mm, 2.0 * u_mm[i]);
    }
    return tips;
  }

 private:
  const MachineModel& model_;
  std::vector<ProgramEnd> ends_;
  std::vector<Stand> stands_;
  Displacements before_, after_;
  std::optional<RigidFit> rigid_;
  RigidFit::Body part_;
};

void compensate_program_of(MachineJobResult& result, const MachineModel& model) {
  const MachineJobProgram& program = *result.job.program;
  CompensationOptions options = program.options;
  options.keep_ends = true;
  result.compensation = compensate_program(model, program.text, program.file, options);
}

/// Maps where there is no program: the part's displacement is that over the maps themselves.
void map_alone(MachineJobResult& result, const MachineModel& model) {
  const Setting setting = first_setting(result.job.machine);
  const std::vector<Stand> stands = map_stands(result.ranges, result.job.machine, setting);
  std::vector<Eigen::Vector3d> points;
  Displacements moved;
  for (const Stand& stand : stands) {
    points.push_back(nominal_tip(model, stand));
    moved.push_back(displaced_tip(model, stand.axes, stand));
  }
  const RigidFit rigid(points);
  const ProbedTipUncertainty uncertainty(model, rigid, stands);
  result.maps = error_maps(model, result.ranges, setting, uncertainty, rigid.nearest(moved));
}

}  // namespace
}  // namespace machine_job

MachineJobResult run_machine_job(MachineJob job) {
  expects(!job.data.empty(), "a measurement");
  MachineDiagnoseOptions options;
  options.calibration.errors = job.known;
  options.false_alarm = job.false_alarm;
  MachineDiagnosis diagnosis = diagnose_machine(job.machine, job.data, options);
  return run_machine_job(std::move(job), std::move(diagnosis));
}

MachineJobResult run_machine_job(MachineJob job, MachineDiagnosis diagnosis) {
  using namespace machine_job;
  MachineJobResult result;
  result.job = std::move(job);
  result.diagnosis = std::move(diagnosis);
  CalibrationOptions known;
  known.errors = result.job.known;
  result.implausible = implausible(result.diagnosis.baseline, known);
  MachineJobVerdict numbers;
  if (result.diagnosis.baseline.converged) {
    result.errors = job_errors(result.job, result.diagnosis);
    const MachineModel model(result.job.machine, to_be_weighed(result.job, result.errors));
    if (result.job.program) compensate_program_of(result, model);
    const std::vector<ProgramEnd> ends =
        result.compensation ? cutting(result.compensation->ends) : std::vector<ProgramEnd>{};
    result.ranges = axis_ranges(result.job, ends);
    if (ends.empty() || !result.compensation->unreachable.empty()) {
      map_alone(result, model);
    } else {
      const ProgramTips tips(model, ends);
      const ProbedTipUncertainty uncertainty(model, tips.rigid(), tips.stands());
      result.part = displacement_of(tips.part());
      result.tips = tips.take(uncertainty, numbers);
      numbers.between_mm = result.compensation->between_after.value;
      const LargestInProgram between =
          off_between_before(model, result.compensation->ends, tips.part());
      numbers.between_before_mm = between.value;
      numbers.between_before_line = between.line;
      numbers.not_corrected_mm = not_corrected_mm(result, model, tips.stands());
      result.maps =
          error_maps(model, result.ranges, ends.front().setting, uncertainty, tips.part());
    }
  }
  result.remarks = machine_remarks(result);
  result.verdict = decide(result, numbers);
  return result;
}

}  // namespace trueaxis
