// SPDX-License-Identifier: Apache-2.0
// Programs of random machines with random errors, compensated; where the tool then is, is asked of
// matrices that the test multiplies out itself, at the numbers that stand in the new text.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <set>
#include <sstream>

#include "support/chain_matrices.hpp"
#include "support/random_machine.hpp"
#include "trueaxis/compensation.hpp"

namespace trueaxis::testing {
namespace {

constexpr std::uint64_t seeds = 6;
constexpr const char* letters = "XYZABC";

std::string block(const Machine& machine, const std::array<double, axis_count>& words) {
  std::string text = "G1";
  char number[64];
  for (std::size_t k = 0; k < axis_count; ++k) {
    if (machine.find(static_cast<AxisName>(k)) == nullptr) continue;
    std::snprintf(number, sizeof number, " %c%.12f", letters[k],
                  words[k] / (k < 3 ? 1.0 : rad_per_deg));
    text += number;
  }
  return text + "\n";
}

/// The words of every line that has an axis word, those left out as before; mm and rad.
std::vector<std::array<double, axis_count>> words_of(const std::string& text) {
  std::vector<std::array<double, axis_count>> out;
  std::istringstream lines(text);
  std::array<double, axis_count> words{};
  for (std::string line; std::getline(lines, line);) {
    bool moves = false;
    for (std::size_t k = 0; k < axis_count; ++k) {
      const std::size_t at = line.find(letters[k]);
      if (at == std::string::npos) continue;
      words[k] = std::strtod(line.c_str() + at + 1, nullptr) * (k < 3 ? 1.0 : rad_per_deg);
      moves = true;
    }
    if (moves) out.push_back(words);
  }
  return out;
}

CompensationOptions fine() {
  CompensationOptions options;
  options.decimals = options.angle_decimals = 12;
  return options;
}

/// A machine of which some parts are turned into those of a program: mode, zeros.
struct Case {
  Case(const Layout& layout, std::uint64_t seed) : draw(seed), machine(draw.machine(layout)) {
    for (double& zero : machine.work_offsets[0]->zero) zero = draw.between(-1.0, 1.0);
    errors = draw.errors(machine, 0.02, 2e-4);
    setting = first_setting(machine);
  }
  Vector3 nominal_tip(const AxisPositions& q) const {
    return tip_of(ChainMatrices{machine, none}.tool_in_part(q, setting));
  }

  /// The axes to which a control takes a tip, by the nominal tip's being linear in X Y Z.
  AxisPositions axes_of_tip(const std::array<double, axis_count>& words) const {
    AxisPositions q{};
    for (std::size_t k = 3; k < axis_count; ++k)
      if (machine.find(static_cast<AxisName>(k)) != nullptr)
        q[k] = words[k] + machine.work_offsets[0]->zero[k];
    for (int round = 0; round < 2; ++round) {
      const Vector3 at = nominal_tip(q);
      double J[3][3], r[3];
      for (std::size_t k = 0; k < 3; ++k) {
        AxisPositions one = q;
        one[k] += 1.0;
        const Vector3 there = nominal_tip(one);
        for (std::size_t i = 0; i < 3; ++i) J[i][k] = there[i] - at[i];
        r[k] = words[k] - at[k];
      }
      const auto det = [](const double(&m)[3][3]) {
        return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
      };
      const double whole = det(J);
      for (std::size_t k = 0; k < 3; ++k) {
        double Jk[3][3];
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j) Jk[i][j] = j == k ? r[i] : J[i][j];
        q[k] += det(Jk) / whole;
      }
    }
    return q;
  }

