// SPDX-License-Identifier: Apache-2.0
// Blocks that are cut in pieces: between the numbers of the new text, every axis going evenly, the
// tip is asked of matrices that the test multiplies out itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "compensate/nominal_way.hpp"
#include "support/program_case.hpp"

namespace trueaxis::testing {
namespace {

/// Where a tip is, a part of the way along a block, in `axes`: every axis goes evenly.
Vector3 on_the_way(const ProgramCase& one, const AxisPositions& from, const AxisPositions& to,
                   double s) {
  AxisPositions q;
  for (std::size_t k = 0; k < axis_count; ++k) q[k] = from[k] + s * (to[k] - from[k]);
  return tip_of(ChainMatrices{one.machine, one.errors}.tool_in_part(q, one.setting));
}

double from_line(const Vector3& p, const Vector3& a, const Vector3& b) {
  Vector3 ab, ap;
  double length = 0.0, along = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    ab[i] = b[i] - a[i], ap[i] = p[i] - a[i];
    length += ab[i] * ab[i], along += ab[i] * ap[i];
  }
  const double s = length > 0.0 ? std::clamp(along / length, 0.0, 1.0) : 0.0;
  return std::hypot(ap[0] - s * ab[0], ap[1] - s * ab[1], ap[2] - s * ab[2]);
}

/// How far the tip leaves a line, at 40 points of every piece.
double largest_off(const ProgramCase& one, const std::vector<AxisPositions>& written,
                   const Vector3& start, const Vector3& end) {
  double largest = 0.0;
  for (std::size_t i = 1; i < written.size(); ++i)
    for (int j = 0; j <= 40; ++j)
      largest = std::max(
          largest, from_line(on_the_way(one, written[i - 1], written[i], j / 40.0), start, end));
  return largest;
}

// The tip is asked at 40 points of every piece; between the quarters that the command looks at an
// even curve rises by at most a third of a percent, a curve of the third degree by 3 %.
TEST(CompensatePiecesLaw, PiecesStayWithinTheTolerance) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    ProgramCase one(layouts()[0], seed);
    one.machine.work_offsets[0]->zero = {};
    const AxisPositions a = one.draw.positions(one.machine);
    AxisPositions b = a;
    for (std::size_t k : {0, 1, 2}) b[k] += one.draw.between(-20.0, 20.0);
    for (std::size_t k : {3, 5}) b[k] += one.draw.between(-0.2, 0.2);
    const std::string text = block(one.machine, a) + block(one.machine, b);
    const MachineModel model(one.machine, one.errors);
    CompensationOptions options = fine();
    const auto whole = compensate_program(model, text, "p.nc", options);
    options.tolerance_mm = 0.01;
    const auto result = compensate_program(model, text, "p.nc", options);
    const std::vector<AxisPositions> written = words_of(result.text);
    ASSERT_EQ(written.size(), 2 + result.blocks_inserted);
    const Vector3 start = one.nominal_tip(a), end = one.nominal_tip(b);
    const double largest = largest_off(one, written, start, end);
    EXPECT_LT(largest, 1.03 * 0.01) << "seed " << seed;
    EXPECT_LE(result.between_after.value, 0.01);
    EXPECT_GT(result.blocks_inserted, 0u);
    // An even curve that leaves d in one piece leaves d / n² in n.
    const double asked = std::sqrt(whole.between_after.value / 0.01);
    EXPECT_LE(static_cast<double>(result.blocks_inserted + 1), std::ceil(1.3 * asked)) << seed;
  }
}

// Blocks of any length, in both modes, against 1000 points of each way: the largest is stated to a
// hundredth.
TEST(CompensatePiecesLaw, BetweenBlocksIsTheLargestOfAThousandPoints) {
  for (std::uint64_t seed = 21; seed < 57; ++seed) {
    ProgramCase one(layouts()[seed % 7], seed);
    one.machine.work_offsets[0]->zero = {};
    const bool tip = seed % 2 == 0;
    if (tip) one.machine.mode = ProgramMode::tip;
    const double size = std::pow(10.0, -static_cast<double>(seed % 4));
    const AxisPositions a = one.draw.positions(one.machine);
    AxisPositions b = a;
    for (const MachineAxis& axis : one.machine.axes)
      b[index_of(axis.name)] +=
          size * (is_rotary(axis.name) ? one.draw.between(-3.0, 3.0) : one.draw.between(-500, 500));
    const Vector3 start = one.nominal_tip(a), end = one.nominal_tip(b);
    AxisPositions word_a = a, word_b = b;
    if (tip) std::ranges::copy(start, word_a.begin()), std::ranges::copy(end, word_b.begin());
    const auto result =
        compensate_program(MachineModel(one.machine, one.errors),
                           block(one.machine, word_a) + block(one.machine, word_b), "p.nc", fine());
    ASSERT_TRUE(result.unreachable.empty()) << result.unreachable.front().why;
    double largest = 0.0;
    for (int j = 0; j <= 1000; ++j) {
      AxisPositions words;
      for (std::size_t k = 0; k < axis_count; ++k)
        words[k] = std::lerp(word_a[k], word_b[k], j / 1000.0);
      const AxisPositions q = tip ? one.axes_of_tip(words) : words;
      const Vector3 there =
          tip_of(ChainMatrices{one.machine, one.errors}.tool_in_part(q, one.setting));
      largest = std::max(largest, from_line(there, start, end));
    }
    EXPECT_NEAR(result.between_before.value, largest, 0.01 * largest) << "seed " << seed;
  }
}

