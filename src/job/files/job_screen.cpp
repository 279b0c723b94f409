// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "base/counted.hpp"
#include "base/number.hpp"
#include "diagnose/files/diagnosis_screen.hpp"
#include "fit/files/fit_files.hpp"
#include "format/text_layout.hpp"
#include "job/agreement.hpp"
#include "job/cut_files.hpp"
#include "job/doubts.hpp"
#include "job/files/feedback_files.hpp"
#include "job/files/job_results.hpp"
#include "job/files/job_words.hpp"
#include "job/references.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using namespace layout;

constexpr std::size_t most_findings = 2;
constexpr double least_mm = 1e-5;  // what nobody measures

/// Of a reference: its name, what was seen of it, and its axis where no table takes it off.
std::string reference_screen(const JobResult& result, std::size_t i) {
  const FitResult& fit = fit_used(result, i);
  const std::string& name = result.job.references[i].name;
  const std::string surface = to_string(fit.surface);
  std::string text = "seat   " + name + (name == surface ? "" : ", a " + surface) + ": " +
                     counted(fit.points, "reading");
  if (fit.status != FitStatus::converged) return text + ", " + fit.message + "\n";
  const auto& diagnosis = result.diagnoses[i];
  const bool ideal = diagnosis && diagnosis->verdict == DiagnosisVerdict::ideal;
  text += ", residuals " + um(diagnosis && !ideal ? diagnosis->gain.rms_after_mm : fit.rms_mm) +
          " RMS" + (ideal ? ", " + ideal_words(*diagnosis) : "") + "\n";
  for (const std::string& note : result.fits[i].input_notes) text += "input  " + note + "\n";
  if (diagnosis) text += excluded_screen(*diagnosis);
  if (diagnosis && !ideal) text += findings_screen(*diagnosis, most_findings);
  // With causes and the axis the screen has no line for what no tolerance asks for.
  const bool room = ideal || result.fits.size() > 1 || result.correction;
  if (i < result.forms.size() && (room || !result.forms[i].judgements.empty()))
    text += part_form_screen(result.forms[i], result.fits.size() > 1 ? name : "");
  if (!result.job.target)
    return text + seat_axis_screen(result, i) +
           (diagnosis ? unseen_screen(*diagnosis) + limit_screen(*diagnosis) : "");
  if (result.fits.size() == 1 && !result.correction) text += axis_screen(fit);
  return text;
}

std::string tool_screen(const ActuatorMargin& margin) {
  return fmt::format("tool   The table uses {} of {} µm stroke, {}\n",
                     significant(margin.stroke_used_mm / mm_per_um, 3),
                     significant(margin.stroke_available_mm / mm_per_um, 3),
                     margin.follows
                         ? "the actuator follows to " + (margin.following_mm < least_mm
                                                             ? "less than " + um(least_mm)
                                                             : um(margin.following_mm))
                         : "the actuator cannot follow: " + words_of(margin.breaks, "; "));
}

/// What the readings of a cut's first reference that hides something do not show.
std::string hidden_screen(const JobResult& result) {
  std::string text;
  for (std::size_t i = 0; result.job.target && text.empty() && i < result.diagnoses.size(); ++i)
    if (result.diagnoses[i]) text = unseen_screen(*result.diagnoses[i]);
  return text;
}

/// "seat: "; nothing of a reference without a name.
std::string named(const JobReference& reference) {
  return reference.name.empty() ? "" : reference.name + ": ";
}

/// What the cut is about where the job says more than the references.
std::string datum_screen(const JobResult& result) {
  std::string text;
  for (std::size_t i = 0; i < result.associated.size(); ++i)
    if (result.associated[i])
      text += fmt::format("datum  {}{} association\n", named(result.job.references[i]),
                          name_of(*result.job.references[i].association));
  if (result.datum) text += "datum  " + result.datum->name + ": " + datum_words(result) + "\n";
  return text;
}

std::string next_screen(const JobResult& result) {
  if (const Reasons would = result.verdict.what_would_prove(); !would.empty())
    return "next   " + words_of(would, "; ", result) + "\n";
  if (const NextMeasurement* best = next_measurement(result))
    return fmt::format("next   to tell the causes apart: {} ({:.0f} min)\n", best->what,
                       std::ceil(best->minutes));
  return "";
}

bool asks_for_proof(const JobResult& result) { return !result.verdict.what_would_prove().empty(); }

/// How well the axis is known of the one reference of a job without a cut, how far apart the axes
/// of several are.
std::string accuracy(const JobResult& result) {
  if (result.job.target) return "";
  if (result.fits.size() > 1) return largest_distance_text(result);
  const std::string known = axis_accuracy(fit_used(result, 0));
  return known.empty() ? "" : "; " + known;
}

/// What to do now: tap the part, measure what would prove it, run the table.
std::string action_screen(const JobResult& result) {
  std::string text;
  if (asks_for_proof(result)) text += next_screen(result);
  if (result.correction) return text + tool_screen(result.correction->margin);
  for (std::size_t i = 0; i < result.fits.size(); ++i) {
    const std::string &name = result.job.references[i].name,
                      surface = to_string(fit_used(result, i).surface);
    text += tap_screen(fit_used(result, i), name.empty() ? surface : name);
  }
  return text;
}

}  // namespace

std::string job_screen(const JobResult& result) {
  std::string text = verdict_line(result) + accuracy(result) + "\n" + action_screen(result);
  for (const Reason& reservation : result.verdict.reservations)
    text += "but    " + words_of(reservation, result) + "\n";
  for (std::size_t i = 0; i < result.fits.size(); ++i) text += reference_screen(result, i);
  text += hidden_screen(result);
  const std::string apart = result.job.target ? "" : seats_apart_screen(result);
  text += apart;
  for (const Disagreement& d : result.agreement.disagreements)
    if (apart.empty()) text += "apart  " + words_of(how_apart(d), result) + "\n";
  text += datum_screen(result);
  for (const Inclusion& inclusion : result.inclusions)
    text += "motion " + inclusion_text(inclusion);
  text += coarse_rows_lines(result, "rows   ") + feedback_screen(result);
  return text + (asks_for_proof(result) ? "" : next_screen(result));
}

}  // namespace trueaxis