  Draw draw;
  Machine machine;
  ErrorModel errors, none;
  Setting setting;
};

std::set<std::size_t> singular_lines(const ProgramCompensation& result) {
  std::set<std::size_t> lines;
  for (const SingularBlock& one : result.singular) lines.insert(one.line);
  return lines;
}

void expect_where_it_shall_be(const Case& one, const std::vector<AxisPositions>& commanded,
                              const std::vector<AxisPositions>& written,
                              const ProgramCompensation& result) {
  ASSERT_EQ(written.size(), commanded.size());
  const ChainMatrices nominal{one.machine, one.none}, with_errors{one.machine, one.errors};
  const std::set<std::size_t> singular = singular_lines(result);
  double largest = 0.0;
  for (std::size_t i = 0; i < commanded.size(); ++i) {
    const Matrix4 target = nominal.tool_in_part(commanded[i], one.setting);
    const Matrix4 actual = with_errors.tool_in_part(written[i], one.setting);
    const double tip = distance(tip_of(actual), tip_of(target));
    largest = std::max(largest, tip);
    EXPECT_LT(tip, 1e-9) << one.machine.chain << literal(commanded[i]);
    if (one.machine.rotary_count() != 2 || singular.contains(i + 2)) continue;
    EXPECT_LT(distance(turned(actual, one.machine.tool.direction),
                       turned(target, one.machine.tool.direction)),
              1e-9)
        << one.machine.chain << literal(commanded[i]);
  }
  EXPECT_NEAR(result.after.position.value, largest, 3e-11);  // rounding of both, at 2 m
}

/// Layouts whose linear axes span space: on others a tip cannot be put anywhere.
std::vector<Layout> spatial() {
  std::vector<Layout> out;
  std::ranges::copy_if(layouts(), std::back_inserter(out),
                       [](const Layout& layout) { return std::string(layout.name) != "lathe"; });
  return out;
}

// Twelve decimals at 2 m are 2e-12 mm, the model's rounding as much; asked for are 1e-9 mm and rad.
TEST(CompensateProgramLaw, AxesPutTheToolWhereItShallBe) {
  std::printf("seeds 1 to %d\n", static_cast<int>(seeds));
  for (const Layout& layout : spatial()) {
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      Case one(layout, seed);
      const bool with_length = seed % 2 == 0;
      const double along = seed % 4 == 0 ? 1.0 : -1.0;
      for (MachineAxis& axis : one.machine.axes)
        if (axis.name == AxisName::Z) axis.direction = {0.0, 0.0, along};
      AxisPositions shift = one.machine.work_offsets[0]->zero;
      if (with_length) shift[2] += along * one.machine.tool.length_mm;
      std::string text = with_length ? "G43 H1\n" : "(axes)\n";
      std::vector<AxisPositions> commanded;
      for (int i = 0; i < 20; ++i) {
        commanded.push_back(one.draw.positions(one.machine));
        AxisPositions words{};
        for (std::size_t k = 0; k < axis_count; ++k) words[k] = commanded.back()[k] - shift[k];
        text += block(one.machine, words);
      }
      const auto result =
          compensate_program(MachineModel(one.machine, one.errors), text, "p.nc", fine());
      ASSERT_TRUE(result.unreachable.empty()) << layout.name << result.unreachable.front().why;
      std::vector<AxisPositions> written = words_of(result.text);
      for (AxisPositions& q : written)
        for (std::size_t k = 0; k < axis_count; ++k)
          if (one.machine.find(static_cast<AxisName>(k)) != nullptr) q[k] += shift[k];
      expect_where_it_shall_be(one, commanded, written, result);
    }
  }
}

TEST(CompensateProgramLaw, TipsPutTheToolWhereItShallBe) {
  for (const Layout& layout : spatial()) {
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      Case one(layout, 100 + seed);
      if (seed % 2 == 0) one.machine.mode = ProgramMode::tip;
      std::string text = seed % 2 == 0 ? "(tip)\n" : "G43.4 H1\n";
      const AxisPositions& zero = one.machine.work_offsets[0]->zero;
      std::vector<AxisPositions> commanded;
      for (int i = 0; i < 20; ++i) {
        AxisPositions words = one.draw.positions(one.machine);
        const Vector3 tip = one.nominal_tip(words);
        for (std::size_t k = 3; k < axis_count; ++k) words[k] -= zero[k];
        std::ranges::copy(tip, words.begin());
        text += block(one.machine, words);
        commanded.push_back(one.axes_of_tip(words_of(block(one.machine, words)).front()));
      }
      const auto result =
          compensate_program(MachineModel(one.machine, one.errors), text, "p.nc", fine());
      ASSERT_TRUE(result.unreachable.empty()) << layout.name << result.unreachable.front().why;
      std::vector<AxisPositions> written;
      for (const auto& words : words_of(result.text)) written.push_back(one.axes_of_tip(words));
      expect_where_it_shall_be(one, commanded, written, result);
    }
  }
}

