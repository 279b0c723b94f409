// SPDX-License-Identifier: Apache-2.0
#include "calibrate/estimate/read_out.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "base/angle.hpp"
#include "calibrate/estimate/periodic_fit.hpp"
#include "calibrate/estimate/read_out_rows.hpp"
#include "calibrate/estimate/unknown.hpp"
#include "infer/significance.hpp"
#include "math/fourier_sums.hpp"
#include "math/statistics.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::calibrate_detail {
namespace {

constexpr double oversampling = 8.0;        // points of the periodogram a resolution width
constexpr std::size_t least_readings = 24;  // for something periodic to be looked for
constexpr int most_divisions = 8;           // orders of the period that its strongest line may be
constexpr int most_gear_orders = 4;         // of a gear's turn
constexpr double false_alarm = 0.01;

struct Band {
  double low = 0.0, high = 0.0, step = 0.0;  ///< per mm or rad
};

/// From one and a half undulations over the range to half the mean density of the positions.
Band band_of(const std::vector<double>& position) {
  const Extent range = range_of(position);
  const std::set<double> different(position.begin(), position.end());
  const double density = static_cast<double>(different.size() - 1) / range.length();
  return {1.5 / range.length(), 0.5 * density, 1.0 / (oversampling * range.length())};
}

bool passes(double log_p, double tests) {
  return infer::Family{tests}.p_value(std::exp(log_p)) < false_alarm;
}

/// The strongest line of the residuals, refined with four of its multiples; 0 if it could be noise.
double strongest_line(const PeriodicFit& fit, const Band& band) {
  const PeriodicFit::Result smooth = fit.with({}, 1.0);
  const auto count = static_cast<std::size_t>((band.high - band.low) / band.step) + 1;
  const FourierSums sums(fit.position(), two_pi * band.low, two_pi * band.step, count);
  const FourierSums::Sums lines = sums.of(smooth.residuals);
  const auto top = std::ranges::max_element(
      lines, {}, [](const std::complex<double>& line) { return std::norm(line); });
  const double start = band.low + band.step * static_cast<double>(top - lines.begin());
  const auto rss = [&](double frequency) {
    return fit.with(fit.orders_up_to(5, 1.0 / frequency, band.high), 1.0 / frequency).rss;
  };
  const double frequency = least_of(rss, start - band.step, start + band.step);
  const double left = fit.with({1}, 1.0 / frequency).rss;
  const double log_p = infer::log_p_value(smooth.rss - left, 2.0, smooth.rss, smooth.freedom);
  return passes(log_p, static_cast<double>(count)) ? frequency : 0.0;
}

/// The orders of a period that are significant, and its Bayesian information criterion.
struct Choice {
  double period = 0.0, criterion = 0.0;
  std::vector<int> orders;
};

Choice choose(const PeriodicFit& fit, double period, std::vector<int> orders) {
  Choice choice{period, 0.0, std::move(orders)};
  const auto n = static_cast<double>(fit.position().size());
  const PeriodicFit::Result all = fit.with(choice.orders, period);
  const double tests = static_cast<double>(choice.orders.size());
  std::vector<int> real;
  for (std::size_t k = 0; k < choice.orders.size(); ++k)
    if (passes(infer::log_p_value(all.gains[k], 2.0, all.rss + all.gains[k], all.freedom + 2.0),
               tests))
      real.push_back(choice.orders[k]);
  choice.orders = real;
  choice.criterion = n * std::log(std::max(fit.with(real, period).rss, 1e-300)) +
                     2.0 * std::log(n) * static_cast<double>(real.size());
  return choice;
}

/// Orders that are all multiples of one are orders of a shorter period.
Choice in_shortest(Choice choice) {
  int common = 0;
  for (const int order : choice.orders) common = std::gcd(common, order);
  if (common < 2) return choice;
  choice.period /= common;
  for (int& order : choice.orders) order /= common;
  return choice;
}

Choice best_period(const PeriodicFit& fit, int max_orders) {
  Choice best;
  const auto& position = fit.position();
  if (position.size() < least_readings) return best;
  const Band band = band_of(position);
  if (!(band.high > band.low)) return best;
  const double line = strongest_line(fit, band);
  if (line == 0.0) return best;
  for (int k = 1; k <= most_divisions && k / line <= range_of(position).length(); ++k) {
    Choice one =
        in_shortest(choose(fit, k / line, fit.orders_up_to(max_orders, k / line, band.high)));
    // The same lines of a longer period differ by rounding only.
    if (!one.orders.empty() && (best.period == 0.0 || one.criterion < best.criterion - 1e-3))
      best = std::move(one);
  }
  if (best.period == 0.0) return best;
  const double off = 0.1 * best.period * best.period * band.step;
  best.period = least_of([&](double period) { return fit.with(best.orders, period).rss; },
                         best.period - off, best.period + off);
  return best;
}

constexpr double whole_turn_gap_rad = 60.0 * rad_per_deg;  // the widest of a turn that was measured
constexpr double free_period_turns = 2.0;                  // below, a period is that of the turn
constexpr double clearly = 10.0;                           // Bayesian information: 150 to 1
constexpr std::size_t least_of_a_sense = 3;                // readings for a reversal value

/// The widest gap that positions leave in the circle, rad.
double widest_gap_rad(const std::vector<double>& position_rad) {
  std::vector<double> on_turn;
  for (const double at : position_rad) on_turn.push_back(within_turn(at));
  std::ranges::sort(on_turn);
  double widest = on_turn.front() + two_pi - on_turn.back();
  for (std::size_t i = 1; i < on_turn.size(); ++i)
    widest = std::max(widest, on_turn[i] - on_turn[i - 1]);
  return widest;
}

/// Of a rotary axis that was read all around: what it does repeats itself every turn.
Choice of_turn(const PeriodicFit& fit, const MachineMeasurement& file, int max_orders) {
  return choose(fit, two_pi, orders_of_turn(fit.position(), file.gear_ratio, max_orders));
}

/// What is fitted to a read-out, in addition to the reversal value if it was read in both senses. A
/// linear axis has a polynomial and any period. A rotary axis that was read all around has the turn
/// alone, or a free period that wins clearly over more than two turns. One that was read over a
/// part of it has a polynomial.
struct ReadOutModel {
  PeriodicFit fit;
  Choice choice;
  bool repeats = false;  ///< its errors are known everywhere
};

ReadOutModel model_of(const MachineMeasurement& file, std::vector<double> position,
                      std::vector<double> error, int max_orders) {
  std::vector<double> sense = senses_of(position);
  if (!is_rotary(*file.axis)) {
    PeriodicFit fit(std::move(position), std::move(error), 4, std::move(sense));
    Choice choice = best_period(fit, max_orders);
    return {std::move(fit), std::move(choice), false};
  }
  if (widest_gap_rad(position) > whole_turn_gap_rad)
    return {PeriodicFit(std::move(position), std::move(error), 4, std::move(sense)), {}, false};
  PeriodicFit fit(std::move(position), std::move(error), 1, std::move(sense));
  Choice choice = of_turn(fit, file, max_orders);
  if (!file.gear_ratio && range_of(fit.position()).length() > free_period_turns * two_pi) {
    Choice free = best_period(fit, max_orders);
    if (free.period > 0.0 && free.criterion < choice.criterion - clearly) choice = std::move(free);
  }
  return {std::move(fit), std::move(choice), true};
}

/// u of one coefficient, along every direction that the axis has a part in.
void add_uncertainty(const std::array<double, 3>& factors, UncertainAmount amount, double u,
                     ErrorCovariance& covariance) {
  std::vector<UncertainAmount> amounts;
  std::vector<double> sizes, products;
  const std::size_t first = amount.name.direction;
  for (std::size_t i = 0; i < 3; ++i) {
    if (factors[i] == 0.0) continue;
    amount.name.direction = first + i;
    amounts.push_back(amount);
    sizes.push_back(factors[i] * u);
  }
  for (const double a : sizes)
    for (const double b : sizes) products.push_back(a * b);
  add_covariance(covariance, {std::move(amounts), products});
}

/// E_KK in the machine's directions of the position error along the axis: what the moving part does
/// (docs/reference/calibration.md, signs).
void add_errors(const MachineAxis& axis, const AxisReadOut& read_out, Calibration& out) {
  const std::size_t body = index_of(axis.name), first = is_rotary(axis.name) ? 3 : 0;
  std::vector<double> powers{0.0};
  PolynomialError polynomial = legendre(0, read_out.low, read_out.high);
  for (std::size_t degree = 1; degree < read_out.polynomial.size(); ++degree) {
    const PolynomialError one = legendre(static_cast<int>(degree), read_out.low, read_out.high);
    powers.resize(one.coefficients.size(), 0.0);
    for (std::size_t i = 0; i < one.coefficients.size(); ++i)
      powers[i] += read_out.polynomial[degree].value * one.coefficients[i];
  }
  polynomial.coefficients = powers;
  FourierError fourier{{}, read_out.period};
  for (const AxisReadOut::Order& one : read_out.orders)
    fourier.terms.push_back({static_cast<double>(one.order), one.cos.value, one.sin.value});
  std::optional<std::array<double, 2>> known;
  if (!read_out.repeats) known = {read_out.low, read_out.high};
  const std::array<double, 3> factors = read_out_factors(axis, out.errors.sign);
  const ErrorName along{true, first, body};
  using Shape = UncertainAmount::Shape;
  for (std::size_t degree = 1; degree < read_out.polynomial.size(); ++degree)
    add_uncertainty(factors,
                    {along, Shape::legendre, static_cast<int>(degree), read_out.low, read_out.high},
                    read_out.polynomial[degree].u, out.errors.covariance);
  for (const AxisReadOut::Order& one : read_out.orders) {
    add_uncertainty(factors, {along, Shape::cosine, one.order, 0.0, read_out.period}, one.cos.u,
                    out.errors.covariance);
    add_uncertainty(factors, {along, Shape::sine, one.order, 0.0, read_out.period}, one.sin.u,
                    out.errors.covariance);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double factor = factors[i];
    if (factor == 0.0) continue;
    const ErrorName name{true, first + i, body};
    if (read_out.polynomial.size() > 1)
      out.errors.terms.push_back({name, scaled(polynomial, factor), 0.0, known});
    if (read_out.period > 0.0) out.errors.terms.push_back({name, scaled(fourier, factor), 0.0});
  }
}

void check(const MachineMeasurement& file) {
  const std::set<AxisPositions> different(file.axes.begin(), file.axes.end());
  if (different.size() < 4)
    throw InputError(file.source, "has " + std::to_string(different.size()) +
                                      " positions of the axis: its error needs four or more");
}

}  // namespace

