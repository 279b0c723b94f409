// SPDX-License-Identifier: Apache-2.0
// Programs of random machines with random errors, compensated; where the tool then is, is asked of
// matrices that the test multiplies out itself, at the numbers that stand in the new text.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "support/program_case.hpp"

namespace trueaxis::testing {
namespace {

constexpr std::uint64_t seeds = 6;

std::set<std::size_t> singular_lines(const ProgramCompensation& result) {
  std::set<std::size_t> lines;
  for (const SingularBlock& one : result.singular) lines.insert(one.line);
  return lines;
}

void expect_where_it_shall_be(const ProgramCase& one, const std::vector<AxisPositions>& commanded,
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
      ProgramCase one(layout, seed);
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
      ProgramCase one(layout, 100 + seed);
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
    ProgramCase one(layout, 5);
    std::string text;
    for (int i = 0; i < 20; ++i) text += block(one.machine, one.draw.positions(one.machine));
    const auto result = compensate_program(MachineModel(one.machine), text, "p.nc", {});
    EXPECT_EQ(result.text, text) << layout.name;
    EXPECT_EQ(result.blocks_rewritten, 0u);
    EXPECT_EQ(result.before.position.value, 0.0);
  }
}

TEST(CompensateProgramLaw, EachErrorAloneIsThatOfAMachineWithItOnly) {
  for (const Layout& layout : layouts()) {
    ProgramCase one(layout, 9);
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
    // u is summed in single precision: its factor of 6e-8 for each of the terms.
    EXPECT_NEAR(result.u_tip->value, largest,
                6e-8 * static_cast<double>(one.errors.terms.size()) * largest)
        << layout.name;
  }
}

TEST(CompensateProgramLaw, TheSameBytesOnAnyNumberOfThreads) {
  ProgramCase one(layouts()[0], 3);
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
  ProgramCase one(layouts()[0], 4);
  std::string text;
  for (int i = 0; i < 50; ++i) {
    AxisPositions words = one.draw.positions(one.machine);
    words[3] = one.draw.between(0.4, 1.2) - one.machine.work_offsets[0]->zero[3];  // off the pole
    text += block(one.machine, words);
  }
  CompensationOptions options = fine();
  options.method = CompensationMethod::differential;
  const auto left = [&](double factor) {
    ProgramCase scaled(layouts()[0], 4);
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
  // The residual is of the second order; the third order is below the size of the errors, 1e-3.
  EXPECT_NEAR(left(1.0) / left(0.5), 4.0, 0.05);
}

}  // namespace
}  // namespace trueaxis::testing
