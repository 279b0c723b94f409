// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "format/units.hpp"
#include "machine/files/error_sizes.hpp"
#include "machine/files/errors_files.hpp"
#include "machine/files/toml_parts.hpp"
#include "machine/uncertainty.hpp"
#include "math/covariance.hpp"
#include "math/linear_algebra.hpp"

namespace trueaxis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double as_rounded = 1e-6;  // of 1: what nine digits leave of symmetry and of no variance
constexpr double same_u = 2e-3;

void read_shape(TomlTable& table, bool rotary, UncertainAmount& amount) {
  using Shape = UncertainAmount::Shape;
  const std::string range = rotary ? "range_rad" : "range_mm";
  const std::string period = rotary ? "period_rad" : "period_mm";
  int shapes = 0;
  const auto take = [&](const char* key, Shape shape) {
    const auto order = table.maybe_integer(key, 1, 100);
    if (!order) return;
    ++shapes;
    amount.shape = shape;
    amount.order = static_cast<int>(*order);
  };
  take("degree", Shape::legendre);
  take("cos", Shape::cosine);
  take("sin", Shape::sine);
  if (shapes > 1) table.complain("degree", "is one of degree, cos and sin: remove the others");
  if (shapes > 0 && !amount.name.component)
    table.complain("name", "is a location error: a constant, without degree, cos or sin");
  if (amount.shape == Shape::legendre) {
    const std::vector<double> ends = table.numbers(range);
    if (ends.size() == 2 && ends[0] < ends[1])
      amount.low = ends[0], amount.high = ends[1];
    else
      table.complain(range,
                     "is needed with degree: the range of Legendre's polynomial, [low, "
                     "high]");
  } else if (amount.shape != Shape::constant) {
    amount.high = rotary ? table.number(period, two_pi, Range::positive())
                         : table.required_number(period, Range::positive());
  }
}

std::vector<UncertainAmount> read_amounts(TomlTable& table, const Machine& machine) {
  std::vector<UncertainAmount> amounts;
  for (TomlTable& entry : table.tables("amounts")) {
    const std::string text = entry.required_text("name");
    const auto name = parse_error_name(text);
    const std::string trouble = text.empty() ? "" : error_name_trouble(text, machine);
    if (!trouble.empty()) entry.complain("name", trouble);
    if (!name) {
      entry.ignore_rest();
      continue;
    }
    UncertainAmount amount{.name = *name};
    read_shape(entry, name->body >= 3 && name->body < axis_count, amount);
    if (without_effect(*name)) entry.complain("name", "is " + text + ", which has no effect");
    if (std::ranges::find(amounts, amount) != amounts.end())
      entry.complain("name", "is " + to_string(amount) + " for the second time");
    amounts.push_back(amount);
  }
  return amounts;
}

/// By rows: all n² numbers, or the n(n + 1)/2 up to the diagonal.
std::optional<MatrixXd> square_of(const std::vector<double>& numbers, Index n) {
  const auto count = static_cast<Index>(numbers.size());
  if (count != n * n && count != n * (n + 1) / 2) return std::nullopt;
  MatrixXd out(n, n);
  std::size_t at = 0;
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < (count == n * n ? n : i + 1); ++j) {
      out(i, j) = numbers[at++];
      if (count != n * n) out(j, i) = out(i, j);
    }
  return out;
}

/// Why a matrix is not a covariance; "": it is one.
std::string trouble_of(const MatrixXd& matrix, const std::vector<UncertainAmount>& amounts) {
  const auto name = [&](Index i) { return to_string(amounts[static_cast<std::size_t>(i)]); };
  const VectorXd u = matrix.diagonal().cwiseMax(0.0).cwiseSqrt();
  MatrixXd correlation = MatrixXd::Identity(matrix.rows(), matrix.cols());
  for (Index i = 0; i < matrix.rows(); ++i) {
    if (matrix(i, i) < 0.0) return "has a negative variance of " + name(i);
    for (Index j = 0; j < i; ++j) {
      const double size = u[i] * u[j];
      const std::string pair = name(i) + " and " + name(j);
      if (std::abs(matrix(i, j) - matrix(j, i)) > as_rounded * size)
        return "is not symmetric: see " + pair;
      if (std::abs(matrix(i, j)) > (1.0 + as_rounded) * size)
        return "has a covariance of " + pair + " that is more than the product of their u";
      if (size > 0.0) correlation(i, j) = correlation(j, i) = matrix(i, j) / size;
    }
  }
  const double least = linear::eigenvalues(correlation)[0];
  if (least < -as_rounded * static_cast<double>(matrix.rows()))
    return fmt::format(
        "is not a covariance: a sum of its amounts would have a negative variance "
        "(least eigenvalue of the correlations {:.3g})",
        least);
  return "";
}

