// SPDX-License-Identifier: Apache-2.0
#include "fit/uncertainty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "math/linear_algebra.hpp"
#include "math/statistics.hpp"

namespace trueaxis {
namespace {

constexpr double rounding = 1e-15;       // relative error of a prediction
constexpr double correlation_sds = 4.0;  // 1/√N each: below, neighbours count as uncorrelated
constexpr double size_share =
    0.1;  // of the radius: uncertainties beyond it are not linear any more

const char* influence_name(Influence::Kind kind) {
  static constexpr const char* names[] = {"probe height", "probe gain", "spindle angle datum",
                                          "position datum", "ball radius"};
  return names[static_cast<std::size_t>(kind)];
}

/// Jᵀa for the effect a of one unit of an influence on every reading; J column by column from the
/// kernel.
Eigen::VectorXd projected(const Surface& surface, std::span<const double> working,
                          const PreparedStream& prepared, Influence::Kind kind) {
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
        const auto at = surface.influences(working, stream.c_rad[row], position);
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
  noise.source = robust ? "robust residuals" : "residuals";
  noise.sigma_mm = robust           ? association.scale_mm
                   : redundancy > 0 ? std::sqrt(association.minimum.normal.sum_rho / redundancy)
                                    : std::numeric_limits<double>::quiet_NaN();
  noise.stated_mm = options.noise_mm;
  noise.shown_mm = noise.sigma_mm;
  noise.redundancy = redundancy;
  if (options.noise_mm && !(noise.sigma_mm >= *options.noise_mm)) {
    noise.sigma_mm = *options.noise_mm;
    noise.source = "sensor";
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
  const double clip = 3.0 * (robust ? association.scale_mm : noise.sigma_mm);
  noise.autocorrelation =
      std::isfinite(clip) && clip > 0.0 ? neighbour_correlation(residual, clip) : 0.0;
  if (noise.autocorrelation * std::sqrt(n) > correlation_sds) {
    const double rho = std::min(noise.autocorrelation, 0.99);
    noise.u_factor = std::sqrt((1.0 + rho) / (1.0 - rho));
    noise.correlated = find_correlated_noise(model, association, clip);
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

void take_in(const Determination& determination, ReadingNoise& noise) {
  if (!noise.correlated) return;
  constexpr double least_share = 0.1;  // of N − p: nearly all freedom taken says nothing of σ
  const Eigen::MatrixXd& inverse = determination.inverse;
  const Eigen::MatrixXd moved = inverse * noise.correlated->jtcj;
  if (noise.source != "sensor" && noise.redundancy > 0.0) {
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
  const double sigma = noise.sigma_mm * (noise.correlated ? 1.0 : noise.u_factor);
  const Eigen::MatrixXd& inverse = determination.inverse;
  std::vector<Source> sources{
      {"noise of the readings", 'A', sigma * sigma * noise.loss_factor * inverse}};
  if (noise.correlated)
    sources.front().covariance = sources.front().covariance * noise.correlated->jtcj * inverse;
  if (options.influences.empty()) return sources;
  for (const Influence& influence : options.influences) {
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
                 projected(*part.surface, working, *part.prepared, influence.kind);
      }
      shift = determination.inverse * shift;
    }
    shift *= influence.u;
    sources.push_back({influence_name(influence.kind), 'B', shift * shift.transpose()});
  }
  return sources;
}

}  // namespace trueaxis
