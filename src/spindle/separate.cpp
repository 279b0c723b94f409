// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "spindle/joint_estimate.hpp"

namespace trueaxis {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;

constexpr double rounding_mm = 1e-9;       // no amplitude is known better than 1 pm
constexpr double least_condition = 10.0;   // an order is not suppressed below
constexpr double share_of_readings = 0.1;  // U above this share of the readings tells nothing
constexpr double in_the_null_space = 1e-6;

/// What the runs read of one order, and its covariance, which has a block a run.
struct OrderReadings {
  VectorXcd z;
  MatrixXcd covariance;
  Eigen::VectorXd white_mm2;  ///< of its diagonal, what all orders have alike
};

OrderReadings readings_of(const Layout& layout, std::span<const SynchronousPart> parts, Index n,
                          double remainder_mm) {
  const auto& channels = layout.channels();
  const auto count = static_cast<Index>(channels.size());
  OrderReadings out{VectorXcd(count), MatrixXcd::Zero(count, count), Eigen::VectorXd(count)};
  for (Index i = 0; i < count; ++i) {
    const Channel& one = channels[static_cast<std::size_t>(i)];
    const SynchronousPart& part = parts[one.run];
    out.z[i] = part.harmonics(static_cast<Index>(one.sensor), n);
    for (Index j = 0; j < count; ++j) {
      const Channel& other = channels[static_cast<std::size_t>(j)];
      if (other.run == one.run)
        out.covariance(i, j) = part.covariance[static_cast<std::size_t>(n)](
            static_cast<Index>(one.sensor), static_cast<Index>(other.sensor));
    }
    const auto sensor = static_cast<Index>(one.sensor);
    out.white_mm2[i] = rounding_mm * rounding_mm + part.white_mm2[sensor];
    out.covariance(i, i) +=
        rounding_mm * rounding_mm + 2.0 * remainder_mm * remainder_mm + part.folded_mm2[sensor];
  }
  return out;
}

/// RMS of what one channel reads over all orders from `order_min` on.
double rms_of_readings(const Layout& layout, std::span<const SynchronousPart> parts, int order_min,
                       int order_max) {
  double sum = 0.0;
  for (const Channel& one : layout.channels()) {
    sum += 0.5 * parts[one.run]
                     .harmonics.row(static_cast<Index>(one.sensor))
                     .segment(order_min, order_max - order_min + 1)
                     .squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(layout.channels().size()));
}

/// dz of a turn of the influence's channels by 1 rad.
VectorXcd moved_readings(const Layout& layout, const AngleInfluence& influence, int order,
                         const VectorXcd& unknowns) {
  const auto& channels = layout.channels();
  VectorXcd dz = VectorXcd::Zero(static_cast<Index>(channels.size()));
  for (const std::size_t i : influence.channels) {
    const Channel& one = channels[i];
    Complex& at = dz[static_cast<Index>(i)];
    if (one.sees_form)
      at += Complex(0.0, order) * std::polar(1.0, order * one.form_angle_rad) *
            unknowns[layout.form()];
    if (!influence.turns_motion) continue;
    at -= one.across * unknowns[layout.along()];
    if (layout.has_across()) at += one.along * unknowns[layout.across()];
  }
  return dz;
}

/// Largest-condition rule and null space of one order.
class OrderSolver {
 public:
  OrderSolver(const Layout& layout, int order)
      : layout_(layout),
        order_(order),
        matrix_(layout.matrix(order)),
        svd_(matrix_, Eigen::ComputeThinU | Eigen::ComputeFullV) {}

