// SPDX-License-Identifier: Apache-2.0
#include "fit/uncertainty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "math/linear_algebra.hpp"
#include "math/statistics.hpp"
#include "measure/turn_centres.hpp"

namespace trueaxis {
namespace {

constexpr double rounding = 1e-15;       // relative error of a prediction
constexpr double correlation_sds = 4.0;  // 1/√N each: below, neighbours count as uncorrelated
constexpr double size_share =
    0.1;  // of the radius: uncertainties beyond it are not linear any more

/// Those that a fit knows what to do with: the others are causes of a diagnosis.
bool is_of_fit(const Influence& influence) {
  return influence.kind <= Influence::Kind::ball_radius;
}

/// Jᵀa for the effect a of one unit of an influence on every reading; J column by column from the
/// kernel.
Eigen::VectorXd projected(const Surface& surface, std::span<const double> working,
                          const PreparedStream& prepared, const Influence& influence) {
  const Influence::Kind kind = influence.kind;
  const std::size_t p = surface.parameter_count(), columns = surface.column_count();
  const ProbeStream& stream = prepared.source();
  std::vector<double> transform(p * columns);
  surface.transform(working, transform.data());
  const double mean = std::accumulate(stream.reading_mm.begin(), stream.reading_mm.end(), 0.0) /
                      static_cast<double>(stream.size());
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(columns));
  PredictionBlock block;
  for (std::size_t b = 0; b < prepared.blocks(); ++b) {
    surface.evaluate(working, prepared.block(b), block);
    for (std::size_t i = 0; i < prepared.filled(b); ++i) {
      const std::size_t row = b * block_size + i;
      double a = stream.reading_mm[row] - mean;
      if (kind != Influence::Kind::probe_gain) {
        const double position = stream.has_position() ? stream.position_mm[row] : 0.0;
        const auto at =
            surface.influences(working, stream.c_rad[row], position,
                               kind == Influence::Kind::probe_height ? influence.value : 0.0);
        a = kind == Influence::Kind::probe_height ? at.height
            : kind == Influence::Kind::c_offset   ? at.c
                                                  : at.position;
      }
      for (std::size_t j = 0; j < columns; ++j)
        sums(static_cast<Eigen::Index>(j)) += a * block.column[j][i];
    }
  }
  return Eigen::Map<const RowMajorMatrix>(transform.data(), static_cast<Eigen::Index>(p),
                                          static_cast<Eigen::Index>(columns)) *
         sums;
}

/// By how much the centres of single turns scatter beyond what their readings tell (Eq. 313), in
/// the clamping where they do so most.
double spread_of_turns(const JointModel& model, const std::vector<double>& residual_mm,
                       double clip_mm) {
  double most = 1.0;
  for (const JointPart& part : model.parts()) {
    const ProbeStream& stream = part.prepared->source();
    std::vector<double> left_mm(stream.size());
    for (std::size_t i = 0; i < left_mm.size(); ++i)
      left_mm[i] = std::clamp(residual_mm[part.rows.empty() ? i : part.rows[i]], -clip_mm, clip_mm);
    most = std::max(most, centres_spread(turn_centres(stream, left_mm, CentresOf::residuals),
                                         part.surface->parameter_count()));
  }
  return most;
}

/// Variance of C: residuals then scatter where the reading changes with C, r² = σ² + σ_C² (dX/dC)².
/// 0: they do not, by 4 standard deviations. The slope is that of the readings' first harmonic.
double variance_of_angle(const JointModel& model, const std::vector<double>& residual_mm) {
  double found = 0.0;
  for (const JointPart& part : model.parts()) {
    const PreparedStream& stream = *part.prepared;
    const auto n = static_cast<double>(stream.size());
    const auto for_each = [&](auto use) {
      for (std::size_t b = 0; b < stream.blocks(); ++b)
        for (std::size_t i = 0; i < stream.filled(b); ++i)
          use(stream.block(b), i, b * block_size + i);
    };
    double mean_mm = 0.0, cosine = 0.0, sine = 0.0;
    for_each([&](const ReadingBlock& at, std::size_t i, std::size_t) {
      mean_mm += at.reading_mm[i] / n;
    });
    for_each([&](const ReadingBlock& at, std::size_t i, std::size_t) {
      cosine += 2.0 / n * (at.reading_mm[i] - mean_mm) * at.cos_c[i];
      sine += 2.0 / n * (at.reading_mm[i] - mean_mm) * at.sin_c[i];
    });
    double s = 0.0, ss = 0.0, r = 0.0, rr = 0.0, rs = 0.0;
    for_each([&](const ReadingBlock& at, std::size_t i, std::size_t row) {
      const double slope = sine * at.cos_c[i] - cosine * at.sin_c[i];
      const double left = residual_mm[part.rows.empty() ? row : part.rows[row]];
      const double s2 = slope * slope, r2 = left * left;
      s += s2 / n, ss += s2 * s2 / n, r += r2 / n, rr += r2 * r2 / n, rs += r2 * s2 / n;
    });
    const double variance = ss - s * s, scatter = rr - r * r, common = rs - r * s;
    if (variance > 0.0 && scatter > 0.0 &&
        common * std::sqrt(n) > correlation_sds * std::sqrt(variance * scatter))
      found = std::max(found, common / variance);
  }
  return found;
}

}  // namespace

