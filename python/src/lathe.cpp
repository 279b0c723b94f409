// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "cli/checked_fit.hpp"
#include "cli/diagnosed_stream.hpp"
#include "cli/stream_options.hpp"
#include "correct/files/table_files.hpp"
#include "diagnose/files/diagnosis_screen.hpp"
#include "fit/files/fit_files.hpp"
#include "form/files/form_files.hpp"
#include "job/conclude.hpp"
#include "job/files/job_results.hpp"
#include "job/files/job_toml.hpp"
#include "job/files/job_words.hpp"
#include "job/files/stream_job.hpp"
#include "outcome.hpp"
#include "report/report.hpp"
#include "simulate/files/scenario_files.hpp"
#include "spindle/files/spindle_files.hpp"
#include "work.hpp"

namespace trueaxis::python {
namespace {

void expect_one_sensor(const ProbeStream& stream) {
  if (!stream.more_reading_mm.empty())
    throw InputError(stream.source, "has several sensors: they belong to spindle()");
}

struct Fitted {
  Stream stream;
  FitOptions options;
  FitResult result;
};

/// @param checked as the command does it: whether the readings are those of one surface, whose part
/// did not move; else the library's fit alone
FitResult fit_as_asked(const ProbeStream& stream, const FitOptions& options, bool checked) {
  expect_one_sensor(stream);
  if (!checked) return fit(stream, options);
  expect_one_surface(stream, options.surface, RangesAs::options);
  return cli::checked_fit(stream, options);
}

Outcome fit_of(const Stream& stream, const FitOptions& options, bool checked,
               const py::object& progress) {
  const auto found = stoppable(progress, [&] {
    auto one = std::make_shared<Fitted>(Fitted{stream, options, {}});
    one->result = fit_as_asked(*stream, one->options, checked);
    cli::expect_enough_readings(one->result);
    return std::shared_ptr<const Fitted>(one);
  });
  Outcome out = outcome_of(
      found, [](const Fitted& one) { return fit_json(one.result); },
      [](const Fitted& one) { return fit_screen(one.result); });
  out.files["report.html"] = [found] {
    return render_fit_report(*found->stream, found->result, found->options);
  };
  out.arrays = {{"residual_mm", found->result.residual_mm}};
  out.ending = cli::ending_of(found->result, stream->source);
  return out;
}

/// Seconds that a fit takes in C++, of a stream or from its arrays: scripts/bench_python compares.
double seconds_per_fit(const Stream& stream, const FitOptions& options, bool checked, int repeats,
                       bool from_arrays) {
  using Clock = std::chrono::steady_clock;
  const auto begun = Clock::now();
  for (int i = 0; i < repeats; ++i) {
    if (from_arrays) {
      const ProbeStream copy = *stream;
      fit_as_asked(copy, options, checked);
    } else {
      fit_as_asked(*stream, options, checked);
    }
  }
  return std::chrono::duration<double>(Clock::now() - begun).count() / repeats;
}

struct Diagnosed {
  Stream stream;  ///< as it was read
  DiagnoseOptions options;
  cli::CheckedDiagnosis found;
  std::vector<double> order, before_mm, after_mm;  ///< of the spectrum
};

/// A diagnosis keeps what correct() needs of it.
struct DiagnosisOutcome : Outcome {
  std::shared_ptr<const Diagnosed> diagnosed;
};

DiagnosisOutcome diagnosis_of(const Stream& stream, const FitOptions& options, double false_alarm,
                              const py::object& progress) {
  const auto found = stoppable(progress, [&] {
    auto one = std::make_shared<Diagnosed>();
    one->stream = stream;
    one->options.fit = options;
    one->options.false_alarm = false_alarm;
    expect_one_sensor(*stream);
    expect_one_surface(*stream, one->options.fit.surface, RangesAs::options);
    one->found = cli::checked_diagnosis(*stream, one->options);
    cli::expect_enough_readings(one->found.diagnosis.baseline);
    for (const SpectrumBin& bin : one->found.diagnosis.spectrum) {
      one->order.push_back(bin.order);
      one->before_mm.push_back(bin.before_mm);
      one->after_mm.push_back(bin.after_mm);
    }
    return std::shared_ptr<const Diagnosed>(one);
  });
  const Diagnosis& diagnosis = found->found.diagnosis;
  DiagnosisOutcome out;
  static_cast<Outcome&>(out) = outcome_of(
      found,
      [](const Diagnosed& one) { return diagnosis_with_form(one.found.diagnosis, one.found.form); },
      [](const Diagnosed& one) {
        const bool fitted = one.found.deciding_fit().status == FitStatus::converged;
        return diagnosis_screen(one.found.diagnosis,
                                fitted ? part_form_screen(one.found.form, "") : "");
      });
  out.files["report.html"] = [found] {
    return render_diagnosis_report(found->found.stream, found->found.diagnosis, found->options.fit,
                                   found->found.form);
  };
  out.arrays = {{"residual_before_mm", diagnosis.residual_before_mm},
                {"residual_after_mm", diagnosis.residual_after_mm},
                {"effect_mm", diagnosis.effect_mm},
                {"spectrum_order", found->order},
                {"spectrum_before_mm", found->before_mm},
                {"spectrum_after_mm", found->after_mm}};
  out.ending = cli::ending_of(found->found.deciding_fit(), stream->source);
  out.diagnosed = found;
  return out;
}

struct Tabled {
  JobResult result;
  std::string table;  ///< empty: the target is not cut
  std::vector<double> c_rad, position_mm, wanted_mm, command_mm;
};

/// The table for `target` (TOML) about the axis of a diagnosed stream, as `trueaxis table` has it.
Outcome correction_of(const DiagnosisOutcome& diagnosis, const std::string& target,
                      const py::object& progress) {
  const auto found = stoppable(progress, [&] {
    const Diagnosed& of = *diagnosis.diagnosed;
    if (!of.found.deciding_fit().axis_known())
      throw Refusal(of.stream->source + ": the axis is not known");
    IdentifiedJob identified;
    identified.job = read_target_toml(target);
    identified.job.references.emplace_back();
    identified.job.references[0].name = of.stream->source;
    identified.job.references[0].fit = of.options.fit;
    identified.job.outputs.clear();
    identified.streams = {*of.stream};
    identified.fits = {of.found.diagnosis.baseline};
    identified.diagnoses = {of.found.diagnosis};
    identified.resimulations = {
        resimulate(of.found.diagnosis, *of.stream, of.options.fit.ball_radius_mm)};
    auto out = std::make_shared<Tabled>();
    out->result = conclude(std::move(identified));
    if (out->result.verdict.go() && out->result.correction) {
      const CorrectionRows& rows = out->result.correction->rows;
      out->table = correction_csv(*out->result.correction);
      out->c_rad = rows.c_rad;
      out->position_mm = rows.position_mm;
      out->wanted_mm = rows.wanted_mm;
      out->command_mm = rows.command_mm;
    }
    return std::shared_ptr<const Tabled>(out);
  });
  Outcome out = outcome_of(
      found, [](const Tabled& one) { return job_json(one.result, {}); },
      [](const Tabled& one) {
        return verdict_line(one.result) + '\n' +
               (one.result.correction ? correction_preview(*one.result.correction) : "");
      });
  out.arrays = {{"c_rad", found->c_rad},
                {"position_mm", found->position_mm},
                {"wanted_mm", found->wanted_mm},
                {"command_mm", found->command_mm}};
  if (!found->table.empty())
    out.files["table.csv"] = [found] { return found->table; };
  else
    out.ending = {cli::refused, words_of(found->result.verdict.reasons, "; ", found->result)};
  return out;
}

/// What a user states of a surface and its readings: read once, the same for every function that
/// fits one.
void bind_association(py::module_& module) {
  py::class_<FitOptions>(module, "Association")
      .def(py::init([](const std::string& surface, const std::string& loss, bool bore,
                       double ball_radius_mm, std::optional<double> noise_um,
                       const std::vector<std::string>& known, double coverage_factor) {
        cli::AssociationOptions one;
        one.surface = surface;
        one.loss = loss;
        one.fit.bore = bore;
        one.fit.ball_radius_mm = ball_radius_mm;
        one.noise_um = noise_um.value_or(-1.0);
        one.known = known;
        one.fit.coverage_factor = coverage_factor;
        return one.chosen();
      }));
}

py::tuple simulation_of(const std::string& scenario, const std::string& path,
                        std::optional<std::uint64_t> seed, const py::object& progress) {
  std::shared_ptr<ProbeStream> stream;
  const auto truth = stoppable(progress, [&] {
    virtual_lathe::Scenario one = parse_scenario_toml(scenario, path);
    if (one.cut) throw InputError(path, "has a cut: simulate_cut() plays it");
    if (seed) one.seed = *seed;
    virtual_lathe::Simulation all = virtual_lathe::simulate_with_truth(one);
    stream = std::make_shared<ProbeStream>(std::move(all.stream));
    stream->source = path;
    return std::make_shared<const virtual_lathe::Truth>(std::move(all.truth));
  });
  Outcome out = outcome_of(
      truth, [](const virtual_lathe::Truth& one) { return truth_json(one); },
      [](const virtual_lathe::Truth&) { return std::string(); });
  out.arrays = {{"clean_mm", truth->clean_mm}};
  return py::make_tuple(stream, out);
}

Outcome spindle_of(const std::vector<Stream>& streams, const SpindleOptions& options,
                   const py::object& progress) {
  struct Separated {
    SpindleOptions options;
    SpindleResult result;
  };
  const auto found = stoppable(progress, [&] {
    std::vector<ProbeStream> all;
    for (const Stream& stream : streams) all.push_back(*stream);
    return std::make_shared<const Separated>(Separated{options, separate_spindle(all, options)});
  });
  Outcome out = outcome_of(
      found, [](const Separated& one) { return spindle_json(one.result, one.options); },
      [](const Separated& one) { return spindle_text(one.result, false); });
  out.files["report.html"] = [found] { return spindle_page(found->result); };
  if (const auto& radial = found->result.radial) {
    out.arrays = {{"angle_rad", radial->polar.angle_rad},
                  {"motion_mm", radial->polar.motion_mm},
                  {"u_motion_mm", radial->polar.u_motion_mm},
                  {"form_mm", radial->polar.form_mm},
                  {"u_form_mm", radial->polar.u_form_mm}};
  }
  return out;
}

}  // namespace

void bind_lathe(py::module_& module) {
  bind_association(module);
  module.def("fit", &fit_of);
  module.def("seconds_per_fit", &seconds_per_fit);
  py::class_<DiagnosisOutcome, Outcome>(module, "DiagnosisOutcome");
  module.def("diagnose", &diagnosis_of);
  module.def("correct", &correction_of);
  module.def("simulate", &simulation_of);
  module.def("spindle", [](const std::vector<std::shared_ptr<ProbeStream>>& streams, int order_max,
                           std::optional<double> sensitive_direction_deg, double u_angle_deg,
                           double u_reindex_deg, double largest_condition, double coverage_factor,
                           const py::object& progress) {
    SpindleOptions options;
    options.order_max = order_max;
    if (sensitive_direction_deg) options.sensitive_rad = *sensitive_direction_deg * rad_per_deg;
    options.u_angle_rad = u_angle_deg * rad_per_deg;
    options.u_reindex_rad = u_reindex_deg * rad_per_deg;
    options.largest_condition = largest_condition;
    options.coverage_factor = coverage_factor;
    return spindle_of({streams.begin(), streams.end()}, options, progress);
  });
}

}  // namespace trueaxis::python
