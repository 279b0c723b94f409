// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/part_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/threads.hpp"
#include "form/swallowed.hpp"
#include "job/part_form_steps.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

constexpr std::array<double, 2> asked_by_default{1.0, 50.0};  // where a tolerance is stated
constexpr double standard_upr[] = {500.0, 150.0, 50.0, 15.0};
constexpr int trials_that_judge = 400, trials_that_show = 20;  // u to 3.5 and to 16 %
constexpr int fewest_trials = 10;
/// Readings × trials of one assessment, beyond which u comes from fewer trials: some seconds.
constexpr double most_work = 2e7;
/// Readings: more take longer than all else of a job, and only a tolerance is worth that.
constexpr std::size_t most_to_show = 20'000, most_to_judge = 2'000'000;

class Question {
 public:
  Question(const DiagnosedStream& part, const DiagnosedStream* datum, const FitOptions& fit)
      : part_(part, ball_of(part, fit), false) {
    if (datum) datum_.emplace(*datum, ball_of(*datum, fit), true);
    options_.bore = fit.bore;
    options_.ball_radius_mm = ball_of(part, fit);
    options_.coverage_factor = fit.coverage_factor;
    options_.noise_mm = fit.noise_mm;
    if (part.diagnosis && part.diagnosis->noise.sigma_mm > 0.0)
      options_.noise_mm = part.diagnosis->noise.sigma_mm;
    const double readings = static_cast<double>(part.stream.size());
    options_.trials = static_cast<int>(
        std::clamp(most_work / readings, double{fewest_trials}, double{trials_that_judge}));
  }

  FormOptions& options() { return options_; }
  const PartReadings& part() const { return part_; }

  /// @param taken_off whether anything is; @param open what may be either as well
  FormResult assess(bool taken_off, bool open) const {
    const ProbeStream of_part = taken_off ? part_.less(open) : part_.stream();
    std::optional<ProbeStream> of_datum;
    if (datum_) of_datum = taken_off ? datum_->less(open) : datum_->stream();
    std::vector<TakenOff> off;
    if (taken_off) add(part_, open, false, off);
    if (taken_off && datum_) add(*datum_, open, true, off);
    return assess_form(of_part, options_, of_datum ? &*of_datum : nullptr, off);
  }

 private:
  static double ball_of(const DiagnosedStream& of, const FitOptions& fit) {
    return fit.ball_radius_mm > 0.0 ? fit.ball_radius_mm : of.stream.ball_radius_mm.value_or(0.0);
  }

  static void add(const PartReadings& of, bool open, bool is_datum, std::vector<TakenOff>& off) {
    for (const MotionColumns& one : of.columns())
      if (open || one.of == FindingIsOf::motion)
        off.push_back({one.columns_mm, one.correlation, is_datum});
  }

  PartReadings part_;
  std::optional<PartReadings> datum_;
  FormOptions options_;
};

/// The band that a task is judged in, or the widest that the readings carry.
std::array<double, 2> band_of(const FormTask& task, int carried) {
  if (task.band_upr) return *task.band_upr;
  if (task.judges()) return asked_by_default;
  for (const double one : standard_upr)
    if (one <= carried) return {1.0, one};
  return {1.0, static_cast<double>(carried)};
}

std::vector<std::string> ids_of(const PartReadings& readings, FindingIsOf what) {
  std::vector<std::string> out;
  for (const MotionColumns& one : readings.columns())
    if (one.of == what) out.push_back(one.finding->effect());
  return out;
}

/// Sum of the local forms that were found, with their U.
double most_of_local_forms_mm(const Diagnosis& diagnosis, double coverage_factor) {
  double sum_mm = 0.0;
  for (const Unexplained& one : diagnosis.unexplained)
    if (is_local_form(one))
      sum_mm += std::abs(one.amplitude.value) + one.amplitude.expanded(coverage_factor);
  return sum_mm;
}

std::string first_of(const InputError& error) { return error.diagnostics().front().message; }

void assess(Question& question, const FormTask& task, PartForm& out) {
  const ProbeStream& stream = question.part().stream();
  FormOptions& options = question.options();
  options.filter = stream.kind == StreamKind::face ? ProfileFilter::none : task.filter;
  options.all_references = false;
  if (!task.judges()) options.trials = std::min(options.trials, trials_that_show);
  if (stream.kind == StreamKind::lateral) {
    out.carried_upr = carried_upr(stream, options);
    if (out.carried_upr < 2 && task.filter != ProfileFilter::none) {
      out.why_not =
          "there are too few readings per revolution for a filter, which needs 7 per wave, or part "
          "of the revolution is missing";
      return;
    }
    const auto [low, high] = band_of(task, out.carried_upr);
    options.low_upr = low;
    options.high_upr = high;
    if (high > out.carried_upr && task.filter != ProfileFilter::none) {
      out.why_not = fmt::format(
          "{:g} UPR needs {:.0f} readings per revolution, 7 per wave, and these support up to {} "
          "UPR",
          high, 7.0 * high, out.carried_upr);
      return;
    }
  }
  if (!out.motion.empty()) out.less_motion.emplace();
  if (!out.open.empty()) out.less_open.emplace();
  for_each_index(3, options.threads, [&](std::size_t k) {
    if (k == 0) out.probed = question.assess(false, false);
    if (k == 1 && out.less_motion) out.less_motion = question.assess(true, false);
    if (k == 2 && out.less_open) out.less_open = question.assess(true, true);
  });
  if (!(out.local_mm > 0.0)) return;
  for (FormResult* form : {&out.probed, out.less_motion ? &*out.less_motion : nullptr,
                           out.less_open ? &*out.less_open : nullptr})
    if (form) form::bound_values(*form, out.local_mm, "a local form is not in the surface");
}

}  // namespace

PartForm part_form(const DiagnosedStream& part, const FitOptions& fit, const FormTask& task,
                   const DiagnosedStream* datum) {
  PartForm out;
  try {
    if (part.diagnosis && part.diagnosis->baseline.status == FitStatus::implausible) {
      out.why_not = part.diagnosis->baseline.message;
      judge(task, out);
      return out;
    }
    if (part.stream.size() > (task.judges() ? most_to_judge : most_to_show)) {
      out.why_not =
          fmt::format("with {} readings it takes long: use `trueaxis form`", part.stream.size());
    } else {
      Question question(part, datum, fit);
      out.left_out = question.part().left_out();
      if (part.diagnosis)
        out.local_mm = most_of_local_forms_mm(*part.diagnosis, fit.coverage_factor);
      out.motion = ids_of(question.part(), FindingIsOf::motion);
      out.open = ids_of(question.part(), FindingIsOf::open);
      assess(question, task, out);
    }
  } catch (const InputError& error) {
    out.why_not = first_of(error);
  }
  judge(task, out);
  return out;
}

}  // namespace trueaxis
