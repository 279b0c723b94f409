// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "math/linear_algebra.hpp"
#include "report/chart_readings.hpp"
#include "report/page_data.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t most_points = 4000, sectors_of_many = 720;
constexpr int most_order = 50;

/// The trace about its least-squares circle: one point a reading in the order of C, or means of
/// equal sectors.
struct Trace {
  std::vector<double> c_deg, um;
  std::size_t readings = 0;
  bool averaged = false;
  double low_um = 0.0, high_um = 0.0, square_um2 = 0.0;  ///< of all readings
};

Trace trace_of(const ChartReadings& all) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < all.kept.size(); ++i)
    if (all.kept[i]) kept.push_back(i);
  std::ranges::stable_sort(kept, {}, [&](std::size_t i) { return all.c_deg[i]; });
  Trace trace{{}, {}, kept.size(), kept.size() > most_points};
  for (const std::size_t i : kept) {
    const double um = all.residual_um[i];
    trace.low_um = std::min(trace.low_um, um);
    trace.high_um = std::max(trace.high_um, um);
    trace.square_um2 += um * um;
  }
  if (!trace.averaged) {
    for (const std::size_t i : kept) {
      trace.c_deg.push_back(all.c_deg[i]);
      trace.um.push_back(all.residual_um[i]);
    }
    return trace;
  }
  const Bins sectors{0.0, 360.0, sectors_of_many};
  std::vector<double> sum_c(sectors.count), sum_um(sectors.count), count(sectors.count);
  for (const std::size_t i : kept) {
    const std::size_t bin = sectors.of(all.c_deg[i]);
    sum_c[bin] += all.c_deg[i];
    sum_um[bin] += all.residual_um[i];
    count[bin] += 1.0;
  }
  for (std::size_t bin = 0; bin < sectors.count; ++bin) {
    if (count[bin] == 0.0) continue;
    trace.c_deg.push_back(sum_c[bin] / count[bin]);
    trace.um.push_back(sum_um[bin] / count[bin]);
  }
  return trace;
}

/// Orders that the points show: two of them at least in half an undulation over the largest gap.
int order_limit(const std::vector<double>& c_deg) {
  double gap_deg = c_deg.empty() ? 360.0 : c_deg.front() + 360.0 - c_deg.back();
  for (std::size_t i = 1; i < c_deg.size(); ++i)
    gap_deg = std::max(gap_deg, c_deg[i] - c_deg[i - 1]);
  const double points = static_cast<double>(c_deg.size());
  const double limit = std::min(90.0 / gap_deg, points / 4.0);
  return limit >= most_order ? most_order : static_cast<int>(limit);
}

/// Σ a_n cos nC + b_n sin nC, n = 0 … limit, by least squares: a_0, a_1, b_1, a_2 …
Eigen::VectorXd harmonics_of(const Trace& trace, int limit) {
  const Eigen::Index columns = 2 * limit + 1;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(columns, columns);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(columns), row(columns);
  for (std::size_t i = 0; i < trace.um.size(); ++i) {
    row[0] = 1.0;
    for (int n = 1; n <= limit; ++n) {
      row[2 * n - 1] = std::cos(n * trace.c_deg[i] * rad_per_deg);
      row[2 * n] = std::sin(n * trace.c_deg[i] * rad_per_deg);
    }
    normal.selfadjointView<Eigen::Lower>().rankUpdate(row);
    right += trace.um[i] * row;
  }
  return linear::solve_normal(normal, right);
}

double at(const Eigen::VectorXd& harmonics, int from, double c_rad) {
  double um = 0.0;
  for (Eigen::Index n = from; 2 * n < harmonics.size(); ++n)
    um += harmonics[2 * n - 1] * std::cos(static_cast<double>(n) * c_rad) +
          harmonics[2 * n] * std::sin(static_cast<double>(n) * c_rad);
  return um;
}

Json orders_data(const Trace& trace, int limit) {
  const Eigen::VectorXd harmonics = harmonics_of(trace, limit);
  Json list = Json::array();
  for (int n = 2; n <= limit; ++n) {
    const double a = harmonics[2 * n - 1], b = harmonics[2 * n];
    const double phase_deg = std::atan2(b, a) / rad_per_deg;
    list.push_back({{"order", n},
                    {"amplitude_um", rounded(std::hypot(a, b), 4)},
                    {"phase_deg", rounded(phase_deg < 0.0 ? phase_deg + 360.0 : phase_deg, 1)}});
  }
  double left = 0.0;
  for (std::size_t i = 0; i < trace.um.size(); ++i) {
    const double rest = trace.um[i] - harmonics[0] - at(harmonics, 1, trace.c_deg[i] * rad_per_deg);
    left += rest * rest;
  }
  double low = 0.0, high = 0.0;
  for (int step = 0; step < 3600; ++step) {
    const double um = at(harmonics, 2, step * 0.1 * rad_per_deg);
    low = std::min(low, um);
    high = std::max(high, um);
  }
  const double points = static_cast<double>(trace.um.size());
  const double free = points - static_cast<double>(harmonics.size());
  const double rms = std::sqrt(left / std::max(1.0, free));
  return {{"orders", std::move(list)},
          {"order_max", limit},
          {"of_orders_um", rounded(high - low, 4)},
          {"left_um", rounded(rms, 4)},
          {"u_amplitude_um", rounded(rms * std::sqrt(2.0 / points), 5)}};
}

}  // namespace

Json roundness_data(const ProbeStream& stream, const FitResult& fit) {
  const ChartReadings all = chart_readings(stream, fit, CoaxialNominal(stream, fit));
  if (!all.has_model) return nullptr;
  const Trace trace = trace_of(all);
  if (trace.um.size() < 8) return nullptr;
  const int limit = order_limit(trace.c_deg);
  Json data =
      limit < 2 ? Json{{"orders", Json::array()}, {"order_max", 0}} : orders_data(trace, limit);
  data["c_deg"] = column(trace.c_deg, 2);
  data["um"] = column(trace.um, 4);
  data["readings"] = trace.readings;
  data["averaged"] = trace.averaged;
  data["turns"] = rounded(static_cast<double>(stream.size()) / all.readings_per_turn, 2);
  data["peak_um"] = rounded(trace.high_um, 4);
  data["valley_um"] = rounded(-trace.low_um, 4);
  data["rms_um"] = rounded(std::sqrt(trace.square_um2 / static_cast<double>(trace.readings)), 4);
  return data;
}

}  // namespace trueaxis
