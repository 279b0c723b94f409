// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "base/number.hpp"
#include "calibrate/estimate/column_mistakes.hpp"
#include "calibrate/estimate/tip_fit.hpp"
#include "math/golden_section.hpp"
#include "trueaxis/calibration.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

using namespace calibrate_detail;

constexpr double far_too_small = 30.0;  // scatter over the noise that is stated, or its inverse
constexpr double same_factor = 0.02;    // of a factor between two units

struct Limits {
  double largest, left;  ///< mm or rad
};
Limits limits_of(AxisName axis) {
  return is_rotary(axis) ? Limits{20.0 * rad_per_deg, 0.5 * rad_per_deg} : Limits{5.0, 0.05};
}

struct Factor {
  double of;
  const char* words;
};

/// By what `actual` grows with `command`.
double slope_of(const MachineMeasurement& file) {
  const std::size_t axis = index_of(*file.axis);
  const auto n = static_cast<double>(file.rows());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < file.rows(); ++i)
    x += file.axes[i][axis] / n, y += file.actual[i] / n;
  for (std::size_t i = 0; i < file.rows(); ++i) {
    const double dx = file.axes[i][axis] - x;
    xx += dx * dx;
    xy += dx * (file.actual[i] - y);
  }
  return xx > 0.0 ? xy / xx : 1.0;
}

std::string unit_mistake(const MachineMeasurement& file) {
  static constexpr Factor lengths[] = {{1e3, "actual is in um, or command in m"},
                                       {1e-3, "actual is in m, or command in um"},
                                       {25.4, "command is in inch"},
                                       {1.0 / 25.4, "actual is in inch"}};
  static constexpr Factor angles[] = {{rad_per_deg, "actual is in radians"},
                                      {1.0 / rad_per_deg, "command is in radians"}};
  const std::span<const Factor> factors =
      is_rotary(*file.axis) ? std::span<const Factor>(angles) : std::span<const Factor>(lengths);
  const double slope = slope_of(file);
  if (std::abs(slope + 1.0) < same_factor) return "one of the two columns runs the other way";
  for (const Factor& factor : factors)
    if (std::abs(slope / factor.of - 1.0) < same_factor)
      return std::string(factor.words) + ": write the unit that the numbers have";
  return "check that both columns belong to this axis and have the units of the header";
}

/// The mistake that the read-outs of axes most likely have. Columns differ by 5 mm or 5° and more,
/// as with columns in two units, or their residuals are thirty times the stated noise and more than
/// axes leave. Empty: none.
std::string read_out_mistake(std::span<const MachineMeasurement> data, const Calibration& found) {
  auto read_out = found.read_outs.begin();
  for (const MachineMeasurement& file : data) {
    if (file.kind != MeasurementKind::axis || read_out == found.read_outs.end()) continue;
    const AxisReadOut& one = *read_out++;
    const bool rotary = is_rotary(one.axis);
    const double unit = rotary ? rad_per_deg : mm_per_um;
    const char* const name = rotary ? "deg" : "µm";
    const Limits limits = limits_of(one.axis);
    double largest = one.rms_before;
    if (one.polynomial.size() > 1) largest = std::max(largest, std::abs(one.polynomial[1].value));
    if (largest > limits.largest)
      return fmt::format("{}: actual and command of {} differ by {:.3g} {}: {}", file.source,
                         letter_of(one.axis), largest / unit, name, unit_mistake(file));
    const double noise = file.noise_mm.value_or(0.0);
    if (one.rms_after <= std::max(far_too_small * noise, limits.left)) continue;
    const std::string said = noise > 0.0 ? fmt::format(", and their stated noise is {} {}",
                                                       significant(noise / unit, 2), name)
                                         : std::string();
    return fmt::format("{}: the fit leaves residuals of {:.3g} {} in the read-out of {}{}: {}",
                       file.source, one.rms_after / unit, name, letter_of(one.axis), said,
                       unit_mistake(file));
  }
  return "";
}

constexpr double far_better = 0.5;   // of the RMS: four times the χ²
constexpr double well_fitted = 1.4;  // RMS over a stated σ: nothing is looked for
constexpr double much_fitted = 0.3;  // of the RMS before, where no σ is stated: nothing either
// RMS that machines leave once everything is fitted: ten times what the component errors of worn
// ones do (docs/reference/calibration.md).
constexpr double largest_left_mm = 0.05;
constexpr double explained_mm = 0.02;   // RMS: a mistake that leaves more explains nothing
constexpr double least_tool_mm = 0.01;  // to which the lengths of tools are known anyway
constexpr double some_numbers = 120;    // of readings, on which a mistake is tried first
constexpr double some_leeway = 1.3;     // of the RMS that is left of them

