// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "study/bound/bound.hpp"
#include "study/bound/quantities.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::study {

using namespace virtual_lathe;

namespace {

constexpr double length_step = 0.01, cosine_step = 1e-4, angle_step = 1e-4;

/// The set-up of a number, its axis written out.
Chucking& written_out(Scenario& scenario, int number) {
  auto at = std::ranges::find(scenario.plan.setups, number, &Chucking::number);
  if (at == scenario.plan.setups.end()) {
    Chucking as_first;
    as_first.number = number;
    at = scenario.plan.setups.insert(at, as_first);
  }
  const Part& part = scenario.part;
  at->x0_mm = at->x0_mm.value_or(part.x0_mm), at->y0_mm = at->y0_mm.value_or(part.y0_mm);
  at->l = at->l.value_or(part.l), at->m = at->m.value_or(part.m);
  return *at;
}

bool same_axis(const Chucking& a, const Chucking& b) {
  return a.x0_mm == b.x0_mm && a.y0_mm == b.y0_mm && a.l == b.l && a.m == b.m;
}

}  // namespace

std::optional<Estimable> Estimable::of(const Scenario& scenario, const ProbeStream& probed,
                                       SurfaceKind surface) {
  Estimable out;
  out.scenario_ = scenario;
  out.surface_ = surface;
  const std::vector<SetUp> all = list_set_ups(probed);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i == 0 || !all[i].clamped_as(all[i - 1])) out.set_ups_.emplace_back();
    out.set_ups_.back().push_back(all[i].number);
  }
  for (const std::vector<int>& numbers : out.set_ups_) {
    const Chucking first = written_out(out.scenario_, numbers.front());
    for (const int number : numbers) {
      if (!same_axis(first, written_out(out.scenario_, number))) return std::nullopt;
    }
  }
  if (scenario.part.kind == PartKind::cone) out.place_radius(probed);
  if (!scenario.probe.relative_zero_mm || scenario.part.kind == PartKind::face) return out;
  for (std::size_t i = 0; i < probed.size(); ++i) {
    const int number = probed.setup.empty() ? all.front().number : probed.setup[i];
    const auto holds = [&](const std::vector<int>& numbers) {
      return std::ranges::find(numbers, number) != numbers.end();
    };
    out.gauge_zero_of_.push_back(
        static_cast<std::size_t>(std::ranges::find_if(out.set_ups_, holds) - out.set_ups_.begin()));
  }
  return out;
}

void refuse_moving_axis(const Scenario& scenario, const ProbeStream& probed, const char* who) {
  if (Estimable::of(scenario, probed, surface_of(scenario.part.kind))) return;
  throw InputError(who, std::string(to_string(Bound::Missing::axis_moves)) +
                            ": say in the set-up what moved the part (reindex, z_shift or "
                            "clamp_force_ratio)");
}

void Estimable::place_radius(const ProbeStream& probed) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < probed.size(); ++i) {
    const double on_part = probed.position_mm[i] - set_up_of(probed, i).z_shift_mm;
    low = std::min(low, on_part), high = std::max(high, on_part);
  }
  Part& part = scenario_.part;
  const double n = std::sqrt(1.0 - part.l * part.l - part.m * part.m);
  const double middle = 0.5 * (low + high) / n;
  const double tangent = std::tan(part.half_angle_rad);
  if (part.apex_mm) {
    part.radius_mm = std::abs(middle - *part.apex_mm) * tangent;
    if (*part.apex_mm > middle) part.half_angle_rad = -part.half_angle_rad;
    part.apex_mm.reset();
  } else {
    part.radius_mm += tangent * (middle - part.radius_at_mm);
  }
  part.radius_at_mm = middle;
}

std::vector<EstimatedParameter> Estimable::estimated_parameters() {
  std::vector<EstimatedParameter> out;
  Part& part = scenario_.part;
  const bool tilts = surface_ != SurfaceKind::section, is_face = part.kind == PartKind::face;
  for (const std::vector<int>& numbers : set_ups_) {
    const auto move = [&](double step, const auto& number_of) {
      EstimatedParameter& parameter =
          out.emplace_back(EstimatedParameter{{}, step, step == length_step});
      for (const int number : numbers)
        parameter.numbers.push_back(&number_of(written_out(scenario_, number)));
    };
    if (is_face) {
      move(length_step, [](Chucking& setup) -> double& { return setup.z_shift_mm; });
    } else {
      move(length_step, [](Chucking& setup) -> double& { return *setup.x0_mm; });
      move(length_step, [](Chucking& setup) -> double& { return *setup.y0_mm; });
    }
    if (!tilts) continue;
    move(cosine_step, [](Chucking& setup) -> double& { return *setup.l; });
    move(cosine_step, [](Chucking& setup) -> double& { return *setup.m; });
  }
  if (is_face) return out;
  if (gauge_zero_of_.empty()) out.push_back({{&part.radius_mm}, length_step});
  if (tilts && part.kind == PartKind::cone) {
    const double size = std::abs(part.half_angle_rad);
    const double room = std::min(size, 90.0 * rad_per_deg - size);
    out.push_back({{&part.half_angle_rad}, std::min(angle_step, 0.25 * room), false});
  }
  return out;
}

}  // namespace trueaxis::study