TEST(CompensateProgramLaw, WithoutErrorsNothingChanges) {
  for (const Layout& layout : layouts()) {
    Case one(layout, 5);
    std::string text;
    for (int i = 0; i < 20; ++i) text += block(one.machine, one.draw.positions(one.machine));
    const auto result = compensate_program(MachineModel(one.machine), text, "p.nc", {});
    EXPECT_EQ(result.text, text) << layout.name;
    EXPECT_EQ(result.blocks_rewritten, 0u);
    EXPECT_EQ(result.before.position.value, 0.0);
  }
}

/// Where a tip is, a part of the way along a block, in `axes`: every axis goes evenly.
Vector3 on_the_way(const Case& one, const AxisPositions& from, const AxisPositions& to, double s) {
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

// The tip is asked at 40 points of every piece; between the quarters that the command looks at an
// even curve rises by at most a third of a percent, a curve of the third degree by 3 %.
TEST(CompensateProgramLaw, PiecesStayWithinTheTolerance) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    Case one(layouts()[0], seed);
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
    double largest = 0.0;
    for (std::size_t i = 1; i < written.size(); ++i)
      for (int j = 0; j <= 40; ++j)
        largest = std::max(
            largest, from_line(on_the_way(one, written[i - 1], written[i], j / 40.0), start, end));
    EXPECT_LT(largest, 1.03 * 0.01) << "seed " << seed;
    EXPECT_LE(result.between_after.value, 0.01);
    EXPECT_GT(result.blocks_inserted, 0u);
    // An even curve that leaves d in one piece leaves d / n² in n.
    const double asked = std::sqrt(whole.between_after.value / 0.01);
    EXPECT_LE(static_cast<double>(result.blocks_inserted + 1), std::ceil(1.3 * asked)) << seed;
  }
}

// A block of half a turn, on which the curvature is anything but even.
TEST(CompensateProgramLaw, PiecesOfLongBlocksStayWithinTheTolerance) {
  for (const std::uint64_t seed : {11, 12, 13, 14, 15, 16}) {
    Case one(layouts()[seed % 2], seed);
    one.machine.work_offsets[0]->zero = {};
    const AxisPositions a = one.draw.positions(one.machine), b = one.draw.positions(one.machine);
    CompensationOptions options = fine();
    options.tolerance_mm = 0.2;
    const auto result =
        compensate_program(MachineModel(one.machine, one.errors),
                           block(one.machine, a) + block(one.machine, b), "p.nc", options);
    ASSERT_TRUE(result.unreachable.empty()) << result.unreachable.front().why;
    const std::vector<AxisPositions> written = words_of(result.text);
    const Vector3 start = one.nominal_tip(a), end = one.nominal_tip(b);
    double largest = 0.0;
    for (std::size_t i = 1; i < written.size(); ++i)
      for (int j = 0; j <= 40; ++j)
        largest = std::max(
            largest, from_line(on_the_way(one, written[i - 1], written[i], j / 40.0), start, end));
    EXPECT_LT(largest, 1.03 * 0.2) << "seed " << seed;
    EXPECT_GT(result.blocks_inserted, 10u);
  }
}

