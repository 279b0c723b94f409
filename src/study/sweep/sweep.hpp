// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "study/bound/quantities.hpp"
#include "study/sweep/scenario_parameters.hpp"
#include "trueaxis/surface.hpp"
#include "trueaxis/virtual_lathe.hpp"

/// Robustness studies: a scenario of the virtual lathe over a grid, repeated with other noise, and
/// what the fit or the diagnosis makes of it, compared with the Cramér-Rao bound.
namespace trueaxis::study {

/// Lists that take the place of the scenario's, each as a whole.
struct Lists {
  std::optional<std::vector<virtual_lathe::PlannedPass>> passes;
  std::optional<std::vector<virtual_lathe::Chucking>> setups;
  std::optional<std::vector<virtual_lathe::Effect>> effects;

  void put_into(virtual_lathe::Scenario& scenario) const;
};

/// A point of an axis of the grid: one number or, for a case with a name, several, and lists.
struct AxisPoint {
  std::string label;  ///< as in the file: "5", "uniform"
  std::vector<Setting> settings;
  Lists lists{};
};

struct GridAxis {
  std::string name;  ///< as in the file: "noise.sigma_um", "noise kind"
  std::vector<AxisPoint> points;
};

/// A number of the scenario that every repeat draws anew.
struct Drawn {
  enum class Kind { uniform, normal, log_uniform };
  std::string name;  ///< as in the file
  std::string path;
  Kind kind = Kind::uniform;
  double first = 0.0, second = 1.0;  ///< low and high; normal: mean and standard deviation
};

/// What is studied.
enum class Method { fit, huber, tukey, diagnosis };

struct Sweep {
  std::string name;
  virtual_lathe::Scenario base;
  std::string surface;            ///< fitted; empty: that of the part
  std::vector<Setting> settings;  ///< of all cells, before the numbers of the axes
  std::vector<GridAxis> axes;     ///< a grid: every point of one with every point of the others
  std::vector<Drawn> drawn;       ///< outside the grid
  /// Pass band of the roundness that is compared as well, undulations per revolution; none: none
  /// is.
  std::optional<std::array<double, 2>> form_upr{};
  std::vector<Method> methods{Method::fit};  ///< each on the same readings
  std::size_t repeats = 2000;
  std::uint64_t seed = 1;
  std::vector<std::string> input_files;  ///< that the sweep was read from
  std::string input_hash;                ///< of all their bytes
};

/// Surface that the sweep fits.
SurfaceKind fitted_surface(const Sweep& sweep);

/// What a sweep compares: the quantities of its surface, the residual of a scenario that cuts, and
/// with a pass band the roundness.
std::vector<Quantity> compared_quantities(const Sweep& sweep);

/// A cell is a point of the grid and a method; the method changes fastest, then the last axis.
struct Cell {
  std::size_t grid = 0;
  Method method = Method::fit;
  std::vector<std::size_t> point;  ///< of every axis
};
std::size_t cell_count(const Sweep& sweep);
Cell cell_at(const Sweep& sweep, std::size_t cell);
/// The labels of its point, one an axis.
std::vector<std::string> labels_of(const Sweep& sweep, const Cell& cell);

/// The scenario of a cell: first the lists of its cases, then the sweep's settings, then the
/// numbers of all axes together. Its noise is seeded for repeat 0 and nothing drawn: a drawn number
/// is at the middle of its distribution.
virtual_lathe::Scenario scenario_of(const Sweep& sweep, std::size_t cell);

/// The scenario of a repeat: a function of (sweep, grid point, repeat) alone, whatever else is run,
/// and the same for all methods.
virtual_lathe::Scenario scenario_of(const Sweep& sweep, std::size_t cell, std::size_t repeat);

/// Seed of a repeat's noise: Philox of (repeat, grid point) under the sweep's seed.
std::uint64_t seed_of(const Sweep& sweep, std::size_t cell, std::size_t repeat);

const char* to_string(Method method);

}  // namespace trueaxis::study
