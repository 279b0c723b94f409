// SPDX-License-Identifier: Apache-2.0
#include "bench/peers.hpp"

#include <cminpack.h>

#include <chrono>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "bench/cone_stream.hpp"
#include "bench/peers_ceres.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis::peer {
namespace {

class Stopwatch {
 public:
  double ms() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_)
        .count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

PeerFit engine(const ProbeStream& stream) {
  const Stopwatch watch;
  const FitResult result = fit(stream, FitOptions{});
  if (result.status != FitStatus::converged) throw std::runtime_error(result.message);
  PeerFit peer;
  for (std::size_t i = 0; i < peer.p.size(); ++i) peer.p[i] = result.parameters[i].estimate.value;
  peer.p[5] *= rad_per_deg;
  peer.solver_ms = watch.ms();
  peer.iterations = result.iterations;
  peer.converged = true;
  return peer;
}

/// Ceres' defaults (initial trust region of 1e4 included) but for the linear solver, the tolerances
/// and silence. `matched` starts with a large trust region, as the engine does.
PeerFit solve_ceres(ceres::Problem& problem, PeerFit peer, int threads, bool matched) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.num_threads = threads;
  options.function_tolerance = cost_tolerance;
  options.parameter_tolerance = parameter_tolerance;
  options.gradient_tolerance = 0.0;
  options.max_num_iterations = most_iterations;
  options.logging_type = ceres::SILENT;
  if (matched) options.initial_trust_region_radius = 1e16;
  ceres::Solver::Summary summary;
  const Stopwatch watch;
  ceres::Solve(options, &problem, &summary);
  peer.solver_ms = watch.ms();
  peer.iterations = summary.num_successful_steps + summary.num_unsuccessful_steps;
  peer.converged = summary.termination_type == ceres::CONVERGENCE;
  return peer;
}

template <int threads>
PeerFit ceres_autodiff(const ProbeStream& stream) {
  PeerFit peer{.p = table1_nominal};
  ceres::Problem problem;
  add_readings<ConeResidual>(problem, stream, peer.p.data());
  const PeerFit solved = solve_ceres(problem, peer, threads, false);
  return {peer.p, solved.solver_ms, solved.iterations, solved.converged};
}

class HandConeCost final : public ceres::SizedCostFunction<1, 6> {
 public:
  explicit HandConeCost(const Reading& at) : at_(at) {}
  bool Evaluate(const double* const* p, double* residual, double** jacobian) const override {
    const ConeRow row(p[0]);
    if (jacobian == nullptr || jacobian[0] == nullptr) {
      residual[0] = row(at_.cos_c, at_.sin_c, at_.z_mm) - at_.x_mm;
      return true;
    }
    std::array<double, 6> dx_dp;
    residual[0] = row(at_.cos_c, at_.sin_c, at_.z_mm, dx_dp) - at_.x_mm;
    std::copy(dx_dp.begin(), dx_dp.end(), jacobian[0]);
    return true;
  }

 private:
  Reading at_;
};

PeerFit ceres_hand(const ProbeStream& stream) {
  PeerFit peer{.p = table1_nominal};
  ceres::Problem problem;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    problem.AddResidualBlock(new HandConeCost(reading_of(stream, i)), nullptr, peer.p.data());
  }
  const PeerFit solved = solve_ceres(problem, peer, 1, true);
  return {peer.p, solved.solver_ms, solved.iterations, solved.converged};
}

