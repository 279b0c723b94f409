// SPDX-License-Identifier: Apache-2.0
// What people and files see of a diagnosis that was made by hand.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "diagnose/files/diagnosis_json.hpp"
#include "diagnose/files/diagnosis_text.hpp"
#include "diagnose/files/seen.hpp"
#include "format/text_layout.hpp"
#include "job/files/job_results.hpp"
#include "support/diagnosis_example.hpp"
#include "trueaxis/effect.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

using nlohmann::json;

json written(const Diagnosis& diagnosis) { return json::parse(diagnosis_json(diagnosis)); }

/// Every object with a value has a unit; where the value is null it says why.
void expect_quantities(const json& at, const std::string& where) {
  if (at.is_object() && at.contains("value")) {
    EXPECT_TRUE(at.contains("unit")) << where << at;
    EXPECT_TRUE(at.at("value").is_number() || at.contains("why")) << where << at;
    if (at.contains("u") && at.at("u").is_null()) {
      EXPECT_TRUE(at.contains("why")) << where << at;
    }
  }
  if (!at.is_structured()) return;
  for (const auto& [key, value] : at.items()) expect_quantities(value, where + "/" + key);
}

TEST(DiagnosisJson, HasTheFieldsOfTheSchema) {
  const json d = written(example::cone_diagnosis());
  EXPECT_EQ(d.at("schema"), "trueaxis.diagnosis/3");
  EXPECT_EQ(d.at("verdict"), "unexplained");
  EXPECT_EQ(d.at("input").at("hash"), "xxh3-64:0123456789abcdef");
  EXPECT_EQ(d.at("baseline").at("schema"), "trueaxis.fit/1");
  EXPECT_EQ(d.at("extended").at("schema"), "trueaxis.fit/1");
  const json& f = d.at("findings").at(0);
  EXPECT_EQ(f.at("class"), (json{"part.roundness", "spindle.radial_synchronous"}));
  EXPECT_EQ(f.at("parameters").at("order").at("value"), 3.0);
  EXPECT_EQ(f.at("parameters").at("amplitude").at("unit"), "mm");
  EXPECT_EQ(f.at("parameters").at("phase").at("unit"), "deg");
  for (const char* key : {"p_value", "probability"}) EXPECT_TRUE(f.at(key).is_number()) << key;
  EXPECT_EQ(f.at("axis_bias").at("axis_shift").at("unit"), "mm");
  EXPECT_TRUE(f.at("axis_bias").at("cosmetic").get<bool>());
  EXPECT_EQ(f.at("separate_with").at("plan"), "RC");
  EXPECT_EQ(f.at("separate_with").at("power"), 0.993);
  EXPECT_EQ(f.at("separate_with").at("minutes"), 12.0);
  for (const char* key : {"harmonic", "dependence", "amplitude"})
    EXPECT_TRUE(d.at("unexplained").at(0).contains(key)) << key;
  for (const char* key : {"effect", "why", "axis_bias_per_unit", "separate_with"})
    EXPECT_TRUE(d.at("not_observable").at(0).contains(key)) << key;
  for (const char* key : {"sigma", "source", "autocorrelation"})
    EXPECT_TRUE(d.at("noise").contains(key)) << key;
  for (const char* key : {"rms_before", "rms_after", "held_out_rms_before", "held_out_rms_after",
                          "noise_floor", "axis_shift", "coaxiality_before", "coaxiality_after"})
    EXPECT_EQ(d.at("gain").at(key).at("unit"), "mm") << key;
  for (const char* key : {"plan", "separates", "power_before", "power_after", "minutes"})
    EXPECT_TRUE(d.at("next_measurement").contains(key)) << key;
}

TEST(DiagnosisJson, EveryNumberHasAUnitOrAReason) {
  expect_quantities(written(example::cone_diagnosis()), "");
  expect_quantities(written(Diagnosis{}), "");
}

TEST(DiagnosisJson, WhatIsNotFiniteIsNullWithAReason) {
  const std::string text = diagnosis_json(example::cone_diagnosis());
  for (const char* word : {"nan", "NaN", "inf\n", "Infinity"})
    EXPECT_EQ(text.find(word), std::string::npos) << word;
  const json d = json::parse(text);
  const json& detectable = d.at("not_observable").at(0).at("detectable");
  EXPECT_TRUE(detectable.at("value").is_null());
  EXPECT_EQ(detectable.at("why"), "no size of it would be found");
  EXPECT_EQ(d.at("findings").at(1).at("axis_bias").at("axis_shift").at("why"),
            "the extended axis is not determined");
}

