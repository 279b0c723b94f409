// SPDX-License-Identifier: Apache-2.0

#include <chrono>

#include "base/number.hpp"
#include "base/text.hpp"
#include "recording/recording.hpp"

namespace trueaxis {
namespace {

/// The whole number in front of `until`, removed with it from the text; else nothing.
std::optional<int> number_before(std::string_view& text, char until) {
  const auto value = take_number<int>(text);
  return value && *value >= 0 && take_word(text, {&until, 1}) ? value : std::nullopt;
}

}  // namespace

std::optional<double> instant_s(std::string_view text) {
  double days_s = 0.0;
  if (text.ends_with('Z')) text.remove_suffix(1);  // UTC
  const std::size_t date_end = text.find_first_of(" T");
  if (date_end != std::string_view::npos) {
    const auto year = number_before(text, '-'), month = number_before(text, '-');
    const auto day = number_before(text, text[text.find_first_of(" T")]);
    if (!year || !month || !day || *year > 9999 || *month > 12 || *day > 31) return {};
    const std::chrono::year_month_day date{std::chrono::year(*year),
                                           std::chrono::month(static_cast<unsigned>(*month)),
                                           std::chrono::day(static_cast<unsigned>(*day))};
    if (!date.ok()) return {};
    days_s = 86400.0 * static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
  }
  const auto hours = number_before(text, ':');
  const int minutes = hours ? number_before(text, ':').value_or(-1) : -1;
  double seconds = 0.0;
  const char decimal = text.find(',') == std::string_view::npos ? '.' : ',';
  if (minutes < 0 || minutes > 59 || !recorded_number(text, decimal, seconds) || seconds < 0.0 ||
      seconds >= 61.0)
    return {};
  return days_s + 3600.0 * *hours + 60.0 * minutes + seconds;
}

}  // namespace trueaxis
