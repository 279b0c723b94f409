// SPDX-License-Identifier: Apache-2.0
// A tilt axis that was read at a few angles has an error of which these do not show the form. The
// readings are those of the test's own matrices.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "support/ball_bench.hpp"
#include "trueaxis/machine_diagnosis.hpp"

namespace trueaxis::testing {
namespace {

constexpr int machines = 40;
constexpr double probing_sigma_mm = 1e-3, low_rad = -90.0 * rad_per_deg,
                 high_rad = 30.0 * rad_per_deg;

/// 5 to 40 µm (at 250 mm) as one or two waves a revolution, or as a polynomial of degree 2 or 3
/// over what is read.
ErrorTerm hidden_error(std::size_t tilt, Draw& draw) {
  const auto direction = static_cast<std::size_t>(draw.whole(0, 5));
  const ErrorName name{true, direction, tilt};
  const double size = 5e-3 * std::pow(8.0, draw.between(0.0, 1.0)) * (name.angular() ? 4e-3 : 1.0);
  if (draw.whole(0, 1) == 0) {
    const double order = draw.whole(1, 2), phase = draw.between(0.0, two_pi);
    return {name, FourierError{{{order, size * std::cos(phase), size * std::sin(phase)}}, two_pi}};
  }
  // Legendre's P2 and P3.
  PolynomialError form{
      {-0.5 * size, 0.0, 1.5 * size}, 0.5 * (low_rad + high_rad), 0.5 * (high_rad - low_rad)};
  if (draw.whole(0, 1) == 0) form.coefficients = {0.0, -1.5 * size, 0.0, 2.5 * size};
  return {name, form};
}

/// Without what the plan does not tell, which u presupposes.
ErrorModel location_errors(const Machine& machine, const BallPlan& plan, Draw& draw) {
  ErrorModel errors = drawn_location_errors(machine, draw);
  const ErrorModel none;
  MachineMeasurement ideal = measure_balls({machine, none}, plan, 0.0, draw);
  ideal.noise_mm = probing_sigma_mm;
  for (const NotDetermined& one : calibrate(machine, std::span(&ideal, 1)).not_determined)
    std::erase_if(errors.terms, [&](const ErrorTerm& term) {
      return to_string(term.name) == one.members.front();
    });
  return errors;
}

// E e² = u² of every location error if u counts every form that fits (Eq. 332). All of a machine
// may be off along one direction, so that the mean of e²/u² over n machines has a relative standard
// deviation of sqrt(2/n) at most; the bound is five of these. With the named form alone known the
// mean is above 50.
TEST(TiltFormLaw, TheUncertaintyCountsEveryFormThatFitsFewAngles) {
  double squares = 0.0, inside = 0.0, count = 0.0;
  int named = 0;
  for (int i = 0; i < machines; ++i) {
    Draw draw(7000 + static_cast<std::uint64_t>(i));
    const Machine machine = i % 2 == 0 ? trunnion() : head_and_table();
    BallPlan plan;
    plan.tilt = i % 2 == 0 ? 3 : 4;
    plan.a_deg.clear();
    const int angles = draw.whole(4, 6);
    for (int k = 0; k < angles; ++k)
      plan.a_deg.push_back(std::lerp(low_rad, high_rad, k / (angles - 1.0)) / rad_per_deg);
    ErrorModel truth = location_errors(machine, plan, draw);
    truth.terms.push_back(hidden_error(plan.tilt, draw));
    const MachineMeasurement data = measure_balls({machine, truth}, plan, probing_sigma_mm, draw);
    const MachineDiagnosis found = diagnose_machine(machine, std::span(&data, 1));
    if (found.findings.empty() || !found.unexplained.empty()) continue;
    ++named;
    for (const CalibratedParameter& one : found.extended) {
      const double share =
          (one.estimate.value - truth.value(*parse_error_name(one.name), {})) / one.estimate.u;
      squares += share * share, inside += std::abs(share) <= 2.0 ? 1.0 : 0.0, count += 1.0;
    }
  }
  std::printf("%d named, mean e^2/u^2 %.3f, within U %.3f\n", named, squares / count,
              inside / count);
  ASSERT_GT(named, machines / 2);
  EXPECT_LT(squares / count, 1.0 + 5.0 * std::sqrt(2.0 / named));
}

}  // namespace
}  // namespace trueaxis::testing
