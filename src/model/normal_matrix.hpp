// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "surface/surface.hpp"
#include "trueaxis/probe_stream.hpp"

namespace trueaxis {

/// A column of doubles that is written before it is read: not zeroed, and large ones on huge pages,
/// because faulting in small pages costs more than computing what goes into them.
class ColumnBuffer {
 public:
  ColumnBuffer() = default;
  explicit ColumnBuffer(std::size_t size);

  std::span<double> view() const { return {data_.get(), size_}; }
  double* data() const { return data_.get(); }

 private:
  struct Free {
    void operator()(double* data) const;
  };
  std::unique_ptr<double[], Free> data_;
  std::size_t size_ = 0;
};

/// A stream as the kernels read it: views of its columns, sin C and cos C computed once.
/// The stream must outlive it.
class PreparedStream {
 public:
  explicit PreparedStream(const ProbeStream& stream);
  ~PreparedStream();
  PreparedStream(const PreparedStream&) = delete;
  PreparedStream& operator=(const PreparedStream&) = delete;

  /// Takes the readings of the source anew: they may be other numbers, at the same C and position.
  void reload_readings();

  const ProbeStream& source() const { return source_; }
  std::size_t size() const { return reading_.size(); }
  std::size_t blocks() const { return (size() + block_size - 1) / block_size; }
  /// Readings of a block; the last one is filled up with copies of the last reading.
  ReadingBlock block(std::size_t index) const;
  /// How many readings of a block are real.
  std::size_t filled(std::size_t index) const;

 private:
  const ProbeStream& source_;
  std::span<const double> reading_, position_;
  struct Angles;
  std::unique_ptr<Angles> angles_;    ///< cos C and sin C
  std::vector<double> zeros_, tail_;  ///< position of a stream without Z; the padded last block
};

/// How a residual r counts: ρ(r) with weight ψ(r)/r. `scale_mm` is not used by plain.
struct LossScale {
  enum class Kind { plain, huber, tukey } kind = Kind::plain;
  double threshold_mm = 0.0;  ///< Huber: where it turns linear; Tukey: where the weight ends
};

/// JᵀWJ, JᵀWr and Σρ over a stream, with J the Jacobian of the prediction.
struct NormalMatrix {
  std::size_t parameters = 0;
  std::vector<double> jtj;  ///< row-major, symmetric
  std::vector<double> jtr;
  double sum_rho = 0.0;  ///< Σρ, plain: Σr²
  /// Σψ' / Σ(ψ/r): what the weights overstate the curvature of a robust loss by, as ψ' and J are
  /// nearly independent; curvature · JᵀWJ is the Hessian up to O(1/√N). 1 for plain.
  double curvature = 1.0;
  bool valid = false;  ///< false: a probe line misses the surface at these parameters
};

/// One pass over the stream: root, basis, products, block by block in the first cache; sums are
/// formed per block and then over blocks, always in the same order.
NormalMatrix accumulate(const Surface& surface, std::span<const double> working,
                        const PreparedStream& stream, const LossScale& loss);

/// Reading − prediction, one per reading. @returns false where a probe line misses the surface.
bool residuals(const Surface& surface, std::span<const double> working,
               const PreparedStream& stream, std::span<double> out_mm);

/// Sums over readings of a robust loss: ρ, its second derivative ψ' and its weight ψ/r.
struct LossSums {
  double rho = 0.0, curvature = 0.0, weight = 0.0;
};

/// Scales columns and residual of a block by the square root of the loss's weight.
/// Eqs. 23, 26, 27.
void apply_loss(const LossScale& loss, std::size_t columns, std::size_t filled,
                PredictionBlock& block, LossSums& sums);

}  // namespace trueaxis