/// RMS of the readings once location errors are fitted; none where there is no fit, or one that no
/// machine has.
std::optional<double> left_mm(const Machine& machine, std::span<const MachineMeasurement> data,
                              const CalibrationOptions& options) {
  std::vector<MachineMeasurement> tips;  // `read_out_mistake` looks at read-outs
  std::ranges::copy_if(data, std::back_inserter(tips), [](const MachineMeasurement& file) {
    return file.kind != MeasurementKind::axis;
  });
  Calibration fitted;
  fitted.errors = options.errors;
  if (!fit_tips(machine, tips, options, true, fitted) || !fitted.converged) return std::nullopt;
  if (!implausible(fitted, options).empty()) return std::nullopt;
  return fitted.rms_after_mm;
}

/// The rows that are kept, by file and row; read-outs whole.
template <class Kept>
std::vector<MachineMeasurement> rows_of(std::span<const MachineMeasurement> data, Kept kept) {
  std::vector<MachineMeasurement> out(data.begin(), data.end());
  for (std::size_t f = 0; f < out.size(); ++f) {
    MachineMeasurement& file = out[f];
    if (file.kind == MeasurementKind::axis) continue;
    const auto thin = [&](auto& column) {
      std::size_t row = 0;
      std::erase_if(column, [&](const auto&) { return !kept(f, row++); });
    };
    thin(file.setup), thin(file.ball), thin(file.axes), thin(file.deviation_mm);
    thin(file.length_mm), thin(file.along_mm), thin(file.tool_length_mm), thin(file.time_s);
  }
  return out;
}

/// Rows here and there, some 120 numbers of them, for a first look at many mistakes.
std::vector<MachineMeasurement> some_of(std::span<const MachineMeasurement> data,
                                        std::size_t numbers) {
  const double share = some_numbers / static_cast<double>(numbers);
  return rows_of(data, [&](std::size_t, std::size_t row) { return golden_share(row) < share; });
}

