// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/program_harm.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "calibrate/estimate/unknown.hpp"
#include "compensate/program_axes.hpp"
#include "compensate/single_errors.hpp"
#include "compensate/tally.hpp"
#include "math/linear_algebra.hpp"
#include "nc/program.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr std::size_t most_blocks_of_U = 2000;  // of a longer program every n-th

struct Block {
  AxisPositions axes{};
  Setting setting;
  std::size_t line = 0;
};

/// Where the program cuts, or where it goes if it only travels.
std::vector<Block> blocks_of(const Machine& machine, std::string text, const std::string& file) {
  const ProgramAxes axes(machine);
  const nc::Program program =
      nc::read_program(std::move(text), file, axes.read_options(std::nullopt));
  std::vector<Block> out;
  const bool cuts = std::ranges::any_of(
      program.moves, [](const nc::Move& one) { return one.modal.motion != nc::Motion::rapid; });
  for (const nc::Move& move : program.moves) {
    if (cuts && move.modal.motion == nc::Motion::rapid) continue;
    if (const auto at = axes.positions(move.words, move.modal))
      out.push_back({*at, axes.setting(move.modal), move.line + std::size_t{1}});
  }
  return out;
}

/// An effect alone over all blocks; of cos and sin of one order in the worst phase.
LargestInProgram alone(const Machine& machine, const ErrorModel& frame,
                       const std::vector<Block>& blocks, std::vector<ErrorTerm> terms,
                       bool worst_phase) {
  std::vector<SingleErrors> each;
  const auto add = [&](std::vector<ErrorTerm> some) {
    ErrorModel errors = frame;
    errors.terms = std::move(some);
    each.push_back(SingleErrors::of_names(MachineModel(machine, errors)));
  };
  if (worst_phase)
    for (const ErrorTerm& term : terms) add({term});
  else
    add(std::move(terms));
  LargestInProgram out;
  for (const Block& block : blocks) {
    double square = 0.0;
    for (const SingleErrors& one : each) {
      double tip = 0.0;
      one.tip_mm(block.axes, block.setting, std::span(&tip, 1));
      square += tip * tip;
    }
    take(out, std::sqrt(square), block.line);
  }
  return out;
}

std::vector<EffectOnProgram> effects_of(const Machine& machine, const MachineDiagnosis& diagnosis,
                                        const std::vector<Block>& blocks) {
  std::vector<EffectOnProgram> out;
  for (const MachineFinding& one : diagnosis.findings) {
    if (!one.errors.empty())
      out.push_back({one.effect(), true, one.size, one.cause.unit,
                     alone(machine, diagnosis.errors, blocks, one.errors, false)});
  }
  for (const MachineNotObservable& one : diagnosis.not_observable) {
    if (one.errors.empty()) continue;
    std::vector<ErrorTerm> terms = one.errors;
    for (ErrorTerm& term : terms)
      term.function = calibrate_detail::scaled(term.function, one.hidden);
    out.push_back({one.effect, false, one.hidden, one.detectable_unit,
                   alone(machine, diagnosis.errors, blocks, std::move(terms), true)});
  }
  std::ranges::stable_sort(out, std::ranges::greater{},
                           [](const EffectOnProgram& one) { return one.tip.value; });
  return out;
}

/// What a datum of the part takes up, three rows a block: six columns, made orthonormal.
MatrixXd datums(const MachineModel& nominal, const std::vector<Block>& blocks) {
  MatrixXd out = MatrixXd::Zero(3 * static_cast<Index>(blocks.size()), 6);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const Vector3 tip = nominal.nominal(blocks[i].axes, blocks[i].setting).tip_mm;
    const auto at = 3 * static_cast<Index>(i);
    out.block<3, 3>(at, 0).setIdentity();
    for (Index k = 0; k < 3; ++k)
      out.block<3, 1>(at, 3 + k) =
          Eigen::Vector3d::Unit(k).cross(Eigen::Vector3d(tip[0], tip[1], tip[2]));
  }
  return linear::orthonormal_basis(out, 1e-9);
}

