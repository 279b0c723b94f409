// SPDX-License-Identifier: Apache-2.0
#include "trueaxis/part_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "form/uncertainty.hpp"
#include "job/form_judgement.hpp"
#include "job/part_readings.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

constexpr std::array<double, 2> asked_by_default{1.0, 50.0};  // where a tolerance is stated
constexpr double standard_upr[] = {500.0, 150.0, 50.0, 15.0};
constexpr int trials_that_judge = 400, trials_that_show = 20;  // u to 3.5 and to 16 %
constexpr int fewest_trials = 10;
/// Readings × trials of one assessment, beyond which u is taken of fewer trials: some seconds.
constexpr double most_work = 2e7;
/// Readings: more take longer than all else of a job, and only a tolerance is worth that.
constexpr std::size_t most_to_show = 20'000, most_to_judge = 2'000'000;

/// All values of a result in their order.
std::vector<FormValue*> values_of(FormResult& form) {
  std::vector<FormValue*> out;
  for (SectionForm& section : form.sections)
    for (FormValue& one : section.values) out.push_back(&one);
  for (FormGroup& group : form.groups)
    for (FormValue& one : group.values) out.push_back(&one);
  return out;
}

class Question {
 public:
  Question(const DiagnosedStream& part, const DiagnosedStream* datum, const FitOptions& fit)
      : part_(part, ball_of(part, fit)) {
    if (datum) datum_.emplace(*datum, ball_of(*datum, fit));
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
    FormResult out = assess_form(of_part, options_, of_datum ? &*of_datum : nullptr);
    if (!taken_off) return out;
    std::vector<double> variance(values_of(out).size(), 0.0);
    add_variance(part_, open, of_part, of_datum ? &*of_datum : nullptr, true, out, variance);
    if (datum_) add_variance(*datum_, open, of_part, &*of_datum, false, out, variance);
    const auto values = values_of(out);
    for (std::size_t v = 0; v < values.size(); ++v)
      values[v]->estimate.u = std::hypot(values[v]->estimate.u, std::sqrt(variance[v]));
    return out;
  }

 private:
  static double ball_of(const DiagnosedStream& of, const FitOptions& fit) {
    return fit.ball_radius_mm > 0.0 ? fit.ball_radius_mm : of.stream.ball_radius_mm.value_or(0.0);
  }

  /// What the values change by per u of every amplitude that was taken off (Eq. 291).
  void add_variance(const PartReadings& of, bool open, const ProbeStream& part,
                    const ProbeStream* datum, bool is_part, const FormResult& at,
                    std::vector<double>& variance) const {
    FormOptions few = options_;
    few.trials = form::values_alone;
    FormResult middle = at;
    const auto values = values_of(middle);
    for (const MotionColumns& one : of.columns()) {
      if (!open && is_of(*one.finding) != FindingIsOf::motion) continue;
      const std::size_t count = one.columns_mm.size();
      std::vector<std::vector<double>> change(count, std::vector<double>(values.size(), 0.0));
      for (std::size_t j = 0; j < count; ++j) {
        ProbeStream moved = is_part ? part : *datum;
        for (std::size_t i = 0; i < moved.size(); ++i) moved.reading_mm[i] += one.columns_mm[j][i];
        FormResult off = is_part ? assess_form(moved, few, datum) : assess_form(part, few, &moved);
        const auto now = values_of(off);
        for (std::size_t v = 0; v < values.size() && v < now.size(); ++v)
          change[j][v] = now[v]->estimate.value - values[v]->estimate.value;
      }
      for (std::size_t v = 0; v < values.size(); ++v)
        for (std::size_t j = 0; j < count; ++j)
          for (std::size_t i = 0; i < count; ++i)
            variance[v] += one.correlation[j * count + i] * change[i][v] * change[j][v];
    }
    for (double& one : variance) one = std::max(one, 0.0);
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
    if (is_of(*one.finding) == what) out.push_back(one.finding->effect());
  return out;
}

std::string first_of(const InputError& error) { return error.diagnostics().front().message; }

void assess(Question& question, const FormTask& task, PartForm& out) {
  const ProbeStream& stream = question.part().stream();
  FormOptions& options = question.options();
  options.filter = task.filter;
  if (!task.judges()) options.trials = std::min(options.trials, trials_that_show);
  if (stream.kind == StreamKind::lateral) {
    out.carried_upr = carried_upr(stream, options);
    const auto [low, high] = band_of(task, out.carried_upr);
    options.low_upr = low;
    options.high_upr = high;
    if (high > out.carried_upr && task.filter != ProfileFilter::none) {
      out.why_not = out.carried_upr < 2
                        ? "the readings of a turn are too few for any filter, which takes 7 a wave"
                        : fmt::format(
                              "{:g} UPR takes {:.0f} readings a turn, 7 a wave, and these "
                              "carry up to {} UPR",
                              high, 7.0 * high, out.carried_upr);
      return;
    }
  }
  out.probed = question.assess(false, false);
  if (!out.motion.empty()) out.less_motion = question.assess(true, false);
  if (!out.open.empty()) out.less_open = question.assess(true, true);
}

}  // namespace

PartForm part_form(const DiagnosedStream& part, const FitOptions& fit, const FormTask& task,
                   const DiagnosedStream* datum) {
  PartForm out;
  try {
    if (part.stream.size() > (task.judges() ? most_to_judge : most_to_show)) {
      out.why_not = fmt::format("of {} readings it takes its time: `trueaxis form` does it",
                                part.stream.size());
    } else {
      Question question(part, datum, fit);
      out.left_out = question.part().left_out();
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
