// SPDX-License-Identifier: Apache-2.0
#include "measure/files/stream_csv_setup.hpp"

#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include "measure/files/stream_csv_number.hpp"
#include "measure/files/stream_csv_text.hpp"
#include "measure/files/stream_csv_unit.hpp"

namespace trueaxis {
namespace {

constexpr std::string_view prefix = "setup.";

struct SetupKey {
  int number = 0;
  std::string_view what;
};

std::optional<SetupKey> parse_key(std::string_view key) {
  SetupKey out;
  const char *begin = key.data() + prefix.size(), *end = key.data() + key.size();
  const auto [stop, error] = std::from_chars(begin, end, out.number);
  if (error != std::errc{} || stop == end || *stop != '.') return {};
  out.what = {stop + 1, static_cast<std::size_t>(end - stop - 1)};
  return out;
}

/// A number with a unit of `quantity`, which must be there, in the units inside.
std::optional<double> parse_value(std::string_view text, CsvQuantity quantity) {
  double value = 0.0;
  std::errc error{};
  const char* end = text.data() + text.size();
  const char* stop = csv_number(text.data(), end, value, error);
  if (stop == text.data() || error != std::errc{} || !std::isfinite(value)) return {};
  const std::string_view unit = csv_trimmed({stop, static_cast<std::size_t>(end - stop)});
  if (quantity == CsvQuantity::count) return unit.empty() ? std::optional(value) : std::nullopt;
  const auto known = csv_find_unit(quantity, unit);
  return known ? std::optional(value * known->factor) : std::nullopt;
}

/// The keys after the number, what may stand there, and where it goes.
struct Quantity {
  std::string_view what;
  CsvQuantity quantity;
  double SetUp::*member;
  const char* unit;  ///< as it is written
  const char* wanted;
};
constexpr Quantity quantities[] = {
    {"reindex", CsvQuantity::angle, &SetUp::reindex_rad, " rad",
     "an angle in deg, rad or rev, such as 70 deg"},
    {"z_shift", CsvQuantity::length, &SetUp::z_shift_mm, " mm",
     "a length in mm, um, \xC2\xB5m, m or in, such as 12 mm"},
    {"x_jog", CsvQuantity::length, &SetUp::x_jog_mm, " mm",
     "a length in mm, um, \xC2\xB5m, m or in, such as 0.1 mm"},
    {"clamp_force_ratio", CsvQuantity::count, &SetUp::clamp_force_ratio, "",
     "the force over that of the first clamping, 0 or more and without unit, such as 0.6"},
};

}  // namespace

bool csv_is_setup_key(std::string_view key) { return key.starts_with(prefix); }

int csv_setup_number(std::string_view key) { return parse_key(key).value_or(SetupKey{}).number; }

std::string csv_take_setup(std::string_view key, std::string_view value,
                           std::map<int, SetUp>& set_ups) {
  const auto parsed = parse_key(key);
  if (!parsed)
    return "unknown key " + csv_quoted(key) +
           ": write the number of the set-up behind setup, such as setup.2.reindex";
  const auto not_understood = [&](const char* wanted) {
    return std::string(key) + ": " + csv_quoted(value) + " is not understood: write " + wanted;
  };
  const bool is_side = parsed->what == "side";
  for (const Quantity& quantity : quantities) {
    if (quantity.what != parsed->what) continue;
    const auto number = parse_value(value, quantity.quantity);
    if (!number || (quantity.quantity == CsvQuantity::count && *number < 0.0))
      return not_understood(quantity.wanted);
    SetUp& set_up = set_ups[parsed->number];
    set_up.number = parsed->number;
    set_up.*quantity.member = *number;
    return "";
  }
  if (!is_side)
    return "unknown key " + csv_quoted(key) +
           ": a set-up has reindex, z_shift, side, x_jog and clamp_force_ratio";
  if (value != "front" && value != "rear") return not_understood("front or rear");
  SetUp& set_up = set_ups[parsed->number];
  set_up.number = parsed->number;
  set_up.rear = value == "rear";
  return "";
}

void csv_put_setups(const ProbeStream& stream, const std::map<int, SetUp>& stated,
                    std::map<std::string, std::string>& metadata) {
  std::set<int> listed;
  for (const SetUp& set_up : list_set_ups(stream)) {
    listed.insert(set_up.number);
    const auto at = stated.find(set_up.number);
    const SetUp said = at == stated.end() ? SetUp{} : at->second;
    const auto key = [&](std::string_view what) {
      return std::string(prefix).append(std::to_string(set_up.number)).append(".").append(what);
    };
    for (const Quantity& quantity : quantities) {
      const double value = set_up.*quantity.member;
      if (value != said.*quantity.member)
        metadata[key(quantity.what)] = csv_text(value) + quantity.unit;
    }
    if (set_up.rear != said.rear) metadata[key("side")] = set_up.rear ? "rear" : "front";
  }
  std::erase_if(metadata, [&](const auto& entry) {
    return csv_is_setup_key(entry.first) && !listed.contains(csv_setup_number(entry.first));
  });
}

}  // namespace trueaxis