/// What a MINPACK callback works on: columns with sin C and cos C taken once.
struct Columns {
  explicit Columns(const ProbeStream& stream)
      : cos_c(stream.size()),
        sin_c(stream.size()),
        z_mm(stream.position_mm),
        x_mm(stream.reading_mm) {
    for (std::size_t i = 0; i < stream.size(); ++i) {
      cos_c[i] = std::cos(stream.c_rad[i]);
      sin_c[i] = std::sin(stream.c_rad[i]);
    }
  }
  void residuals(const double* p, double* residual) const {
    const ConeRow row(p);
    for (std::size_t i = 0; i < cos_c.size(); ++i) {
      residual[i] = row(cos_c[i], sin_c[i], z_mm[i]) - x_mm[i];
    }
  }
  void jacobian(const double* p, double* columns, std::size_t stride) const {
    const ConeRow row(p);
    std::array<double, 6> dx_dp;
    for (std::size_t i = 0; i < cos_c.size(); ++i) {
      row(cos_c[i], sin_c[i], z_mm[i], dx_dp);
      for (std::size_t j = 0; j < dx_dp.size(); ++j) columns[i + j * stride] = dx_dp[j];
    }
  }
  std::vector<double> cos_c, sin_c;
  const std::vector<double>&z_mm, &x_mm;
};

int lmder_callback(void* data, int, int, const double* p, double* residual, double* jacobian,
                   int stride, int flag) {
  const Columns& columns = *static_cast<const Columns*>(data);
  if (flag == 1) columns.residuals(p, residual);
  if (flag == 2) columns.jacobian(p, jacobian, static_cast<std::size_t>(stride));
  return 0;
}

int lmdif_callback(void* data, int, int, const double* p, double* residual, int) {
  static_cast<const Columns*>(data)->residuals(p, residual);
  return 0;
}

/// MINPACK's own defaults (scaling by column norms, factor 100) but for the tolerances.
template <bool analytic>
PeerFit minpack(const ProbeStream& stream) {
  constexpr int n = 6, evaluations = 100 * (n + 1), own_scaling = 1;
  constexpr double factor = 100.0;
  PeerFit peer{.p = table1_nominal};
  Columns columns(stream);
  const int m = static_cast<int>(stream.size());
  std::vector<double> residual(stream.size()), jacobian(stream.size() * n), work(stream.size());
  std::array<double, n> scale{}, qtf{}, work1{}, work2{}, work3{};
  std::array<int, n> pivot{};
  int calls = 0, gradients = 0;
  const Stopwatch watch;
  int info = 0;
  if constexpr (analytic) {
    info = lmder(lmder_callback, &columns, m, n, peer.p.data(), residual.data(), jacobian.data(), m,
                 cost_tolerance, parameter_tolerance, 0.0, evaluations, scale.data(), own_scaling,
                 factor, 0, &calls, &gradients, pivot.data(), qtf.data(), work1.data(),
                 work2.data(), work3.data(), work.data());
  } else {
    info = lmdif(lmdif_callback, &columns, m, n, peer.p.data(), residual.data(), cost_tolerance,
                 parameter_tolerance, 0.0, evaluations, 0.0, scale.data(), own_scaling, factor, 0,
                 &calls, jacobian.data(), m, pivot.data(), qtf.data(), work1.data(), work2.data(),
                 work3.data(), work.data());
    gradients = calls / (n + 1);
  }
  peer.solver_ms = watch.ms();
  peer.iterations = gradients;
  peer.converged = info >= 1 && info != 5;  // 6 and 7: no further reduction is possible
  return peer;
}

constexpr std::array<PeerCode, 6> codes = {{
    {"engine", engine},
    {"ceres_autodiff", ceres_autodiff<1>},
    {"ceres_autodiff_2", ceres_autodiff<2>},
    {"ceres_hand", ceres_hand},
    {"lmder", minpack<true>},
    {"lmdif", minpack<false>},
}};

}  // namespace

std::span<const PeerCode> peer_codes() { return codes; }

double cone_cost(const ProbeStream& stream, const std::array<double, 6>& p) {
  const std::array<long double, 6> exact = {p[0], p[1], p[2], p[3], p[4], p[5]};
  long double sum = 0.0L;
  for (std::size_t i = 0; i < stream.size(); ++i) {
    const long double residual = cone_reading(exact.data(), std::cos(stream.c_rad[i]),
                                              std::sin(stream.c_rad[i]), stream.position_mm[i]) -
                                 stream.reading_mm[i];
    sum += residual * residual;
  }
  return static_cast<double>(sum);
}

}  // namespace trueaxis::peer
