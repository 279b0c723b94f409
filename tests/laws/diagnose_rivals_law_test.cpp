// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <iostream>

#include "study/bound/quantities.hpp"
#include "support/sweep_examples.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis::testing {
namespace {

using namespace virtual_lathe;

constexpr std::uint64_t first_seed = 20261121;

/// One pass over a cone: a sensor that is not linear and a barrel form differ in nothing but what
/// they make of the axis.
Scenario one_pass_over_a_cone(bool barrel) {
  Scenario scenario = probed_part(PartKind::cone);
  scenario.part.x0_mm = 0.2, scenario.part.y0_mm = 0.1;
  scenario.noise.sigma_mm = 0.002;
  scenario.plan.passes[0].readings_per_revolution = 24.3;
  scenario.effects = {
      barrel ? virtual_lathe::Effect{"part.barrel", {{"amplitude_mm", 0.004}}}
             : virtual_lathe::Effect{
                   "probe.nonlinearity",
                   {{"quadratic_mm", 0.005}, {"range_mm", 3.0}, {"reference_mm", 35.5}}}};
  return scenario;
}

double u_from_noise(const FitResult& fit, std::size_t parameter) {
  return fit.budget.front().u[parameter];
}

// Half of the streams have the one cause and half the other, so that whichever is named is wrong in
// many: the noise alone does not cover the errors then, what the rival causes make of the axis
// does.
TEST(DiagnosedRivals, WidenTheUncertaintyOfTheAxis) {
  std::cout << "seeds from " << first_seed << '\n';
  constexpr int streams = 60;
  const std::vector<std::string> names{"x0", "y0", "l", "m", "k", "half_angle"};
  std::vector<int> covered(names.size(), 0), by_noise(names.size(), 0);
  int ambiguous = 0;
  for (int i = 0; i < streams; ++i) {
    Scenario scenario = one_pass_over_a_cone(i % 2 == 0);
    scenario.seed = first_seed + static_cast<std::uint64_t>(i);
    const ProbeStream stream = simulate(scenario);
    DiagnoseOptions options;
    options.fit.surface = SurfaceKind::cone;
    options.threads = 1;
    const FitResult fit = diagnose(stream, options).extended;
    ambiguous += fit.budget.size() > 1 ? 1 : 0;
    const std::vector<double> truth =
        study::true_values(scenario, study::probed_length(stream), SurfaceKind::cone);
    for (std::size_t p = 0; p < names.size(); ++p) {
      const Estimate& inside = fit.parameters[p].estimate;
      const Estimate found = at_edge(inside);
      const double error = std::abs(found.value - truth[p]);
      covered[p] += error <= 2.0 * found.u ? 1 : 0;
      by_noise[p] += error <= 2.0 * edge_factor(inside.unit) * u_from_noise(fit, p) ? 1 : 0;
    }
  }
  EXPECT_GT(ambiguous, streams / 2);
  const double least = quantile(boost::math::binomial(streams, 0.954), 1e-3 / 6.0);
  int too_few = 0;
  for (std::size_t p = 0; p < names.size(); ++p) {
    EXPECT_GE(covered[p], least) << names[p];
    too_few += by_noise[p] < least ? 1 : 0;
    std::cout << names[p] << ": " << covered[p] << " of " << streams << ", by noise alone "
              << by_noise[p] << '\n';
  }
  EXPECT_GT(too_few, 0) << "nothing to widen: the test cannot fail";
}

}  // namespace
}  // namespace trueaxis::testing
