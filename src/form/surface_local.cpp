// SPDX-License-Identifier: Apache-2.0
#include "form/surface_local.hpp"

#include <algorithm>
#include <cmath>

#include "math/linear_algebra.hpp"
#include "math/statistics.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::form {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double widest_rad = two_pi / 12.0;                // beyond it is lobes
constexpr double widths[] = {1.0, 0.6, 0.35, 0.2, 0.12};    // over the widest
constexpr double lengths[] = {0.4, 0.2, 0.1, 0.05, 0.025};  // over the whole
constexpr double longest = 0.8;                             // of t: beyond it is lobes too
constexpr double least_steps = 0.6;  // a standard deviation, in steps from angle to angle
constexpr double least_waves = 4.5;  // of the highest order, in a radian of the width
constexpr Index most_cells = 96, most_cells_along = 40;
constexpr std::size_t most_readings = 16384;
constexpr double clipped_medians = 6.0;  // 4 σ of normal noise
constexpr double golden = 0.6180339887498949;
constexpr int steps_of_refining = 8;
constexpr double smallest_share = 1e-4;

/// He_k(x) exp(−x²/2).
class Hermite {
 public:
  explicit Hermite(double x) : x_(x), bell_(std::exp(-0.5 * x * x)) {}
  double of(int k) const {
    const double square = x_ * x_;
    return bell_ * (k == 0   ? 1.0
                    : k == 1 ? x_
                    : k == 2 ? square - 1.0
                             : square * (square - 6.0) + 3.0);
  }

 private:
  double x_, bell_;
};

MatrixXd kernel(Index cells, double step, double deviation, bool closed) {
  MatrixXd out(cells, cells);
  for (Index i = 0; i < cells; ++i)
    for (Index j = 0; j < cells; ++j) {
      double off = step * static_cast<double>(i - j);
      if (closed) off = std::remainder(off, two_pi);
      out(i, j) = std::exp(-0.5 * off * off / (deviation * deviation));
    }
  return out;
}

}  // namespace

bool LocalForm::differs(const LocalForm& from) const {
  constexpr double share = 0.05;
  const double around = std::abs(std::remainder(angle_rad - from.angle_rad, two_pi)) +
                        std::abs(width_rad - from.width_rad);
  return around > share * width_rad ||
         std::abs(t - from.t) + std::abs(length - from.length) > share * length;
}

LocalForm::Row LocalForm::at(double angle, double place) const {
  const Hermite around(std::remainder(angle - angle_rad, two_pi) / width_rad);
  Row out = along(place);
  for (std::size_t k = 0; k < shapes.size(); ++k)
    out[static_cast<Index>(k)] *= around.of(shapes[k].a);
  return out;
}

LocalForm::Row LocalForm::along(double place) const {
  const Hermite by((place - t) / length);
  Row out;
  for (std::size_t k = 0; k < shapes.size(); ++k) out[static_cast<Index>(k)] = by.of(shapes[k].b);
  return out;
}

/// The transform of He_a(u) exp(−u²/2) is (−iω)^a exp(−ω²/2) times that of ω = 0.
LocalForm::Pair LocalForm::around(int order) const {
  const double n = order, wave = n * width_rad;
  const double size =
      (order == 0 ? 1.0 : 2.0) * width_rad / std::sqrt(two_pi) * std::exp(-0.5 * wave * wave);
  if (size * std::max(1.0, std::pow(wave, 4)) < smallest_share * width_rad) return Pair::Zero();
  const double c = std::cos(n * angle_rad), s = std::sin(n * angle_rad);
  Pair out;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const int a = shapes[k].a;
    const double amplitude = (a == 2 ? -size : size) * std::pow(wave, a);
    out.col(static_cast<Index>(k)) << amplitude * (a == 1 ? -s : c), amplitude * (a == 1 ? c : s);
  }
  return out;
}

double height_of(const SurfaceTerms& terms, std::span<const LocalForm> local, const VectorXd& q,
                 double angle_rad, double t) {
  const VectorXd f = along(terms.degrees, t);
  double height = 0.0;
  for (int n = 0; n <= terms.orders; ++n) {
    const Index column = terms.column(n, 0), width = SurfaceTerms::width(n);
    double amplitude[2] = {0.0, 0.0};
    for (int d = 0; d <= terms.degrees_of(n); ++d)
      for (Index w = 0; w < width; ++w) amplitude[w] += f[d] * q[column + d * width + w];
    if (amplitude[0] != 0.0 || amplitude[1] != 0.0)
      height += amplitude[0] * std::cos(n * angle_rad) + amplitude[1] * std::sin(n * angle_rad);
  }
  Index from = terms.size();
  for (const LocalForm& one : local) {
    height += one.at(angle_rad, t).dot(q.segment<LocalForm::columns>(from));
    from += LocalForm::columns;
  }
  return height;
}