/// The term as written gives the effect back: a simulation needs nothing else.
TEST(DiagnosisJson, TermAndFrameRebuildTheModel) {
  const json d = written(example::cone_diagnosis());
  const json& term = d.at("findings").at(0).at("term");
  EXPECT_EQ(term.at("shape").at("order").at("value"), 3.0);
  const double a = term.at("linear").at(0).at("value"), b = term.at("linear").at(1).at("value");
  EXPECT_EQ(term.at("linear").at(0).at("name"), "amplitude_cos");
  EXPECT_NEAR(std::hypot(a, b), example::lobes_mm, 1e-15);
  EXPECT_NEAR(std::atan2(b, a) / rad_per_deg, example::lobes_phase_deg, 1e-12);
  // A slope is an angle, and angles are written in degrees.
  const json& tilt = d.at("findings").at(1).at("term");
  EXPECT_EQ(tilt.at("linear").at(0).at("unit"), "deg");
  EXPECT_NEAR(tilt.at("linear").at(0).at("value").get<double>() * rad_per_deg, 1.9e-5, 1e-18);
  EXPECT_EQ(tilt.at("shape").at("lever_from").at("value"), -120.0);
  EXPECT_EQ(tilt.at("shape").at("lever_from").at("unit"), "mm");
  EXPECT_EQ(d.at("u_frame").at("z_mid").at("value"), 15.0);
  EXPECT_EQ(d.at("u_frame").at("z_half").at("value"), 15.0);
  EXPECT_EQ(d.at("unexplained").at(0).at("term").at("linear").at(0).at("value"),
            example::wander_mm);
}

/// Every cause of a class, the named one and its rival causes, of the catalogue or one's own.
TEST(DiagnosisJson, EveryCauseHasItsConsequence) {
  const Effect own{.id = "own.form", .title = "a form of its own", .consequence = "turn it again"};
  Diagnosis d = example::cone_diagnosis();
  d.own_effects = {&own, 1};
  d.findings.front().rivals.push_back({"own.form", 0.1, 0.1, 0.1, false});
  const json told = written(d).at("consequences");
  for (const char* id : {"part.roundness", "spindle.radial_synchronous"})
    EXPECT_EQ(told.at(id), find_effect(id)->consequence) << id;
  EXPECT_EQ(told.at("own.form"), "turn it again");
  const auto lines = cause_lines(d, d.findings.front(), 9);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines.back(), "a form of its own (10 %): turn it again [own.form]");
  EXPECT_NE(lines.front().find(find_effect("part.roundness")->consequence), std::string::npos);
}

TEST(DiagnosisJson, EveryTermOfTheCatalogueCanBeWritten) {
  std::size_t terms = 0;
  for (const Effect& effect : effect_catalogue()) {
    if (effect.check) continue;
    ++terms;
    Diagnosis d;
    Finding finding;
    finding.term.effect = &effect;
    finding.term.linear.assign(linear_parameters(effect.term, {}).size(), 1.0);
    d.findings = {finding};
    const json term = written(d).at("findings").at(0).at("term");
    EXPECT_EQ(term.at("linear").size(), finding.term.linear.size()) << effect.id;
    EXPECT_EQ(term.at("shape").size(), shape_parameters(effect.term).size()) << effect.id;
  }
  EXPECT_GE(terms, 40u);
}

/// Numbers that no default has, by the reader next to the writer.
TEST(DiagnosisJson, EveryTermComesBack) {
  const TermShape shape{7.5, -31.0, 43.0, 4, 0.77, 12.5, 321.0, 9.25, 38.5, 1.75};
  for (const Effect& effect : effect_catalogue()) {
    if (effect.check) continue;
    SCOPED_TRACE(effect.id);
    TermValue term;
    term.effect = &effect;
    term.shape = shape;
    for (std::size_t j = 0; j < linear_parameters(effect.term, shape).size(); ++j)
      term.linear.push_back(0.001 * static_cast<double>(j + 1));
    const TermValue back = effect_term_from(std::string(effect.id), term_object(term));
    EXPECT_EQ(back.effect, term.effect);
    EXPECT_EQ(term_object(back).dump(), term_object(term).dump());
    for (std::size_t j = 0; j < term.linear.size(); ++j)
      EXPECT_DOUBLE_EQ(back.linear.at(j), term.linear[j]);
  }
  using Kind = Pattern::Kind;
  for (const Pattern& pattern :
       {Pattern{Kind::fourier_legendre, 3.0, true, 2, true},
        Pattern{Kind::fourier_legendre, 0.0, false, 1, false},
        Pattern{Kind::line, 7.41, false, 0, false, 0.14},
        Pattern{Kind::line, 1.0, true, 0, true, 3.25},
        Pattern{Kind::bump, 0.0, false, 0, false, 0.0, 1.2, 18.0, 0.2, 3.5}}) {
    TermValue term;
    term.pattern = pattern;
    term.linear.assign(term.columns(), 0.002);
    const TermValue back = pattern_term_from(term_object(term));
    EXPECT_EQ(back.pattern.spindle, pattern.spindle);
    EXPECT_EQ(term_object(back).dump(), term_object(term).dump());
  }
}

