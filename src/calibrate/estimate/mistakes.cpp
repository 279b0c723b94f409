// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "calibrate/estimate/tip_fit.hpp"
#include "math/golden_section.hpp"
#include "trueaxis/calibration.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

using calibrate_detail::fit_tips;

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
    const std::string said =
        noise > 0.0 ? fmt::format(", and their stated noise is {:.2g} {}", noise / unit, name)
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
constexpr double some_numbers = 120;  // of readings, on which a mistake is tried first
constexpr double some_leeway = 1.3;   // of the RMS that is left of them

/// A way in which columns are written wrongly, and how they are mended.
struct Mistake {
  std::string what, mend;
  std::function<void(MachineMeasurement&)> undo;
  /// The factor by which mending makes the readings smaller, and the residuals with it.
  double smaller = 1.0;
};

std::string d(std::size_t i) { return std::string("d") + "XYZ"[i]; }

Mistake exchanged_axes(AxisName a, AxisName b) {
  const std::string both = std::string(1, letter_of(a)) + " and " + std::string(1, letter_of(b));
  return {"the columns " + both + " are exchanged", "exchange them", [=](MachineMeasurement& file) {
            for (AxisPositions& at : file.axes) std::swap(at[index_of(a)], at[index_of(b)]);
          }};
}

Mistake scaled_axis(AxisName axis, double factor, const std::string& what,
                    const std::string& mend) {
  const std::string letter(1, letter_of(axis));
  return {fmt::format(fmt::runtime(what), letter), fmt::format(fmt::runtime(mend), letter),
          [=](MachineMeasurement& file) {
            for (AxisPositions& at : file.axes) at[index_of(axis)] *= factor;
          }};
}

/// Deviations in another unit than their header says.
Mistake scaled_deviations(double factor, const std::string& is, const std::string& said) {
  return {"the deviations are in " + is + " and the header says " + said,
          "write [" + is + "] after their names",
          [=](MachineMeasurement& file) {
            for (Vector3& one : file.deviation_mm)
              for (double& size : one) size *= factor;
          },
          std::min(1.0, factor)};
}

void add_deviations(std::vector<Mistake>& list) {
  list.push_back(scaled_deviations(1.0 / mm_per_um, "mm", "um"));
  list.push_back(scaled_deviations(mm_per_um, "um", "mm"));
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i + 1; j < 3; ++j)
      list.push_back({"the columns " + d(i) + " and " + d(j) + " are exchanged", "exchange them",
                      [=](MachineMeasurement& file) {
                        for (Vector3& one : file.deviation_mm) std::swap(one[i], one[j]);
                      }});
  for (std::size_t i = 0; i < 3; ++i)
    list.push_back({"the column " + d(i) + " has the wrong sign",
                    "it is ball's centre - tip: turn its sign", [=](MachineMeasurement& file) {
                      for (Vector3& one : file.deviation_mm) one[i] = -one[i];
                    }});
  list.push_back({"dX, dY and dZ have the wrong sign",
                  "they are ball's centre - tip: turn their signs", [](MachineMeasurement& file) {
                    for (Vector3& one : file.deviation_mm)
                      for (double& size : one) size = -size;
                  }});
}

