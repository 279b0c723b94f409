// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <hwy/aligned_allocator.h>

#include <Eigen/Dense>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "diagnose/geometry/condense.hpp"
#include "diagnose/geometry/hypothesis.hpp"
#include "diagnose/geometry/observation_mask.hpp"
#include "infer/gram.hpp"

namespace trueaxis::diagnose_detail {

/// Columns of some readings as computed and as whitened, in aligned memory padded with zeros.
class WhiteColumns {
 public:
  /// @param history readings before the first that the others are predicted from
  /// @param rows at most
  WhiteColumns(std::size_t columns, std::size_t history, std::size_t rows);

  std::span<double* const> raw() const { return raw_column_; }
  /// y_i − Σ φ_j y_{i−j} of `rows` rows, the first of them after `lead` others.
  void whiten(const std::vector<double>& phi, std::size_t lead, std::size_t rows);
  /// A row that comes `run` readings after the first of its run, fewer than the order.
  void begin_run(const std::vector<double>& phi, std::size_t lead, std::size_t row,
                 std::size_t run);
  /// A row that does not count.
  void drop(std::size_t row);
  /// Those of `rows` rows, padded; the same again.
  std::span<const double* const> white(std::size_t rows);
  std::span<const double* const> white() const { return view_; }
  /// Leaves only what is whitened.
  void forget_raw();

 private:
  std::size_t history_;
  hwy::AlignedFreeUniquePtr<double[]> raw_, white_;
  std::vector<double*> raw_column_, white_column_;
  std::vector<const double*> view_;
};

/// Which products are made of columns that are appended to others.
struct Appended {
  std::size_t before = 0;         ///< columns that are there already
  std::size_t together = 0;       ///< and those that are fitted with them
  std::vector<std::size_t> ends;  ///< of the groups after these that are judged one by one

  std::size_t columns() const { return ends.empty() ? together : ends.back(); }
};

/// Sums over readings of the products that columns appended to others have with those, with each
/// other where they are fitted together, and within a group that is judged alone.
class GramSums {
 public:
  /// @param of outlives this
  explicit GramSums(const Appended& of);

  /// Columns are those there and those appended, 64-byte aligned, padded as of a WideBlock.
  void add(std::span<const double* const> columns, std::size_t rows);
  /// Adds them to the rows and columns of a symmetric matrix of all columns.
  void add_to(Eigen::MatrixXd& gram) const;

 private:
  const Appended* of_;
  std::vector<double> fitted_, cross_, apart_, groups_;
};

using namespace infer;

/// Whether streams of a kind have an effect.
inline bool is_of(const Effect& effect, const BaseKind& base) {
  return effect.needs.stream.value_or(base.stream()) == base.stream();
}

/// The effects that may be causes: those of the catalogue, each as `own` has it if it does, then
/// what else is a user's own; no checks, and none that such a stream cannot have.
inline std::vector<const Effect*> possible_causes(const BaseKind& base,
                                                  std::span<const Effect> own = {}) {
  std::vector<const Effect*> list;
  for (const std::span<const Effect> some : {effect_catalogue(), own})
    for (const Effect& effect : some) {
      const Effect* used = find_effect(effect.id, own);
      if (!std::holds_alternative<std::monostate>(effect.term) && is_of(effect, base) &&
          std::ranges::find(list, used) == list.end())
        list.push_back(used);
    }
  return list;
}

/// What a search is given and does not change.
struct Problem {
  const LinearisationPoint& point;
  const ObservationMask& mask;
  const Resolution& resolution;
  std::span<const double> deviation_mm;
  double false_alarm = 0.01;
  int threads = 1;
  std::size_t most_terms = 8;
  std::vector<const Effect*> effects = possible_causes(point.base);
  double rounding_mm = 0.0;  ///< step of the readings where it may show; 0: it does not
  // Where the readings are means:
  const Means* means = nullptr;
  const Problem* whole = nullptr;  ///< all readings
  std::vector<Hypothesis> fast{};  ///< lines found in all readings that means do not show
  double fast_bandwidth = 0.0;     ///< of what was scanned for them
  /// Over a single pass, how far from one per revolution a line is to be looked for.
  double fewest_cycles = 0.75;