TEST(DiagnosisJson, AnEffectOfOnesOwnIsReadByWhoGivesIt) {
  const Effect own{
      .id = "own.five_at_the_ends",
      .title = "five undulations towards both ends",
      .term = Harmonic{Harmonic::Angle::part, Harmonic::Envelope::parabola, TermPort::normal, 5.0},
      .parameters = {{"amplitude", "mm", 1e-3, 0.02, "at the ends"}}};
  Diagnosis diagnosis = example::cone_diagnosis();
  ASSERT_FALSE(diagnosis.findings.empty());
  TermValue& term = diagnosis.findings[0].term;
  term = {};
  term.effect = &own;
  term.linear = {0.004, -0.003};
  const std::string text = diagnosis_json(diagnosis);
  const Diagnosis back = diagnosis_from_json(text, "d.json", {&own, 1});
  EXPECT_EQ(back.findings.at(0).term.effect, &own);
  EXPECT_EQ(back.findings.at(0).effect(), own.id);
  EXPECT_EQ(back.findings.at(0).term.linear, term.linear);
  try {
    diagnosis_from_json(text, "d.json");
    FAIL() << "an effect that nobody knows was read";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "d.json: the catalogue has no `own.five_at_the_ends`: what names an effect of a "
              "program's own is read by that program alone");
  }
}

TEST(DiagnosisJson, AFileOfAnotherSchemaIsRefused) {
  json old = written(example::cone_diagnosis());
  EXPECT_NO_THROW(diagnosis_from_json(old.dump(), "d.json"));
  old["schema"] = "trueaxis.diagnosis/1";
  EXPECT_THROW(diagnosis_from_json(old.dump(), "d.json"), InputError);
  EXPECT_THROW(diagnosis_from_json("{}", "d.json"), InputError);
}

TEST(DiagnosisText, PatternsInWords) {
  using Kind = Pattern::Kind;
  const auto words = [](const Pattern& p) { return harmonic_text(p) + ", " + dependence_text(p); };
  EXPECT_EQ(words({Kind::fourier_legendre, 3.0}), "3 UPR, constant along Z");
  EXPECT_EQ(words({Kind::fourier_legendre, 3.0, true, 1, true}), "3 UPR, linear in time");
  EXPECT_EQ(words({Kind::fourier_legendre, 0.0, false, 2}), "0 UPR, P2 in Z");
  EXPECT_EQ(words({Kind::line, 7.41, false, 0, false, 0.14}),
            "7.41 UPR, turning along Z, 0.14 per mm");
  EXPECT_EQ(words({Kind::line, 1.0, true, 0, true, 3.25}), "1 UPR, turning with 3.25 Hz");
  Pattern bump{.kind = Kind::bump, .angle_rad = 70.0 * rad_per_deg, .width_rad = 0.1};
  EXPECT_EQ(words(bump), "local form, at 70.0° (± 5.7°)");
  bump.position_mm = 18.0, bump.length_mm = 3.5;
  EXPECT_EQ(words(bump), "local form, at 70.0° (± 5.7°), Z 18.00 mm (± 3.50 mm)");
}

