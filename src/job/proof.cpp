// SPDX-License-Identifier: Apache-2.0
#include "job/proof.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "correct/coaxiality_distribution.hpp"
#include "job/references.hpp"
#include "job/target_datum.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

constexpr double most_times = 100.0;  // readings; beyond that another measurement is meant
constexpr double no_noise = 2.0;      // widening of u by correlated residuals
constexpr double margin = 1.05;       // the next stream's σ and angles are not those of this one
constexpr double longest = 10.0;      // times the probed length

/// What the readings' noise alone leaves of a reference's axis: its fit without influences.
AxisCovariance noise_of(const JobResult& result, std::size_t i) {
  if (result.streams.at(i).size() == 0) return fit_used(result, i).axis.covariance;
  FitOptions options = result.job.references[i].fit;
  options.influences.clear();
  const FitResult& used = fit_used(result, i);
  AxisCovariance noise = fit(result.streams[i], options).axis.covariance;
  // An extended model has its own σ and widening; beyond that its covariance holds what rivals
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
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::ceil(value / unit) * unit;
}

/// The cause that was not found and leaves most of U, and the measurement that would show it;
/// empty: none leaves as much as the readings' noise.
std::string most_open(const Diagnosis& diagnosis, const AxisCovariance& noise) {
  const AxisShare* most = nullptr;
  double largest = std::max(noise(AxisRow::x, AxisRow::x), noise(AxisRow::y, AxisRow::y));
  for (const AxisShare& share : diagnosis.shares) {
    const double variance = share.probability * (share.axis_shift.value * share.axis_shift.value +
                                                 share.axis_shift.u * share.axis_shift.u);
    if (share.instead_of.empty() && variance > largest) most = &share, largest = variance;
  }
  if (!most) return "";
  const auto hidden =
      std::ranges::find(diagnosis.not_observable, most->effect, &NotObservable::effect);
  const bool told = hidden != diagnosis.not_observable.end() && hidden->separate_with &&
                    !hidden->separate_with->plan.empty();
  const Effect* effect = diagnosis.entry(most->effect);
  const std::string_view key = effect ? effect->stated_as : "";
  return fmt::format(
      "no number of readings proves it: {}, which these passes do not show, leaves {:.2g} µm of "
      "the axis open{}{}",
      most->effect, std::sqrt(largest) / mm_per_um,
      told ? ". " + hidden->separate_with->what : std::string(),
      key.empty() ? "" : fmt::format(". Or state the uncertainty of the {} in the job", key));
}

}  // namespace

std::string what_would_prove(const JobResult& result, double allowed_mm) {
  const std::vector<Reference> references = references_of(result);
  for (std::size_t i = 0; i < result.associated.size(); ++i)
    if (result.associated[i])
      return fmt::format(
          "{}the axis by {} rests on few readings and takes their noise in whole: a quieter probe "
          "or least squares (without `association`) would prove it",
          of_reference(result, i), name_of(*result.job.references[i].association));
  std::vector<AxisCovariance> noise;
  double readings = 0.0, length_mm = 0.0;
  for (std::size_t i = 0; i < references.size(); ++i) {
    const FitResult& used = fit_used(result, i);
    if (used.u_factor > no_noise)
      return fmt::format(
          "{}what the readings leave is no noise, neighbours are alike ({:.2f}): more of them "
          "prove "
          "nothing. Look for its cause, or clamp the part again and probe again",
          of_reference(result, i), used.autocorrelation);
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
  std::string text;
  if (times)
    text = fmt::format("about {:.0f} readings instead of {:.0f}",
                       rounded_up(margin * *times * readings), readings);
  if (longer && length_mm > 0.0)
    text += fmt::format("{}the same number over {:.4g} mm instead of {:.4g} mm",
                        text.empty() ? "" : ", or ", rounded_up(margin * *longer * length_mm),
                        length_mm);
  if (!text.empty()) return text + " would prove it";
  if (proven(1e12, 1.0))
    return fmt::format("more than {:.0f} times the readings would be needed: take a quieter sensor",
                       most_times);
  for (std::size_t i = 0; i < references.size(); ++i) {
    if (!result.diagnoses[i]) continue;
    if (const std::string open = most_open(*result.diagnoses[i], noise[i]); !open.empty())
      return open;
    const NextMeasurement& next = result.diagnoses[i]->next;
    if (!next.plan.empty()) return "readings alone do not prove it: " + next.what;
  }
  return "no number of readings proves it: what the compromise, the stated influences and rival "
         "models leave is more than the tolerance";
}

}  // namespace trueaxis