// A block of half a turn means the way of its axes, which a machine without errors goes. Of 4000
// straight parts of it none is 0.5 µm off the way: 1 m (π/4000)²/8 is 0.08 µm for one axis.
TEST(CompensatePiecesLaw, PiecesOfLongBlocksStayOnTheWayOfTheAxes) {
  for (const std::uint64_t seed : {11, 12, 13, 14, 15, 16}) {
    ProgramCase one(layouts()[seed % 2], seed);
    one.machine.work_offsets[0]->zero = {};
    const AxisPositions a = one.draw.positions(one.machine), b = one.draw.positions(one.machine);
    CompensationOptions options = fine();
    options.tolerance_mm = 0.02;
    const auto result =
        compensate_program(MachineModel(one.machine, one.errors),
                           block(one.machine, a) + block(one.machine, b), "p.nc", options);
    ASSERT_TRUE(result.unreachable.empty()) << result.unreachable.front().why;
    std::vector<Vector3> way;
    for (int j = 0; j <= 4000; ++j) {
      AxisPositions q;
      for (std::size_t k = 0; k < axis_count; ++k) q[k] = std::lerp(a[k], b[k], j / 4000.0);
      way.push_back(one.nominal_tip(q));
    }
    const std::vector<AxisPositions> written = words_of(result.text);
    double largest = 0.0;
    for (std::size_t i = 1; i < written.size(); ++i)
      for (int j = 0; j <= 40; ++j) {
        const Vector3 tip = on_the_way(one, written[i - 1], written[i], j / 40.0);
        double least = INFINITY;
        for (std::size_t k = 1; k < way.size(); ++k)
          least = std::min(least, from_line(tip, way[k - 1], way[k]));
        largest = std::max(largest, least);
      }
    EXPECT_LT(largest, 1.03 * 0.02 + 0.0005) << "seed " << seed;
    EXPECT_GT(result.blocks_inserted, 1u);
  }
}

// A table of straight lines bends at its places alone, by as much as a piece is long: sixteen of
// them on one line. A corner of up to 2 · 40 µm / 50 mm is 0.5 µm off on a piece of 1.25 mm: equal
// ones would be 780/1.25.
TEST(CompensatePiecesLaw, PiecesAtTheCornersOfATable) {
  for (const std::uint64_t seed : {41, 42, 43}) {
    ProgramCase one(layouts()[0], seed);
    one.machine.work_offsets[0]->zero = {};
    TableError table;
    for (double at = -400.0; at <= 400.0; at += 50.0) {
      table.at.push_back(at);
      table.values.push_back(one.draw.between(-0.02, 0.02));
    }
    one.errors.terms.push_back({*parse_error_name("EYX"), table, 0.0});
    AxisPositions a{}, b{};
    a[0] = -390.0, b[0] = 390.0;
    CompensationOptions options = fine();
    options.tolerance_mm = 0.0005;
    const auto result =
        compensate_program(MachineModel(one.machine, one.errors),
                           block(one.machine, a) + block(one.machine, b), "p.nc", options);
    ASSERT_TRUE(result.unreachable.empty()) << result.unreachable.front().why;
    const std::vector<AxisPositions> written = words_of(result.text);
    const Vector3 start = one.nominal_tip(a), end = one.nominal_tip(b);
    const double largest = largest_off(one, written, start, end);
    EXPECT_LT(largest, 1.03 * 0.0005) << "seed " << seed;
    EXPECT_LT(static_cast<double>(result.blocks_inserted), 0.5 * 780.0 / 1.25) << "seed " << seed;
  }
}

TEST(CompensatePiecesLaw, PiecesUnderInverseTimeTakeTheSameTime) {
  ProgramCase one(layouts()[0], 1);
  const AxisPositions a = one.draw.positions(one.machine);
  AxisPositions b = a;
  b[0] += 30.0, b[5] += 0.3;
  std::string to_b = block(one.machine, b);
  to_b.insert(to_b.size() - 1, " F3");
  CompensationOptions options = fine();
  options.tolerance_mm = 0.01;
  const auto result = compensate_program(MachineModel(one.machine, one.errors),
                                         "G93 F2 " + block(one.machine, a) + to_b, "p.nc", options);
  double time_min = 0.0;
  std::istringstream lines(result.text);
  std::string line;
  std::getline(lines, line);
  for (; std::getline(lines, line);)
    time_min += 1.0 / std::strtod(line.c_str() + line.find('F') + 1, nullptr);
  EXPECT_GT(result.blocks_inserted, 3u);
  EXPECT_NEAR(time_min, 1.0 / 3.0, 1e-12);
}

// From 20° to 40° are 20°, and not more by the rounding of a radian.
TEST(CompensatePiecesLaw, ExactlyTwentyDegreesAreEven) {
  for (int from = -180; from < 180; from += 20) {
    AxisPositions before{}, after{};
    before[5] = from * rad_per_deg, after[5] = (from + 20) * rad_per_deg;
    after[0] = 10.0;
    EXPECT_FALSE(means_own_way(before, after)) << from;
    after[5] = (from + 20.001) * rad_per_deg;
    EXPECT_TRUE(means_own_way(before, after)) << from;
  }
}

}  // namespace
}  // namespace trueaxis::testing
