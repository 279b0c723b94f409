// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "trueaxis/units.hpp"

namespace trueaxis {

using Json = nlohmann::ordered_json;

/// A number, or null where it is not finite (JSON has no NaN).
inline Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// {"value", "unit"}
inline Json with_unit(double value, const char* unit) {
  return {{"value", number(value)}, {"unit", unit}};
}

/// The same, and `why` where the value is not finite.
inline Json quantity_object(double value, const char* unit, const char* why = "not determined") {
  Json json = with_unit(value, unit);
  if (!std::isfinite(value)) json["why"] = why;
  return json;
}

inline Json mm_json(double length_mm) { return with_unit(length_mm, "mm"); }
inline Json deg_json(double angle_rad) { return with_unit(angle_rad / rad_per_deg, "deg"); }

/// An array of what `write` makes of each item.
template <class Items, class Write>
Json list_of(const Items& items, const Write& write) {
  Json list = Json::array();
  for (const auto& item : items) list.push_back(write(item));
  return list;
}

/// The same of the numbers 0 … count − 1.
template <class Write>
Json list_of_first(std::size_t count, const Write& write) {
  Json list = Json::array();
  for (std::size_t i = 0; i < count; ++i) list.push_back(write(i));
  return list;
}

/// Rows of a square matrix; `at(i, j)` is its element as the file has it.
template <class At>
Json square_json(std::size_t size, const At& at) {
  return list_of_first(size, [&](std::size_t i) {
    return list_of_first(size, [&](std::size_t j) { return number(at(i, j)); });
  });
}

/// {"file", "hash"} of whatever has both.
template <class Files>
Json files_json(const Files& files) {
  return list_of(files, [](const auto& one) -> Json {
    return {{"file", one.file}, {"hash", one.hash}};
  });
}

/// The same for paths and hashes in two lists.
inline Json files_json(const std::vector<std::string>& files,
                       const std::vector<std::string>& hashes) {
  return list_of_first(files.size(), [&](std::size_t i) -> Json {
    return {{"file", files[i]}, {"hash", hashes[i]}};
  });
}

/// A quantity, and the line of a program where it is met; null for none.
inline Json at_line(Json quantity, std::size_t line) {
  quantity["line"] = line == 0 ? Json(nullptr) : Json(line);
  return quantity;
}

/// A name whose suffix is the unit inside, as a file has it: "half_angle_rad" is half_angle in deg.
struct NameAndUnit {
  std::string name;
  const char* unit;
  double factor = 1.0;  ///< from inside to the file
};
inline NameAndUnit name_and_unit(std::string_view name) {
  static constexpr struct {
    std::string_view inside;
    const char* unit;
    double factor = 1.0;
  } suffixes[] = {{"_mm_per_rev", "mm/rev"},          {"_mm_per_s", "mm/s"}, {"_mm", "mm"},
                  {"_rad", "deg", 1.0 / rad_per_deg}, {"_hz", "Hz"},         {"_s", "s"}};
  for (const auto& suffix : suffixes) {
    if (name.ends_with(suffix.inside))
      return {std::string(name.substr(0, name.size() - suffix.inside.size())), suffix.unit,
              suffix.factor};
  }
  return {std::string(name), "1"};
}

/// A size in mm or rad as files have it: mm or degrees.
inline Json edge_size(double value, const std::string& unit) {
  return with_unit(value * edge_factor(unit), unit == "rad" ? "deg" : unit.c_str());
}

/// At the edge: {"value", "u", "unit"}, "interval" if value ± U is not the interval, "why" if a
/// number is missing.
inline Json to_json(const Estimate& inside) {
  const Estimate estimate = at_edge(inside);
  Json json{{"value", number(estimate.value)}, {"u", number(estimate.u)}, {"unit", estimate.unit}};
  if (estimate.interval) json["interval"] = *estimate.interval;
  if (!estimate.why_not.empty()) json["why"] = estimate.why_not;
  return json;
}

/// The number there, or NaN for null: `number` read back.
inline double number_from(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

/// `to_json` read back.
inline Estimate estimate_from(const Json& json) {
  Estimate estimate{number_from(json.at("value")), number_from(json.at("u")), json.at("unit"),
                    json.value("why", "")};
  if (json.contains("interval")) estimate.interval = json.at("interval");
  if (estimate.unit == "deg") {
    estimate.value *= rad_per_deg;
    estimate.u *= rad_per_deg;
    estimate.unit = "rad";
  }
  return estimate;
}

/// As written to a file. Bytes that are not UTF-8 (a file name may hold some) become U+FFFD.
inline std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace trueaxis
