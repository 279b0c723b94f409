// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <optional>

#include "associate/files/association_files.hpp"
#include "base/number.hpp"
#include "format/csv_text.hpp"
#include "format/doubled_points.hpp"
#include "format/file.hpp"
#include "format/units.hpp"
#include "interchange/number_file.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t most_places = 20;

/// "x[um]": the unit of the column, "" if it has none; nothing if the text is not such a column.
std::optional<std::string_view> unit_of_column(std::string_view text, char name) {
  const auto [written, unit] = name_with_unit(text);
  if (written.size() != 1 || lower_case(written[0]) != name) return {};
  return unit.value_or("");
}

class Reader {
 public:
  Reader(const std::string& path, const std::string& unit) : wrong_(path, most_places) {
    if (!unit.empty()) said_ = find_unit(UnitKind::length, unit);
    if (said_) factor_ = said_->factor;
  }

  void line(std::string_view text, std::size_t number, PointText& out) {
    text = csv_without_comment(text);
    if (trimmed(text).empty()) return;
    // Blanks, or commas with blanks around them.
    csv_split(text, text.find(',') != std::string_view::npos ? ',' : ' ', fields_);
    if (first_ && !starts_number(fields_.front()) && header(text, number)) return;
    first_ = false;
    if (fields_.size() != 3)
      return wrong_.add(number, 0,
                        "has " + std::to_string(fields_.size()) +
                            (fields_.size() == 1 ? " field" : " fields") +
                            ", a point has three: x y z (z = 0 throughout for a line or circle of "
                            "the plane)",
                        "fields");
    Point3 point{};
    bool good = true;
    for (std::size_t i = 0; i < 3; ++i) good = coordinate(text, number, i, point[i]) && good;
    if (!good) return;
    out.points_mm.push_back(point);
    out.lines.push_back(number);
  }

  void finish(const PointText& out) {
    if (out.points_mm.empty() && !wrong_.any()) wrong_.add(0, 0, "has no points");
    wrong_.throw_if_any();
  }

 private:
  bool coordinate(std::string_view line, std::size_t number, std::size_t i, double& value) {
    const std::string_view text = fields_[i];
    if (parse_number(text, value)) {
      value *= factor_;
      if (std::abs(value) <= largest_coordinate_mm) return true;
      wrong_.add(number, csv_character(line, fields_[i]),
                 csv_quoted(text) + " is more than 1e12 mm: check the unit", "large");
      return false;
    }
    wrong_.add(number, csv_character(line, fields_[i]),
               csv_quoted(text) + " is not a finite number", "number");
    return false;
  }

  /// The names of the columns with their unit. @returns false if it is not such a line at all
  bool header(std::string_view line, std::size_t number) {
    first_ = false;
    if (fields_.size() != 3) return false;
    std::optional<Unit> unit;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto name = unit_of_column(fields_[i], "xyz"[i]);
      if (!name) return false;
      if (name->empty()) continue;
      const std::size_t column = csv_character(line, fields_[i]);
      const auto found = find_unit(UnitKind::length, *name);
      if (!found)
        wrong_.add(
            number, column,
            csv_quoted(*name) + " is not a unit of length: write " + known_units(UnitKind::length));
      else if (said_ && found->factor != said_->factor)
        wrong_.add(number, column, csv_quoted(*name) + " differs from --unit: remove one of them");
      else if (unit && unit->factor != found->factor)
        wrong_.add(number, column, "the three columns must have one unit");
      else
        unit = found;
    }
    if (unit) factor_ = unit->factor;
    return true;
  }

  CsvDiagnostics wrong_;
  std::optional<Unit> said_;
  double factor_ = 1.0;
  bool first_ = true;
  std::vector<std::string_view> fields_;
};

PointText points_of_text(const std::string& path, const std::string& content,
                         const std::string& unit) {
  PointText out{.source = path, .hash = content_hash(content), .points_mm = {}, .lines = {}};
  Reader reader(path, unit);
  for_each_line(content, [&](auto line, std::size_t number) { reader.line(line, number, out); });
  reader.finish(out);
  return out;
}

}  // namespace

PointText read_points(const std::string& path, const std::string& unit, const std::string& array) {
  const std::string content = read_file(path);
  const bool numbers = is_number_file(content);
  if (!numbers && !array.empty()) throw InputError(path, "is a text of points: remove --array");
  PointText points =
      numbers ? points_of_numbers(path, content, unit, array) : points_of_text(path, content, unit);
  refuse_doubled(points.points_mm, path);
  return points;
}

}  // namespace trueaxis
