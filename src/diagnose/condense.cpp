// SPDX-License-Identifier: Apache-2.0
#include "diagnose/condense.hpp"

#include <algorithm>
#include <cmath>

#include "trueaxis/base/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr std::size_t few_readings = 60000;
constexpr double means_per_turn = 40.0;

using Column = std::vector<double>;

constexpr Column Scene::*straight[] = {
    &Scene::c, &Scene::z,      &Scene::time,      &Scene::speed, &Scene::velocity,
    &Scene::x, &Scene::sensed, &Scene::dx_dc,     &Scene::dx_dz, &Scene::d2x_dc2,
    &Scene::s, &Scene::clamp,  &Scene::dx_dnormal};
constexpr Column Scene::*turning[] = {&Scene::theta, &Scene::chuck};

/// First reading of every group, and one past the last.
std::vector<std::size_t> groups_of(const Scene& scene, const Rows& rows, std::size_t every) {
  std::vector<std::size_t> first;
  for (const Pass& pass : scene.passes) {
    std::size_t begun = pass.begin;
    for (std::size_t i = pass.begin; i < pass.end; ++i) {
      const bool broken = i > pass.begin && rows.used[i] && rows.used[i - 1] && rows.run[i] == 0;
      if (i == pass.begin || i - begun >= every || broken) first.push_back(begun = i);
    }
  }
  first.push_back(scene.size());
  return first;
}

/// Mean over the readings of a group that count, or over all where none does.
class Mean {
 public:
  Mean(const Rows& rows, std::size_t begin, std::size_t end)
      : rows_(rows), begin_(begin), end_(end) {
    for (std::size_t i = begin; i < end; ++i) count_ += rows.used[i];
  }
  std::size_t count() const { return count_; }
  double operator()(const Column& of) const {
    double sum = 0.0;
    for (std::size_t i = begin_; i < end_; ++i)
      if (rows_.used[i] || count_ == 0) sum += of[i];
    return sum / size();
  }
  /// Of angles, which may jump by a turn.
  double angle(const Column& of) const {
    double sum = 0.0;
    for (std::size_t i = begin_; i < end_; ++i)
      if (rows_.used[i] || count_ == 0) sum += std::remainder(of[i] - of[begin_], two_pi);
    return of[begin_] + sum / size();
  }

 private:
  double size() const { return static_cast<double>(count_ > 0 ? count_ : end_ - begin_); }
  const Rows& rows_;
  std::size_t begin_, end_, count_ = 0;
};

}  // namespace

std::size_t condensation(const Scene& scene, const Resolution& resolution) {
  if (scene.size() < few_readings || resolution.sections) return 1;
  return static_cast<std::size_t>(std::max(1.0, std::floor(resolution.per_turn / means_per_turn)));
}

Condensed condense(const Scene& scene, const Rows& rows, const std::vector<double>& deviation_mm,
                   std::size_t every) {
  const std::vector<std::size_t> first = groups_of(scene, rows, every);
  const std::size_t count = first.size() - 1;
  Condensed out;
  static_cast<SceneFacts&>(out.scene) = scene;
  for (Column Scene::*column : straight) (out.scene.*column).reserve(count);
  for (Column Scene::*column : turning) (out.scene.*column).reserve(count);
  for (std::size_t g = 0; g < count; ++g) {
    const Mean mean(rows, first[g], first[g + 1]);
    for (Column Scene::*column : straight) (out.scene.*column).push_back(mean(scene.*column));
    for (Column Scene::*column : turning) (out.scene.*column).push_back(mean.angle(scene.*column));
    out.deviation_mm.push_back(mean(deviation_mm));
    out.scene.axis.push_back(scene.axis[first[g]]);
    out.scene.rear.push_back(scene.rear[first[g]]);
    out.rows.used.push_back(2 * mean.count() > first[g + 1] - first[g]);
  }
  const auto group_of = [&](std::size_t reading) {
    return static_cast<std::size_t>(std::ranges::lower_bound(first, reading) - first.begin());
  };
  for (Pass pass : scene.passes) {
    const auto readings = static_cast<double>(pass.end - pass.begin);
    pass.begin = group_of(pass.begin), pass.end = group_of(pass.end);
    pass.readings_per_revolution *= static_cast<double>(pass.end - pass.begin) / readings;
    out.scene.passes.push_back(pass);
  }
  for (const std::size_t begin : rows.fold_begin) {
    const std::size_t group = group_of(begin);
    if (out.rows.fold_begin.empty() || group > out.rows.fold_begin.back())
      out.rows.fold_begin.push_back(group);
  }
  out.rows.block = rows.block;
  out.rows.find_runs(out.scene);
  return out;
}

}  // namespace trueaxis::diagnose_detail