LocalFormSearch::LocalFormSearch(const SurfaceTerms& terms, const SurfaceData& data)
    : terms_(terms), data_(data) {
  // If there are many readings, some of them, at places that follow no step of the angles.
  const std::size_t all = data.t.size(), count = std::min(all, most_readings);
  const double step = static_cast<double>(all) / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double phase = count == all ? 0.0 : std::fmod(golden * static_cast<double>(i), 1.0);
    some_.push_back(
        std::min(all - 1, static_cast<std::size_t>((static_cast<double>(i) + phase) * step)));
  }
  const double per_turn = static_cast<double>(count) / data.turns;
  const auto angles = std::clamp(static_cast<Index>(2.0 * per_turn), Index{24}, most_cells);
  const auto places = std::clamp(static_cast<Index>(2.0 * data.turns), Index{8}, most_cells_along);
  const double step_rad = two_pi / static_cast<double>(angles),
               step_t = 2.0 / static_cast<double>(places);
  MatrixXd readings = MatrixXd::Zero(angles, places);
  for (const std::size_t i : some_) {
    const double turn = data.angle_rad[i] / two_pi - std::floor(data.angle_rad[i] / two_pi);
    const Cell cell{
        std::min(angles - 1, static_cast<Index>(turn * static_cast<double>(angles))),
        std::clamp(static_cast<Index>((data.t[i] + 1.0) / step_t), Index{0}, places - 1)};
    readings(cell.angle, cell.length) += 1.0;
    cell_.push_back(cell);
  }
  least_width_rad_ =
      std::max(least_steps * two_pi / per_turn, least_waves / static_cast<double>(terms.orders));
  least_length_ = least_steps * 2.0 / data.turns;
  double tests = 0.0;
  for (const double w : widths)
    for (const double l : lengths) {
      Size size{w * widest_rad, 2.0 * l, {}, {}, {}};
      if (size.width_rad < least_width_rad_ || size.length < least_length_) continue;
      size.around = kernel(angles, step_rad, size.width_rad, true);
      size.along = kernel(places, step_t, size.length, false);
      size.squares = linear::product(linear::product(size.around.cwiseAbs2(), readings),
                                     size.along.cwiseAbs2());
      // Places a standard deviation apart count as independent.
      tests += std::max(1.0, two_pi / size.width_rad) * std::max(1.0, 2.0 / size.length);
      sizes_.push_back(std::move(size));
    }
  log_tests_ = std::log(std::max(tests, 1.0));
}

std::optional<LocalFormSearch::Found> LocalFormSearch::best(std::span<const LocalForm> local,
                                                            const VectorXd& q,
                                                            double variance) const {
  if (sizes_.empty()) return {};
  const std::vector<double> left = left_mm(local, q);
  const Size& first = sizes_.front();
  MatrixXd sums = MatrixXd::Zero(first.around.rows(), first.along.rows());
  std::vector<double> size_mm;
  for (const double one : left) size_mm.push_back(std::abs(one));
  // So that a chip, which one reading meets, is not where a form is looked for.
  const double most_mm = clipped_medians * median(size_mm);
  for (std::size_t k = 0; k < some_.size(); ++k)
    sums(cell_[k].angle, cell_[k].length) += std::clamp(left[k], -most_mm, most_mm);
  LocalForm form;
  double gain = 0.0;
  const double step_rad = two_pi / static_cast<double>(sums.rows()),
               step_t = 2.0 / static_cast<double>(sums.cols());
  for (const Size& size : sizes_) {
    const MatrixXd found = linear::product(linear::product(size.around, sums), size.along);
    Index a = 0, b = 0;
    const double most =
        (found.array().square() / size.squares.array().max(least_steps)).maxCoeff(&a, &b);
    if (most <= gain) continue;
    gain = most;
    form = {step_rad * (static_cast<double>(a) + 0.5), size.width_rad,
            step_t * (static_cast<double>(b) + 0.5) - 1.0, size.length};
  }
  if (gain < variance) return {};
  refine(left, form, gain);
  if (gain_all_round(left, form) > gain) return {};
  gain = gain_without_strongest(left, form);
  // As many readings as were looked at stand for all.
  const double of_all = static_cast<double>(data_.t.size()) / static_cast<double>(some_.size());
  const double over = of_all * gain / variance;
  return Found{form, 0.5 * (over - std::log(1.0 + over)) - log_tests_};
}