  OrderSolution solve(const OrderReadings& read, double limit, double lines,
                      std::span<const AngleInfluence> influences) const {
    OrderSolution out;
    out.condition = condition_of(matrix_);
    out.largest_condition = limit;
    const Index p = matrix_.cols(), m = matrix_.rows();
    const Index rank = directions(1.0 / singular), kept = directions(limit);
    const MatrixXcd unseen = svd_.matrixV().rightCols(p - kept);
    const MatrixXcd whitener = read.covariance.llt().matrixL().solve(MatrixXcd::Identity(m, m));
    // All directions that the readings hold are solved, whatever their condition: dropping one
    // would bias the others.
    const MatrixXcd basis = svd_.matrixV().leftCols(rank);
    const Eigen::HouseholderQR<MatrixXcd> qr(whitener * matrix_ * basis);
    const MatrixXcd thin = qr.householderQ() * MatrixXcd::Identity(m, rank);
    const MatrixXcd inverse =
        qr.matrixQR().topRows(rank).template triangularView<Eigen::Upper>().solve(
            MatrixXcd::Identity(rank, rank));
    const MatrixXcd gain = basis * inverse * thin.adjoint() * whitener;  // unknowns = gain z
    out.unknowns = gain * read.z;
    out.guessed = shortest(read.z, kept);
    const VectorXcd y = whitener * read.z;
    out.freedom = 2.0 * static_cast<double>(m - rank);
    // Both components of a circular complex number have half of its variance.
    out.chi_squared = 2.0 * (y - thin * (thin.adjoint() * y)).squaredNorm();
    out.read_mm2 = read.z.squaredNorm() / static_cast<double>(m);
    out.contradicted_mm2 = (read.z - matrix_ * out.unknowns).squaredNorm();
    const MatrixXcd covariance = gain * read.covariance * gain.adjoint();
    const double wide = widening(lines, m - rank);
    const Eigen::VectorXd squares = (0.5 * wide * covariance.diagonal().real()).cwiseMax(0.0);
    const Eigen::VectorXd white = 0.5 * wide * gain.cwiseAbs2() * read.white_mm2;
    out.u_mm = squares.cwiseSqrt();
    out.u_not_noise_mm = (squares - white).cwiseMax(0.0).cwiseSqrt();
    out.moved_mm.resize(p, static_cast<Index>(influences.size()));
    for (std::size_t k = 0; k < influences.size(); ++k)
      out.moved_mm.col(static_cast<Index>(k)) =
          influences[k].u_rad *
          (gain * moved_readings(layout_, influences[k], order_, out.unknowns));
    for (Index u = 0; u < p; ++u) {
      out.determined.push_back(unseen.row(u).squaredNorm() < in_the_null_space);
      if (!out.determined.back()) out.unknowns[u] = 0.0;
    }
    return out;
  }

 private:
  /// Directions of the unknowns whose singular value is the largest over `condition` or more.
  Index directions(double condition) const {
    const Eigen::VectorXd values = svd_.singularValues();
    Index count = 0;
    while (count < values.size() && values[count] * condition >= values[0]) ++count;
    return count;
  }

  /// The shortest unknowns that explain readings by so many directions.
  VectorXcd shortest(const VectorXcd& z, Index count) const {
    const VectorXcd seen = svd_.matrixU().leftCols(count).adjoint() * z;
    return svd_.matrixV().leftCols(count) *
           seen.cwiseQuotient(svd_.singularValues().head(count).cast<Complex>());
  }

  /// A covariance that is the mean of `lines` complex ones: variance of t, and what weights that
  /// are estimated lose where channels are to spare.
  double widening(double lines, Index spare) const {
    const double freedom = 2.0 * lines;
    const double lost = static_cast<double>(spare) / runs();
    return freedom / std::max(freedom - 2.0, 1.0) * lines / std::max(lines - lost, 1.0);
  }
  double runs() const { return 1.0 + static_cast<double>(layout_.channels().back().run); }

  const Layout& layout_;
  int order_;
  MatrixXcd matrix_;
  Eigen::JacobiSVD<MatrixXcd> svd_;
};

}  // namespace

std::vector<OrderSolution> separate(const Layout& layout, std::span<const SynchronousPart> parts,
                                    std::span<const AngleInfluence> influences,
                                    const SeparationTask& task) {
  const double rms_mm = rms_of_readings(layout, parts, task.order_min, task.order_max);
  double lines = parts.front().freedom;
  for (const SynchronousPart& part : parts) lines = std::min(lines, part.freedom);
  std::vector<OrderSolution> out;
  for (int n = task.order_min; n <= task.order_max; ++n) {
    const OrderReadings read = readings_of(layout, parts, n, task.remainder_mm);
    const double u_mm = std::sqrt(0.5 * read.covariance.diagonal().real().mean());
    // Eq. 146
    const double useful = share_of_readings * rms_mm / (task.coverage_factor * u_mm);
    const double limit = std::min(task.largest_condition, std::max(least_condition, useful));
    out.push_back(OrderSolver(layout, n).solve(read, limit, lines, influences));
  }
  return out;
}

}  // namespace trueaxis
