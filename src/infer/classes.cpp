// SPDX-License-Identifier: Apache-2.0
#include "infer/classes.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

namespace trueaxis::infer {
namespace {

constexpr double structural = 0.999;
constexpr double unlike = 0.2;  // share of the named prediction that is left: what columns bend

/// Probabilities by the criteria, and what is too improbable for a class.
Class settled(const Class& found, const Named& named, std::span<const Cause> causes) {
  double best = named.criterion, sum = 0.0;
  for (const Class::Member& m : found.members) best = std::min(best, causes[m.cause].criterion);
  const auto likelihood = [&](double criterion) { return std::exp(-0.5 * (criterion - best)); };
  sum += likelihood(named.criterion);
  for (const Class::Member& m : found.members) sum += likelihood(causes[m.cause].criterion);
  Class out{likelihood(named.criterion) / sum, found.members, found.dropped};
  for (Class::Member& m : out.members)
    m.rival.probability = likelihood(causes[m.cause].criterion) / sum;
  std::ranges::stable_sort(out.members, std::ranges::greater{},
                           [](const Class::Member& m) { return m.rival.probability; });
  std::erase_if(out.members, [&](const Class::Member& m) {
    if (m.rival.probability >= in_no_class) return false;
    out.dropped.push_back({m.cause, m.rival.probability, false});
    return true;
  });
  return out;
}

}  // namespace

double right_name(double d) { return cdf(boost::math::normal(), 0.5 * d); }

double right_name_of(const std::vector<Rival>& rivals, const std::vector<double>& distances) {
  double right = 0.0, all = 0.0;
  for (std::size_t r = 0; r < rivals.size(); ++r) {
    right += rivals[r].probability * right_name(distances[r]);
    all += rivals[r].probability;
  }
  return all > 0.0 ? right / all : 1.0;
}

double left_of(const Projection& beside, const Columns& columns,
               const Eigen::VectorXd& coefficients) {
  double sum = 0.0;
  for (std::size_t a = 0; a < columns.size(); ++a) {
    for (std::size_t b = 0; b < columns.size(); ++b)
      sum +=
          coefficients(static_cast<Eigen::Index>(a)) * coefficients(static_cast<Eigen::Index>(b)) *
          beside.gram(static_cast<Eigen::Index>(columns[a]), static_cast<Eigen::Index>(columns[b]));
  }
  return std::max(0.0, sum);
}

Class distinguish(const Eigen::MatrixXd& gram, const Columns& others, const Projection& beside,
                  const Named& named, std::span<const Cause> causes, double variance,
                  double freedom) {
  const Score best = score(beside, named.columns);
  const double all2 = left_of(beside, named.columns, named.coefficients);
  Class out;
  for (std::size_t k = 0; k < causes.size(); ++k) {
    const Cause& c = causes[k];
    if (std::ranges::any_of(out.members,
                            [&](const Class::Member& m) { return m.rival.effect == c.effect; }))
      continue;
    Columns with = others;
    with.insert(with.end(), c.columns.begin(), c.columns.end());
    const double left2 = left_of(project(gram, with), named.columns, named.coefficients);
    Rival rival;
    rival.effect = c.effect;
    rival.distance = std::sqrt(left2 / variance);
    const double twice_log_ratio =
        freedom * std::log(std::max(beside.rss - c.gain, 1e-300) / (beside.rss - best.gain)) +
        2.0 * (static_cast<double>(c.rank) - static_cast<double>(best.rank));
    rival.log_likelihood_ratio = 0.5 * twice_log_ratio;
    rival.structural = all2 > 0.0 && 1.0 - left2 / all2 > structural * structural;
    if (rival.distance < told_apart || twice_log_ratio < likelihood_tells)
      out.members.push_back({k, rival});
    else if (left2 < unlike * all2)
      out.dropped.push_back({k, 0.0, true});
  }
  return settled(out, named, causes);
}

}  // namespace trueaxis::infer
