// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/number.hpp"
#include "correct/coaxiality_distribution.hpp"
#include "job/conclude.hpp"
#include "job/doubts.hpp"
#include "job/references.hpp"
#include "job/target_datum.hpp"

namespace trueaxis {
namespace {

using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

constexpr double most_times = 100.0;  // readings; beyond that another measurement is meant
constexpr double no_noise = 2.0;      // widening of u by correlated residuals
constexpr double margin = 1.05;       // the next stream's σ and angles are not those of this one
constexpr double longest = 10.0;      // times the probed length

/// What the readings' noise alone leaves of a reference's axis: its fit without influences.
AxisCovariance noise_of(const PlannedJob& result, std::size_t i) {
  if (result.streams.at(i).size() == 0) return fit_used(result, i).axis.covariance;
  FitOptions options = result.job.references[i].fit;
  options.influences.clear();
  const FitResult& used = fit_used(result, i);
  AxisCovariance noise = fit(result.streams[i], options).axis.covariance;
  // A final axis has its own σ and widening; beyond that its covariance holds what other models
  // leave.
  const double ideal = result.fits[i].sigma_mm * result.fits[i].u_factor;
  const double ratio = ideal > 0.0 ? used.sigma_mm * used.u_factor / ideal : 1.0;
  for (double& c : noise.by_rows) c *= ratio * ratio;
  return noise;
}

/// Covariance with the noise of `times` as many readings over `longer` times the length, which
/// turns the axis less about the place where position and slope are uncorrelated.
AxisCovariance with_more(const AxisEstimate& axis, const AxisCovariance& noise, double times,
                         double longer) {
  const Eigen::Map<const Matrix4> whole(axis.covariance.data()), part(noise.data());
  const double slope2 = part(2, 2) + part(3, 3);
  const double lever = slope2 > 0.0 ? -(part(0, 2) + part(1, 3)) / slope2 : 0.0;
  Matrix4 to_middle = Matrix4::Identity();
  to_middle(0, 2) = to_middle(1, 3) = lever;
  Matrix4 shrink = Matrix4::Identity();
  shrink(2, 2) = shrink(3, 3) = 1.0 / longer;
  const Matrix4 move = to_middle.inverse() * shrink * to_middle;
  const Matrix4 scaled = move * part * move.transpose() / times;
  AxisCovariance out;
  Eigen::Map<Matrix4>(out.data()) = whole - part + scaled;
  return out;
}

/// The smallest factor from 1 to `most` that `enough` of, which is monotone; none: not even `most`.
template <typename Enough>
std::optional<double> smallest(double most, Enough enough) {
  if (!enough(most)) return {};
  double low = 1.0, high = most;
  while (high / low > 1.01) {
    const double middle = std::sqrt(low * high);
    (enough(middle) ? high : low) = middle;
  }
  return high;
}

/// Two digits upwards: 1234 → 1300.
double rounded_up(double value) {
  const double unit = digit_worth(value, 2);
  return std::ceil(value / unit) * unit;
}

/// The cause that was not found and leaves most of U, and the measurement that would show it;
/// none: none leaves as much as the readings' noise.
std::optional<Reason> most_open(const Diagnosis& diagnosis, const AxisCovariance& noise) {
  const AxisShare* most = nullptr;
  double largest = std::max(noise(AxisRow::x, AxisRow::x), noise(AxisRow::y, AxisRow::y));
  for (const AxisShare& share : diagnosis.shares) {
    const double variance = share.probability * (share.axis_shift.value * share.axis_shift.value +
                                                 share.axis_shift.u * share.axis_shift.u);
    if (share.instead_of.empty() && variance > largest) most = &share, largest = variance;
  }
  if (!most) return {};
  Reason reason{ReasonCode::hidden_cause,
                {},
                {{"open", std::sqrt(largest), "mm"}},
                {{"effect", most->effect}}};
  const auto hidden =
      std::ranges::find(diagnosis.not_observable, most->effect, &NotObservable::effect);
  if (hidden != diagnosis.not_observable.end() && hidden->separate_with &&
      !hidden->separate_with->plan.empty()) {
    reason.names.push_back({"plan", hidden->separate_with->plan});
    reason.names.push_back({"what", hidden->separate_with->what});
  }
  if (const Effect* effect = diagnosis.entry(most->effect);
      effect && effect->stated_as && !effect->stated)
    reason.names.push_back(
        {"stated_as", std::string(info_of(*effect->stated_as).stated) + " with its u"});
  return reason;
}

/// What a reference asks for before the number of its readings matters.
std::optional<Reason> before_more_readings(const PlannedJob& result, std::size_t i) {
  const FitResult& used = fit_used(result, i);
  if (used.u_factor > no_noise)
    return Reason{ReasonCode::look_for_cause, {i}, {{"autocorrelation", used.autocorrelation}}};
  return {};
}

}  // namespace

Reason what_would_prove(const PlannedJob& result, double allowed_mm) {
  const std::vector<Reference> references = references_of(result);
  for (std::size_t i = 0; i < result.associated.size(); ++i)
    if (result.associated[i])
      return {ReasonCode::quieter_probe_or_least_squares,
              {i},
              {},
              {{"association", name_of(*result.job.references[i].association)}}};
  std::vector<AxisCovariance> noise;
  double readings = 0.0, length_mm = 0.0;
  for (std::size_t i = 0; i < references.size(); ++i) {
    if (const auto first = before_more_readings(result, i)) return *first;
    noise.push_back(noise_of(result, i));
    readings += static_cast<double>(result.fits[i].points);
    length_mm =
        std::max(length_mm, result.fits[i].position_max_mm - result.fits[i].position_min_mm);
  }
  const TargetSurface& target = *result.job.target;
  const auto proven = [&](double times, double longer) {
    std::vector<Reference> better = references;
    for (std::size_t i = 0; i < better.size(); ++i)
      better[i].axis.covariance = with_more(references[i].axis, noise[i], times, longer);
    const CoaxialityDistribution distribution(judged(result, better), result.target_axis->axis.axis,
                                              target.z_start_mm, target.z_end_mm);
    return distribution.quantile(1.0 - nonconformity_risk) <= allowed_mm;
  };
  const auto times = smallest(most_times, [&](double t) { return proven(t, 1.0); });
  const auto longer = smallest(longest, [&](double l) { return proven(1.0, l); });
  Reason more{ReasonCode::more_would_prove};
  if (times)
    more.parts.push_back({ReasonCode::more_readings,
                          {},
                          {{"needed", rounded_up(margin * *times * readings)}, {"now", readings}}});
  if (longer && length_mm > 0.0)
    more.parts.push_back(
        {ReasonCode::greater_length,
         {},
         {{"needed", rounded_up(margin * *longer * length_mm), "mm"}, {"now", length_mm, "mm"}}});
  if (!more.parts.empty()) return more;
  if (proven(1e12, 1.0)) return {ReasonCode::quieter_sensor, {}, {{"times", most_times}}};
  for (std::size_t i = 0; i < references.size(); ++i) {
    if (!result.diagnoses[i]) continue;
    if (const auto open = most_open(*result.diagnoses[i], noise[i])) return *open;
    Reason next = measure(result.diagnoses[i]->next);
    next.code = ReasonCode::measurement_would_prove;
    if (!result.diagnoses[i]->next.plan.empty()) return next;
  }
  return {ReasonCode::nothing_proves};
}

}  // namespace trueaxis
