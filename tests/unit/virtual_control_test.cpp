// SPDX-License-Identifier: Apache-2.0
// The control of the virtual machine: what it makes of a program by hand, and that it and the
// reader of the compensation, which share no code, make the same of random ones.
#include <gtest/gtest.h>

#include "compensate/program_axes.hpp"
#include "nc/program.hpp"
#include "simulate/machine/control.hpp"
#include "simulate/machine/nominal_path.hpp"
#include "support/nc_programs.hpp"

namespace trueaxis::virtual_machine {
namespace {

/// A trunnion with two tools, work offsets and Z reversed.
Machine machine_with_tools() {
  std::vector<ChainTrouble> none;
  Machine machine;
  machine.chain = "w C' A' Y' b X Z t";
  machine.axes = parse_chain(machine.chain, none);
  for (MachineAxis& axis : machine.axes)
    if (axis.name == AxisName::Z) axis.direction = {0.0, 0.0, -1.0};
  machine.tool = {{0.0, 0.0, 150.0}, {0.0, 0.0, 1.0}, 120.0};
  machine.tool_lengths_mm = {{1, 80.0}, {2, 100.0}};
  machine.work_offsets[0] = WorkOffset{{}, {1.0, 2.0, 3.0, 0.1, 0.0, 0.2}};
  machine.work_offsets[1] = WorkOffset{{}, {10.0, 20.0, 30.0, 0.0, 0.0, 0.0}};
  return machine;
}

TEST(VirtualControl, CarriesOutAProgram) {
  const Machine machine = machine_with_tools();
  const auto moves =
      moves_of_program(machine,
                       "%\nO1 (X9)\nG21 T1 M6\nG0 X1 Y1 Z1 A0 C0 ; X9\n/N5g43 h1 z-.5\n"
                       "G1 G20 X1. F10\nG21 G91 X1 C9\nG90 G93 F2 Y7\nG55 X0\n"
                       "G28 G91 Z0\nG90 G53 G0 X0\nM30\nG2 X7\n%\n",
                       "p.nc");
  ASSERT_EQ(moves.size(), 8u);
  const double expected[][4] = {
      {2, 3, 4, 0.2},
      {2, 3, 2.5 - 80, 0.2},  // Z moves the tool down for +: length subtracted
      {26.4, 3, 2.5 - 80, 0.2},
      {27.4, 3, 2.5 - 80, 0.2 + 9 * rad_per_deg},
      {27.4, 9, 2.5 - 80, 0.2 + 9 * rad_per_deg},
      {10, 9, 2.5 - 80, 0.2 + 9 * rad_per_deg},
      {10, 9, 0, 0.2 + 9 * rad_per_deg},
      {0, 9, 0, 0.2 + 9 * rad_per_deg}};
  for (std::size_t i = 0; i < moves.size(); ++i) {
    for (const std::size_t k : {0, 1, 2})
      EXPECT_NEAR(moves[i].to[k], expected[i][k], 1e-12) << i << ' ' << k;
    EXPECT_NEAR(moves[i].to[5], expected[i][3], 1e-12) << i;
    EXPECT_EQ(moves[i].leaves, i >= 6) << i;
    EXPECT_EQ(moves[i].begins_anew, i == 0 || i == 7) << i;
  }
  EXPECT_NEAR(moves[2].duration_s, 60.0 * 24.4 / 254.0, 1e-9);  // 10 inches a minute
  EXPECT_NEAR(moves[4].duration_s, 30.0, 1e-12);
}

TEST(VirtualControl, ATipStaysWhereItIsSaidToBe) {
  Machine machine = machine_with_tools();
  machine.mode = ProgramMode::tip;
  machine.work_offsets[0] = WorkOffset{};
  // The tip of the gauge point's tool is at z = 30 in the zero position; turning A leaves it.
  const auto moves = moves_of_program(machine, "G1 F100 X5 Y6 Z7 A0 C0\nA-90\nX6\n", "p.nc");
  ASSERT_EQ(moves.size(), 3u);
  EXPECT_NEAR(moves[0].to[0], 5.0, 1e-12);
  EXPECT_NEAR(moves[0].to[2], -(7.0 - 30.0), 1e-12);
  // A' at -90 deg turns the table by +90 about X: (5, 6, 7) is then at (5, -7, 6).
  EXPECT_NEAR(moves[1].to[1], -7.0, 1e-12);
  EXPECT_NEAR(moves[1].to[2], -(6.0 - 30.0), 1e-12);
  EXPECT_NEAR(moves[2].to[0], 6.0, 1e-12);
  EXPECT_NEAR(moves[1].duration_s, 54.0, 1e-9);  // a way in degrees alone
}

void expect_same_moves(const std::string& text, const Machine& machine) {
  const ProgramAxes axes(machine);
  const nc::Program read = nc::read_program(text, "p.nc", axes.read_options(std::nullopt));
  const auto moves = moves_of_program(machine, text, "p.nc");
  ASSERT_EQ(moves.size(), read.moves.size()) << trueaxis::testing::pasted(text);
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const auto positions = axes.positions(read.moves[i].words, read.moves[i].modal);
    EXPECT_EQ(moves[i].line, read.moves[i].line + 1);
    EXPECT_EQ(moves[i].rapid, read.moves[i].modal.motion == nc::Motion::rapid);
    EXPECT_EQ(moves[i].begins_anew, !read.moves[i].continues);
    for (std::size_t k = 0; k < axis_count; ++k)
      EXPECT_NEAR(moves[i].to[k], (*positions)[k], 1e-10) << i << ' ' << k;
  }
}

TEST(VirtualControl, ReadsAsTheCompensationDoes) {
  constexpr std::uint64_t seed = 20261123;
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  trueaxis::testing::ProgramMaker maker(seed);
  const Machine machine = machine_with_tools();
  for (int number = 0; number < 50; ++number) {
    SCOPED_TRACE(number);
    expect_same_moves(maker.next(30), machine);
  }
}

// Under G91 a new R moves the bottom, and the initial level is a word of the block's offset.
TEST(VirtualControl, DrillsAsTheCompensationDoes) {
  const std::string text =
      "G0 X1 Y2 Z80 A4 C5\nG91 G55 G81 X10 R-45 Z-8 F100\nX10 R-30\nG90 X9 Z-9 R2\nX8\n";
  const Machine machine = machine_with_tools();
  expect_same_moves(text, machine);
  const auto moves = moves_of_program(machine, text, "p.nc");
  ASSERT_EQ(moves.size(), 17u);
  EXPECT_NEAR(moves[3].to[2], 83.0 - 45.0 - 8.0, 1e-12);
  EXPECT_NEAR(moves[7].to[2], 83.0 - 30.0 - 8.0, 1e-12);
}

/// Points on the way against the arc's own equation, and how far it turns.
TEST(VirtualControl, GoesOnArcs) {
  const Machine machine = machine_with_tools();
  struct Case {
    std::string text;
    std::size_t u, v;
    double centre_u, centre_v, radius, turn_rad;
  };
  const Case cases[] = {
      {"G0 X10 Y0 Z0 A0 C0\nG3 X0 Y10 I-10 J0 F100\n", 0, 1, 0, 0, 10, 0.25 * two_pi},
      {"G0 X10 Y0 Z0 A0 C0\nG2 X0 Y10 Z6 C90 I-10 J0 F100\n", 0, 1, 0, 0, 10, -0.75 * two_pi},
      {"G0 X10 Y0 Z0 A0 C0\nG18 G2 X0 Z10 R10 F100\n", 2, 0, 0, 0, 10, -0.25 * two_pi},
      {"G0 X0 Y0 Z5 A0 C0\nG19 G3 Y5 Z0 R-5 F100\n", 1, 2, 0, 0, 5, 0.75 * two_pi},
      {"G0 X3 Y0 Z0 A0 C0\nG2 I-3 F100\n", 0, 1, 0, 0, 3, -two_pi}};
  const AxisPositions& zero = machine.work_offsets[0]->zero;
  for (const Case& one : cases) {
    const auto moves = moves_of_program(machine, one.text, "p.nc");
    ASSERT_EQ(moves.size(), 2u) << one.text;
    const ControlMove& arc = moves[1];
    ASSERT_TRUE(arc.arc) << one.text;
    EXPECT_NEAR(arc.arc->turn_rad, one.turn_rad, 1e-12) << one.text;
    EXPECT_NEAR(arc.duration_s, 0.6 * one.radius * std::abs(one.turn_rad), 1e-9) << one.text;
    double turned = 0.0, last = 0.0;
    for (int i = 0; i <= 100; ++i) {
      const AxisPositions q = axes_on_way(machine, arc, i / 100.0);
      const double u = q[one.u] - zero[one.u] - one.centre_u,
                   v = q[one.v] - zero[one.v] - one.centre_v;
      EXPECT_NEAR(std::hypot(u, v), one.radius, 1e-12) << one.text;
      const double at = std::atan2(v, u);
      if (i > 0) turned += std::remainder(at - last, two_pi);
      last = at;
    }
    EXPECT_NEAR(turned, one.turn_rad, 1e-9) << one.text;
  }
  const auto helix = moves_of_program(machine, cases[1].text, "p.nc");
  const AxisPositions middle = axes_on_way(machine, helix[1], 0.5);
  EXPECT_NEAR(middle[2] - zero[2], 3.0, 1e-12);
  EXPECT_NEAR(middle[5] - zero[5], 45.0 * rad_per_deg, 1e-12);
}

TEST(VirtualControl, PiecesComeBeforeTheirBlock) {
  const Machine machine = machine_with_tools();
  const std::string nominal = "G1 F100 X0 Y0 Z0 A-40 C0\nX10\nX10\nN9 X0 M3\nM30\n",
                    pieces =
                        "G1 F100 X0 Y0 Z0 A-40 C0\nX3\nX6\nX10\nX10\nM3 X7\nX3\nN9 X0 M3\nM30\n";
  const auto of_nominal = moves_of_program(machine, nominal, "p.nc"),
             of_pieces = moves_of_program(machine, pieces, "q.nc");
  EXPECT_EQ(nominal_moves_of(machine, {}, of_pieces, of_nominal, "q.nc"),
            (std::vector<std::size_t>{0, 1, 1, 1, 2, 3, 3, 3}));
  EXPECT_THROW(nominal_moves_of(machine, {}, of_nominal, of_pieces, "p.nc"), InputError);
  // The first piece says G1 and F as its block does; a whole turn ends where it begins.
  const auto of_arcs = moves_of_program(
                 machine, "G0 X0 Y0 Z0 A-40 C0\nG2 I5 F100\nX10 I5\nG1 X20\nX30\nG1 X40\n", "p.nc"),
             of_chords = moves_of_program(
                 machine,
                 "G0 X0 Y0 Z0 A-40 C0\nG1 F100 X5 Y5\nX10 Y0\nX5 Y-5\nG1 X0 Y0 F100\n"
                 "X5 Y5\nX10 Y0\nG1 X20\nX30\nG1 X40\n",
                 "q.nc");
  EXPECT_EQ(nominal_moves_of(machine, {}, of_chords, of_arcs, "q.nc"),
            (std::vector<std::size_t>{0, 1, 1, 1, 1, 2, 2, 3, 4, 5}));
}

}  // namespace
}  // namespace trueaxis::virtual_machine
