// SPDX-License-Identifier: Apache-2.0
// Programs of random machines with random errors are compensated and cut on the virtual machine,
// which has a control, an interpolator and a chain of its own: neither the compensation nor the
// model of the machine can hide a mistake from it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "simulate/machine/cut.hpp"
#include "support/program_case.hpp"

namespace trueaxis::testing {
namespace {

namespace vm = virtual_machine;

constexpr std::uint64_t seeds = 4;

enum class Mode { axes, tip };

/// A program of blocks of some tens of mm and degrees: of every axis of the machine.
struct CutCase : ProgramCase {
  CutCase(const Layout& layout, std::uint64_t seed, Mode mode) : ProgramCase(layout, seed) {
    if (mode == Mode::tip) machine.mode = ProgramMode::tip;
    const AxisPositions& zero = machine.work_offsets[0]->zero;
    AxisPositions q = draw.positions(machine);
    text = "G94 F1000\n";
    for (int i = 0; i < 12; ++i) {
      for (const MachineAxis& axis : machine.axes)
        q[index_of(axis.name)] +=
            is_rotary(axis.name) ? draw.between(-0.3, 0.3) : draw.between(-40.0, 40.0);
      AxisPositions words{};
      for (std::size_t k = 0; k < axis_count; ++k) words[k] = q[k] - zero[k];
      if (mode == Mode::tip) std::ranges::copy(nominal_tip(q), words.begin());
      text += block(machine, words);
    }
  }

  vm::Cut cut(const std::string& program, const ErrorModel& with, double step_mm = 1.0,
              double rad_per_mm = 0.01) const {
    vm::CutPlan plan;
    plan.program = program, plan.program_file = "compensated.nc";
    plan.nominal = text, plan.nominal_file = "part.nc";
    plan.step_mm = step_mm, plan.step_rad = rad_per_mm * step_mm;
    return vm::cut(machine, with, plan);
  }

  /// What words rounded to half a unit of their last decimals do to the tip, at most: every axis by
  /// that much at the rate at which it moves the tip; in tip programs X Y Z are the tip themselves,
  /// and a rotary word turns the part and the tool, of which only the errors are not made up for.
  double rounding_mm(const CompensationOptions& options) const {
    const double mm = 0.5 * std::pow(10.0, -options.decimals),
                 rad = 0.5 * std::pow(10.0, -options.angle_decimals) * rad_per_deg;
    double largest = 0.0;
    for (const AxisPositions& words : words_of(text)) {
      AxisPositions q = words;
      for (std::size_t k = 0; k < axis_count; ++k) q[k] += machine.work_offsets[0]->zero[k];
      const bool tip = machine.mode == ProgramMode::tip;
      if (tip) q = axes_of_tip(words);
      double sum = tip ? std::sqrt(3.0) * mm : 0.0;
      for (const MachineAxis& axis : machine.axes) {
        const bool rotary = is_rotary(axis.name);
        if (tip && !rotary) continue;
        AxisPositions ahead = q;
        ahead[index_of(axis.name)] += 1e-5;
        const double rate = distance(nominal_tip(ahead), nominal_tip(q)) / 1e-5;
        sum += rate * (rotary ? rad : mm) * (tip ? 0.01 : 1.0);
      }
      largest = std::max(largest, sum);
    }
    return 1.01 * largest + 1e-9;  // rates change by less than a hundredth with the errors
  }

