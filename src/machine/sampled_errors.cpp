// SPDX-License-Identifier: Apache-2.0
#include "machine/sampled_errors.hpp"

#include <algorithm>
#include <cmath>

#include "machine/algebra.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

struct Needs {
  std::vector<double> positions;
  bool any = false, smooth = false;
};

bool is_limited(const MachineAxis& axis) {
  return std::isfinite(axis.low) && std::isfinite(axis.high);
}

Needs needs_of(const ErrorModel& errors, const MachineAxis& of) {
  Needs needs;
  const std::size_t axis = index_of(of.name);
  for (const ErrorTerm& term : errors.terms) {
    if (!term.name.component || term.name.body != axis) continue;
    needs.any = true;
    const auto* table = std::get_if<TableError>(&term.function);
    // A turn that is written from 0 to 360° keeps the places of its table.
    if (table != nullptr &&
        (!table->periodic || (!is_limited(of) && std::abs(table->at.front()) < 1e-9)))
      needs.positions.insert(needs.positions.end(), table->at.begin(), table->at.end());
    else if (!std::holds_alternative<ConstantError>(term.function))
      needs.smooth = true;
  }
  return needs;
}

std::vector<double> positions_of(const MachineAxis& axis, Needs needs, int points) {
  double low = axis.low, high = axis.high;
  const bool limited = is_limited(axis);
  if (!limited && is_rotary(axis.name)) low = 0.0, high = two_pi;
  if (needs.smooth && !limited && !is_rotary(axis.name))
    throw InputError("machine", std::string("axis ") + letter_of(axis.name) +
                                    " needs limits_mm: its errors are not tables and are written "
                                    "as a table over its travel");
  for (int i = 0; needs.smooth && i < points; ++i)
    needs.positions.push_back(i + 1 == points ? high : low + (high - low) * i / (points - 1));
  if (needs.positions.empty()) needs.positions = {0.0, 1.0};
  std::ranges::sort(needs.positions);
  const auto twice = std::ranges::unique(needs.positions);
  needs.positions.erase(twice.begin(), twice.end());
  return needs.positions;
}

/// The translation and rotation vector of E⁻¹ for E = Tr(t) exp(r).
void invert(std::array<double, 6>& e) {
  const Eigen::Vector3d t(e[0], e[1], e[2]), r(e[3], e[4], e[5]);
  const Eigen::Vector3d inverse = -(rigid::exponential(r).transpose() * t);
  for (std::size_t i = 0; i < 3; ++i) {
    e[i] = inverse[static_cast<Eigen::Index>(i)];
    e[i + 3] = -e[i + 3];
  }
}

}  // namespace

SamplingLoss sampling_loss(const Machine& machine, const ErrorModel& errors, ErrorSign sign,
                           int points) {
  const auto table = sample_components(machine, errors, sign, points);
  const auto fine = sample_components(machine, errors, sign, 16 * (points - 1) + 1);
  SamplingLoss loss;
  for (std::size_t a = 0; a < fine.size(); ++a)
    for (std::size_t d = 0; d < 6; ++d) {
      if (fine[a].values[d].empty()) continue;
      const std::vector<double>& written = table[a].values[d];
      const TableError linear{
          table[a].positions,
          written.empty() ? std::vector(table[a].positions.size(), 0.0) : written, false};
      double& most = d < 3 ? loss.length_mm : loss.angle_rad;
      for (std::size_t i = 0; i < fine[a].positions.size(); ++i)
        most =
            std::max(most, std::abs(fine[a].values[d][i] - value_at(linear, fine[a].positions[i])));
    }
  return loss;
}

double location_value(const ErrorModel& errors, const ErrorName& name) {
  return errors.value(name, AxisPositions{});
}

std::vector<SampledErrors> sample_components(const Machine& machine, const ErrorModel& errors,
                                             ErrorSign sign, int points) {
  expects(points >= 2, "two points or more");
  std::vector<SampledErrors> all;
  for (std::size_t k = 0; k < axis_count; ++k) {
    const MachineAxis* axis = machine.find(static_cast<AxisName>(k));
    if (axis == nullptr) continue;
    const Needs needs = needs_of(errors, *axis);
    if (!needs.any) continue;
    SampledErrors one{axis->name, positions_of(*axis, needs, points), {}};
    const bool inverted = axis->carries_workpiece && sign != errors.sign;
    for (const double position : one.positions) {
      AxisPositions axes{};
      axes[k] = position;
      std::array<double, 6> e{};
      for (std::size_t d = 0; d < 6; ++d) e[d] = errors.value({true, d, k}, axes);
      if (inverted) invert(e);
      for (std::size_t d = 0; d < 6; ++d) one.values[d].push_back(e[d]);
    }
    for (auto& values : one.values)
      if (std::ranges::all_of(values, [](double value) { return value == 0.0; })) values.clear();
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace trueaxis
