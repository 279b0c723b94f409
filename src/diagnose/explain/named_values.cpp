// SPDX-License-Identifier: Apache-2.0
#include "diagnose/explain/named_values.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace trueaxis::diagnose_detail {
namespace {

/// Phases of these are written cos(k z + φ), those of harmonics cos(n θ − φ).
bool phase_is_added(std::string_view id) {
  return id == "spindle.asynchronous" || id == "environment.vibration" || id == "part.waviness" ||
         id == "slide.leadscrew_periodic" || id == "part.feed_marks" || id == "probe.cyclic";
}

std::string period_name(std::string_view id) {
  if (id == "part.waviness") return "wavelength";
  if (id == "part.feed_marks") return "feed";
  return id == "slide.leadscrew_periodic" ? "pitch" : "period";
}

void add_shape(const TermValue& h, std::vector<NamedValue>& out) {
  const auto id = h.effect->id;
  const TermShape& s = h.shape;
  const bool drift_rate = id == "thermal.drift" && !h.free.empty() && h.free[0] == 0;
  for (const std::string& name : shape_parameters(h.effect->term)) {
    if (name == "order") out.push_back({"order", "1", s.order});
    if (name == "degree") out.push_back({"degree", "1", static_cast<double>(s.degree)});
    if (name == "lever_from_mm")
      out.push_back(
          {id == "part.chuck_lobing" ? "jaw_position" : "bearing", "mm", s.lever_from_mm});
    if (name == "decay_length_mm") out.push_back({"decay_length", "mm", s.decay_length_mm});
    if (name == "period_mm") out.push_back({period_name(id), "mm", s.period_mm});
    if (name == "frequency_hz") out.push_back({"frequency", "Hz", s.frequency_hz});
    if (name == "time_constant_s" && id != "probe.lag" && !drift_rate)
      out.push_back({"time_constant", "s", s.time_constant_s});
    if (name == "onset_s") out.push_back({"onset", "s", s.onset_s});
    if (name == "reference_x_mm") out.push_back({"reference_x", "mm", s.reference_x_mm});
    if (name == "range_mm") out.push_back({"range", "mm", s.range_mm});
  }
}

}  // namespace

std::vector<NamedValue> values_of(const TermValue& term) {
  std::vector<NamedValue> out;
  const auto names = linear_parameters(term.effect->term, term.shape);
  const auto free = [&](std::size_t j) {
    return term.free.empty() || std::ranges::find(term.free, j) != term.free.end();
  };
  const auto id = term.effect->id;
  for (std::size_t j = 0; j < names.size(); ++j) {
    if (!free(j)) continue;
    const std::string& name = names[j].name;
    if (!name.ends_with("_cos")) {
      const bool of_part = id == "part.taper" || id == "part.barrel";
      out.push_back({!of_part                ? name
                     : name == "amplitude_3" ? "cubic"
                                             : "amplitude",
                     names[j].unit, term.linear[j]});
      continue;
    }
    const std::string of = name.substr(0, name.size() - 4);
    const double c = term.linear[j], s = term.linear[j + 1];
    out.push_back({of, names[j].unit, std::hypot(c, s)});
    const double phase = std::atan2(phase_is_added(id) ? -s : s, c);
    if (id == "part.chuck_lobing" && of == "amplitude") {
      out.push_back({"jaw_angle", "rad", phase / term.shape.order});
    } else {
      out.push_back({of == "amplitude" ? "phase" : of + "_phase", "rad", phase});
    }
    ++j;
  }
  add_shape(term, out);
  return out;
}

}  // namespace trueaxis::diagnose_detail