  /// The same readings about another point.
  Problem about(const LinearisationPoint& other, std::span<const double> deviation) const {
    Problem out{other,   mask,       resolution, deviation,  false_alarm,
                threads, most_terms, effects,    rounding_mm};
    out.fewest_cycles = fewest_cycles;
    return out;
  }
};

/// The Gram matrix of [readings | base | hypotheses], whitened, also block by block of readings:
/// all that tests, refits and held-out predictions need of the data. Column 0 is the deviation of
/// the readings from the point's surface (mm); then the base; then what was appended.
class NormalEquations {
 public:
  /// @param autoregression φ of ε_i = Σ φ_j ε_{i−j} + e_i: a row is y_i − Σ φ_j y_{i−j}, and where
  ///        a run of readings begins that of RunStart.
  /// @param blocks whether the Gram matrices of the blocks are wanted, or their sum alone
  NormalEquations(const LinearisationPoint& point, const ObservationMask& mask,
                  std::span<const double> deviation_mm, std::vector<double> autoregression,
                  int threads, bool blocks = false);

  /// One pass over the readings. @returns the columns of each hypothesis.
  std::vector<Columns> append(std::span<const Hypothesis> list) {
    return append(list, list.size());
  }
  /// The same where only the first `together` are fitted: those after them are judged one by one
  /// together with these and what is there already, and no product of two of them is made (0).
  /// Cells of one order of the Fourier-Legendre basis in a row count as one.
  std::vector<Columns> append(std::span<const Hypothesis> list, std::size_t together);

  const Eigen::MatrixXd& total() const { return total_; }
  /// The sums of the blocks for cross-validation. @throws ContractViolation where they were not
  /// asked for.
  const std::vector<Eigen::MatrixXd>& folds() const;
  std::size_t count() const { return count_; }  ///< rows that count
  /// 2 ln of the determinant of the whitening; only the first readings of runs count in it.
  double log_volume() const { return log_volume_; }
  const Columns& base() const { return base_; }
  const std::vector<double>& autoregression() const { return autoregression_; }
  const LinearisationPoint& point() const { return *point_; }
  const ObservationMask& mask() const { return *mask_; }
  std::span<const double> deviation() const { return deviation_; }
  int threads() const { return threads_; }
  /// Drops all columns from `columns` on.
  void shrink(std::size_t columns);
  /// With few readings, keeps the columns that are there, whitened, for all that is appended later;
  /// these are not dropped again.
  void keep_columns();

 private:
  struct Kept;
  /// Calls work(readings with those that predict them, the first that counts here, number) for
  /// the blocks of a part.
  template <typename Work>
  void for_each_block(std::size_t part, const Work& work) const;
  void pass(std::span<const Hypothesis> fresh, std::size_t together);
  Appended appended(std::span<const Hypothesis> fresh, std::size_t together) const;
  GramSums sums_of(std::size_t part, std::span<const Hypothesis> fresh,
                   const Appended& appended) const;
  std::size_t counted(std::size_t begin, std::size_t end) const;
  int threads_for_columns(std::size_t columns) const;
  void fill_raw(std::span<const Hypothesis> fresh, const PointPart& part,
                std::span<double* const> columns) const;
  /// Columns that are not kept, and fresh ones, of readings from `begin` on.
  void fill_white(std::span<const Hypothesis> fresh, const PointPart& at, std::size_t begin,
                  WhiteColumns& out) const;

  const LinearisationPoint* point_;
  const ObservationMask* mask_;
  std::span<const double> deviation_;
  std::vector<double> autoregression_;
  int threads_;
  std::vector<Hypothesis> list_;
  Columns base_;
  std::size_t count_ = 0;
  double log_volume_ = 0.0;
  double floor2_ = 0.0;  ///< mm²: what rounding and the linearisation of the columns leave
  Eigen::MatrixXd total_;
  std::vector<std::size_t> part_begin_;  ///< of what one Gram matrix sums over
  std::vector<Eigen::MatrixXd> folds_;
  std::shared_ptr<const Kept> kept_;  ///< copies share it
};

inline std::span<const double> span_of(const Eigen::VectorXd& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

}  // namespace trueaxis::diagnose_detail
