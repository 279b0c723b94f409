// SPDX-License-Identifier: Apache-2.0
#include "diagnose/rows.hpp"

#include <algorithm>
#include <cmath>

#include "trueaxis/base/units.hpp"
#include "trueaxis/math/statistics.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr std::size_t blocks_wanted = 30;  // effects.md: 30, not 5
constexpr double few_turns = 6.0;          // fewer revolutions than this are no blocks to hold out
constexpr unsigned char longest_run = 8;

/// Where Z stands still for a section and then steps: the first reading of every section.
std::vector<std::size_t> section_starts(const Scene& scene) {
  std::vector<std::size_t> starts{0};
  std::size_t still = 0;
  for (std::size_t i = 1; i < scene.size(); ++i) {
    if (std::abs(scene.z[i] - scene.z[i - 1]) > 1e-3 * scene.z_half_mm)
      starts.push_back(i);
    else
      ++still;
  }
  const bool sections = starts.size() >= 3 && starts.size() * 4 <= scene.size() &&
                        still + starts.size() == scene.size();
  return sections ? starts : std::vector<std::size_t>{};
}

}  // namespace

void Rows::find_runs(const Scene& scene) {
  run.assign(scene.size(), 0);
  for (const Pass& pass : scene.passes) {
    std::vector<double> steps;
    const auto clock = [&](std::size_t i) { return scene.has_time ? scene.time[i] : scene.c[i]; };
    for (std::size_t i = pass.begin + 1; i < pass.end; ++i)
      steps.push_back(std::abs(clock(i) - clock(i - 1)));
    if (steps.empty()) continue;
    const double usual = median(steps);
    for (std::size_t i = pass.begin + 1; i < pass.end; ++i) {
      const bool regular = std::abs(clock(i) - clock(i - 1)) <= 1.8 * usual;
      if (used[i] && used[i - 1] && regular)
        run[i] = static_cast<unsigned char>(std::min<int>(run[i - 1] + 1, longest_run));
    }
  }
}

Rows make_rows(const Scene& scene) {
  Rows rows;
  rows.used.assign(scene.size(), 1);
  rows.find_runs(scene);
  rows.fold_begin = section_starts(scene);
  if (!rows.fold_begin.empty()) {
    rows.fold_begin.push_back(scene.size());
    rows.block = "a section";
    return rows;
  }
  double turns = 0.0;
  for (const Pass& pass : scene.passes)
    turns += std::abs(scene.c[pass.end - 1] - scene.c[pass.begin]) / two_pi;
  if (turns < few_turns) {
    const std::size_t blocks = std::min(blocks_wanted, scene.size() / 2);
    for (std::size_t b = 0; b <= blocks; ++b) rows.fold_begin.push_back(b * scene.size() / blocks);
    rows.block = "an arc";
    return rows;
  }
  const double per_block = std::max(1.0, std::floor(turns / static_cast<double>(blocks_wanted)));
  for (const Pass& pass : scene.passes) {
    const double own = std::abs(scene.c[pass.end - 1] - scene.c[pass.begin]) / two_pi;
    const double share =
        static_cast<double>(pass.end - pass.begin) / static_cast<double>(scene.size());
    const double blocks = own > 0.5 ? std::max(1.0, std::round(own / per_block))
                                    : std::max(1.0, std::round(share * blocks_wanted));
    for (double b = 0.0; b < blocks; ++b) {
      const auto begin = pass.begin + static_cast<std::size_t>(
                                          b / blocks * static_cast<double>(pass.end - pass.begin));
      if (rows.fold_begin.empty() || begin > rows.fold_begin.back())
        rows.fold_begin.push_back(begin);
    }
  }
  rows.fold_begin.push_back(scene.size());
  rows.block = per_block == 1.0 ? "a revolution"
                                : std::to_string(static_cast<int>(per_block)) + " revolutions";
  return rows;
}

}  // namespace trueaxis::diagnose_detail
