// SPDX-License-Identifier: Apache-2.0
#include "calibrate/diagnose/remarks.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "infer/classes.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis::calibrate_detail {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

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

std::string data_row(const TipFit& fit, Index equation) {
  const auto row = std::ranges::find_if(fit.problem.rows, [&](const Row& one) {
    return equation >= one.first && equation < one.first + one.equations();
  });
  return fmt::format("row {} of file {}", row->row + 1, row->file + 1);
}

}  // namespace

void weigh_aliases(const Problem& problem, const Term& term, MachineFinding& finding) {
  const auto* error = term.of ? std::get_if<ErrorOfPosition>(&term.of->term) : nullptr;
  if (!error || term.shape.empty() || term.shape.front().name != "order") return;
  const std::size_t axis = error->of ? index_of(*error->of) : error->error.body;
  VectorXd position(static_cast<Index>(problem.rows.size()));
  for (std::size_t i = 0; i < problem.rows.size(); ++i)
    position[static_cast<Index>(i)] = problem.rows[i].axes[axis];
  const double own = term.shape.front().value;
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

std::vector<std::array<std::string, 2>> pairs_like(const Regression& regression,
                                                   const std::vector<Term>& terms,
                                                   const Regression::Set& set, std::size_t at,
                                                   const MachineFinding& finding,
                                                   const CalibrationOptions& options) {
  constexpr std::size_t of_terms = 60, most = 5;
  constexpr double least_part = 0.02;  // of a finding that a member makes alone
  if (terms[set[at]].pattern) return {};
  const infer::Projection beside = regression.beside(without(set, at));
  const infer::Columns& own = regression.block(set[at]).columns;
  const infer::Solution all = regression.fitted(with_last(set, at));
  const VectorXd a = all.coefficients.tail(static_cast<Index>(own.size()));
  const double whole = infer::left_of(beside, own, a);
  const double near = infer::told_apart * infer::told_apart * regression.variance(set);
  /// What columns make of the finding, and their coefficients.
  const auto made = [&](const infer::Columns& columns, VectorXd& share) {
    const VectorXd cross = beside.gram(columns, own) * a;
    share = linear::least_squares(beside.gram(columns, columns), cross);
    return share.dot(cross);
  };
  const auto listed = finding.members();
  std::vector<std::pair<double, std::size_t>> alone;
  VectorXd share;
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const infer::Columns& columns = regression.block(t).columns;
    if (terms[t].pattern || columns.empty() || std::ranges::find(set, t) != set.end() ||
        terms[t].is_slip() || std::ranges::find(listed, terms[t].effect) != listed.end())
      continue;
    if (const double part = made(columns, share); part >= least_part * whole)
      alone.emplace_back(-part, t);
  }
  std::ranges::sort(alone);
  if (alone.size() > of_terms) alone.resize(of_terms);
  std::vector<std::pair<double, std::array<std::string, 2>>> found;
  for (std::size_t i = 0; i < alone.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Regression::Set pair{alone[i].second, alone[j].second};
      if (terms[pair[0]].effect == terms[pair[1]].effect) continue;
      const double rest = whole - made(regression.columns_of(pair), share);
      if (rest >= near) continue;
      bool plausible = true;
      Index from = 0;
      for (const std::size_t t : pair) {
        const auto& block = regression.block(t);
        const auto rank = static_cast<Index>(block.columns.size());
        plausible = plausible &&
                    (block.back * share.segment(from, rank)).norm() <=
                        (terms[t].angle ? options.largest_angle_rad : options.largest_length_mm);
        from += rank;
      }
      if (plausible) found.push_back({rest, {terms[pair[1]].effect, terms[pair[0]].effect}});
    }
  std::ranges::sort(found);
  std::vector<std::array<std::string, 2>> out;
  for (const auto& [rest, pair] : found)
    if (out.size() < most) out.push_back(pair);
  return out;
}

double independent_tests(const Regression& regression, const std::vector<Term>& terms) {
  Regression::Set effects;
  for (std::size_t t = 0; t < terms.size(); ++t)
    if (!terms[t].pattern) effects.push_back(t);
  const infer::Columns columns = regression.columns_of(effects);
  if (columns.empty()) return 0.0;
  const MatrixXd products = regression.gram()(columns, columns);
  double sum = 0.0;
  for (const double value : linear::eigenvalues(products))
    if (value > 1e-9) sum += (value >= 1.0 ? 1.0 : 0.0) + value - std::floor(value);
  return sum;
}

void add_checks(const TipFit& fit, const Regression& regression, const Regression::Set& found,
                bool timed, MachineDiagnosis& out) {
  const MatrixXd columns = regression.columns(found);
  VectorXd left = regression.residuals();
  if (columns.cols() > 0) left -= columns * linear::least_squares(columns, left);
  const auto freedom = static_cast<double>(regression.rows() - regression.fitted(found).rank);
  const double sigma = std::sqrt(left.squaredNorm() / freedom);
  QualityCheck noise{"noise", false, "no noise is stated: the residuals give it"};
  if (fit.problem.noise_stated) {
    const boost::math::chi_squared chi(freedom);
    const double below = cdf(chi, left.squaredNorm());
    noise.found = below < 1e-3 || below > 1.0 - 1e-3;
    noise.text = fmt::format("the residuals are {:.3g} times the noise that is stated", sigma);
  }
  out.checks.push_back(noise);
  Index worst = 0;
  const double most = left.cwiseAbs().maxCoeff(&worst) / sigma;
  const double p = std::min(
      1.0, 2.0 * static_cast<double>(left.size()) * cdf(complement(boost::math::normal(), most)));
  out.checks.push_back(
      {"outlier", p < 0.01,
       fmt::format("the largest residual is {:.3g} standard deviations ({}; p {:.2g})", most,
                   data_row(fit, worst), p)});
  out.checks.push_back({"times", !timed,
                        timed ? "every row has its time"
                              : "the rows have no times: drift and warming up are not looked for"});
}

void add_remarks(MachineDiagnosis& out) {
  for (const MachineFinding& finding : out.findings) {
    if (!finding.likely_order)
      out.remarks.push_back(finding.effect + ": these positions read " + finding.alias +
                            " alike, so that the order is the likeliest and not certain");
    for (const auto& [one, other] : finding.pairs)
      out.remarks.push_back(finding.effect + " is not told from " + one + " and " + other +
                            " together");
  }
  for (const MachineUnexplained& one : out.unexplained)
    if (one.pattern.ends_with("unknown"))
      return out.remarks.push_back(
          "what shares its axis with an unknown pattern may be part of it and is not named; it "
          "stays in the model");
}

}  // namespace trueaxis::calibrate_detail
