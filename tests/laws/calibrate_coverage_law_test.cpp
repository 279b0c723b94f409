// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <iostream>

#include "calibrate/estimate/tip_fit.hpp"
#include "machine/uncertainty.hpp"
#include "support/shop_machine.hpp"

namespace trueaxis::testing {
namespace {

/// How often something was inside, one draw a machine (independent) and all together.
struct Coverage {
  int inside = 0, draws = 0;
  double all_inside = 0.0, all = 0.0;
  double square = 0.0, u_square = 0.0;  ///< of errors and of u

  void take(const std::vector<double>& error, const std::vector<double>& u, Draw& draw) {
    const auto chosen = static_cast<std::size_t>(draw.whole(0, static_cast<int>(u.size()) - 1));
    inside += std::abs(error[chosen]) <= 2.0 * u[chosen] ? 1 : 0;
    ++draws;
    for (std::size_t i = 0; i < u.size(); ++i) {
      all_inside += std::abs(error[i]) <= 2.0 * u[i] ? 1.0 : 0.0;
      all += 1.0;
      square += error[i] * error[i];
      u_square += u[i] * u[i];
    }
  }
  /// Of 99.9 %: Clopper and Pearson.
  double low() const {
    return boost::math::binomial_distribution<>::find_lower_bound_on_p(draws, inside, 5e-4);
  }
  double high() const {
    return boost::math::binomial_distribution<>::find_upper_bound_on_p(draws, inside, 5e-4);
  }
  double u_over_error() const { return std::sqrt(u_square / square); }
  void print(const char* what) const {
    std::cout << what << ": " << inside << " of " << draws << " inside U (99.9 %: " << low()
              << " to " << high() << "), of all " << all_inside / all << ", u over RMS error "
              << u_over_error() << '\n';
  }
};

struct Study {
  Coverage lengths, angles, tips;
  double square_none = 0.0, square_all = 0.0;
  double spread = 0.0;  ///< of the sizes of a machine's errors: the factor of a standard deviation

  void machine(const char* chain, bool bar, double size, std::uint64_t seed) {
    Draw draw(seed);
    const Machine machine = shop_machine(chain, draw);
    const auto plan = shop_plan(machine, bar, 1e-3, draw);
    // u holds given what is held, which these positions say: the machine has nothing there.
    std::vector<std::string> held;
    const MachineMeasurement ideal = measured(machine, {}, plan);
    Calibration geometry;
    calibrate_detail::fit_tips(machine, std::span(&ideal, 1), {}, true, geometry);
    for (const NotDetermined& one : geometry.not_determined) held.push_back(one.members.front());
    const ErrorModel truth = shop_errors(machine, size, held, draw, spread);
    const MachineMeasurement data = measured(machine, truth, plan);
    const Calibration found = calibrate(machine, std::span(&data, 1));
    ASSERT_TRUE(found.converged);
    std::vector<double> error[2], u[2];
    for (const CalibratedParameter& one : found.parameters) {
      const ErrorName name = *parse_error_name(one.name);
      const std::size_t angle = name.angular() ? 1 : 0;
      error[angle].push_back(one.estimate.value - truth.value(name, {}));
      u[angle].push_back(one.estimate.u);
      EXPECT_GE(one.estimate.u, 0.999 * one.u_noise) << one.name;
    }
    lengths.take(error[0], u[0], draw);
    angles.take(error[1], u[1], draw);
    predict(machine, truth, found, draw);
  }

  /// Tips at positions that were not measured.
  void predict(const Machine& machine, const ErrorModel& truth, const Calibration& found,
               Draw& draw) {
    const MachineModel model(machine, found.errors), nominal(machine);
    const TipUncertainty uncertainty(model);
    Setting setting;
    setting.tool_length_mm = 120.0;
    virtual_machine::MeasurementPlan elsewhere;
    elsewhere.tool_length_mm = 120.0;
    elsewhere.balls_mm = {draw.vector(120.0)};
    for (int i = 0; i < 10; ++i) {
      AxisPositions at{};
      for (const MachineAxis& axis : machine.axes)
        if (is_rotary(axis.name))
          at[index_of(axis.name)] = axis.name == AxisName::C
                                        ? draw.between(0.0, two_pi)
                                        : draw.between(-80.0, 30.0) * rad_per_deg;
      elsewhere.positions.push_back(at);
    }
    std::vector<double> error, u;
    for (const auto& row : virtual_machine::measure(machine, {}, elsewhere)) {
      const Vector3 real = true_tip(machine, truth, row.axes, 120.0),
                    said = model.actual(row.axes, setting).tip_mm,
                    ideal = nominal.nominal(row.axes, setting).tip_mm;
      const Matrix3 covariance = uncertainty.covariance_mm2(row.axes, setting);
      for (std::size_t i = 0; i < 3; ++i) {
        error.push_back(said[i] - real[i]);
        u.push_back(std::sqrt(covariance[i][i]));
        square_none += std::pow(ideal[i] - real[i], 2);
        square_all += std::pow(said[i] - real[i], 2);
      }
    }
    tips.take(error, u, draw);
  }