std::vector<double> LocalFormSearch::left_mm(std::span<const LocalForm> local,
                                             const VectorXd& q) const {
  std::vector<double> left;
  for (const std::size_t i : some_)
    left.push_back(data_.height_mm[i] -
                   height_of(terms_, local, q, data_.angle_rad[i], data_.t[i]));
  return left;
}

/// What the form gains by the readings without the two that speak for it most.
double LocalFormSearch::gain_without_strongest(const std::vector<double>& left,
                                               const LocalForm& form) const {
  std::vector<std::pair<double, double>> each;  // product and square
  double product = 0.0, square = 0.0;
  for (std::size_t k = 0; k < some_.size(); ++k) {
    const double g = form.at(data_.angle_rad[some_[k]], data_.t[some_[k]])[0];
    each.emplace_back(g * left[k], g * g);
    product += each.back().first, square += each.back().second;
  }
  const double sign = product < 0.0 ? -1.0 : 1.0;
  std::ranges::partial_sort(each, each.begin() + 2, std::ranges::greater{},
                            [&](const auto& one) { return sign * one.first; });
  for (int k = 0; k < 2; ++k) {
    product -= each[static_cast<std::size_t>(k)].first;
    square -= each[static_cast<std::size_t>(k)].second;
  }
  return sign * product > 0.0 && square > 0.0 ? product * product / square : 0.0;
}

/// What radius and centre about the place gain. A course that no degree follows gains more by them.
double LocalFormSearch::gain_all_round(const std::vector<double>& left,
                                       const LocalForm& form) const {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < some_.size(); ++k) {
    const double angle = data_.angle_rad[some_[k]];
    const Eigen::Vector3d row =
        form.along(data_.t[some_[k]])[0] * Eigen::Vector3d(1.0, std::cos(angle), std::sin(angle));
    normal += row * row.transpose();
    right += row * left[k];
  }
  return right.dot(linear::pseudo_inverse(normal) * right);
}

LocalForm LocalFormSearch::refined(std::span<const LocalForm> local, const VectorXd& q,
                                   std::size_t which) const {
  LocalForm form = local[which];
  double gain = 0.0;
  refine(left_mm(local, q), form, gain);
  return form;
}

/// Gauss-Newton, with radius, cone and axis fitted anew at every step.
void LocalFormSearch::refine(const std::vector<double>& left_mm, LocalForm& form,
                             double& gain) const {
  constexpr Index base = 6, own = 5, all = base + own;
  const auto n = static_cast<Index>(some_.size());
  gain = 0.0;
  LocalForm trial = form;
  for (int step = 0; step < steps_of_refining; ++step) {
    MatrixXd normal = MatrixXd::Zero(all, all);
    VectorXd right = VectorXd::Zero(all), row(all);
    for (Index k = 0; k < n; ++k) {
      const std::size_t i = some_[static_cast<std::size_t>(k)];
      const double c = std::cos(data_.angle_rad[i]), s = std::sin(data_.angle_rad[i]),
                   t = data_.t[i];
      row << 1.0, t, c, s, t * c, t * s, trial.at(data_.angle_rad[i], t).head<own>().transpose();
      normal.selfadjointView<Eigen::Lower>().rankUpdate(row);
      right += left_mm[static_cast<std::size_t>(k)] * row;
    }
    normal.triangularView<Eigen::StrictlyUpper>() = normal.transpose();
    // The bump alone in addition to the base: what it gains, and its height.
    const MatrixXd corner = normal.topLeftCorner(base, base);
    const MatrixXd by =
        linear::product(linear::pseudo_inverse(corner), MatrixXd(normal.block(0, base, base, own)));
    const MatrixXd rest =
        normal.bottomRightCorner(own, own) -
        linear::transposed_product(by, MatrixXd(normal.block(0, base, base, own)));
    const VectorXd of_rest = right.tail(own) - by.transpose() * right.head(base);
    if (!(rest(0, 0) > 0.0)) return;
    const double gained = of_rest[0] * of_rest[0] / rest(0, 0);
    if (gained <= gain * (1.0 + 1e-6)) return;
    gain = gained;
    form = trial;
    const VectorXd x = linear::pseudo_inverse(rest) * of_rest;
    if (x[0] == 0.0) return;
    const auto moved = [&](Index k) { return std::clamp(x[k] / x[0], -0.4, 0.4); };
    trial.angle_rad += moved(1) * form.width_rad;
    trial.width_rad = std::clamp(form.width_rad * (1.0 + moved(2)), least_width_rad_, widest_rad);
    trial.t = std::clamp(form.t + moved(3) * form.length, -1.0, 1.0);
    trial.length = std::clamp(form.length * (1.0 + moved(4)), least_length_, longest);
  }
}

}  // namespace trueaxis::form
