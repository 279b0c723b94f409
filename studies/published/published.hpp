// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "study/sweep/sweep.hpp"

namespace trueaxis::study {

/// A number as it was printed, in its edge unit.
struct PrintedNumber {
  std::string text;
  double value = 0.0;
  int decimals = 0;  ///< after the point: what was printed is rounded to half of the last one
};

/// One single run of a published table.
struct PublishedRow {
  std::string name;
  std::size_t grid = 0;  ///< its place in the sweep's grid
  /// The axis whose point is not known (damaged in print): the noise level; `grid` is then at the
  /// axis' first point.
  std::optional<std::size_t> unknown_axis;
  std::vector<PrintedNumber> values;  ///< of Published::parameters
};

/// What the printed numbers may mean.
struct PublishedReading {
  std::string name;
  std::vector<Setting> settings;  ///< of the scenario, before the axes of the grid
  /// Printed error over the error of the sweep's quantity, one for each parameter.
  std::vector<double> printed_per_error;
  double noise_factor = 1.0;        ///< true noise over the one that the table states
  bool fit_noise = false;           ///< the factor is estimated by likelihood instead
  std::vector<int> least_decimals;  ///< of each parameter: shorter numbers lost zeros at their end
};

/// Results that were published, to be placed in the distribution of the sweep.
struct Published {
  std::string source;
  std::vector<std::string> parameters;  ///< names of quantities()
  std::vector<PublishedRow> rows;
  std::vector<PublishedReading> readings;  ///< the first is the plain one: the sweep as it is
};

/// A sweep and, where its file has them, results of it that someone printed.
struct PublishedSweep {
  Sweep sweep;
  std::optional<Published> published;
};

}  // namespace trueaxis::study
