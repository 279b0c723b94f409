// SPDX-License-Identifier: Apache-2.0
// Read-outs alone, made by the test's own formulas, and what a diagnosis names in them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <numbers>

#include "simulate/machine/bodies.hpp"
#include "support/ball_bench.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/machine_diagnosis.hpp"

namespace trueaxis::testing::read_outs {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double sigma_mm = 1e-3, sigma_rad = 4e-6;

/// One reading: its share of the range 0 … 1, the sense of its run, its share of the time.
struct At {
  double s = 0.0, sense = 0.0, time = 0.0;
  std::size_t row = 0;
};
using Hidden = std::function<double(const At&)>;

struct ReadOut {
  AxisName axis = AxisName::X;
  int runs = 2, positions = 51;
  bool timed = true;
  double low = -200.0, high = 300.0;  ///< mm or rad
};

double sigma_of(const ReadOut& plan) { return is_rotary(plan.axis) ? sigma_rad : sigma_mm; }

/// There and back, and so on.
MachineMeasurement read(const ReadOut& plan, const Hidden& hidden, Draw& draw) {
  MachineMeasurement data;
  data.source = "read_out.csv";
  data.kind = MeasurementKind::axis;
  data.axis = plan.axis;
  std::normal_distribution<double> normal(0.0, sigma_of(plan));
  const std::size_t all = static_cast<std::size_t>(plan.runs * plan.positions);
  for (int run = 0; run < plan.runs; ++run)
    for (int i = 0; i < plan.positions; ++i) {
      const double s =
          static_cast<double>(run % 2 == 0 ? i : plan.positions - 1 - i) / (plan.positions - 1);
      const std::size_t row = data.rows();
      const At at{s, run % 2 == 0 ? 0.5 : -0.5,
                  static_cast<double>(row) / static_cast<double>(all - 1), row};
      AxisPositions axes{};
      axes[static_cast<std::size_t>(plan.axis)] = plan.low + s * (plan.high - plan.low);
      data.actual.push_back(axes[static_cast<std::size_t>(plan.axis)] + hidden(at) +
                            normal(draw.engine));
      data.axes.push_back(axes);
      data.setup.push_back(1);
      data.ball.push_back(1);
      if (plan.timed) data.time_s.push_back(5.0 * static_cast<double>(row));
    }
  return data;
}

ReadOut turn() { return {AxisName::C, 2, 73, true, 0.0, 2.0 * pi}; }

MachineDiagnosis diagnosed(const MachineMeasurement& data) {
  return diagnose_machine(trunnion(), std::span(&data, 1));
}

std::string all_of(const MachineDiagnosis& d) {
  std::string text;
  for (const MachineFinding& one : d.findings) text += one.effect() + ' ';
  for (const MachineUnexplained& one : d.unexplained) text += "unexplained " + one.pattern + ' ';
  return text;
}

const MachineNotObservable* hidden_of(const MachineDiagnosis& d, const std::string& effect) {
  const auto at = std::ranges::find(d.not_observable, effect, &MachineNotObservable::effect);
  return at == d.not_observable.end() ? nullptr : &*at;
}

struct Case {
  std::string effect;
  ReadOut plan;
  double size = 0.0;  ///< mm or rad
  Hidden hidden;
};

/// Six σ and more of one reading over some 100 readings: λ of some hundred.
std::vector<Case> cases() {
  const auto x = [](const At& at) { return 2.0 * at.s - 1.0; };
  const double mm = 6e-3, rad = 25e-6;
  return {
      {"EXX.poly1", {}, mm, [=](const At& at) { return mm * x(at); }},
      {"EXX.poly2", {}, mm, [=](const At& at) { return mm * 0.5 * (3.0 * x(at) * x(at) - 1.0); }},
      {"EXX.poly3",
       {},
       mm,
       [=](const At& at) { return mm * 0.5 * x(at) * (5.0 * x(at) * x(at) - 3.0); }},
      // 13.4 and 21.7 waves over the travel, between those of the grid of periods.
      {"EXX.periodic", {}, mm, [=](const At& at) { return mm * std::cos(13.4 * 2.0 * pi * at.s); }},
      {"EXX.periodic",
       {},
       10.0 * mm,
       [=](const At& at) { return 10.0 * mm * std::sin(21.7 * 2.0 * pi * at.s + 0.4); }},
      {"reversal.X", {}, mm, [=](const At& at) { return mm * at.sense; }},
      {"read_out.X.drift", {}, mm, [=](const At& at) { return mm * at.time; }},
      {"read_out.X.step", {}, mm, [=](const At& at) { return at.row >= 37 ? mm : 0.0; }},
      {"EZZ.poly2",
       {AxisName::Z},
       mm,
       [=](const At& at) { return mm * 0.5 * (3.0 * x(at) * x(at) - 1.0); }},
      {"ECC.harmonic1", turn(), rad, [=](const At& at) { return rad * std::cos(2.0 * pi * at.s); }},
      {"ECC.harmonic9", turn(), rad,
       [=](const At& at) { return rad * std::sin(9.0 * 2.0 * pi * at.s + 0.7); }},
      {"reversal.C", turn(), rad, [=](const At& at) { return rad * at.sense; }},
  };
}

TEST(DiagnoseReadOutLaw, NamesWhatIsThereWithItsSize) {
  for (const Case& one : cases()) {
    Draw draw(21);
    const MachineDiagnosis found = diagnosed(read(one.plan, one.hidden, draw));
    ASSERT_EQ(found.findings.size(), 1U) << one.effect << ": " << all_of(found);
    EXPECT_TRUE(found.unexplained.empty()) << one.effect << ": " << all_of(found);
    const MachineFinding& cause = found.findings.front();
    EXPECT_EQ(cause.effect(), one.effect);
    double u = 0.0;
    for (const CalibratedParameter& p : cause.parameters) u = std::max(u, p.estimate.u);
    EXPECT_NEAR(cause.size, one.size, 4.0 * u) << one.effect;
    // By the noise alone it is σ/√(n m), m the mean square of the shape about its mean: 1/12 for a
    // drift, the least of these; a quarter more, as σ is estimated to 7 %.
    const auto n = static_cast<double>(one.plan.runs * one.plan.positions);
    EXPECT_LT(u, 1.25 * sigma_of(one.plan) * std::sqrt(12.0 / n)) << one.effect;
  }
}

// What is written as an error of the machine, by the virtual machine: less it, the read-out has
// lost what was hidden, wherever the axis is and whatever sign the errors have.
TEST(DiagnoseReadOutLaw, WritesTheErrorWithTheSignOfTheReadOut) {
  for (const ErrorSign sign : {ErrorSign::moving_part, ErrorSign::tool_minus_workpiece})
    for (const AxisName axis : {AxisName::X, AxisName::Y, AxisName::Z}) {
      Draw draw(22);
      const ReadOut plan{axis};
      const MachineMeasurement data = read(
          plan, [](const At& at) { return 0.02 * at.s; }, draw);
      MachineDiagnoseOptions options;
      options.calibration.errors.sign = sign;
      const Machine machine = trunnion();
      const MachineDiagnosis found = diagnose_machine(machine, std::span(&data, 1), options);
      ASSERT_EQ(found.findings.size(), 1U) << all_of(found);
      const double written = virtual_machine::own_error(machine, found.errors, axis, plan.high) -
                             virtual_machine::own_error(machine, found.errors, axis, plan.low);
      // From −1 to 1 it is twice the coefficient.
      EXPECT_NEAR(written, 0.02, 8.0 * found.findings.front().parameters.front().estimate.u)
          << letter_of(axis);
    }
}

// False alarms at 1 % per measurement, σ stated or not: at most 21 of 1000 (binomial, 99.9 %).
TEST(DiagnoseReadOutLaw, IsSilentInNoise) {
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    Draw draw(seed);
    const ReadOut plan = seed % 3 == 0 ? turn() : ReadOut{};
    MachineMeasurement data = read(
        plan, [](const At&) { return 0.0; }, draw);
    if (seed % 2 == 0) data.noise_mm = sigma_of(plan);
    if (diagnosed(data).verdict != DiagnosisVerdict::ideal) ++alarms;
  }
  RecordProperty("alarms", alarms);
  EXPECT_LE(alarms, 21);
}