bool noise_disagrees(double stated_mm, double shown_mm, double redundancy) {
  constexpr double factor = 3.0;
  constexpr double enough = 5.0;  // χ²(5) gives less than a third of σ once in 100
  if (!(redundancy >= enough) || !(stated_mm > 0.0)) return false;
  return shown_mm > factor * stated_mm || factor * shown_mm < stated_mm;
}

ReadingNoise estimate_noise(const JointModel& model, const Association& association,
                            const FitOptions& options) {
  ReadingNoise noise;
  const std::vector<double>& residual = association.residual_mm;
  const auto n = static_cast<double>(residual.size());
  const auto parameters = static_cast<double>(model.parameter_count());
  const double redundancy = n - parameters;
  const bool robust = association.scale_mm > 0.0;
  noise.source = robust ? SigmaSource::robust_residuals : SigmaSource::residuals;
  noise.sigma_mm = robust           ? association.scale_mm
                   : redundancy > 0 ? std::sqrt(association.minimum.normal.sum_rho / redundancy)
                                    : std::numeric_limits<double>::quiet_NaN();
  noise.stated_mm = options.noise_mm;
  noise.shown_mm = noise.sigma_mm;
  noise.redundancy = redundancy;
  if (options.noise_mm && !(noise.sigma_mm >= *options.noise_mm)) {
    noise.sigma_mm = *options.noise_mm;
    noise.source = SigmaSource::sensor;
  }
  if (robust && redundancy > 0) {  // Eq. 33; Huber 1981, section 7.6
    double psi2 = 0.0, slope = 0.0, slope2 = 0.0;
    for (const double r : residual) {
      const auto [psi, derivative] = psi_and_derivative(association.loss, r);
      psi2 += psi * psi;
      slope += derivative;
      slope2 += derivative * derivative;
    }
    const double mean = slope / n, spread = slope2 / n - mean * mean;
    const double k = 1.0 + parameters / n * spread / (mean * mean);
    noise.loss_factor =
        k * k * psi2 / redundancy / (mean * mean) / (association.scale_mm * association.scale_mm);
  }
  noise.angle_rad2 = variance_of_angle(model, residual);
  const double clip = 3.0 * (robust ? association.scale_mm : noise.sigma_mm);
  noise.autocorrelation =
      std::isfinite(clip) && clip > 0.0 ? neighbour_correlation(residual, clip) : 0.0;
  if (noise.autocorrelation * std::sqrt(n) > correlation_sds) {
    const double rho = std::min(noise.autocorrelation, 0.99);
    noise.u_factor = std::sqrt((1.0 + rho) / (1.0 - rho));
    noise.correlated = find_correlated_noise(model, association, clip);
    if (!noise.correlated)
      noise.u_factor = std::max(noise.u_factor, spread_of_turns(model, residual, clip));
    // aᵀCa ≤ tr C = N σ² for any unit vector a: all readings alike are the worst there is.
    noise.u_factor = std::min(noise.u_factor, std::sqrt(n));
  }
  return noise;
}

Determination determine(const NormalMatrix& normal, const std::vector<double>& scale_mm,
                        double size_mm, const ReadingNoise& noise, double coverage) {
  const auto p = static_cast<Eigen::Index>(normal.parameters);
  const Eigen::Map<const Eigen::VectorXd> scale(scale_mm.data(), p);
  const Eigen::VectorXd unscale = scale.cwiseInverse();
  const Eigen::MatrixXd h = unscale.asDiagonal() *
                            Eigen::Map<const Eigen::MatrixXd>(normal.jtj.data(), p, p) *
                            unscale.asDiagonal();
  const linear::Spectrum of = linear::spectrum(h);
  const double largest = of.values.maxCoeff();
  const double factor = noise.correlated ? 1.0 : noise.u_factor;
  const double sigma_mm = noise.sigma_mm * factor;
  const double sigma = std::max(std::isfinite(sigma_mm) ? sigma_mm : 0.0, rounding * size_mm);

  Determination out;
  out.inverse = Eigen::MatrixXd::Zero(p, p);
  out.free_directions.resize(p, 0);
  for (Eigen::Index i = 0; i < p; ++i) {
    const double value = of.values(i);
    const Eigen::VectorXd direction = unscale.asDiagonal() * of.vectors.col(i);
    const double widened =
        noise.correlated ? std::sqrt(direction.dot(noise.correlated->jtcj * direction) / value)
                         : 1.0;
    // Each entry of JᵀJ carries the square of the prediction's rounding, so that a singular
    // direction shows as 1e-14.
    if (value <= 1e-14 * largest ||
        coverage * sigma * widened / std::sqrt(value) > size_share * size_mm) {
      out.free_directions.conservativeResize(Eigen::NoChange, out.free_directions.cols() + 1);
      out.free_directions.rightCols(1) = direction;
    } else {
      out.inverse += direction * direction.transpose() / value;
    }
  }
  return out;
}

