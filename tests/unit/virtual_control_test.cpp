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
      {2, 3, 2.5 - 80, 0.2},  // Z moves the tool down for +: length taken off
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

TEST(VirtualControl, ReadsAsTheCompensationDoes) {
  constexpr std::uint64_t seed = 20261123;
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  trueaxis::testing::ProgramMaker maker(seed);
  const Machine machine = machine_with_tools();
  const ProgramAxes axes(machine);
  for (int number = 0; number < 50; ++number) {
    const std::string text = maker.next(30);
    const nc::Program read = nc::read_program(text, "p.nc", axes.read_options(std::nullopt));
    const auto moves = moves_of_program(machine, text, "p.nc");
    ASSERT_EQ(moves.size(), read.moves.size()) << trueaxis::testing::pasted(text);
    for (std::size_t i = 0; i < moves.size(); ++i) {
      const auto positions = axes.positions(read.moves[i].words, read.moves[i].modal);
      EXPECT_EQ(moves[i].line, read.moves[i].line + 1);
      EXPECT_EQ(moves[i].rapid, read.moves[i].modal.motion == nc::Motion::rapid);
      EXPECT_EQ(moves[i].begins_anew, !read.moves[i].continues);
      for (std::size_t k = 0; k < axis_count; ++k)
        EXPECT_NEAR(moves[i].to[k], (*positions)[k], 1e-10) << number << ' ' << i << ' ' << k;
    }
  }
}

TEST(VirtualControl, PiecesComeBeforeTheirBlock) {
  const Machine machine = machine_with_tools();
  const std::string nominal = "G1 F100 X0 Y0 Z0 A-40 C0\nX10\nX10\nN9 X0 M3\nM30\n",
                    pieces =
                        "G1 F100 X0 Y0 Z0 A-40 C0\nX3\nX6\nX10\nX10\nM3 X7\nX3\nN9 X0 M3\nM30\n";
  const auto of_nominal = moves_of_program(machine, nominal, "p.nc"),
             of_pieces = moves_of_program(machine, pieces, "q.nc");
  EXPECT_EQ(nominal_moves_of(machine, of_pieces, of_nominal, "q.nc"),
            (std::vector<std::size_t>{0, 1, 1, 1, 2, 3, 3, 3}));
  EXPECT_THROW(nominal_moves_of(machine, of_nominal, of_pieces, "p.nc"), InputError);
}

}  // namespace
}  // namespace trueaxis::virtual_machine
