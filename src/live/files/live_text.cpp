// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/number.hpp"
#include "format/json.hpp"
#include "live/files/arriving_text.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t rows_of_picture = 13;

double um(double length_mm) { return length_mm / mm_per_um; }

std::vector<double> ends_of(const FitResult& fit) {
  if (fit.position_max_mm > fit.position_min_mm) return {fit.position_min_mm, fit.position_max_mm};
  return {fit.position_min_mm};
}

std::string axis_lines(const LiveState& state) {
  const FitResult& fit = state.fit;
  std::string text;
  for (const double z : ends_of(fit)) {
    const auto [x, y] = fit.axis.axis.at(z);
    text += state.fit.axis_known()
                ? fmt::format("axis      x {:.3f} µm, y {:.3f} µm, U {:.3f} µm at Z {:.6g} mm\n",
                              um(x), um(y), um(fit.coverage_factor * fit.axis.u_at(z)), z)
                : "axis      not determined yet\n";
  }
  return text + (ends_of(fit).size() < 2 ? "\n" : "");
}

}  // namespace

bool is_enough(const LiveState& state, std::optional<double> wanted_U_mm) {
  return wanted_U_mm && state.U_mm <= *wanted_U_mm && live_alarm(state).empty();
}

std::string live_alarm(const LiveState& state) {
  if (state.deaf)
    return "the probe is deaf: its readings do not follow the part. Stop, and look at the probe";
  if (state.moved)
    return fmt::format(
        "the part slipped by about {} µm{}", significant(um(state.moved->size_mm), 2),
        state.moved->may_be_delay ? ", or X is late and the speed changed: stop, and look at both"
                                  : ": stop, and clamp it again");
  return "";
}

std::string live_picture(const LiveState& state, std::optional<double> wanted_U_mm) {
  const std::string alarm = live_alarm(state);
  std::string text = fmt::format(
      "{} readings in {:.1f} revolutions{}\n", state.readings, state.turns,
      state.stride > 1 ? fmt::format(", every {}th kept", state.stride) : std::string());
  text += fmt::format("{}, residuals {:.3f} µm RMS of {} readings\n", to_string(state.fit.surface),
                      um(state.fit.rms_mm), state.used);
  text += axis_lines(state);
  text += alarm.empty() ? is_enough(state, wanted_U_mm)
                              ? "enough    U is reached: probing may stop\n"
                          : wanted_U_mm ? fmt::format("wanted    U {:.3f} µm\n", um(*wanted_U_mm))
                                        : std::string("\n")
                        : "STOP      " + alarm + "\n";
  double most = 0.0;
  for (const double left : state.left_mm)
    if (std::isfinite(left)) most = std::max(most, std::abs(left));
  text += fmt::format("residuals over C, ± {:.3f} µm\n", um(most));
  std::vector<std::string> rows(rows_of_picture, std::string(LiveState::bins, ' '));
  rows[rows_of_picture / 2].assign(LiveState::bins, '-');
  for (std::size_t bin = 0; bin < LiveState::bins; ++bin) {
    if (!std::isfinite(state.left_mm[bin]) || most == 0.0) continue;
    const double height = 0.5 * (1.0 - state.left_mm[bin] / most) * (rows_of_picture - 1);
    rows[static_cast<std::size_t>(std::lround(height))][bin] = '*';
  }
  for (const std::string& row : rows) text += "  |" + row + "|\n";
  return text + "   0" + std::string(LiveState::bins / 2 - 4, ' ') + "180" +
         std::string(LiveState::bins / 2 - 3, ' ') + "360 deg\n";
}

std::string live_json_line(const LiveState& state, std::optional<double> wanted_U_mm) {
  const FitResult& fit = state.fit;
  Json json{{"schema", "trueaxis.watch/1"},
            {"readings", state.readings},
            {"used", state.used},
            {"stride", state.stride},
            {"turns", number(state.turns)},
            {"surface", to_string(fit.surface)},
            {"status", to_string(fit.status)},
            {"rms", mm_json(fit.rms_mm)},
            {"U", mm_json(state.U_mm)}};
  json["axis"] = list_of(ends_of(fit), [&](double z) -> Json {
    const auto [x, y] = fit.axis.axis.at(z);
    const bool known = fit.axis_known();
    const double nothing = std::nan("");
    return {{"z", mm_json(z)},
            {"x", mm_json(known ? x : nothing)},
            {"y", mm_json(known ? y : nothing)},
            {"U", mm_json(known ? fit.coverage_factor * fit.axis.u_at(z) : nothing)}};
  });
  json["residuals"] = list_of(state.left_mm, [](double left) { return number(left); });
  json["enough"] = is_enough(state, wanted_U_mm);
  json["deaf"] = state.deaf;
  json["slipped"] = state.moved ? mm_json(state.moved->size_mm) : Json(nullptr);
  json["alarm"] = live_alarm(state);
  return json.dump() + '\n';
}

}  // namespace trueaxis