/// Displacements of the tip by every uncertain number, three rows per block, after the part's
/// datum.
MatrixXd displacements(const Machine& machine, const MachineDiagnosis& diagnosis,
                       const std::vector<Block>& blocks) {
  MatrixXd out(3 * static_cast<Index>(blocks.size()),
               static_cast<Index>(diagnosis.uncertain.size()));
  for (Index j = 0; j < out.cols(); ++j) {
    ErrorModel errors = diagnosis.errors;
    errors.terms = {diagnosis.uncertain[static_cast<std::size_t>(j)].unit};
    const MachineModel model(machine, errors);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const Vector3 d = model.linear_error(blocks[i].axes, blocks[i].setting).tip_mm;
      out.block<3, 1>(3 * static_cast<Index>(i), j) = Eigen::Vector3d(d[0], d[1], d[2]);
    }
  }
  const MatrixXd datum = datums(MachineModel(machine), blocks);
  return out - datum * (datum.transpose() * out);
}

LargestInProgram largest_U(const MatrixXd& tips, const Covariance& covariance,
                           const std::vector<Block>& blocks, double coverage_factor) {
  LargestInProgram out;
  if (covariance.empty()) return out;
  const Eigen::Map<const MatrixXd> of(covariance.data(), tips.cols(), tips.cols());
  const MatrixXd spread = tips * of;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto at = 3 * static_cast<Index>(i);
    const double variance = spread.middleRows<3>(at).cwiseProduct(tips.middleRows<3>(at)).sum();
    take(out, coverage_factor * std::sqrt(std::max(0.0, variance)), blocks[i].line);
  }
  return out;
}

/// If no plan lowers U, because no plan shows its largest part: the plan that shows most per minute
/// of what could hide on this program and does a tenth of U there.
std::string plan_of_hidden(const ProgramHarm& harm, const MachineDiagnosis& diagnosis) {
  std::string code;
  double best = 0.0;
  for (const EffectOnProgram& effect : harm.effects) {
    if (effect.found || effect.tip.value < 0.1 * harm.U.value) continue;
    for (const MachinePlan& plan : diagnosis.plans)
      if (std::ranges::find(plan.shows, effect.effect) != plan.shows.end() &&
          effect.tip.value / plan.minutes > best)
        best = effect.tip.value / plan.minutes, code = plan.code;
  }
  return code;
}

void choose_next(const ProgramHarm& harm, MachineDiagnosis& diagnosis) {
  if (diagnosis.next_plan == "B1") return;
  diagnosis.next_plan.clear();
  double best = 0.01 * harm.U.value / 60.0;  // a hundredth in an hour is not worth advising
  for (std::size_t i = 0; i < harm.plans.size(); ++i) {
    const double lowered = (harm.U.value - harm.plans[i].U.value) / diagnosis.plans[i].minutes;
    if (lowered > best) best = lowered, diagnosis.next_plan = harm.plans[i].plan;
  }
  if (diagnosis.next_plan.empty()) diagnosis.next_plan = plan_of_hidden(harm, diagnosis);
}

}  // namespace

ProgramHarm weigh_on_program(const Machine& machine, MachineDiagnosis& diagnosis, std::string text,
                             const std::string& file) {
  ProgramHarm out;
  out.file = file;
  out.coverage_factor = diagnosis.baseline.coverage_factor;
  std::vector<Block> blocks = blocks_of(machine, std::move(text), file);
  out.blocks = blocks.size();
  if (blocks.empty())
    throw InputError(file, "moves no axis of the machine: name the program that cuts the part");
  out.effects = effects_of(machine, diagnosis, blocks);
  if (const std::size_t step = (blocks.size() + most_blocks_of_U - 1) / most_blocks_of_U;
      step > 1) {
    std::vector<Block> fewer;
    for (std::size_t i = 0; i < blocks.size(); i += step) fewer.push_back(blocks[i]);
    blocks = std::move(fewer);
  }
  const MatrixXd tips = displacements(machine, diagnosis, blocks);
  out.U = largest_U(tips, diagnosis.covariance, blocks, out.coverage_factor);
  for (const MachinePlan& plan : diagnosis.plans)
    out.plans.push_back({plan.code, largest_U(tips, plan.covariance, blocks, out.coverage_factor)});
  choose_next(out, diagnosis);
  return out;
}

}  // namespace trueaxis
