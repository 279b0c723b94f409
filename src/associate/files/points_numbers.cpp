// SPDX-License-Identifier: Apache-2.0
// Points of X3P, HDF5, MATLAB and NumPy files: which array, which unit is said, never guessed.
#include <algorithm>
#include <cmath>

#include "associate/files/association_files.hpp"
#include "format/csv_text.hpp"
#include "format/file.hpp"
#include "format/units.hpp"
#include "interchange/number_file.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t most_rows_named = 20;

using Axes = std::array<NumberColumn, 3>;

class Chooser {
 public:
  Chooser(const std::string& path, const NumberFile& file, const std::string& array,
          const std::string& unit)
      : path_(path), file_(file), columns_(number_columns(file)), array_(array), unit_(unit) {}

  Axes axes() const {
    if (!array_.empty()) return said();
    for (const auto name_of : {&whole_name, &last_name}) {
      Axes found;
      std::size_t count = 0;
      for (const NumberColumn& column : columns_)
        for (std::size_t i = 0; i < 3; ++i)
          if (lower_case(name_of(column.name)) == std::string(1, "xyz"[i])) {
            found[i] = column;
            ++count;
          }
      if (count == 3 && found[0].array && found[1].array && found[2].array) return found;
    }
    std::vector<const NumberArray*> of_points;
    for (const NumberArray& array : file_.arrays)
      if (array.unusable.empty() && array.columns == 3) of_points.push_back(&array);
    if (of_points.size() == 1) return across(*of_points.front());
    const bool lying = std::ranges::any_of(file_.arrays, [](const NumberArray& array) {
      return array.unusable.empty() && array.rows == 3 && array.columns > 3;
    });
    refuse(
        lying
            ? "its array has one point per column: transpose it, as a point is a row of x, y and z"
            : "it is not clear which of its arrays are the points: one of three columns, or x, y "
              "and z");
  }

  /// What makes mm of the numbers.
  double factor(const Axes& axes) const {
    std::string unit = unit_;
    for (const NumberColumn& axis : axes) {
      const std::string& told = axis.array->unit;
      if (told.empty()) continue;
      if (!find_unit(UnitKind::length, told))
        throw InputError(path_, csv_quoted(told) + " of " + axis.array->name +
                                    " is not a unit of length: write " +
                                    known_units(UnitKind::length));
      if (unit.empty()) unit = told;
      if (of(unit) != of(told))
        throw InputError(path_, "its unit is " + csv_quoted(told) + ", and " + csv_quoted(unit) +
                                    (unit == unit_ ? " is given by the file: remove --unit"
                                                   : " elsewhere: x, y and z must have one unit"));
    }
    for (const NumberColumn& axis : axes)
      if (unit_.empty() && !unit.empty() && axis.array->unit.empty()) unit.clear();
    if (unit.empty()) refuse("it does not state the unit of its coordinates", Missing::unit);
    return of(unit);
  }

 private:
  static std::string whole_name(const std::string& name) { return name; }
  static std::string last_name(const std::string& name) {
    return name.substr(name.find_last_of("/.") + 1);
  }
  static double of(const std::string& unit) { return find_unit(UnitKind::length, unit)->factor; }
  static Axes across(const NumberArray& array) {
    Axes axes;
    for (std::size_t i = 0; i < 3; ++i) axes[i] = {&array, i, array.name};
    return axes;
  }

  Axes said() const {
    for (const NumberArray& array : file_.arrays)
      if (array.name == array_ && array.unusable.empty() && array.columns == 3)
        return across(array);
    Axes axes;
    std::size_t at = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t comma = std::min(array_.find(',', at), array_.size());
      const std::string name(trimmed(std::string_view(array_).substr(at, comma - at)));
      for (const NumberColumn& column : columns_)
        if (column.name == name) axes[i] = column;
      if (axes[i].array == nullptr || (comma == array_.size()) != (i == 2))
        refuse("--array " + csv_quoted(array_) +
               " names no array of three columns in it, nor three columns");
      at = comma + 1;
    }
    return axes;
  }

  /// What the file does not tell, so that an option must.
  enum class Missing { array, unit };

  [[noreturn]] void refuse(const std::string& why, Missing missing = Missing::array) const {
    const bool unit_alone = missing == Missing::unit;
    throw InputError(std::vector<Diagnostic>{
        {path_, 0, 0, why},
        {path_, 0, 0, "was read as " + file_.kind + " with " + listed(file_)},
        {path_, 0, 0,
         "the option" + std::string(unit_alone ? "" : "s") + " that would read it:" +
             (unit_alone ? (array_.empty() ? "" : " --array " + array_)
                         : " --array NAME or --array X,Y,Z") +
             (unit_.empty() &&
                      std::ranges::all_of(
                          columns_, [](const auto& column) { return column.array->unit.empty(); })
                  ? " --unit mm (or um, m, in)"
                  : "")}});
  }

  const std::string& path_;
  const NumberFile& file_;
  std::vector<NumberColumn> columns_;
  const std::string &array_, &unit_;
};

}  // namespace

PointText points_of_numbers(const std::string& path, const std::string& bytes,
                            const std::string& unit, const std::string& array) {
  const NumberFile file = read_number_file(path, bytes);
  const Chooser chooser(path, file, array, unit);
  const Axes axes = chooser.axes();
  const double factor = chooser.factor(axes);
  const std::size_t rows = axes[0].array->rows;
  CsvDiagnostics wrong(path, most_rows_named);
  for (const NumberColumn& axis : axes)
    if (axis.array->rows != rows)
      throw InputError(path, "its x, y and z have " + std::to_string(axes[0].array->rows) + ", " +
                                 std::to_string(axes[1].array->rows) + " and " +
                                 std::to_string(axes[2].array->rows) +
                                 " numbers: they must have equally many");
  PointText out{.source = path, .hash = content_hash(bytes), .points_mm = {}, .lines = {}};
  out.notes = file.notes;
  const bool metres = factor == 1000.0;
  for (std::size_t row = 0; row < rows; ++row) {
    Point3 point{};
    bool good = true;
    for (std::size_t i = 0; i < 3; ++i) {
      point[i] = axes[i].array->at(row, axes[i].column);
      const bool finite = std::isfinite(point[i]);
      if (finite && std::abs(point[i]) * factor <= largest_coordinate_mm) continue;
      wrong.add(row + 1, i + 1,
                std::string(1, "xyz"[i]) +
                    (finite ? " is more than 1e12 mm: check the unit" : " is not a finite number"),
                finite ? "large" : "number");
      good = false;
    }
    if (!good) continue;
    for (double& value : point) {
      if (metres) out.metres.push_back(value);
      value *= factor;
    }
    out.points_mm.push_back(point);
    out.lines.push_back(axes[0].array->numbers.empty() ? row + 1 : axes[0].array->numbers[row]);
  }
  wrong.throw_if_any();
  return out;
}

std::vector<double> metres_of(const PointText& points) {
  if (!points.metres.empty()) return points.metres;
  std::vector<double> metres;
  metres.reserve(3 * points.points_mm.size());
  for (const Point3& point : points.points_mm)
    for (const double value : point) metres.push_back(value / 1000.0);
  return metres;
}

}  // namespace trueaxis
