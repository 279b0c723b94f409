// SPDX-License-Identifier: Apache-2.0
#include "calibrate/diagnose/explain.hpp"

#include <algorithm>
#include <cmath>

#include "infer/stepwise.hpp"
#include "math/covariance.hpp"

namespace trueaxis::calibrate_detail {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MachineFinding finding_of(const infer::Dictionary& dictionary, const std::vector<Term>& terms,
                          const Set& set, std::size_t at, const infer::SearchOptions& options) {
  const Term& term = terms[set[at]];
  const auto& block = dictionary.block(set[at]);
  const infer::Projection beside = dictionary.beside(infer::without(set, at));
  const infer::Solution all = dictionary.fitted(infer::with_last(set, at));
  const auto rank = static_cast<Index>(block.columns.size());
  const VectorXd a = all.coefficients.tail(rank);
  const double variance = all.rss / static_cast<double>(dictionary.rows() - all.rank);

  MachineFinding out;
  out.cause = term.of;
  out.p_value = infer::family_p(dictionary, options, beside, set[at]);
  const infer::Class found = infer::class_of(dictionary, set, at);
  for (const infer::Class::Member& member : found.members) out.rivals.push_back(member.rival);
  out.probability = found.probability;

  const VectorXd value = block.back * a;
  const MatrixXd covariance =
      variance * block.back * all.inverse.bottomRightCorner(rank, rank) * block.back.transpose();
  out.covariance = with_names(term.of.parameters, covariance);
  for (Index k = 0; k < value.size(); ++k)
    out.parameters.push_back(
        {term.of.parameters[static_cast<std::size_t>(k)],
         {value[k], std::sqrt(std::max(0.0, covariance(k, k))), term.of.unit, ""}});
  for (std::size_t k = 0; k < term.errors.size(); ++k) {
    ErrorTerm error = term.errors[k];
    error.function = scaled(error.function, value[static_cast<Index>(k)]);
    out.errors.push_back(std::move(error));
  }
  out.size = value.norm();
  // Over σ: the caller knows σ and the number of readings.
  out.rms_mm = std::sqrt(infer::left_of(beside, block.columns, a));
  return out;
}

}  // namespace trueaxis::calibrate_detail
