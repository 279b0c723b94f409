// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "fit/uncertainty.hpp"
#include "math/autoregression.hpp"
#include "measure/passes.hpp"

namespace trueaxis {
namespace {

using AtReading = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_columns, 1>;
using Products = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_columns, max_columns>;

constexpr std::size_t group_blocks = 12;         // 1536 readings
constexpr std::size_t enough_readings = 12'000;  // φ to 0.01: u to 2 %
constexpr double rows_per_parameter = 10.0;

/// One side of one clamping at the solution.
struct PartAtSolution {
  const JointPart& part;
  std::vector<double> working;
  RowMajorMatrix jacobian;  ///< of the joint parameters: J = columns of the surface × this
  std::vector<Pass> passes;

  PartAtSolution(const JointModel& model, const std::vector<double>& joint, const JointPart& of)
      : part(of), working(model.working(joint, of)), passes(find_passes(of.prepared->source())) {
    const auto p = static_cast<Eigen::Index>(working.size());
    const auto columns = static_cast<Eigen::Index>(of.surface->column_count());
    RowMajorMatrix transform(p, columns);
    of.surface->transform(working, transform.data());
    jacobian = transform.transpose() * model.working_jacobian(joint, of);
  }

  std::size_t row_of_stream(std::size_t row) const {
    return part.rows.empty() ? row : part.rows[row];
  }
  void evaluate(std::size_t block, PredictionBlock& out) const {
    part.surface->evaluate(working, part.prepared->block(block), out);
  }
};

/// Products of [residual | columns of the surface] of a part, of a long stream in groups of
/// readings taken evenly.
LaggedGram lagged_gram(const PartAtSolution& at, const std::vector<double>& noise_mm,
                       const std::vector<char>& used) {
  const PreparedStream& stream = *at.part.prepared;
  const std::size_t columns = at.part.surface->column_count();
  LaggedGram gram(static_cast<Eigen::Index>(1 + columns));
  const std::size_t stride = group_blocks * (1 + stream.size() / (2 * enough_readings));
  std::vector<char> begins(stream.size(), 0);
  for (const Pass& pass : at.passes) begins[pass.begin] = 1;
  PredictionBlock block;
  Eigen::MatrixXd x(static_cast<Eigen::Index>(group_blocks * block_size),
                    static_cast<Eigen::Index>(1 + columns));
  for (std::size_t first = 0; first < stream.blocks(); first += stride) {
    const std::size_t last = std::min(first + group_blocks, stream.blocks());
    const std::size_t origin = first * block_size;
    std::vector<Eigen::Index> rows;
    int unbroken = 0;  // readings up to this one
    for (std::size_t b = first; b < last; ++b) {
      at.evaluate(b, block);
      for (std::size_t i = 0; i < stream.filled(b); ++i) {
        const std::size_t row = b * block_size + i, of_stream = at.row_of_stream(row);
        const auto here = static_cast<Eigen::Index>(row - origin);
        x(here, 0) = noise_mm[of_stream];
        for (std::size_t j = 0; j < columns; ++j)
          x(here, static_cast<Eigen::Index>(1 + j)) = block.column[j][i];
        unbroken = !used[of_stream] ? 0 : begins[row] ? 1 : unbroken + 1;
        if (unbroken > 2) rows.push_back(here);
      }
    }
    gram.add(x, rows);
  }
  return gram;
}

/// Σ z zᵀ for what each innovation of the noise moves, z_i = c_i + Σ φ_j z_{i+j} with the columns c
/// of a pass; before its first reading z goes on until it has died out.
class BackwardFilter {
 public:
  BackwardFilter(const std::vector<double>& phi, std::size_t columns)
      : phi1_(phi[0]), phi2_(phi.size() < 2 ? 0.0 : phi[1]) {
    const auto n = static_cast<Eigen::Index>(columns);
    sum_ = Products::Zero(n, n);
    next_ = after_ = AtReading::Zero(n);
  }

  void add(const AtReading& columns) {
    AtReading z = columns + phi1_ * next_ + phi2_ * after_;
    sum_.noalias() += z * z.transpose();
    after_ = std::exchange(next_, std::move(z));
  }

  void end_pass() {
    constexpr int most = 4000;       // a root of 0.995 has died out by then
    constexpr double small = 1e-12;  // of the sum
    const AtReading zero = AtReading::Zero(next_.size());
    const double enough = small * sum_.trace();
    for (int i = 0; i < most && next_.squaredNorm() + after_.squaredNorm() > enough; ++i) add(zero);
    next_ = after_ = zero;
  }

  const Products& sum() const { return sum_; }

 private:
  double phi1_, phi2_;
  Products sum_;
  AtReading next_, after_;
};

Eigen::MatrixXd correlated_gram(const PartAtSolution& at, const std::vector<double>& phi) {
  const PreparedStream& stream = *at.part.prepared;
  const std::size_t columns = at.part.surface->column_count();
  BackwardFilter filter(phi, columns);
  PredictionBlock block;
  AtReading row(static_cast<Eigen::Index>(columns));
  auto pass = at.passes.rbegin();
  for (std::size_t b = stream.blocks(); b-- > 0;) {
    at.evaluate(b, block);
    for (std::size_t i = stream.filled(b); i-- > 0;) {
      for (std::size_t j = 0; j < columns; ++j)
        row(static_cast<Eigen::Index>(j)) = block.column[j][i];
      filter.add(row);
      if (b * block_size + i != pass->begin) continue;
      filter.end_pass();
      ++pass;
    }
  }
  return at.jacobian.transpose() * filter.sum() * at.jacobian;
}

}  // namespace

std::optional<CorrelatedNoise> find_correlated_noise(const JointModel& model,
                                                     const Association& association,
                                                     double clip_mm) {
  const std::vector<double>& joint = association.minimum.working;
  std::vector<double> noise_mm = association.residual_mm;
  for (double& r : noise_mm) r = std::clamp(r, -clip_mm, clip_mm);
  std::vector<char> used(noise_mm.size(), 1);
  for (const Rejected& rejected : list_rejected(association)) used[rejected.row - 1] = 0;

  const auto parameters = static_cast<Eigen::Index>(model.parameter_count());
  LaggedGram lagged(1 + parameters);
  std::vector<PartAtSolution> parts;
  std::vector<double> c_rad;
  for (const JointPart& part : model.parts()) {
    const PartAtSolution& at = parts.emplace_back(model, joint, part);
    Eigen::MatrixXd transform = Eigen::MatrixXd::Zero(1 + at.jacobian.rows(), 1 + parameters);
    transform(0, 0) = 1.0;
    transform.bottomRightCorner(at.jacobian.rows(), parameters) = at.jacobian;
    lagged.add_transformed(lagged_gram(at, noise_mm, used), transform);
    const std::vector<double>& c = part.prepared->source().c_rad;
    c_rad.insert(c_rad.end(), c.begin(), c.end());
  }
  if (lagged.rows() < rows_per_parameter * static_cast<double>(parameters)) return {};
  bool form = false;
  CorrelatedNoise out;
  out.phi = find_autoregression(lagged, [&](double phi1, double phi2) {
              return form = rings_with_spindle(phi1, phi2, c_rad);
            }).phi;
  if (form || out.phi.empty()) return {};
  out.jtcj = Eigen::MatrixXd::Zero(parameters, parameters);
  for (const PartAtSolution& at : parts) out.jtcj += correlated_gram(at, out.phi);
  out.jtcj /= variance_over_innovation(out.phi);
  return out;
}

}  // namespace trueaxis
