// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "blind/by_entry.hpp"
#include "blind/rival.hpp"
#include "blind/spectrum.hpp"

namespace trueaxis::blind {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr std::size_t lines_tried = 4;

// Power at n undulations per revolution, constant and linear along Z, set-up by set-up: whatever
// the frame, its order shows.
std::vector<int> likely_orders(const Bench& bench, const Eigen::VectorXd& left, int lowest) {
  std::vector<std::pair<double, int>> power;
  const int setups = *std::ranges::max_element(bench.setup());
  for (int n = lowest; n <= 12; ++n) {
    const Eigen::ArrayXd angle = n * bench.c_rad().array();
    Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(bench.size(), 4 * setups);
    for (Eigen::Index i = 0; i < bench.size(); ++i) {
      const int first = 4 * (bench.setup()[static_cast<std::size_t>(i)] - 1);
      const double along = bench.z_mm()[i] / end_mm - 0.5;
      basis(i, first) = std::cos(angle[i]), basis(i, first + 1) = std::sin(angle[i]);
      basis(i, first + 2) = along * basis(i, first);
      basis(i, first + 3) = along * basis(i, first + 1);
    }
    power.emplace_back(left.squaredNorm() - Subspace(basis).residual(left).squaredNorm(), n);
  }
  std::ranges::sort(power, std::greater<>());
  std::vector<int> orders;
  for (std::size_t k = 0; k < 3; ++k) orders.push_back(power[k].second);
  return orders;
}

struct Scan {
  const Eigen::VectorXd& x;
  Band band;
};

std::vector<double> lines(const Bench& bench, const Residue& of, const Scan& scan, bool turning) {
  Eigen::VectorXd offset = Eigen::VectorXd::Zero(bench.size());
  if (turning) offset = -bench.c_rad();
  return strongest_lines(of.left, scan.x, offset, scan.band, lines_tried);
}

std::vector<Effect> each(const std::string& id, const std::vector<double>& values, const char* name,
                         double (*parameter)(double)) {
  std::vector<Effect> list;
  for (const double value : values) list.push_back({id, {{name, parameter(value)}}});
  return list;
}

double as_is(double w) { return w; }
double hertz(double w) { return w / two_pi; }
double period(double w) { return two_pi / w; }

std::vector<Effect> orders_of(const std::string& id, const std::vector<int>& orders,
                              std::initializer_list<std::map<std::string, double>> shapes,
                              const char* name) {
  std::vector<Effect> list;
  for (const int n : orders) {
    for (std::map<std::string, double> shape : shapes) {
      shape[name] = n;
      list.push_back({id, std::move(shape)});
    }
  }
  return list;
}

// The instant that leaves the least, by columns cos C, sin C from then on.
std::vector<Effect> instants(const Bench& bench, const Residue& of) {
  std::vector<std::pair<double, double>> tried;
  const double last = bench.time_s().maxCoeff();
  constexpr int steps = 120;
  for (int k = 1; k < steps; ++k) {
    const double when = last * k / steps;
    Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(bench.size(), 2);
    for (Eigen::Index i = 0; i < bench.size(); ++i) {
      if (bench.time_s()[i] < when) continue;
      basis(i, 0) = std::cos(bench.c_rad()[i]), basis(i, 1) = std::sin(bench.c_rad()[i]);
    }
    Subspace space = of.taken;
    space.add(basis);
    tried.emplace_back(space.residual(of.left).squaredNorm(), when);
  }
  std::ranges::sort(tried);
  std::vector<Effect> list;
  for (std::size_t k = 0; k < lines_tried; ++k) {
    list.push_back({"part.slip", {{"time_s", tried[k].second}}});
  }
  return list;
}

std::vector<Effect> lobing(const std::vector<int>& orders) {
  std::vector<Effect> list;
  for (const int n : orders) {
    for (const double from : {start_mm - 5.0, end_mm + 5.0}) {
      for (const double length : {20.0, 200.0}) {
        list.push_back({"part.chuck_lobing",
                        {{"jaws", n}, {"jaw_position_mm", from}, {"decay_length_mm", length}}});
      }
    }
  }
  return list;
}

}  // namespace

std::vector<Effect> mimics(const Bench& bench, const std::string& id, const Residue& of) {
  if (const ByEntry* known = known_by_entry(id)) return mimics(bench, *known, of);
  const auto scan = [&](const Eigen::VectorXd& x, double low, double high) {
    return lines(bench, of, {x, {low, high}}, false);
  };
  if (id == "part.chuck_lobing") return lobing(likely_orders(bench, of.left, 2));
  if (id == "part.roundness" || id == "spindle.radial_synchronous") {
    return orders_of(id, likely_orders(bench, of.left, 2), {{}}, "order");
  }
  if (id == "spindle.axial_synchronous") {
    return orders_of(id, likely_orders(bench, of.left, 1), {{}}, "order");
  }
  if (id == "spindle.tilt_synchronous") {
    return orders_of(id, likely_orders(bench, of.left, 1),
                     {{{"bearing_mm", -5000.0}},
                      {{"bearing_mm", -300.0}},
                      {{"bearing_mm", -80.0}},
                      {{"bearing_mm", 0.0}}},
                     "order");
  }
  if (id == "spindle.asynchronous")
    return each(id, scan(bench.c_rad(), 0.02, 24.0), "order", as_is);
  if (id == "environment.vibration") {
    return each(id, scan(bench.time_s(), 0.02 * two_pi, 60.0 * two_pi), "frequency_hz", hertz);
  }
  if (id == "part.waviness") {
    return each(id, scan(bench.z_mm(), two_pi / 60.0, two_pi / 0.05), "wavelength_mm", period);
  }
  if (id == "slide.leadscrew_periodic") {
    return each(id, scan(bench.z_mm(), two_pi / 60.0, two_pi / 0.05), "pitch_mm", period);
  }
  if (id == "part.feed_marks") {
    const Band band{two_pi / 20.0, two_pi / 0.04};
    return each(id, lines(bench, of, {bench.z_mm(), band}, true), "feed_mm_per_rev", period);
  }
  if (id == "probe.cyclic") {
    return each(id, scan(bench.plain(), two_pi / 5.0, two_pi / 0.02), "period_mm", period);
  }
  if (id == "part.slip") return instants(bench, of);
  if (id == "part.creep") {
    std::vector<Effect> list;
    for (const double share : {0.1, 0.25, 0.6, 1.5})
      list.push_back({id, {{"settling_s", share * bench.time_s().maxCoeff()}}});
    return list;
  }
  if (id == "part.bow") {
    return {{id, {{"length_mm", end_mm - start_mm}, {"middle_mm", 0.5 * (start_mm + end_mm)}}}};
  }
  if (id == "thermal.drift") {
    std::vector<Effect> list;
    for (const double tau : {2.0, 10.0, 40.0, 200.0})
      list.push_back({id, {{"time_constant_s", tau}}});
    return list;
  }
  if (id == "probe.nonlinearity" || id == "probe.gain") {
    std::vector<Effect> list;
    for (const double at :
         {bench.plain().minCoeff(), bench.plain().mean(), bench.plain().maxCoeff()}) {
      list.push_back({id, {{"reference_mm", at}}});
    }
    return list;
  }
  if (id == "probe.lag") {
    return {{id, {{"time_constant_s", 1e-3}}}, {id, {{"time_constant_s", 2e-2}}}};
  }
  return {{id, {}}};
}

}  // namespace trueaxis::blind
