// SPDX-License-Identifier: Apache-2.0
#include "diagnose/regression/size_prior.hpp"

#include <algorithm>
#include <cmath>

namespace trueaxis::diagnose_detail {
namespace {

constexpr double wrong_statement = 1e-3;  // how often what is stated of a machine is wrong
constexpr double exact = 1e-6;            // of the median: a statement of u = 0
/// Second harmonic of lobes that jaws press in, of the first. A thin ring has ((j² − 1)/(4j² − 1))²
/// of it (Eq. 41), below 1/16 for any j. Chosen, not derived: five times that, for jaws that press
/// over a width and not all alike. Beyond it the lobes are two.
constexpr double most_second = 0.3;
/// What a sensor errs by where it reads, over the range that it was read in: one that bends more
/// measures no distance.
constexpr double most_of_range = 0.1;

struct Range {
  double median = 0.0, spread = spread_of_size(0.0);
};

Range range_of_size(const EffectParameter* p, const TermShape& shape) {
  if (!p || !(p->high > 0.0)) return {};
  const double ratio = p->low > 0.0 ? p->low / p->high : open_end;
  const double limit = p->share > 0.0 ? p->share * shape.*p->share_of : p->high;
  const double high = std::min(p->high, limit);
  return {high * std::sqrt(ratio), spread_of_size(-std::log(ratio))};
}

/// Amplitude of a wave of the surface as a ball reads it that lies on two crests: half of
/// r − √(r² − λ²/4) (Eq. 43b); 0: another term, or any size can be.
double most_of_wave(const Hypothesis& h) {
  const auto* wave = std::get_if<PeriodicInZ>(&h.effect->term);
  const double r = h.shape.ball_radius_mm, half_mm = 0.5 * std::abs(h.shape.period_mm);
  if (!wave || wave->port != TermPort::normal || !(r > half_mm)) return 0.0;
  return 0.5 * (r - std::sqrt(r * r - half_mm * half_mm));
}

/// Lobes and their growth, a tilt and a radial motion: neither tells how large the other is.
bool has_two_sizes(const Hypothesis& h) {
  const auto* harmonic = std::get_if<Harmonic>(&h.effect->term);
  return harmonic && h.columns() == 4 &&
         (harmonic->envelope == Harmonic::Envelope::growing ||
          harmonic->envelope == Harmonic::Envelope::lever);
}

}  // namespace

bool bends_reading(const EffectTerm& term) {
  const auto* response = std::get_if<Response>(&term);
  return response &&
         (response->of == Response::Of::nonlinearity || response->of == Response::Of::cyclic);
}

SizePrior size_prior(const Hypothesis& h) {
  const auto count = static_cast<Eigen::Index>(h.columns());
  const EffectParameter any{};
  SizePrior out{Eigen::VectorXd::Zero(count), spread_of_size(0.0),
                Eigen::VectorXd::Constant(count, any.least),
                Eigen::VectorXd::Constant(count, any.most)};
  if (!h.effect && h.smallest_mm > 0.0) {
    out.median.setConstant(std::sqrt(h.smallest_mm * h.largest_mm));
    out.spread = spread_of_size(std::log(h.largest_mm / h.smallest_mm));
  }
  if (!h.effect) return out;
  const auto names = linear_parameters(h.effect->term, h.shape);
  for (Eigen::Index j = 0; j < count; ++j) {
    const auto k = static_cast<std::size_t>(j);
    const LinearParameter& linear = names[h.free.empty() ? k : h.free[k]];
    const EffectParameter* parameter = size_for(*h.effect, linear);
    const Range range = range_of_size(parameter, h.shape);
    const bool pair = linear.factor != LinearParameter::Factor::itself;
    out.median(j) = range.median / (pair ? std::sqrt(2.0) : 1.0);
    if (parameter) {
      out.most(j) = parameter->most;
      out.least(j) = pair ? -parameter->most : parameter->least;
    }
    out.spread = std::max(out.spread, range.spread);
  }
  if (has_two_orders(h.effect->term) && h.free.empty()) out.most_of_first = most_second;
  if (bends_reading(h.effect->term) && h.shape.range_mm > 0.0) {
    out.most = out.most.cwiseMin(most_of_range * h.shape.range_mm);
    out.least = out.least.cwiseMax(-most_of_range * h.shape.range_mm);
  }
  if (const double most_mm = most_of_wave(h); most_mm > 0.0) {
    out.most = out.most.cwiseMin(most_mm);
    out.least = out.least.cwiseMax(-most_mm);
  }
  out.spread *= h.effect->size_spread;
  out.own_scale_of_last = has_two_sizes(h);
  if (h.effect->stated && count == 1 && out.median(0) > 0.0) {
    out.stated = std::max(h.effect->stated->u / out.median(0), exact);
    out.doubt = wrong_statement;
  }
  return out;
}

SizePrior stated_prior(const Hypothesis& h) {
  SizePrior out = size_prior(h);
  if (out.stated > 0.0) out.doubt = 0.0;
  return out;
}

Weighed weigh(const Hypothesis& hypothesis, const Projection& projection, const Columns& own,
              std::size_t count) {
  return weigh(size_prior(hypothesis), projection, own, count);
}

}  // namespace trueaxis::diagnose_detail