/// Of every column that these files have.
std::vector<Mistake> mistakes_of(const Machine& machine, std::span<const MachineMeasurement> data) {
  std::vector<Mistake> list;
  const bool deviations = std::ranges::any_of(
      data, [](const MachineMeasurement& file) { return !file.deviation_mm.empty(); });
  if (deviations) add_deviations(list);
  const auto& axes = machine.axes;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    for (std::size_t j = i + 1; j < axes.size(); ++j)
      if (is_rotary(axes[i].name) == is_rotary(axes[j].name))
        list.push_back(exchanged_axes(axes[i].name, axes[j].name));
    list.push_back(scaled_axis(axes[i].name, -1.0, "the column {} runs the other way",
                               "turn its sign, or axes.{}.direction of the machine"));
    if (!is_rotary(axes[i].name)) {
      list.push_back(
          scaled_axis(axes[i].name, mm_per_inch, "the column {} is in inch", "write {}[in]"));
      list.push_back(
          scaled_axis(axes[i].name, 1.0 / mm_per_inch, "the column {} is in mm", "write {}[mm]"));
      continue;
    }
    list.push_back(scaled_axis(axes[i].name, 1.0 / rad_per_deg, "the column {} is in radians",
                               "write {}[rad]"));
    list.push_back(
        scaled_axis(axes[i].name, rad_per_deg, "the column {} is in degrees", "write {}[deg]"));
  }
  for (const bool inch : {true, false})
    list.push_back({std::string("X, Y and Z are in ") + (inch ? "inch" : "mm"),
                    std::string("write [") + (inch ? "in]" : "mm]") + " after their names",
                    [=](MachineMeasurement& file) {
                      for (AxisPositions& at : file.axes)
                        for (std::size_t k = 0; k < 3; ++k)
                          at[k] *= inch ? mm_per_inch : 1.0 / mm_per_inch;
                    }});
  return list;
}

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

void undo(const Mistake& mistake, std::vector<MachineMeasurement>& data) {
  for (MachineMeasurement& file : data)
    if (file.kind != MeasurementKind::axis) mistake.undo(file);
}

/// Whether a mistake is worth a look at all rows: it leaves little of some, or they do not tell.
class Worthwhile {
 public:
  Worthwhile(const Machine& machine, std::span<const MachineMeasurement> data,
             const CalibrationOptions& options, std::size_t numbers)
      : machine_(machine), options_(options), some_(some_of(data, numbers)) {
    if (static_cast<double>(numbers) > some_numbers)
      as_read_mm_ = left_of_some_mm(machine, some_, options);
  }
  bool operator()(const Mistake& mistake) const {
    if (!as_read_mm_) return true;
    std::vector<MachineMeasurement> right = some_;
    undo(mistake, right);
    const auto again_mm = left_of_some_mm(machine_, right, options_);
    return again_mm && *again_mm < some_leeway * far_better * mistake.smaller * *as_read_mm_;
  }

 private:
  const Machine& machine_;
  const CalibrationOptions& options_;
  std::vector<MachineMeasurement> some_;
  std::optional<double> as_read_mm_;
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
  if (found.converged && found.rms_after_mm * far_too_small < found.stated_noise_mm)
    return fmt::format(
        "the readings scatter by {:.2g} µm, but their stated noise is {:.2g} µm: check the unit of "
        "the deviations in the header, and `# noise`",
        found.rms_after_mm / mm_per_um, found.stated_noise_mm / mm_per_um);
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
  const Worthwhile worthwhile(machine, data, options, found.equations);
  for (const Mistake& mistake : mistakes_of(machine, data)) {
    if (!wrong && !worthwhile(mistake)) continue;
    std::vector<MachineMeasurement> right(data.begin(), data.end());
    undo(mistake, right);
    const std::optional<double> again_mm = left_mm(machine, right, options);
    if (!again_mm || !(*again_mm < least_mm * mistake.smaller)) continue;
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
         (noise_um > 0.0 ? fmt::format(", and their stated noise is {:.2g} µm", noise_um) : "") +
         ": check the units of deviations and positions in the header. Check that the machine "
         "file, the tool length and the columns belong to the measurement";
}

std::string implausible(const Calibration& found, const CalibrationOptions& options) {
  constexpr double far_beyond = 50.0;  // largest plausible sizes: 5 mm, 0.6 degrees
  for (const CalibratedParameter& p : found.parameters) {
    const bool angle = p.estimate.unit == "rad";
    const double most =
        far_beyond * (angle ? options.largest_angle_rad : options.largest_length_mm);
    if (!(least_size(p) > most)) continue;
    return fmt::format(
        "{} is {:.4g} {}: no machine is so far from its model. Check that the machine file, the "
        "tool length, and the units and signs of the columns belong to the measurement",
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

}  // namespace trueaxis