TEST(CompensateProgramLaw, PiecesUnderInverseTimeTakeTheSameTime) {
  Case one(layouts()[0], 1);
  const AxisPositions a = one.draw.positions(one.machine);
  AxisPositions b = a;
  b[0] += 30.0, b[5] += 0.5;
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

TEST(CompensateProgramLaw, EachErrorAloneIsThatOfAMachineWithItOnly) {
  for (const Layout& layout : layouts()) {
    Case one(layout, 9);
    std::vector<AxisPositions> commanded;
    std::string text;
    for (int i = 0; i < 10; ++i) {
      commanded.push_back(one.draw.positions(one.machine));
      text += block(one.machine, commanded.back());
    }
    one.machine.work_offsets[0]->zero = {};
    commanded = words_of(text);
    for (ErrorTerm& term : one.errors.terms) term.u = term.name.angular() ? 1e-5 : 1e-3;
    const auto result =
        compensate_program(MachineModel(one.machine, one.errors), text, "p.nc", fine());
    std::set<std::string> names;
    for (const ErrorAlone& alone : result.by_error) {
      EXPECT_TRUE(names.insert(alone.name).second);
      ErrorModel errors = one.errors;
      std::erase_if(errors.terms,
                    [&](const ErrorTerm& term) { return to_string(term.name) != alone.name; });
      double largest = 0.0;
      for (const AxisPositions& q : commanded)
        largest = std::max(
            largest,
            distance(tip_of(ChainMatrices{one.machine, errors}.tool_in_part(q, one.setting)),
                     one.nominal_tip(q)));
      EXPECT_NEAR(alone.tip.value, largest, 1e-11) << layout.name << ' ' << alone.name;
    }
    for (const ErrorTerm& term : one.errors.terms)
      EXPECT_TRUE(names.contains(to_string(term.name)));
    // u of the tip: every term by its own u, squares added, at the position where it is largest.
    double largest = 0.0;
    for (const AxisPositions& q : commanded) {
      double square = 0.0;
      for (const ErrorTerm& term : one.errors.terms) {
        ErrorModel only = one.errors;
        only.terms = {{term.name, ConstantError{term.u}, 0.0}};
        square +=
            std::pow(distance(tip_of(ChainMatrices{one.machine, only}.tool_in_part(q, one.setting)),
                              one.nominal_tip(q)),
                     2);
      }
      largest = std::max(largest, std::sqrt(square));
    }
    ASSERT_TRUE(result.u_tip);
    EXPECT_NEAR(result.u_tip->value, largest, 1e-9) << layout.name;
  }
}

TEST(CompensateProgramLaw, TheSameBytesOnAnyNumberOfThreads) {
  Case one(layouts()[0], 3);
  std::string text;
  for (int i = 0; i < 3000; ++i) text += block(one.machine, one.draw.positions(one.machine));
  const MachineModel model(one.machine, one.errors);
  CompensationOptions options;
  options.threads = 1;
  const auto alone = compensate_program(model, text, "p.nc", options);
  for (const int threads : {2, 5}) {
    options.threads = threads;
    const auto together = compensate_program(model, text, "p.nc", options);
    EXPECT_EQ(together.text, alone.text);
    EXPECT_EQ(together.before.position.line, alone.before.position.line);
    EXPECT_EQ(together.between_after.value, alone.between_after.value);
    EXPECT_EQ(together.by_error.size(), alone.by_error.size());
    for (std::size_t i = 0; i < alone.by_error.size(); ++i)
      EXPECT_EQ(together.by_error[i].name, alone.by_error[i].name);
  }
}

TEST(CompensateProgramLaw, TheDifferentialMethodLeavesAQuarterOfHalvedErrors) {
  Case one(layouts()[0], 4);
  std::string text;
  for (int i = 0; i < 50; ++i) {
    AxisPositions words = one.draw.positions(one.machine);
    words[3] = one.draw.between(0.4, 1.2) - one.machine.work_offsets[0]->zero[3];  // off the pole
    text += block(one.machine, words);
  }
  CompensationOptions options = fine();
  options.method = CompensationMethod::differential;
  const auto left = [&](double factor) {
    Case scaled(layouts()[0], 4);
    for (ErrorTerm& term : scaled.errors.terms)
      std::visit(
          [&](auto& f) {
            using F = std::decay_t<decltype(f)>;
            if constexpr (std::is_same_v<F, ConstantError>) f.value *= factor;
            if constexpr (std::is_same_v<F, PolynomialError>)
              for (double& c : f.coefficients) c *= factor;
            if constexpr (std::is_same_v<F, FourierError>)
              for (auto& t : f.terms) t.cos *= factor, t.sin *= factor;
            if constexpr (std::is_same_v<F, TableError>)
              for (double& v : f.values) v *= factor;
          },
          term.function);
    return compensate_program(MachineModel(one.machine, scaled.errors), text, "p.nc", options)
        .after.position.value;
  };
  // What is left is of the second order; the third order is below the size of the errors, 1e-3.
  EXPECT_NEAR(left(1.0) / left(0.5), 4.0, 0.05);
}

}  // namespace
}  // namespace trueaxis::testing
