// SPDX-License-Identifier: Apache-2.0
#include "blind/bench.hpp"

#include <functional>
#include <numeric>
#include <optional>
#include <utility>

namespace trueaxis::blind {
namespace {

using virtual_lathe::Chucking;
using virtual_lathe::Part;
using virtual_lathe::Scenario;

// A chucking that does not move the part shares its axis: x0 … m of the part itself.
bool has_own_axis(const Chucking& setup) { return setup.x0_mm.has_value(); }

struct Placement {
  std::optional<double> Chucking::*own;
  double Part::*first;
  double step;
};

constexpr double length_step_mm = 1e-3, angle_step = 1e-5;

const Placement placements[] = {{&Chucking::x0_mm, &Part::x0_mm, length_step_mm},
                                {&Chucking::y0_mm, &Part::y0_mm, length_step_mm},
                                {&Chucking::l, &Part::l, angle_step},
                                {&Chucking::m, &Part::m, angle_step}};

Scenario quiet(Scenario scenario) {
  scenario.noise = {};
  scenario.effects.clear();
  return scenario;
}

}  // namespace

Bench::Bench(Scenario scenario, std::vector<std::size_t> rows)
    : scenario_(quiet(std::move(scenario))), rows_(std::move(rows)), surface_(0) {
  const virtual_lathe::Simulation made = virtual_lathe::simulate_with_truth(scenario_);
  if (rows_.empty()) {
    rows_.resize(made.stream.size());
    std::iota(rows_.begin(), rows_.end(), std::size_t{0});
  }
  plain_ = kept(made.truth.clean_mm);
  c_ = kept(made.stream.c_rad);
  z_ = kept(made.stream.position_mm);
  t_ = kept(made.stream.time_s);
  for (const std::size_t row : rows_) {
    pass_.push_back(made.stream.pass[row]);
    setup_.push_back(made.stream.setup[row]);
  }
  surface_ = Subspace(surface_columns());
}

Eigen::VectorXd Bench::kept(const std::vector<double>& column) const {
  Eigen::VectorXd out(static_cast<Eigen::Index>(rows_.size()));
  for (Eigen::Index i = 0; i < out.size(); ++i) out[i] = column[rows_[static_cast<std::size_t>(i)]];
  return out;
}

Eigen::VectorXd Bench::clean(const std::vector<virtual_lathe::Effect>& effects) const {
  Scenario scenario = scenario_;
  scenario.effects = effects;
  return kept(virtual_lathe::simulate_with_truth(scenario).truth.clean_mm);
}

Eigen::MatrixXd Bench::surface_columns() const {
  std::vector<Eigen::VectorXd> columns;
  const auto differ = [&](double step, const std::function<void(Scenario&, double)>& move) {
    Eigen::VectorXd readings[2];
    for (const int side : {0, 1}) {
      Scenario moved = scenario_;
      move(moved, side == 0 ? step : -step);
      readings[side] = kept(virtual_lathe::simulate_with_truth(moved).truth.clean_mm);
    }
    columns.push_back((readings[0] - readings[1]) / (2.0 * step));
  };
  for (const Placement& at : placements) {
    differ(at.step, [&](Scenario& s, double by) { s.part.*at.first += by; });
    for (std::size_t k = 0; k < scenario_.plan.setups.size(); ++k) {
      if (!has_own_axis(scenario_.plan.setups[k])) continue;
      differ(at.step, [&](Scenario& s, double by) {
        std::optional<double>& own = s.plan.setups[k].*at.own;
        own = *own + by;
      });
    }
  }
  differ(length_step_mm, [](Scenario& s, double by) { s.part.radius_mm += by; });
  if (scenario_.part.kind == virtual_lathe::PartKind::cone) {
    differ(angle_step, [](Scenario& s, double by) { s.part.half_angle_rad += by; });
  }
  Eigen::MatrixXd all(size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t j = 0; j < columns.size(); ++j)
    all.col(static_cast<Eigen::Index>(j)) = columns[j];
  return all;
}

}  // namespace trueaxis::blind
