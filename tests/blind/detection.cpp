// SPDX-License-Identifier: Apache-2.0
#include "blind/detection.hpp"

#include <algorithm>
#include <boost/math/distributions/non_central_f.hpp>

namespace trueaxis::blind {
namespace {

const char* const cause = "part.roundness";

bool found(const Answer& answer) {
  return std::ranges::any_of(answer.classes, [](const std::vector<std::string>& members) {
    return std::ranges::find(members, cause) != members.end();
  });
}

}  // namespace

double power(double threshold, double lambda, double readings, double parameters) {
  if (!(threshold > 0.0)) return 0.0;
  const boost::math::non_central_f_distribution<> f(2.0, readings - parameters - 2.0, lambda);
  return cdf(complement(f, threshold / 2.0));
}

std::vector<DetectionPoint> detection_curve(const std::vector<double>& lambdas,
                                            std::size_t cases_each, std::uint64_t seed,
                                            const StudyOptions& options) {
  Selection selection;
  selection.kinds = {Kind::one};
  selection.plans = {PlanId::p1};
  selection.surfaces = {SurfaceId::cone};
  selection.cases = cases_each * lambdas.size();
  selection.seed = seed;
  std::vector<Wanted> wanted = select(selection);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    wanted[i].lambda = lambdas[i / cases_each];
    wanted[i].effect = Effect{cause,
                              {{"order", 3.0},
                               {"amplitude_mm", 1e-3},
                               {"growth_mm", 0.0},
                               {"phase_rad", 0.1 * static_cast<double>(i)}}};
  }
  const std::vector<Result> results = run_study(wanted, options);
  std::vector<DetectionPoint> curve;
  for (std::size_t k = 0; k < lambdas.size(); ++k) {
    DetectionPoint point;
    point.lambda = lambdas[k];
    for (std::size_t i = k * cases_each; i < (k + 1) * cases_each; ++i) {
      const Result& result = results[i];
      const double readings = static_cast<double>(result.made.bench->size());
      ++point.cases;
      if (found(result.answer)) ++point.found;
      point.threshold += result.answer.threshold;
      point.expected += power(result.answer.threshold, result.made.lambdas.front(), readings, 6.0);
    }
    point.threshold /= static_cast<double>(point.cases);
    point.expected /= static_cast<double>(point.cases);
    curve.push_back(point);
  }
  return curve;
}

}  // namespace trueaxis::blind
