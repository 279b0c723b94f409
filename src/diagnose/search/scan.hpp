// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "diagnose/regression/normal_equations.hpp"
#include "math/fourier_sums.hpp"

namespace trueaxis::diagnose_detail {

/// A line found in a scan, before it is refined.
struct Peak {
  Hypothesis hypothesis;
  double gain = 0.0;       ///< decrease of the sum of squares, the surface's own columns forgotten
  double step = 0.0;       ///< of the scanned frequency, half a resolution cell
  double frequency = 0.0;  ///< scanned variable: cycles per revolution, s, mm
};

/// Periodograms of the residuals, over everything a line can be periodic in.
struct Scans {
  std::vector<Peak> causes;    ///< of catalogued kinds, the best of each scan first
  std::vector<Peak> patterns;  ///< (order × Z frequency) and (order × time frequency)
  double bandwidth = 0.0;      ///< Σ of W = Δf √(4π var x) (Baluev 2008, eq. 5) over the scans
};

class LineNorms;

/// A bin of a scan, and what its line takes off the sum of squares.
struct Top {
  std::size_t bin;
  double gain;
};

/// Scans of the readings of a problem, which outlives it; of means only lines that they keep.
/// Eq. 72.
class LineScanner {
 public:
  /// @param fast null: all lines; else those that these means would weaken by 10 %
  explicit LineScanner(const Problem& problem, const Means* fast = nullptr);
  ~LineScanner();

  /// @param equations of the readings of the problem
  /// @param remainder_mm deviation minus base and terms, not whitened
  /// May be called by several threads.
  Scans operator()(const NormalEquations& equations, std::vector<double> remainder_mm) const;
  double bandwidth() const { return bandwidth_; }  ///< see Scans

 private:
  struct Band;
  struct Job;
  using Tops = std::vector<std::vector<Top>>;  ///< the highest of a band, scan by scan
  std::shared_ptr<const FourierSums> plan_of(const Job& job, const Band& band) const;
  struct Norms;
  std::shared_ptr<const Norms> norms_of(const Job& job, const Band& band,
                                        const LineNorms& norms) const;
  Tops tops_of(const Job& job, const Band& band, const LineNorms& norms,
               const std::vector<double>& left) const;
  /// The same of a band of fringes, looked at cell by cell.
  Tops tops_of_fringes(const Job& job, const Band& band, const LineNorms& norms,
                       const std::vector<double>& left) const;
  void add_peaks(const Job& job, const std::vector<Tops>& of_bands, Scans& out) const;

  const Problem& problem_;
  std::vector<Job> jobs_;
  mutable std::mutex plans_;  ///< of the bands, while they are made
  double bandwidth_ = 0.0;
};

/// The same hypothesis at another frequency of its scan.
Hypothesis at_frequency(const Hypothesis& hypothesis, double frequency);
double frequency_of(const Hypothesis& hypothesis);
/// Whether the hypothesis has a frequency that a scan has found.
bool is_line(const Hypothesis& hypothesis);
/// What a line is periodic in.
PointColumn variable_of(const Hypothesis& line);

/// Σ⁻¹ times the residuals, up to the innovation's variance: WᵀW e; 0 where a row does not count.
/// Eq. 66.
std::vector<double> weighted(const NormalEquations& equations, std::vector<double> remainder_mm);

}  // namespace trueaxis::diagnose_detail