/// u that no error of a machine has (error_sizes.hpp).
void check_sizes(TomlTable& table, const ErrorCovariance& covariance) {
  for (std::size_t i = 0; i < covariance.size(); ++i) {
    const std::string trouble = size_trouble(covariance.names()[i].name, covariance.u(i));
    if (!trouble.empty()) table.complain("matrix", "as u " + trouble);
  }
}

/// u of entries of one name, squares added, against that of the matrix.
void check_u(TomlTable& table, const ErrorCovariance& covariance, const ErrorModel& errors) {
  for (std::size_t i = 0; i < covariance.size(); ++i) {
    const UncertainAmount& amount = covariance.names()[i];
    if (amount.shape != UncertainAmount::Shape::constant) continue;
    double square = 0.0;
    for (const ErrorTerm& term : errors.terms)
      if (term.name == amount.name) square += term.u * term.u;
    const double u = covariance.u(i), said = std::sqrt(square);
    if (square == 0.0 || std::abs(said - u) <= same_u * u) continue;
    const double factor = amount.name.angular() ? 1e6 : 1e3;
    table.complain("matrix", fmt::format("has u = {:.6g} {} of {}, whose entries say {:.6g}: take "
                                         "u out of the entries or make both alike",
                                         factor * u, amount.name.angular() ? "urad" : "um",
                                         to_string(amount.name), factor * said));
  }
}

}  // namespace

void read_covariance(TomlTable& root, const Machine& machine, bool large_errors,
                     ErrorModel& errors) {
  auto table = root.maybe_table("covariance");
  if (!table) return;
  const auto length = table->required_choice<double>(
      "length", {unit_choice("um"), unit_choice("mm"), unit_choice("m"), unit_choice("in")});
  const auto angle = table->required_choice<double>(
      "angle", {unit_choice("urad"), unit_choice("mrad"), unit_choice("rad"), unit_choice("deg"),
                unit_choice("arcsec")});
  std::vector<UncertainAmount> amounts = read_amounts(*table, machine);
  const auto n = static_cast<Index>(amounts.size());
  auto matrix = square_of(table->numbers("matrix"), n);
  if (n == 0 || !matrix) {
    if (n == 0) table->complain("amounts", "is needed: tables such as {name = \"X0C\"}");
    if (!matrix)
      table->complain("matrix", fmt::format("must hold the covariance of {} amounts by rows: {} "
                                            "numbers, or {} up to the diagonal",
                                            n, n * n, n * (n + 1) / 2));
    return;
  }
  if (const std::string trouble = trouble_of(*matrix, amounts); !trouble.empty()) {
    table->complain("matrix", trouble);
    return;
  }
  VectorXd unit(n);
  for (Index i = 0; i < n; ++i)
    unit[i] = amounts[static_cast<std::size_t>(i)].name.angular() ? angle : length;
  ErrorCovariance covariance =
      with_names(std::move(amounts), unit.asDiagonal() * *matrix * unit.asDiagonal());
  check_u(*table, covariance, errors);
  if (!large_errors) check_sizes(*table, covariance);
  for (ErrorTerm& term : errors.terms)
    if (covariance.find(UncertainAmount{.name = term.name})) term.u = 0.0;
  errors.covariance = std::move(covariance);
}

std::string covariance_toml(const ErrorCovariance& covariance) {
  const std::size_t n = covariance.size();
  if (n == 0) return "";
  std::string text =
      "\n[covariance] # of amounts that multiply 1, a Legendre polynomial, a cosine or a sine; by "
      "rows up to the diagonal\nlength = \"um\"\nangle = \"urad\"\namounts = [\n";
  std::vector<double> factor;
  for (const UncertainAmount& amount : covariance.names()) {
    const bool rotary = amount.name.body >= 3 && amount.name.body < axis_count;
    const double per = rotary ? 1.0 / rad_per_deg : 1.0;
    const char* const unit = rotary ? "deg" : "mm";
    factor.push_back(amount.name.angular() ? 1e6 : 1e3);
    text += "  {name = \"" + to_string(amount.name) + '"';
    if (amount.shape == UncertainAmount::Shape::legendre)
      text += fmt::format(", degree = {}, range_{} = [{}, {}]", amount.order, unit,
                          per * amount.low, per * amount.high);
    else if (amount.shape != UncertainAmount::Shape::constant)
      text += fmt::format(", {} = {}, period_{} = {}",
                          amount.shape == UncertainAmount::Shape::sine ? "sin" : "cos",
                          amount.order, unit, per * (amount.high - amount.low));
    text += "},\n";
  }
  text += "]\nmatrix = [\n";
  for (std::size_t i = 0; i < n; ++i) {
    text += " ";
    for (std::size_t j = 0; j <= i; ++j)
      text += fmt::format(" {:.9g},", factor[i] * factor[j] * covariance(i, j));
    text += '\n';
  }
  return text + "]\n";
}

}  // namespace trueaxis