std::vector<double> senses_of(const std::vector<double>& position) {
  std::vector<double> sense(position.size(), 0.0);
  double next = 0.0;
  for (std::size_t i = position.size(); i-- > 0;) {
    const double step = i > 0 ? position[i] - position[i - 1] : 0.0;
    sense[i] = step != 0.0 ? std::copysign(0.5, step) : next;
    next = step != 0.0 ? sense[i] : next;
  }
  std::vector<double> up, down;
  for (std::size_t i = 0; i < position.size(); ++i)
    (sense[i] > 0.0 ? up : down).push_back(position[i]);
  if (std::min(up.size(), down.size()) < least_of_a_sense) return {};
  const Extent rising = range_of(up), falling = range_of(down);
  const double common = std::min(rising.high, falling.high) - std::max(rising.low, falling.low);
  return common > 0.5 * range_of(position).length() ? sense : std::vector<double>{};
}

std::vector<int> orders_of_turn(const std::vector<double>& position_rad,
                                std::optional<int> gear_ratio, int max_orders) {
  const double widest = widest_gap_rad(position_rad), highest = 0.5 / widest;
  if (widest > whole_turn_gap_rad) return {};
  std::vector<int> orders =
      PeriodicFit(position_rad, position_rad, 1).orders_up_to(max_orders, two_pi, highest);
  const auto room = position_rad.size() / 6;
  for (int k = 1; gear_ratio && k <= most_gear_orders; ++k) {
    const int order = k * *gear_ratio;
    if (order / two_pi <= highest && orders.size() < room &&
        std::ranges::find(orders, order) == orders.end())
      orders.push_back(order);
  }
  return orders;
}