  void print(const char* what) const {
    std::cout << what << '\n';
    lengths.print("  location errors, lengths");
    angles.print("  location errors, angles");
    tips.print("  tips elsewhere, coordinates");
    std::cout << "  tips elsewhere: RMS " << 1e3 * std::sqrt(square_none / tips.all)
              << " um without, " << 1e3 * std::sqrt(square_all / tips.all) << " um with\n";
  }
};

constexpr const char* chains[] = {"w C' A' Y' b X Z t", "w C' B' b X Y Z t", "w C' b X Y Z B t",
                                  "w X' b Y Z C A t", "w C' A' X' Z' b Y t"};

Study study_of(double size, int each, double spread = 0.0) {
  Study study;
  study.spread = spread;
  std::uint64_t seed = 100;
  for (const char* chain : chains)
    for (int i = 0; i < each; ++i) study.machine(chain, i % 2 == 1, size, ++seed);
  return study;
}

// One number of a machine is drawn, so that draws are independent and inside with a probability of
// 95 % or more. The upper end of the exact binomial interval of 99.9 % falls below 95 % once in
// 2000. The u is not needlessly large where it stays below twice the error that there is.
TEST(CalibrateCoverage, CountsComponentErrorsThatNobodyFits) {
  const Study study = study_of(1.0, 16);
  study.print("component errors of 1-6 um, 5-30 urad");
  for (const Coverage* one : {&study.lengths, &study.angles, &study.tips}) {
    EXPECT_GE(one->high(), 0.95);
    EXPECT_GE(one->all_inside / one->all, 0.93);
    EXPECT_LT(one->u_over_error(), 2.0);
    EXPECT_GT(one->u_over_error(), 0.9);
  }
}

// A size that the readings leave open may be larger than the most probable one. Sizes of errors
// spread by the factor 2 that the prior has: 95.4 % of all are inside, with a standard deviation of
// 1 % of some 880 that hang together in 80 machines. At the most probable sizes 93.1 % were.
TEST(CalibrateCoverage, CountsThatTheSizesAreNotKnown) {
  const Study study = study_of(1.0, 16, 2.0);
  study.print("sizes that spread by a factor of 2");
  const double inside = study.lengths.all_inside + study.angles.all_inside;
  EXPECT_GE(inside / (study.lengths.all + study.angles.all), 0.94);
}

// A machine four times as good is seen to be so, and u with it.
TEST(CalibrateCoverage, FollowsTheSizeThatTheDataShow) {
  const Study fine = study_of(0.25, 8), none = study_of(0.0, 6);
  fine.print("a quarter of that");
  none.print("no component errors");
  for (const Study* study : {&fine, &none})
    for (const Coverage* one : {&study->lengths, &study->angles, &study->tips}) {
      EXPECT_GE(one->high(), 0.95);
      EXPECT_LT(one->u_over_error(), 2.5);
    }
  EXPECT_LT(none.tips.u_square / none.tips.all, 0.1 * fine.tips.u_square / fine.tips.all);
}

/// Errors of C alone, amounts of orders 1 to 4 as Eq. 210 has them. Sizes are twice the plausible
/// ones, by a factor of 2 from each other, the same along X and Y.
ErrorModel errors_of_c(Draw& draw) {
  ErrorModel errors;
  std::normal_distribution<double> normal;
  constexpr double squares = 1.0 + 1.0 / 4.0 + 1.0 / 9.0 + 1.0 / 16.0;
  for (const bool angular : {false, true}) {
    const double rms = (angular ? 24e-6 : 4e-3) * std::pow(2.0, normal(draw.engine));
    for (const std::size_t direction : {0, 1}) {
      FourierError fourier;
      for (int n = 1; n <= 4; ++n)
        fourier.terms.push_back({static_cast<double>(n),
                                 normal(draw.engine) * rms / (n * std::sqrt(squares)),
                                 normal(draw.engine) * rms / (n * std::sqrt(squares))});
      errors.terms.push_back(
          {{true, direction + (angular ? 3 : 0), index_of(AxisName::C)}, fourier, 0.0});
    }
  }
  return errors;
}

// On a head, a line of C that is off and order 1 of EXC and EYC read alike. So do its tilt and
// order 1 of EAC and EBC. U of the four thus rests on the sizes of these errors. Two numbers of a
// machine are drawn: fewer than 95 % are within U with a probability of 1 in 2000 (binomial).
TEST(CalibrateCoverage, CountsOrderOneOfAHeadThatActsLikeItsLine) {
  constexpr int machines = 120;
  int inside = 0;
  for (int i = 0; i < machines; ++i) {
    Draw draw(static_cast<std::uint64_t>(7000 + i));
    const Machine machine = shop_machine("w X' Y' b Z C B t", draw);
    auto plan = shop_plan(machine, false, 1e-3, draw);
    const ErrorModel truth = errors_of_c(draw);
    std::vector<MachineMeasurement> data;
    for (const double length : {120.0, 190.0}) {
      plan.tool_length_mm = length;
      ++plan.seed;
      data.push_back(measured(machine, truth, plan));
    }
    const Calibration found = calibrate(machine, data);
    const bool along_x = draw.whole(0, 1) == 0;
    for (const CalibratedParameter& one : found.parameters)
      if (one.name == (along_x ? "X0C" : "Y0C") || one.name == (along_x ? "B0C" : "A0C"))
        inside += std::abs(one.estimate.value) <= 2.0 * one.estimate.u ? 1 : 0;
  }
  const double high =
      boost::math::binomial_distribution<>::find_upper_bound_on_p(2 * machines, inside, 5e-4);
  std::cout << "line of a head: " << inside << " of " << 2 * machines << " inside U (at most "
            << high << ")\n";
  EXPECT_GE(high, 0.95);
}

}  // namespace
}  // namespace trueaxis::testing