/// The RMS of `left_mm`; none either where there are too few rows.
std::optional<double> left_of_some_mm(const Machine& machine,
                                      std::span<const MachineMeasurement> data,
                                      const CalibrationOptions& options) {
  try {
    return left_mm(machine, data, options);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// Tools whose lengths are wrong against each other, each by what leaves least of the readings: the
/// square of this is a parabola of the length.
std::vector<Mistake> tool_mistakes(const Machine& machine, std::span<const MachineMeasurement> data,
                                   const CalibrationOptions& options) {
  std::vector<Mistake> out;
  for (const double length_mm : tool_lengths(machine, data)) {
    const auto square = [&](double more_mm) {
      std::vector<MachineMeasurement> longer(data.begin(), data.end());
      for (MachineMeasurement& file : longer) longer_tool(length_mm, more_mm).undo(file);
      const double left = left_of_some_mm(machine, longer, options).value_or(0.0);
      return left * left;
    };
    const double step = options.largest_length_mm;
    const double less = square(-step), more = square(step), here = square(0.0);
    const double most_mm = 0.5 * step * (less - more) / (less + more - 2.0 * here);
    if (std::abs(most_mm) > least_tool_mm) out.push_back(longer_tool(length_mm, most_mm));
  }
  return out;
}

void undo(const Mistake& mistake, std::vector<MachineMeasurement>& data) {
  for (MachineMeasurement& file : data)
    if (file.kind != MeasurementKind::axis) mistake.undo(file);
}

/// Whether a mistake is worth a look at all rows: it leaves little of some, or they do not tell.
class Worthwhile {
 public:
  /// @param most_mm RMS that any mistake may leave; none: a share of the RMS as it was read
  Worthwhile(const Machine& machine, std::span<const MachineMeasurement> data,
             const CalibrationOptions& options, std::size_t numbers, std::optional<double> most_mm)
      : machine_(machine), options_(options), some_(some_of(data, numbers)), of_any_mm_(most_mm) {
    if (static_cast<double>(numbers) <= some_numbers)
      of_any_mm_.reset();
    else if (!most_mm)
      as_read_mm_ = left_of_some_mm(machine, some_, options);
  }
  bool operator()(const Mistake& mistake) const {
    if (!of_any_mm_ && !as_read_mm_) return true;
    const double most_mm = of_any_mm_ ? *of_any_mm_ : far_better * mistake.smaller * *as_read_mm_;
    std::vector<MachineMeasurement> right = some_;
    undo(mistake, right);
    try {
      const auto again_mm = left_mm(machine_, right, options_);
      return again_mm && *again_mm < some_leeway * most_mm;
    } catch (const InputError&) {
      return true;  // too few rows
    }
  }

 private:
  const Machine& machine_;
  const CalibrationOptions& options_;
  std::vector<MachineMeasurement> some_;
  std::optional<double> of_any_mm_, as_read_mm_;
};

/// The one row without which the readings fit, by halving of what does not. Empty: there is none.
std::string one_wrong_row(const Machine& machine, std::span<const MachineMeasurement> data,
                          const CalibrationOptions& options, double fine_mm) {
  using Place = std::pair<std::size_t, std::size_t>;
  std::vector<Place> in, out;
  for (std::size_t f = 0; f < data.size(); ++f)
    for (std::size_t row = 0; data[f].kind != MeasurementKind::axis && row < data[f].rows(); ++row)
      (row % 2 == 0 ? in : out).emplace_back(f, row);
  const auto left = [&](const std::vector<Place>& rows) {
    const std::set<Place> kept(rows.begin(), rows.end());
    return left_of_some_mm(machine,
                           rows_of(data,
                                   [&](auto f, auto row) {
                                     return kept.contains({f, row});
                                   }),
                           options)
        .value_or(std::numeric_limits<double>::infinity());
  };
  if (left(in) > fine_mm) std::swap(in, out);
  if (left(in) > fine_mm) return "";
  while (out.size() > 1) {
    const auto middle = out.begin() + static_cast<std::ptrdiff_t>(out.size() / 2);
    std::vector<Place> half(out.begin(), middle), more = in;
    more.insert(more.end(), half.begin(), half.end());
    if (left(more) <= fine_mm) {
      in = std::move(more), out.erase(out.begin(), middle);
    } else {
      in.insert(in.end(), middle, out.end());
      out = std::move(half);
    }
  }
  if (out.empty() || left(in) > fine_mm) return "";
  return fmt::format(
      "no machine model fits row {} of {}, and {:.3g} µm are left without it: correct the row, or "
      "leave it out",
      out.front().second + 1, data[out.front().first].source, left(in) / mm_per_um);
}

/// Whether residuals are far too small for their noise, however few their degrees of freedom.
bool scatters_too_little(const Calibration& found) {
  const double ratio = found.rms_parameters_mm / found.stated_noise_mm;
  const auto n = static_cast<double>(found.equations);
  return ratio * far_too_small < 1.0 &&
         cdf(boost::math::chi_squared(n - static_cast<double>(found.unknowns)), n * ratio * ratio) <
             1e-3;
}

/// Whatever k is printed: a wrong unit stays wrong.
double least_size(const CalibratedParameter& p) {
  return std::abs(p.estimate.value) - 2.0 * p.estimate.u;
}

}  // namespace

std::string likely_mistake(const Machine& machine, std::span<const MachineMeasurement> data,
                           const CalibrationOptions& options, const Calibration& found,
                           double left_by_all_mm) {
  if (const std::string why = read_out_mistake(data, found); !why.empty()) return why;
  if (found.equations == 0 || found.balls.empty()) return "";  // read-outs alone
  if (found.converged && scatters_too_little(found))
    return fmt::format(
        "the readings scatter by {} µm, but their stated noise is {} µm: check the unit of "
        "the deviations in the header, and `# noise`",
        significant(found.rms_after_mm / mm_per_um, 2),
        significant(found.stated_noise_mm / mm_per_um, 2));
  const double as_read_mm = found.rms_parameters_mm;
  const bool wrong = !found.converged || !implausible(found, options).empty();
  const double fine_mm = found.stated_noise_mm > 0.0 ? well_fitted * found.stated_noise_mm
                                                     : much_fitted * found.rms_before_mm;
  const bool in_proportion =
      left_by_all_mm <= std::max(far_too_small * found.stated_noise_mm, largest_left_mm);
  if (!wrong && in_proportion && as_read_mm < fine_mm) return "";
  if (wrong || !in_proportion)
    if (std::string row = one_wrong_row(machine, data, options, fine_mm); !row.empty()) return row;
  std::string best;
  double least_mm = wrong ? std::numeric_limits<double>::infinity() : far_better * as_read_mm;
  const double explained = std::max(fine_mm, explained_mm);
  const Worthwhile worthwhile(machine, data, options, found.equations,
                              wrong ? std::optional(explained) : std::nullopt);
  std::vector<Mistake> mistakes = column_mistakes(machine, data);
  std::ranges::move(tool_mistakes(machine, data, options), std::back_inserter(mistakes));
  for (const Mistake& mistake : mistakes) {
    if (!worthwhile(mistake)) continue;
    std::vector<MachineMeasurement> right(data.begin(), data.end());
    undo(mistake, right);
    const std::optional<double> again_mm = left_mm(machine, right, options);
    if (!again_mm || *again_mm > explained || !(*again_mm < least_mm * mistake.smaller)) continue;
    least_mm = *again_mm / mistake.smaller;
    best = fmt::format(
        "{}, and {:.3g} µm are left if {}: {}",
        wrong ? "no machine model fits the readings"
              : fmt::format("the fit leaves residuals of {:.3g} µm", as_read_mm / mm_per_um),
        *again_mm / mm_per_um, mistake.what, mistake.mend);
  }
  if (!best.empty() || (wrong ? found.converged : in_proportion)) return best;
  const double noise_um = found.stated_noise_mm / mm_per_um;
  return (wrong ? "no machine model fits the readings"
                : fmt::format("even with every error that a machine can have, the residuals are "
                              "{:.3g} µm",
                              left_by_all_mm / mm_per_um)) +
         (noise_um > 0.0
              ? fmt::format(", and their stated noise is {} µm", significant(noise_um, 2))
              : "") +
         ", and no usual mistake in the columns explains it: check the units of deviations and "
         "positions in the header. Check that the machine file, the zeros of the axes, the tool "
         "length and the columns belong to the measurement, and that nothing moved";
}

std::string implausible(const Calibration& found, const CalibrationOptions& options) {
  constexpr double far_beyond = 50.0;  // largest plausible sizes: 5 mm, 0.6 degrees
  for (const CalibratedParameter& p : found.parameters) {
    const bool angle = p.estimate.unit == "rad";
    const double most =
        far_beyond * (angle ? options.largest_angle_rad : options.largest_length_mm);
    if (!(least_size(p) > most)) continue;
    return fmt::format(
        "{} is {:.4g} {}: no machine is so far from its model, and no usual mistake in the columns "
        "explains it. Check the zeros of the axes and the tool length, and that the machine file "
        "and the units and signs of the columns belong to the measurement",
        p.name, p.estimate.value * edge_factor(p.estimate.unit), angle ? "deg" : "mm");
  }
  return "";
}

std::string beyond_plausible(const Calibration& found, const CalibrationOptions& options) {
  const CalibratedParameter* furthest = nullptr;
  for (const CalibratedParameter& p : found.parameters)
    if (p.estimate.unit == "mm" && least_size(p) > options.largest_length_mm &&
        (furthest == nullptr || least_size(p) > least_size(*furthest)))
      furthest = &p;
  if (furthest == nullptr) return "";
  return fmt::format(
      "check the tool length and the points in the machine file, as {} is {:.3g} mm (machines have "
      "{:g} mm at most): a length that is wrong by as much reads the same",
      furthest->name, furthest->estimate.value, options.largest_length_mm);
}

std::string components_beyond_plausible(const Calibration& found) {
  std::string beyond;
  for (const CalibratedComponent& one : found.components) {
    const bool angle = one.rms.unit == "rad";
    if (one.beyond)
      beyond += fmt::format("{}{} {:.3g} {}", beyond.empty() ? "" : ", ", one.name,
                            one.rms.value * (angle ? 1e6 : 1.0 / mm_per_um), angle ? "µrad" : "µm");
  }
  if (beyond.empty()) return "";
  return fmt::format(
      "check tool lengths, scales and what moved or drifted, as component errors of {} RMS are ten "
      "times and more what machines have. Location errors may be wrong with them",
      beyond);
}

}  // namespace trueaxis