std::vector<double> periods_of(const std::vector<double>& position) {
  const Band band = band_of(position);
  std::vector<double> periods;
  for (double at = band.low; position.size() >= least_readings && at <= band.high;
       at += oversampling / frequencies_a_width * band.step)
    periods.push_back(1.0 / at);
  return periods;
}

std::array<double, 3> read_out_factors(const MachineAxis& axis, ErrorSign sign) {
  const bool against = axis.carries_workpiece && sign == ErrorSign::moving_part;
  std::array<double, 3> factors{};
  for (std::size_t i = 0; i < 3; ++i) factors[i] = (against ? -1.0 : 1.0) * axis.direction[i];
  return factors;
}

double read_out_error(const MachineAxis& axis, const ErrorModel& errors, double position) {
  const auto factors = read_out_factors(axis, errors.sign);
  const std::size_t first = is_rotary(axis.name) ? 3 : 0;
  double sum = 0.0;
  for (const ErrorTerm& term : errors.terms)
    if (term.name.component && term.name.body == index_of(axis.name) &&
        term.name.direction >= first && term.name.direction < first + 3)
      sum += factors[term.name.direction - first] * value_at(term.function, position);
  return sum;
}

AxisReadOut read_out_of(const MachineMeasurement& file, int max_orders,
                        const std::function<double(double)>& known) {
  check(file);
  AxisReadOut out;
  out.axis = *file.axis;
  out.readings = file.rows();
  std::vector<double> position, error;
  for (std::size_t i = 0; i < file.rows(); ++i) {
    position.push_back(file.axes[i][index_of(out.axis)]);
    error.push_back(file.actual[i] - position.back() - (known ? known(position.back()) : 0.0));
  }
  const ReadOutModel model = model_of(file, std::move(position), std::move(error), max_orders);
  const PeriodicFit& fit = model.fit;
  const Choice& choice = model.choice;
  const PeriodicFit::Result result = fit.with(choice.orders, std::max(choice.period, 1e-300));
  const char* const unit = is_rotary(out.axis) ? "rad" : "mm";
  const auto estimate = [&](std::size_t i) {
    return Estimate{result.coefficients[i], result.u[i], unit, ""};
  };
  const Extent range = range_of(fit.position());
  out.low = range.low;
  out.high = range.high;
  out.period = choice.orders.empty() ? 0.0 : choice.period;
  out.repeats = model.repeats;
  for (std::size_t i = 0; i < fit.smooth(); ++i) out.polynomial.push_back(estimate(i));
  for (std::size_t k = 0; k < choice.orders.size(); ++k)
    out.orders.push_back({choice.orders[k], estimate(fit.first_order() + 2 * k),
                          estimate(fit.first_order() + 2 * k + 1)});
  if (fit.has_senses()) out.reversal = estimate(fit.smooth());
  const auto n = static_cast<double>(file.rows());
  out.rms_before = std::sqrt(fit.with({}, 1.0).rss / n);
  out.rms_after = std::sqrt(result.rss / n);
  out.freedom = result.freedom;
  out.stated_noise = file.noise_mm.value_or(0.0);
  if (result.freedom > 0.0) out.noise = std::sqrt(result.rss / result.freedom);
  return out;
}

void from_read_outs(const Machine& machine, std::span<const MachineMeasurement> data,
                    const CalibrationOptions& options, Calibration& out) {
  const bool alone = read_outs_alone(data);
  for (const MachineMeasurement& file : data) {
    if (file.kind != MeasurementKind::axis) continue;
    const MachineAxis& axis = *machine.find(*file.axis);
    AxisReadOut found = read_out_of(file, options.max_orders, [&](double position) {
      return read_out_error(axis, options.errors, position);
    });
    const std::string zero = std::string(1, letter_of(found.axis)) + "0" + letter_of(found.axis);
    out.not_determined.push_back(
        {{zero, "read-out"},
         zero + " is not told from the zero of the read-out of " + file.source});
    if (alone || !is_along(machine, axis.name)) add_errors(axis, found, out);
    out.read_outs.push_back(std::move(found));
  }
}

}  // namespace trueaxis::calibrate_detail

namespace trueaxis {

double AxisReadOut::Order::amplitude() const { return std::hypot(cos.value, sin.value); }

const char* to_string(MeasurementKind kind) {
  constexpr const char* names[] = {"ball", "bar", "array", "axis"};
  return names[static_cast<std::size_t>(kind)];
}

}  // namespace trueaxis