TEST(DiagnosisJson, NeighbourCorrelationFollowsFromTheAutoregression) {
  EXPECT_EQ(neighbour_correlation({}), 0.0);
  EXPECT_NEAR(neighbour_correlation({0.8}), 0.8, 1e-12);
  // Yule-Walker of order 2: ρ1 = φ1/(1 − φ2).
  EXPECT_NEAR(neighbour_correlation({0.5, 0.3}), 0.5 / 0.7, 1e-12);
  EXPECT_NEAR(neighbour_correlation({0.0, 0.6}), 0.0, 1e-12);
  EXPECT_TRUE(std::isnan(neighbour_correlation({1.2})));
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

TEST(DiagnosisText, FirstLineSaysWhatWasFoundAndWhatItGains) {
  Diagnosis d = example::cone_diagnosis();
  EXPECT_EQ(diagnosis_line(d),
            "UNEXPLAINED: 1 pattern without a catalogued cause, 2 causes found; cross-validated "
            "RMS 4.7 → "
            "2.1 µm (ratio 0.45, 95 % 0.42-0.48), noise floor 2 µm");
  d.verdict = DiagnosisVerdict::effects;
  EXPECT_EQ(diagnosis_line(d).substr(0, 24), "EFFECTS: 2 causes found;");
  d.verdict = DiagnosisVerdict::ideal;
  EXPECT_EQ(diagnosis_line(d).substr(0, 7), "IDEAL: ");
  d.baseline.status = FitStatus::rank_deficient;
  EXPECT_EQ(first_line(diagnosis_text(d)).substr(0, 29), "NOT DIAGNOSED: rank_deficient");
}

TEST(DiagnosisText, SaysWhatItKnowsWithinAHundredColumns) {
  const std::string text = diagnosis_text(example::cone_diagnosis());
  for (const char* part :
       {"amplitude 6.00 ± 0.22 µm", "phase 40.0 ± 2.1 deg", "order 3,", "the data cannot tell",
        "cosmetic", "RC, the part re-indexed by 70 deg", "12 min", "7.41 UPR", "probe.height",
        "no size", "revolution differences", "autoregression 0.50", "row 201", "Checks",
        "probe.saturation", "Next measurement"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << '\n' << text;
  }
  EXPECT_EQ(text.find("probe.quantisation"), std::string::npos) << "a check that found nothing";
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(layout::width(line), 100u) << line;
}

TEST(DiagnosisText, AdviceListsEveryPlan) {
  const std::string text = advice_text(example::cone_diagnosis());
  for (const char* part : {"RC", "2W", "ST", "the stream has no time column", "0.99"})
    EXPECT_NE(text.find(part), std::string::npos) << part << '\n' << text;
}

TEST(DiagnosisText, BreaksAtBlanksOnly) {
  EXPECT_EQ(layout::wrapped("ab ", ""), "ab \n");
  EXPECT_EQ(layout::wrapped("", std::string(60, 'x') + " " + std::string(60, 'y')),
            std::string(60, 'x') + "\n" + std::string(60, 'y') + "\n");
  EXPECT_EQ(layout::wrapped("é ", std::string(97, 'x') + " y"),
            "é " + std::string(97, 'x') + "\n  y\n");
}

TEST(DiagnosisResiduals, OneRowAReading) {
  JobResult job = example::cone_job(50);
  Diagnosis d = example::diagnosed(job.streams.front(), job.fits.front());
  d.noise.masked = {{2, "off"}};
  d.residual_after_mm[2] = std::nan("");
  std::istringstream lines(residuals_csv(job.streams.front(), d));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "# schema: trueaxis.residuals/1");
  std::getline(lines, line);
  EXPECT_EQ(line,
            "row,C[deg],Z[mm],X_M[mm],residual_before[um],effect[um],residual_after[um],masked");
  std::size_t rows = 0;
  while (std::getline(lines, line)) {
    ++rows;
    EXPECT_EQ(line.back(), rows == 2 ? '1' : '0');
    EXPECT_EQ(line.find("nan"), std::string::npos);
  }
  EXPECT_EQ(rows, 50u);
}

TEST(DiagnosisResiduals, SimulatedColumnsWhereThereIsASimulation) {
  const JobResult job = example::resimulated_job(50);
  SimulatedReadings simulated = job.resimulations.front()->readings;
  simulated.before_mm[0] = 50.1234567;
  simulated.after_mm.resize(49);
  std::istringstream lines(residuals_csv(job.streams.front(), *job.diagnoses.front(), &simulated));
  std::string line, last;
  std::getline(lines, line);  // its schema
  std::getline(lines, line);
  EXPECT_EQ(line.substr(line.find(",masked")), ",masked,simulated_before[mm],simulated_after[mm]");
  std::getline(lines, line);
  EXPECT_NE(line.find(",0,50.1234567,"), std::string::npos) << line;
  while (std::getline(lines, line)) last = line;
  EXPECT_EQ(last.back(), ',') << last;  // not there: an empty cell
}

}  // namespace
}  // namespace trueaxis