namespace {

void take_in_correlation(const Determination& determination, ReadingNoise& noise) {
  if (!noise.correlated) return;
  constexpr double least_share = 0.1;  // of N − p: nearly all freedom taken says nothing of σ
  const Eigen::MatrixXd& inverse = determination.inverse;
  const Eigen::MatrixXd moved = inverse * noise.correlated->jtcj;
  if (noise.source != SigmaSource::sensor && noise.redundancy > 0.0) {
    const auto parameters = static_cast<double>(inverse.rows());
    const double left =
        std::max(noise.redundancy + parameters - moved.trace(), least_share * noise.redundancy);
    noise.sigma_mm *= std::sqrt(noise.redundancy / left);
    noise.shown_mm = noise.sigma_mm;
  }
  const Eigen::VectorXd correlated = (moved * inverse).diagonal(), white = inverse.diagonal();
  noise.u_factor = 1.0;
  for (Eigen::Index i = 0; i < white.size(); ++i) {
    if (white(i) > 0.0)
      noise.u_factor = std::max(noise.u_factor, std::sqrt(correlated(i) / white(i)));
  }
}

}  // namespace

void take_in(const Determination& determination, double coverage, ReadingNoise& noise) {
  take_in_correlation(determination, noise);
  if (noise.stated_mm || !(noise.redundancy > 0.0)) return;
  noise.widened = student_widening(
      std::max(1.0, noise.redundancy / (noise.u_factor * noise.u_factor)), coverage);
}

std::string name_direction(const Eigen::VectorXd& direction, const std::vector<std::string>& names,
                           const std::vector<double>& scale_mm) {
  Eigen::VectorXd size(direction.size());
  for (Eigen::Index i = 0; i < size.size(); ++i)
    size(i) = direction(i) * scale_mm[static_cast<std::size_t>(i)];
  size.normalize();
  Eigen::Index first;
  size.cwiseAbs().maxCoeff(&first);
  if (size(first) < 0) size = -size;
  std::string text;
  for (Eigen::Index i = 0; i < size.size(); ++i) {
    if (std::abs(size(i)) < 0.05) continue;
    text += fmt::format("{}{:.2f} {}",
                        text.empty() ? (size(i) < 0 ? "-" : "") : (size(i) < 0 ? " - " : " + "),
                        std::abs(size(i)), names[static_cast<std::size_t>(i)]);
  }
  return text;
}

std::vector<Source> budget_sources(const JointModel& model, const Association& association,
                                   const Determination& determination, const ReadingNoise& noise,
                                   const FitOptions& options) {
  const std::vector<double>& joint = association.minimum.working;
  const double sigma = noise.sigma_mm * (noise.correlated ? 1.0 : noise.u_factor) * noise.widened;
  const Eigen::MatrixXd& inverse = determination.inverse;
  std::vector<Source> sources{
      {"noise of the readings", 'A', sigma * sigma * noise.loss_factor * inverse}};
  if (noise.correlated)
    sources.front().covariance = sources.front().covariance * noise.correlated->jtcj * inverse;
  std::vector<Influence> influences = options.influences;
  std::erase_if(influences, [](const Influence& influence) { return !is_of_fit(influence); });
  const std::size_t stated = influences.size();
  // Eccentricity at scattered angles is read smaller by σ_C²/2 (Fuller 1987), as by a gain.
  if (noise.angle_rad2 > 0.0)
    influences.push_back({Influence::Kind::probe_gain, 0.5 * noise.angle_rad2});
  for (const Influence& influence : influences) {
    Eigen::VectorXd shift = Eigen::VectorXd::Zero(determination.inverse.rows());
    if (influence.kind == Influence::Kind::ball_radius) {
      const JointPart& part = model.parts().front();
      const double t = part.surface->shape(model.working(joint, part)).tan_half_angle;
      for (std::size_t i = 0; i < model.names().size(); ++i) {
        if (model.names()[i] == "radius" || model.names()[i].starts_with("height"))
          shift(static_cast<Eigen::Index>(i)) = std::sqrt(1.0 + t * t);
      }
    } else {
      for (const JointPart& part : model.parts()) {
        const std::vector<double> working = model.working(joint, part);
        shift += model.working_jacobian(joint, part).transpose() *
                 projected(*part.surface, working, *part.prepared, influence);
      }
      shift = determination.inverse * shift;
    }
    shift *= influence.u;
    const bool said = sources.size() <= stated;
    sources.push_back({said ? std::string(info_of(influence.kind).name) : "noise of C",
                       said ? 'B' : 'A', shift * shift.transpose()});
  }
  return sources;
}

}  // namespace trueaxis
