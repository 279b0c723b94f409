// SPDX-License-Identifier: Apache-2.0
#include "diagnose/geometry/condense.hpp"

#include <algorithm>
#include <cmath>

#include "trueaxis/units.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr std::size_t few_readings = 60000;
constexpr double means_per_turn = 40.0;

using Column = std::vector<double>;

constexpr Column LinearisationPoint::*straight[] = {
    &LinearisationPoint::c,          &LinearisationPoint::z,        &LinearisationPoint::time,
    &LinearisationPoint::speed,      &LinearisationPoint::velocity, &LinearisationPoint::x,
    &LinearisationPoint::sensed,     &LinearisationPoint::dx_dc,    &LinearisationPoint::dx_dz,
    &LinearisationPoint::d2x_dc2,    &LinearisationPoint::s,        &LinearisationPoint::clamp,
    &LinearisationPoint::dx_dnormal, &LinearisationPoint::dx_dy};
constexpr Column LinearisationPoint::*turning[] = {&LinearisationPoint::theta,
                                                   &LinearisationPoint::chuck};

/// First reading of every group, and one past the last.
std::vector<std::size_t> groups_of(const LinearisationPoint& point, const ObservationMask& mask,
                                   std::size_t every) {
  std::vector<std::size_t> first;
  for (const Pass& pass : point.passes) {
    std::size_t begun = pass.begin;
    for (std::size_t i = pass.begin; i < pass.end; ++i) {
      const bool broken = i > pass.begin && mask.used[i] && mask.used[i - 1] && mask.run[i] == 0;
      if (i == pass.begin || i - begun >= every || broken) first.push_back(begun = i);
    }
  }
  first.push_back(point.size());
  return first;
}

/// Mean over the readings of a group that count, or over all where none does.
class Mean {
 public:
  Mean(const ObservationMask& mask, std::size_t begin, std::size_t end)
      : mask_(mask), begin_(begin), end_(end) {
    for (std::size_t i = begin; i < end; ++i) count_ += mask.used[i];
  }
  std::size_t count() const { return count_; }
  double operator()(const Column& of) const {
    double sum = 0.0;
    for (std::size_t i = begin_; i < end_; ++i)
      if (mask_.used[i] || count_ == 0) sum += of[i];
    return sum / size();
  }
  /// Of angles, which may jump by a turn.
  double angle(const Column& of) const {
    double sum = 0.0;
    for (std::size_t i = begin_; i < end_; ++i)
      if (mask_.used[i] || count_ == 0) sum += std::remainder(of[i] - of[begin_], two_pi);
    return of[begin_] + sum / size();
  }

 private:
  double size() const { return static_cast<double>(count_ > 0 ? count_ : end_ - begin_); }
  const ObservationMask& mask_;
  std::size_t begin_, end_, count_ = 0;
};

}  // namespace

std::size_t condensation(const LinearisationPoint& point, const Resolution& resolution) {
  if (point.size() < few_readings || resolution.sections) return 1;
  return static_cast<std::size_t>(std::max(1.0, std::floor(resolution.per_turn / means_per_turn)));
}

Condensed condense(const LinearisationPoint& point, const ObservationMask& mask,
                   const std::vector<double>& deviation_mm, std::size_t every) {
  const std::vector<std::size_t> first = groups_of(point, mask, every);
  const std::size_t count = first.size() - 1;
  Condensed out;
  static_cast<LinearisationFacts&>(out.point) = point;
  for (Column LinearisationPoint::*column : straight) (out.point.*column).reserve(count);
  for (Column LinearisationPoint::*column : turning) (out.point.*column).reserve(count);
  for (std::size_t g = 0; g < count; ++g) {
    const Mean mean(mask, first[g], first[g + 1]);
    for (Column LinearisationPoint::*column : straight)
      (out.point.*column).push_back(mean(point.*column));
    for (Column LinearisationPoint::*column : turning)
      (out.point.*column).push_back(mean.angle(point.*column));
    out.deviation_mm.push_back(mean(deviation_mm));
    out.point.axis.push_back(point.axis[first[g]]);
    out.point.rear.push_back(point.rear[first[g]]);
    out.mask.used.push_back(2 * mean.count() > first[g + 1] - first[g]);
  }
  const auto group_of = [&](std::size_t reading) {
    return static_cast<std::size_t>(std::ranges::lower_bound(first, reading) - first.begin());
  };
  for (Pass pass : point.passes) {
    const auto readings = static_cast<double>(pass.end - pass.begin);
    pass.begin = group_of(pass.begin), pass.end = group_of(pass.end);
    pass.readings_per_revolution *= static_cast<double>(pass.end - pass.begin) / readings;
    out.point.passes.push_back(pass);
  }
  for (const std::size_t begin : mask.fold_begin) {
    const std::size_t group = group_of(begin);
    if (out.mask.fold_begin.empty() || group > out.mask.fold_begin.back())
      out.mask.fold_begin.push_back(group);
  }
  out.mask.block = mask.block;
  out.mask.find_runs(out.point);
  return out;
}

}  // namespace trueaxis::diagnose_detail
