// SPDX-License-Identifier: Apache-2.0
#include "calibrate/diagnose/explain.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "infer/classes.hpp"
#include "infer/cross_validation.hpp"
#include "infer/stepwise.hpp"
#include "math/covariance.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::calibrate_detail {
namespace {

constexpr int highest_alias = 12;
constexpr double sure_of_order = 0.95;
constexpr double same_part = 1e-3;  // of a column's square that is left

MatrixXd waves(const VectorXd& position, int order) {
  MatrixXd out(position.size(), 2);
  out << (order * position.array()).cos().matrix(), (order * position.array()).sin().matrix();
  return out.rowwise() - out.colwise().mean();
}

/// Whether every column that is there lies in those of `basis`.
bool within(const MatrixXd& columns, const MatrixXd& basis) {
  const MatrixXd left = columns - linear::product(basis, linear::least_squares(basis, columns));
  bool any = false;
  for (Index j = 0; j < columns.cols(); ++j) {
    const double whole = columns.col(j).squaredNorm();
    if (whole < same_part * static_cast<double>(columns.rows())) continue;
    any = true;
    if (left.col(j).squaredNorm() > same_part * whole) return false;
  }
  return any;
}

}  // namespace

void weigh_aliases(const Problem& problem, const Term& term, MachineFinding& finding) {
  const auto* error = std::get_if<ErrorOfPosition>(&term.of.term);
  if (!error || term.of.shape.empty() || term.of.shape.front().name != "order") return;
  const std::size_t axis = error->of ? index_of(*error->of) : error->error.body;
  VectorXd position(static_cast<Index>(problem.rows.size()));
  for (std::size_t i = 0; i < problem.rows.size(); ++i)
    position[static_cast<Index>(i)] = problem.rows[i].axes[axis];
  const double own = term.of.shape.front().value;
  const MatrixXd basis = waves(position, static_cast<int>(own));
  double sum = 1.0 / (own * own);
  for (int order = 5; order <= highest_alias; ++order) {
    if (order == own || !within(waves(position, order), basis)) continue;
    sum += 1.0 / (order * order);
    finding.alias += (finding.alias.empty() ? "order " : ", ") + std::to_string(order);
  }
  const double share = 1.0 / (own * own * sum);
  finding.likely_order = share >= sure_of_order;
  finding.probability *= share;
  for (Rival& rival : finding.rivals) rival.probability *= share;
}

std::vector<std::array<std::string, 2>> pairs_like(const infer::Dictionary& dictionary,
                                                   const std::vector<Term>& terms, const Set& set,
                                                   std::size_t at, const MachineFinding& finding) {
  constexpr std::size_t of_terms = 60, most = 5;
  constexpr double least_part = 0.02;  // of a cause that one member makes alone
  if (terms[set[at]].is_pattern()) return {};
  const infer::Projection beside = dictionary.beside(infer::without(set, at));
  const infer::Columns& own = dictionary.block(set[at]).columns;
  const infer::Solution all = dictionary.fitted(infer::with_last(set, at));
  const VectorXd a = all.coefficients.tail(static_cast<Index>(own.size()));
  const double whole = infer::left_of(beside, own, a);
  const double near = infer::told_apart * infer::told_apart * dictionary.variance(set);
  /// What columns make of the cause, and their coefficients.
  const auto made = [&](const infer::Columns& columns, VectorXd& share) {
    const VectorXd cross = beside.gram(columns, own) * a;
    share = linear::least_squares(beside.gram(columns, columns), cross);
    return share.dot(cross);
  };
  const auto listed = finding.members();
  std::vector<std::pair<double, std::size_t>> alone;
  VectorXd share;
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const infer::Columns& columns = dictionary.block(t).columns;
    if (terms[t].is_pattern() || columns.empty() || std::ranges::find(set, t) != set.end() ||
        terms[t].is_slip() || std::ranges::find(listed, terms[t].effect()) != listed.end())
      continue;
    if (const double part = made(columns, share); part >= least_part * whole)
      alone.emplace_back(-part, t);
  }
  std::ranges::sort(alone);
  if (alone.size() > of_terms) alone.resize(of_terms);
  std::vector<std::pair<double, std::array<std::string, 2>>> found;
  for (std::size_t i = 0; i < alone.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Set pair{alone[i].second, alone[j].second};
      if (terms[pair[0]].effect() == terms[pair[1]].effect()) continue;
      const double rest = whole - made(dictionary.columns_of(pair), share);
      if (rest >= near) continue;
      bool plausible = true;
      Index from = 0;
      for (const std::size_t t : pair) {
        const auto& block = dictionary.block(t);
        const auto rank = static_cast<Index>(block.columns.size());
        plausible = plausible && (block.back * share.segment(from, rank)).norm() <= block.largest;
        from += rank;
      }
      if (plausible) found.push_back({rest, {terms[pair[1]].effect(), terms[pair[0]].effect()}});
    }
  std::ranges::sort(found);
  std::vector<std::array<std::string, 2>> out;
  for (const auto& [rest, pair] : found)
    if (out.size() < most) out.push_back(pair);
  return out;
}