  std::string text;
};

/// The first lines of a text.
std::string first_lines_of(const std::string& text, int lines) {
  std::size_t end = 0;
  for (; lines > 0; --lines) end = text.find('\n', end) + 1;
  return text.substr(0, end);
}

std::vector<Layout> with_space() {
  std::vector<Layout> out;
  std::ranges::copy_if(layouts(), std::back_inserter(out),
                       [](const Layout& layout) { return std::string(layout.name) != "lathe"; });
  return out;
}

/// Both modes of every layout whose linear axes span space, for each seed.
template <class Act>
void each_case(const Act& act, std::uint64_t last = seeds) {
  std::printf("seeds 1 to %d\n", static_cast<int>(last));
  for (const Layout& layout : with_space())
    for (std::uint64_t seed = 1; seed <= last; ++seed)
      for (const Mode mode : {Mode::axes, Mode::tip}) {
        SCOPED_TRACE(std::string(layout.name) + ", seed " + std::to_string(seed) +
                     (mode == Mode::tip ? ", tip" : ", axes"));
        act(CutCase(layout, seed, mode));
      }
}

TEST(VirtualCutLaw, WithoutErrorsItIsWhatTheProgramSays) {
  each_case([](const CutCase& one) {
    const vm::Cut cut = one.cut(one.text, {});
    EXPECT_EQ(cut.judged_ends, 12u);
    EXPECT_LT(cut.off_at_ends.value, 1e-11);
    const std::vector<AxisPositions> words = words_of(one.text);
    std::size_t next = 0;
    for (const vm::CutRow& row : cut.rows) {
      if (!row.end) continue;
      AxisPositions q = words[next++];
      for (std::size_t k = 0; k < axis_count; ++k) q[k] += one.machine.work_offsets[0]->zero[k];
      if (one.machine.mode == ProgramMode::tip) q = one.axes_of_tip(words[next - 1]);
      // Rounding of some 2 m, once in each of two chains of matrices.
      EXPECT_LT(distance(row.tool.tip_mm, one.nominal_tip(q)), 1e-10);
    }
    EXPECT_EQ(next, words.size());
  });
}

TEST(VirtualCutLaw, ACompensatedProgramCutsWhatTheMachineWithoutErrorsDoes) {
  each_case([](const CutCase& one) {
    const MachineModel model(one.machine, one.errors);
    for (const CompensationOptions& options : {CompensationOptions{}, fine()}) {
      const auto result = compensate_program(model, one.text, "p.nc", options);
      ASSERT_TRUE(result.unreachable.empty()) << result.unreachable.front().why;
      const vm::Cut before = one.cut(one.text, one.errors),
                    after = one.cut(result.text, one.errors);
      EXPECT_EQ(after.judged_ends, 12u);
      EXPECT_LT(after.off_at_ends.value, one.rounding_mm(options));
      // What the result says of both programs is what the other machine sees: to rounding.
      EXPECT_NEAR(before.off_at_ends.value, result.before.position.value, 1e-10);
      EXPECT_NEAR(after.off_at_ends.value, result.after.position.value, 1e-10);
      EXPECT_EQ(before.off_at_ends.line, result.before.position.line);
      if (one.machine.rotary_count() == 2) {
        EXPECT_NEAR(after.angle_at_ends.value, result.after.direction.value, 1e-11);
      }
      // Between blocks the result is right to a hundredth.
      EXPECT_NEAR(before.off_between.value, result.between_before.value,
                  0.01 * before.off_between.value + 1e-9);
      EXPECT_NEAR(after.off_between.value, result.between_after.value,
                  0.01 * after.off_between.value + 1e-9);
    }
  });
}

// Axes that turn by more than 20°, and rotary axes alone, mean the way of the machine: a ring is
// cut as a ring, whose chord would be a point.
TEST(VirtualCutLaw, AxesThatTurnFarOrAloneKeepTheirOwnWay) {
  each_case(
      [](CutCase one) {
        if (one.machine.mode == ProgramMode::tip) return;
        one.text = first_lines_of(one.text, 2);
        std::string far = "G1", alone = "G1";
        for (const MachineAxis& axis : one.machine.axes) {
          const char letter = letter_of(axis.name);
          if (is_rotary(axis.name))
            alone += fmt::format(" {}{:.3f}", letter, one.draw.between(-60, 60));
          far += fmt::format(" {}{:.3f}", letter, one.draw.between(-60.0, 60.0));
        }
        one.text += far + '\n' + alone + '\n';
        CompensationOptions options = fine();
        for (const double tolerance_mm : {0.0, 0.01}) {
          SCOPED_TRACE(tolerance_mm);
          if (tolerance_mm > 0.0) options.tolerance_mm = tolerance_mm;
          const auto result =
              compensate_program(MachineModel(one.machine, one.errors), one.text, "p.nc", options);
          ASSERT_TRUE(result.unreachable.empty()) << result.unreachable.front().why;
          const vm::Cut before = one.cut(one.text, one.errors),
                        after = one.cut(result.text, one.errors, 0.3, 0.02);
          // The other machine looks at points, and what is stated is right to a hundredth.
          EXPECT_NEAR(before.off_between.value, result.between_before.value,
                      0.02 * before.off_between.value);
          EXPECT_NEAR(after.off_between.value, result.between_after.value,
                      0.02 * after.off_between.value);
          EXPECT_LT(before.off_between.value, 3.0) << "by errors alone, and no chord";
          if (tolerance_mm > 0.0) {
            EXPECT_LT(after.off_between.value, 1.01 * tolerance_mm);
          }
        }
      },
      1);
}

// F of a turn is °/min, and mm/min once the correction moves X Y Z: under G93 all pieces together
// take the time of before. Six digits of each F count.
TEST(VirtualCutLaw, ATurnTakesAsLongAsBefore) {
  each_case(
      [](CutCase one) {
        if (one.machine.rotary_count() == 0) return;
        one.text = first_lines_of(one.text, 2) + "G1";
        double square = 0.0;
        const std::vector<AxisPositions> words = words_of(one.text);
        for (const MachineAxis& axis : one.machine.axes) {
          if (!is_rotary(axis.name)) continue;
          const double to_deg = std::round(one.draw.between(-60.0, 60.0)),
                       from_deg = words.back()[index_of(axis.name)] / rad_per_deg;
          one.text += fmt::format(" {}{:.0f}", letter_of(axis.name), to_deg);
          square += std::pow(to_deg - from_deg, 2);
        }
        one.text += " F250\n";
        CompensationOptions options = fine();
        for (const bool in_pieces : {false, true}) {
          if (in_pieces) options.tolerance_mm = 0.01;
          const auto result =
              compensate_program(MachineModel(one.machine, one.errors), one.text, "p.nc", options);
          ASSERT_TRUE(result.unreachable.empty()) << result.unreachable.front().why;
          ASSERT_EQ(result.remarks.size(), 1u) << result.text;
          std::istringstream turn(result.text.substr(result.text.find("G93")));
          double time_min = 0.0;
          for (std::string line; std::getline(turn, line);)
            time_min += 1.0 / std::stod(line.substr(line.find('F') + 1));
          EXPECT_NEAR(time_min, std::sqrt(square) / 250.0, 6e-6 * time_min) << result.text;
        }
      },
      1);
}

TEST(VirtualCutLaw, PiecesStayWithinTheTolerance) {
  each_case([](CutCase one) {
    // Without G1 in every block nothing but its place tells a block from its pieces.
    if (one.draw.whole(0, 1) == 0)
      for (std::size_t at = 30; (at = one.text.find("G1 ", at)) != std::string::npos;)
        one.text.erase(at, 3);
    CompensationOptions options = fine();
    options.tolerance_mm = 0.05;
    const auto result =
        compensate_program(MachineModel(one.machine, one.errors), one.text, "p.nc", options);
    ASSERT_TRUE(result.unreachable.empty()) << result.unreachable.front().why;
    const vm::Cut cut = one.cut(result.text, one.errors);
    EXPECT_EQ(cut.judged_ends, 12u);
    EXPECT_EQ(cut.blocks, 12 + result.blocks_inserted);
    EXPECT_LT(cut.off_at_ends.value, 1e-9);
    EXPECT_LT(cut.off_between.value, 1.01 * 0.05);
  });
}

// Arcs of the control against chords of the compensation: half a turn and three quarters in every
// plane, a whole one with the rotary axes going along, the blocks after the first without G2.
TEST(VirtualCutLaw, ChordsStayWithTheArcsOfTheControl) {
  each_case([](CutCase one) {
    one.text = first_lines_of(one.text, 2);
    std::string rotary;
    for (const MachineAxis& axis : one.machine.axes)
      if (is_rotary(axis.name)) rotary += std::string(1, letter_of(axis.name)) + "10 ";
    one.text += "G90 G0 X10 Y0 Z0\nG2 X-10 Y0 I-10 J0\nX-10 Y20 R-10\nG17 " + rotary +
                "X-10 I10\nG18 G3 X-20 Z10 K10\nG19 Z0 J3 K-5\n";
    CompensationOptions options = fine();
    options.arc_tolerance_mm = 0.02;
    const auto result =
        compensate_program(MachineModel(one.machine, one.errors), one.text, "p.nc", options);
    ASSERT_TRUE(result.unreachable.empty()) << result.unreachable.front().why;
    const vm::Cut cut = one.cut(result.text, one.errors, 2.0),
                  before = one.cut(one.text, one.errors, 5.0);
    EXPECT_EQ(cut.judged_ends, 7u);
    EXPECT_GT(cut.blocks, 40u);
    EXPECT_LT(cut.off_at_ends.value, 1e-9);
    EXPECT_GT(before.off_at_ends.value, 1e-3);
    // The other machine looks at few points: it finds no more than what is stated to a hundredth.
    EXPECT_LE(cut.off_between.value, 1.01 * result.between_after.value + 1e-9);
    EXPECT_LE(before.off_between.value, 1.01 * result.between_before.value + 1e-9);
  });
}

// While an arc of a radius of 5 to 20 mm turns by a quarter, every rotary axis turns by up to half
// a revolution. What is stated of both programs is what the other machine finds: each is right to
// a hundredth, the other one by the eight points at least that it looks at in a chord.
TEST(VirtualCutLaw, ArcsWithRotaryAxesThatTurnAreStatedAsTheControlFindsThem) {
  const auto judge = [](CutCase one) {
    one.text = first_lines_of(one.text, 1);
    const double radius_mm = one.draw.between(5.0, 20.0);
    std::string from = "G1 X0 Y0 Z0", to = one.draw.whole(0, 1) == 0 ? "G18 G3" : "G17 G2";
    for (const MachineAxis& axis : one.machine.axes) {
      if (!is_rotary(axis.name)) continue;
      from += fmt::format(" {}{:.3f}", letter_of(axis.name), one.draw.between(-60.0, 60.0));
      to += fmt::format(" {}{:.3f}", letter_of(axis.name), one.draw.between(-120.0, 120.0));
    }
    one.text += from + '\n' +
                fmt::format("{} X{:.4f} {}{:.4f} R{:.4f}\n", to, radius_mm,
                            to[2] == '8' ? 'Z' : 'Y', radius_mm, radius_mm);
    CompensationOptions options = fine();
    options.arc_tolerance_mm = 0.02;
    for (const double tolerance_mm : {0.0, 0.01}) {
      SCOPED_TRACE(tolerance_mm);
      if (tolerance_mm > 0.0) options.tolerance_mm = tolerance_mm;
      const auto result =
          compensate_program(MachineModel(one.machine, one.errors), one.text, "p.nc", options);
      ASSERT_TRUE(result.unreachable.empty()) << result.unreachable.front().why;
      const vm::Cut cut = one.cut(result.text, one.errors, 0.06, 0.05),
                    before = one.cut(one.text, one.errors, 0.5, 0.02);
      EXPECT_EQ(cut.judged_ends, 2u);
      EXPECT_GT(cut.blocks, 4u);
      EXPECT_LT(cut.off_at_ends.value, 1e-9);
      EXPECT_NEAR(before.off_between.value, result.between_before.value,
                  0.02 * before.off_between.value);
      EXPECT_NEAR(cut.off_between.value, result.between_after.value, 0.02 * cut.off_between.value);
      if (tolerance_mm > 0.0) {
        EXPECT_LT(cut.off_between.value, 1.01 * tolerance_mm);
      }
    }
  };
  each_case(judge, 1);  // of all four it is the longest test of all
}

/// How far off a program is that was compensated for `machine` with `errors`, by rounding.
double off_by_rounding(const CutCase& one, const Machine& machine, const ErrorModel& errors) {
  const auto result = compensate_program(MachineModel(machine, errors), one.text, "p.nc", fine());
  if (!result.unreachable.empty()) return INFINITY;
  return one.cut(result.text, one.errors).off_at_ends.value / one.rounding_mm(fine());
}

// Errors of 0.02 mm that are taken with another sign, order or pivot leave some µm at least: a
// thousand times what the tests above allow.
TEST(VirtualCutLaw, MistakesAreSeen) {
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    CutCase one(layouts()[0], seed, Mode::axes);
    ASSERT_LT(off_by_rounding(one, one.machine, one.errors), 1.0);
    ErrorModel sign = one.errors;
    sign.sign = sign.sign == ErrorSign::moving_part ? ErrorSign::tool_minus_workpiece
                                                    : ErrorSign::moving_part;
    EXPECT_GT(off_by_rounding(one, one.machine, sign), 1e3) << "sign, seed " << seed;
    ErrorModel pivot = one.errors;
    for (Vector3& reference : pivot.reference_mm) reference = {};
    EXPECT_GT(off_by_rounding(one, one.machine, pivot), 1e3) << "pivot, seed " << seed;
    Machine order = one.machine;
    std::swap(order.axes[0], order.axes[1]);  // C' A' of the table
    EXPECT_GT(off_by_rounding(one, order, one.errors), 1e3) << "order, seed " << seed;
    Machine point = one.machine;
    for (MachineAxis& axis : point.axes) axis.point_mm = {};
    EXPECT_GT(off_by_rounding(one, point, one.errors), 1e3) << "point, seed " << seed;
  }
}

// A disturbance that no geometry explains is seen as what it is.
TEST(VirtualCutLaw, ReversalAndDriftAreCut) {
  std::vector<ChainTrouble> none;
  Machine machine;
  machine.axes = parse_chain("w b X Y Z t", none);
  vm::CutPlan plan;
  plan.program_file = plan.nominal_file = "p.nc";
  plan.program = plan.nominal = "G1 F600 X0 Y0 Z0\nX10\nX20\nX10\nG4 P60\nX5\n";
  plan.disturbance.reversal[0] = 0.006;
  plan.disturbance.drift_mm_per_s = {0.0, 0.001, 0.0};
  const vm::Cut cut = vm::cut(machine, {}, plan);
  ASSERT_EQ(cut.rows.size(), 5u);
  const double time_s[] = {0.0, 1.0, 2.0, 3.0, 63.5}, lost_mm[] = {0.0, 0.0, 0.0, 0.006, 0.006};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(cut.rows[i].time_s, time_s[i], 1e-12);
    EXPECT_NEAR(cut.rows[i].off_mm, std::hypot(lost_mm[i], 0.001 * time_s[i]), 1e-12);
  }
}

}  // namespace
}  // namespace trueaxis::testing