// Two lines, a scale error and a reversal at once, and read-outs of two axes together.
TEST(DiagnoseReadOutLaw, TellsSeveralApart) {
  Draw draw(23);
  const std::vector<MachineMeasurement> data{
      read(
          {},
          [](const At& at) {
            return 0.01 * (2.0 * at.s - 1.0) + 0.006 * at.sense +
                   0.005 * std::cos(9.6 * 2.0 * pi * at.s) +
                   0.004 * std::sin(19.2 * 2.0 * pi * at.s);
          },
          draw),
      read(
          {AxisName::Y}, [](const At& at) { return at.row >= 60 ? 0.006 : 0.0; }, draw)};
  const MachineDiagnosis found = diagnose_machine(trunnion(), data);
  std::vector<std::string> effects;
  for (const MachineFinding& one : found.findings) effects.push_back(one.effect());
  std::ranges::sort(effects);
  EXPECT_EQ(effects, (std::vector<std::string>{"EXX.periodic", "EXX.periodic", "EXX.poly1",
                                               "read_out.Y.step", "reversal.X"}))
      << all_of(found);
}

TEST(DiagnoseReadOutLaw, OneRunTellsNoDriftFromScaleAndShowsNoReversal) {
  Draw draw(24);
  ReadOut plan;
  plan.runs = 1;
  const MachineDiagnosis found = diagnosed(read(
      plan, [](const At& at) { return 0.01 * at.s; }, draw));
  ASSERT_EQ(found.findings.size(), 1U) << all_of(found);
  const auto members = found.findings.front().members();
  EXPECT_NE(std::ranges::find(members, "EXX.poly1"), members.end());
  EXPECT_NE(std::ranges::find(members, "read_out.X.drift"), members.end());
  ASSERT_TRUE(found.findings.front().separate_with);
  EXPECT_EQ(found.findings.front().separate_with->plan, "RV");
  const MachineNotObservable* const reversal = hidden_of(found, "reversal.X");
  ASSERT_NE(reversal, nullptr);
  EXPECT_EQ(reversal->plans(), std::vector<std::string>{"RV"});
  ASSERT_NE(found.next(), nullptr);
  EXPECT_EQ(found.next()->visits.front().axes[0], plan.high);
}

