// SPDX-License-Identifier: Apache-2.0
#include "machine/sampled_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "machine/algebra.hpp"
#include "machine/limits.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

bool is_bounded(const PositionRange& range) {
  return std::isfinite(range.low) && std::isfinite(range.high);
}
bool is_turn(const PositionRange& range) { return range.low == 0.0 && range.high == two_pi; }

bool is_whole(double number) { return std::abs(number - std::round(number)) < 1e-9; }

/// Whether an error of a rotary axis is the same after a turn.
struct GoesRound {
  bool operator()(const ConstantError&) const { return true; }
  bool operator()(const PolynomialError& error) const { return error.coefficients.size() < 2; }
  bool operator()(const FourierError& error) const {
    return std::ranges::all_of(error.terms, [&](const FourierError::Term& term) {
      return is_whole(term.order * two_pi / error.period);
    });
  }
  bool operator()(const TableError& error) const {
    return error.periodic && is_whole(two_pi / (error.at.back() - error.at.front()));
  }
};

bool is_of(const ErrorTerm& term, const MachineAxis& axis) {
  return term.name.component && term.name.body == index_of(axis.name);
}

/// Its limits, or a turn that all errors repeat; of that where they are known.
PositionRange range_of(const ErrorModel& errors, const MachineAxis& axis) {
  PositionRange range = everywhere;
  bool round = is_rotary(axis.name);
  for (const ErrorTerm& term : errors.terms)
    round = round && (!is_of(term, axis) || std::visit(GoesRound{}, term.function));
  if (std::isfinite(axis.low) && std::isfinite(axis.high))
    range = {axis.low, axis.high};
  else if (round)
    range = {0.0, two_pi};
  const auto [low, high] = known_range(errors, axis.name);
  range = {std::max(range.low, low), std::min(range.high, high)};
  if (range.low < range.high) return range;
  throw InputError("errors", std::string("those of ") + letter_of(axis.name) +
                                 " were measured over ranges that have nothing in common: there "
                                 "is no table of them");
}

struct Needs {
  std::vector<double> positions;
  bool smooth = false;
};

Needs needs_of(const ErrorModel& errors, const MachineAxis& of, const PositionRange& range) {
  Needs needs;
  for (const ErrorTerm& term : errors.terms) {
    if (!is_of(term, of)) continue;
    const auto* table = std::get_if<TableError>(&term.function);
    // A turn that is written from 0 to 360° keeps the places of its table.
    if (table != nullptr &&
        (!table->periodic || (is_turn(range) && std::abs(table->at.front()) < 1e-9)))
      needs.positions.insert(needs.positions.end(), table->at.begin(), table->at.end());
    else if (!std::holds_alternative<ConstantError>(term.function))
      needs.smooth = true;
  }
  return needs;
}

/// Those beyond where the errors are known become its end.
std::vector<double> positions_of(const ErrorModel& errors, const MachineAxis& axis,
                                 const PositionRange& range, int points) {
  Needs needs = needs_of(errors, axis, range);
  const char* const unit = is_rotary(axis.name) ? "deg" : "mm";
  if (needs.smooth && !is_bounded(range))
    throw InputError(
        "machine", fmt::format("axis {} needs limits_{}: its errors are not tables{}, and are "
                               "written as a table over its travel",
                               letter_of(axis.name), unit,
                               is_rotary(axis.name) ? " and do not repeat every revolution" : ""));
  for (int i = 0; needs.smooth && i < points; ++i)
    needs.positions.push_back(
        i + 1 == points ? range.high : range.low + (range.high - range.low) * i / (points - 1));
  const PositionRange known = known_range(errors, axis.name);
  for (double& at : needs.positions) at = std::clamp(at, known.low, known.high);
  if (needs.positions.empty()) needs.positions = {0.0, 1.0};
  std::ranges::sort(needs.positions);
  const auto twice = std::ranges::unique(needs.positions);
  needs.positions.erase(twice.begin(), twice.end());
  return needs.positions;
}

/// E about the pivot r becomes E about the origin: its translation becomes that of Tr(r) E Tr(−r).
void about_origin(std::array<double, 6>& e, const Vector3& pivot_mm) {
  const Eigen::Vector3d r(pivot_mm[0], pivot_mm[1], pivot_mm[2]);
  const Eigen::Vector3d more = r - rigid::exponential({e[3], e[4], e[5]}) * r;
  for (std::size_t i = 0; i < 3; ++i) e[i] += more[static_cast<Eigen::Index>(i)];
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

std::vector<std::string> where_known(const Machine& machine, const ErrorModel& errors) {
  std::vector<std::string> notes;
  for (const MachineAxis& axis : machine.axes) {
    const auto [low, high] = known_range(errors, axis.name);
    if (axis.low >= low && axis.high <= high) continue;
    const double unit = is_rotary(axis.name) ? rad_per_deg : 1.0;
    notes.push_back(
        fmt::format("the table of {} covers {:.6g} to {:.6g} {}, beyond which its errors are not "
                    "known: the format cannot state it",
                    letter_of(axis.name), std::max(low, axis.low) / unit,
                    std::min(high, axis.high) / unit, is_rotary(axis.name) ? "deg" : "mm"));
  }
  return notes;
}

std::vector<SampledErrors> sample_components(const Machine& machine, const ErrorModel& errors,
                                             ErrorSign sign, int points) {
  expects(points >= 2, "two points or more");
  std::vector<SampledErrors> all;
  for (std::size_t k = 0; k < axis_count; ++k) {
    const MachineAxis* axis = machine.find(static_cast<AxisName>(k));
    if (axis == nullptr) continue;
    if (std::ranges::none_of(errors.terms, [&](const auto& term) { return is_of(term, *axis); }))
      continue;
    const PositionRange range = range_of(errors, *axis);
    SampledErrors one{axis->name, positions_of(errors, *axis, range, points), {}};
    const bool inverted = axis->carries_workpiece && sign != errors.sign;
    for (const double position : one.positions) {
      AxisPositions axes{};
      axes[k] = position;
      std::array<double, 6> e{};
      for (std::size_t d = 0; d < 6; ++d) e[d] = errors.value({true, d, k}, axes);
      if (k < 3) about_origin(e, errors.reference_mm[k]);
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