void add_checks(const TipFit& fit, const infer::Dictionary& dictionary, const Set& found,
                bool timed, const CalibrationOptions& options, MachineDiagnosis& out) {
  const MatrixXd columns = dictionary.columns(found);
  VectorXd left = dictionary.residuals();
  if (columns.cols() > 0) left -= columns * linear::least_squares(columns, left);
  const auto freedom = static_cast<double>(dictionary.rows() - dictionary.fitted(found).rank);
  const double sigma = std::sqrt(left.squaredNorm() / freedom);
  QualityCheck noise{"noise", false, "no noise is stated: it is estimated from the residuals"};
  if (fit.problem.noise_stated) {
    const boost::math::chi_squared chi(freedom);
    const double below = cdf(chi, left.squaredNorm());
    noise.found = below < 1e-3 || below > 1.0 - 1e-3;
    noise.text = fmt::format("the residuals are {:.3g} times the stated noise", sigma);
  }
  out.checks.push_back(noise);
  Index worst = 0;
  const double most = left.cwiseAbs().maxCoeff(&worst) / sigma;
  const double p = std::min(
      1.0, 2.0 * static_cast<double>(left.size()) * cdf(complement(boost::math::normal(), most)));
  out.checks.push_back(
      {"outlier", p < 0.01,
       fmt::format("the largest residual is {:.3g} standard deviations ({}; p {:.2g})", most,
                   row_in_words(fit.problem, worst), p)});
  out.checks.push_back({"times", !timed,
                        timed ? "every row has its time"
                              : "the rows have no times: drift and warming up cannot be detected"});
  const std::string beyond = beyond_plausible(out.baseline, options);
  out.checks.push_back(
      {"location", !beyond.empty(),
       beyond.empty() ? "every location error is as small as machines have them" : beyond});
}

void add_remarks(MachineDiagnosis& out) {
  for (const MachineFinding& finding : out.findings) {
    if (!finding.likely_order)
      out.remarks.push_back(finding.effect() + ": these positions read " + finding.alias +
                            " alike, so the order is the most likely one, not certain");
    for (const auto& [one, other] : finding.pairs)
      out.remarks.push_back(finding.effect() + " is not told from " + one + " and " + other +
                            " together");
  }
  if (std::ranges::any_of(out.unexplained, &MachineUnexplained::may_have_a_name))
    out.remarks.push_back(
        "a cause that shares its axis with an unknown pattern may be part of the pattern. It is "
        "not named, but remains in the model");
}

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
      variance * linear::propagated(block.back, all.inverse.bottomRightCorner(rank, rank));
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

namespace {

constexpr std::size_t most_blocks = 30;

/// The block of every row: rotary positions (of read-outs those of the axis) in the order in which
/// they came, cut into blocks.
std::vector<std::size_t> blocks_of(const Problem& problem, std::size_t& count) {
  using Rotary = std::array<double, 3>;
  std::vector<Rotary> different;  // of read-outs: the file and the position of its axis
  std::vector<std::size_t> place;
  for (const Row& row : problem.rows) {
    const Rotary at =
        row.read_out ? Rotary{static_cast<double>(row.file), row.axes[index_of(*row.read_out)], 0.0}
                     : Rotary{row.axes[3], row.axes[4], row.axes[5]};
    const auto found = std::ranges::find(different, at);
    place.push_back(static_cast<std::size_t>(found - different.begin()));
    if (found == different.end()) different.push_back(at);
  }
  count = std::min(most_blocks, different.size());
  for (std::size_t& one : place) one = one * count / different.size();
  return place;
}

}  // namespace

void hold_out(const Problem& problem, const MatrixXd& columns, Index base, const VectorXd& readings,
              MachineDiagnosis& out) {
  const std::vector<std::size_t> block_of_row = blocks_of(problem, out.blocks);
  if (out.blocks < 2) return;
  MatrixXd all(columns.rows(), columns.cols() + 1);
  all << readings, columns;
  infer::Columns before(static_cast<std::size_t>(base)),
      after(static_cast<std::size_t>(columns.cols()));
  std::iota(before.begin(), before.end(), 1U);
  std::iota(after.begin(), after.end(), 1U);
  const bool lengths = !std::ranges::all_of(problem.rows, &Row::angle);
  std::vector<infer::Fold> folds;
  for (std::size_t block = 0; block < out.blocks; ++block) {
    std::vector<Index> held;
    double sigma2 = 0.0;
    for (std::size_t i = 0; i < problem.rows.size(); ++i) {
      const Row& row = problem.rows[i];
      if (block_of_row[i] != block || (lengths && row.angle())) continue;
      for (Index k = 0; k < row.equations(); ++k) held.push_back(row.first + k);
      sigma2 += static_cast<double>(row.equations()) * row.sigma_mm * row.sigma_mm;
    }
    if (held.empty()) continue;
    const MatrixXd own = all(held, Eigen::all);
    const auto n = static_cast<double>(held.size());
    // Over σ here; mm by the mean σ of the block.
    folds.push_back({linear::gram(own), n, sigma2 / n});
  }
  out.blocks = folds.size();
  infer::cross_validate(linear::gram(all), folds, before, after, out.gain);
  if (lengths) return;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();  // of angles only the ratio
  for (auto* interval : {&out.gain.held_out_before_mm, &out.gain.held_out_after_mm})
    interval->value = interval->low = interval->high = none;
}

}  // namespace trueaxis::calibrate_detail
