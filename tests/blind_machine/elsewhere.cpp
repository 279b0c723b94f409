// SPDX-License-Identifier: Apache-2.0
#include "blind_machine/elsewhere.hpp"

#include <Eigen/Core>
#include <cmath>
#include <random>

#include "blind_machine/catalogue.hpp"
#include "support/dense.hpp"

namespace trueaxis::blind_machine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double error_elsewhere_mm(const Case& one, const ErrorModel& predicted) {
  std::mt19937_64 engine(one.wanted.seed + 77);
  const auto between = [&](double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<>(0.0, 1.0)(engine);
  };
  const Machine& machine = one.layout->machine;
  Plan plan{"elsewhere", false, 1.0, {}};
  Vector3 centre = one.plan.visits.front().centre_mm;
  for (double& x : centre) x += between(-30.0, 30.0);
  for (int i = 0; i < 120; ++i) {
    Visit visit{1, centre, one.plan.visits.front().tool_mm, {}, 0.0};
    for (const AxisName axis : {one.layout->first, one.layout->round}) {
      const auto [low, high] = range_of(one.plan, axis);
      visit.axes[index_of(axis)] = between(low, high);
    }
    visit.axes = following(machine, visit, {});
    plan.visits.push_back(visit);
  }
  Fault truth{one.fault.errors, {}, {}, 1.0, {}, 0, one.fault.of_visit};
  const Fault said{predicted, {}, {}, 1.0, {}, 0, nullptr};
  const auto read = [&](const Plan& of, const Fault& fault) {
    const auto list = readings(machine, of, fault);
    return VectorXd(Eigen::Map<const VectorXd>(list.data(), static_cast<Index>(list.size())));
  };
  const VectorXd apart = read(plan, truth) - read(plan, said), nominal = read(plan, {});
  MatrixXd place(apart.size(), 3);
  for (Index k = 0; k < 3; ++k) {
    Plan moved = plan;
    for (Visit& visit : moved.visits) visit.centre_mm[static_cast<std::size_t>(k)] += 1.0;
    place.col(k) = read(moved, {}) - nominal;
  }
  const VectorXd left = dense::residuals(place, apart);
  return std::sqrt(left.squaredNorm() / static_cast<double>(plan.visits.size()));
}

}  // namespace trueaxis::blind_machine