TEST(DiagnoseReadOutLaw, SaysWhatTheseReadingsCannotShow) {
  Draw draw(25);
  ReadOut plan;
  plan.positions = 8;
  plan.timed = false;
  const MachineDiagnosis found = diagnosed(read(
      plan, [](const At&) { return 0.0; }, draw));
  for (const char* effect : {"EXX.periodic", "EXX.fine", "read_out.X.drift", "E*X", "E*Y"}) {
    const MachineNotObservable* const one = hidden_of(found, effect);
    ASSERT_NE(one, nullptr) << effect;
    EXPECT_FALSE(one->why.empty());
  }
  EXPECT_EQ(hidden_of(found, "reversal.X"), nullptr);
}

// Orders of a turn go on; a polynomial and a period hold where they were read.
TEST(DiagnoseReadOutLaw, WritesWhereAnErrorIsKnown) {
  std::size_t terms = 0;
  for (const Case& one : cases()) {
    Draw draw(27);
    const MachineDiagnosis found = diagnosed(read(one.plan, one.hidden, draw));
    terms += found.errors.terms.size();
    for (const ErrorTerm& term : found.errors.terms) {
      ASSERT_EQ(term.known_over.has_value(), !is_rotary(one.plan.axis)) << one.effect;
      if (!term.known_over) continue;
      EXPECT_EQ(*term.known_over, (std::array{one.plan.low, one.plan.high})) << one.effect;
    }
  }
  EXPECT_GE(terms, cases().size() / 2);
}

TEST(DiagnoseReadOutLaw, RefusesToWeighAProgram) {
  Draw draw(28);
  const MachineMeasurement data = read(
      {}, [](const At&) { return 0.0; }, draw);
  MachineDiagnoseOptions options;
  options.covariances = true;
  try {
    diagnose_machine(trunnion(), std::span(&data, 1), options);
    FAIL() << "a program was weighed by a read-out alone";
  } catch (const InputError& wrong) {
    EXPECT_NE(std::string(wrong.what()).find("kind ball, bar or array"), std::string::npos);
  }
}

TEST(DiagnoseReadOutLaw, RefusesAnAxisThatIsAlongNoOther) {
  Machine machine = trunnion();
  for (MachineAxis& axis : machine.axes)
    if (axis.name == AxisName::X) axis.direction = {0.8, 0.0, 0.6};
  Draw draw(26);
  const MachineMeasurement data = read(
      {}, [](const At&) { return 0.0; }, draw);
  try {
    diagnose_machine(machine, std::span(&data, 1));
    FAIL() << "a slant axis was diagnosed";
  } catch (const InputError& wrong) {
    EXPECT_NE(std::string(wrong.what()).find("trueaxis machine calibrate"), std::string::npos);
  }
}

}  // namespace
}  // namespace trueaxis::testing::read_outs
