// SPDX-License-Identifier: Apache-2.0
#include "associate/chosen_points.hpp"

#include <algorithm>

#include "associate/distance_kernel.hpp"
#include "base/threads.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t solved_whole = 1500;  ///< so many points are all solved for
constexpr std::size_t spread_out = 256;     ///< of more, so many from everywhere: they enclose it
constexpr std::size_t stretches = 512;      ///< of many points each offers its furthest

}  // namespace

Furthest furthest(const Placed& placed, const PointCloud& cloud, const Sides& sides) {
  const std::size_t n = cloud.points.size();
  const std::size_t blocks = (n + block_size - 1) / block_size;
  const std::size_t each = std::max<std::size_t>(1, (blocks + stretches - 1) / stretches);
  const std::size_t count = (blocks + each - 1) / each;
  Furthest out{std::vector<Furthest::One>(count), std::vector<Furthest::One>(count)};
  for_each_index(count, n < 40000 ? 1 : cloud.threads, [&](std::size_t k) {
    double d[block_size];
    const std::size_t end = std::min(n, (k + 1) * each * block_size);
    for (std::size_t at = k * each * block_size; at < end; at += block_size) {
      const std::size_t some = std::min(block_size, end - at);
      evaluate_only_distances(placed, cloud.points.subspan(at, some), d);
      double high = d[0], low = d[0];
      for (std::size_t i = 1; i < some; ++i) high = std::max(high, d[i]), low = std::min(low, d[i]);
      const auto offer = [&](Furthest::One& to, double value, double of) {
        if (value <= to.value) return;
        to = {at + static_cast<std::size_t>(std::find(d, d + some, of) - d), value};
      };
      offer(out.outer[k], high, high);
      offer(out.inner[k], -low, low);
    }
  });
  for (std::size_t k = 0; k < count; ++k) {
    if (sides.outer) out.top = std::max(out.top, out.outer[k].value);
    if (sides.inner) out.top = std::max(out.top, out.inner[k].value);
  }
  return out;
}

ChosenPoints::ChosenPoints(const PointCloud& cloud) : cloud_(cloud) {
  const std::size_t n = cloud.points.size();
  const std::size_t some = n > solved_whole ? spread_out : n;
  for (std::size_t i = 0; i < some; ++i) indices_.push_back(n > some ? spread_index(i, n) : i);
  std::ranges::sort(indices_);
  gather();
}

bool ChosenPoints::add(const Furthest& from, const Sides& sides, double h) {
  const std::size_t before = indices_.size();
  const auto take = [&](const std::vector<Furthest::One>& all) {
    for (const Furthest::One& one : all)
      if (one.value > h) indices_.push_back(one.point);
  };
  if (sides.outer) take(from.outer);
  if (sides.inner) take(from.inner);
  std::ranges::sort(indices_);
  indices_.erase(std::unique(indices_.begin(), indices_.end()), indices_.end());
  gather();
  return indices_.size() > before;
}

void ChosenPoints::gather() {
  points_.clear();
  for (const std::size_t i : indices_) points_.push_back(cloud_.points[i]);
}

}  // namespace trueaxis
