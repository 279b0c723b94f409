// SPDX-License-Identifier: Apache-2.0
#include "measure/passes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "measure/passes_motion.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

// If a pass column cuts, its net travel gives the senses, if it is more than this.
constexpr double least_turn_rad = 1e-3 * two_pi;
constexpr double least_feed_mm = 5e-3;

int sign_of(double travel, double least) { return travel > least ? 1 : travel < -least ? -1 : 0; }

/// Slope of the position over C by least squares.
double slope_mm_per_rad(const ProbeStream& stream, const Pass& pass) {
  const double c0 = stream.c_rad[pass.begin], z0 = stream.position_mm[pass.begin];
  const double n = static_cast<double>(pass.end - pass.begin);
  double sc = 0.0, sz = 0.0, scc = 0.0, scz = 0.0;
  for (std::size_t i = pass.begin; i < pass.end; ++i) {
    const double c = stream.c_rad[i] - c0, z = stream.position_mm[i] - z0;
    sc += c;
    sz += z;
    scc += c * c;
    scz += c * z;
  }
  const double spread = scc - sc * sc / n;
  return spread > 0.0 ? (scz - sc * sz / n) / spread : 0.0;
}

/// Fills what follows from the readings of a pass and its senses.
void describe(const ProbeStream& stream, Pass& pass) {
  const std::size_t last = pass.end - 1;
  const double turned_rad = stream.c_rad[last] - stream.c_rad[pass.begin];
  if (!stream.setup.empty()) pass.setup = stream.setup[pass.begin];
  if (pass.c_sign == 0 || turned_rad == 0.0) return;
  pass.readings_per_revolution =
      static_cast<double>(last - pass.begin) * two_pi / std::abs(turned_rad);
  if (!stream.time_s.empty() && stream.time_s[last] > stream.time_s[pass.begin]) {
    pass.speed_rad_per_s = turned_rad / (stream.time_s[last] - stream.time_s[pass.begin]);
  }
  if (pass.feed_sign != 0) {
    pass.feed_mm_per_rev = slope_mm_per_rad(stream, pass) * two_pi * (turned_rad > 0 ? 1 : -1);
  }
}

/// A pass of readings [begin, end) whose senses are those of its net travel.
Pass net_pass(const ProbeStream& stream, std::size_t begin, std::size_t end) {
  Pass pass;
  pass.begin = begin;
  pass.end = end;
  pass.c_sign = sign_of(stream.c_rad[end - 1] - stream.c_rad[begin], least_turn_rad);
  if (stream.has_position()) {
    pass.feed_sign =
        sign_of(stream.position_mm[end - 1] - stream.position_mm[begin], least_feed_mm);
  }
  return pass;
}

/// Passes of one set-up by the senses of motion; readings [begin, end).
void passes_by_senses(const ProbeStream& stream, std::size_t begin, std::size_t end,
                      std::vector<Pass>& passes) {
  const std::size_t before = passes.size();
  if (end - begin > 2) {
    const StepSigns signs = find_step_signs(stream, begin, end);
    const std::size_t steps = end - begin - 1;
    std::size_t next_reading = begin;
    for (std::size_t a = 0; a < steps;) {
      std::size_t b = a + 1;
      while (b < steps && signs.c[b] == signs.c[a] && signs.feed[b] == signs.feed[a]) ++b;
      const bool single = b - a == 1;
      if (!single) {
        Pass pass;
        pass.begin = next_reading;
        pass.end = begin + b + 1;  // the reading where two runs meet belongs to the first
        pass.c_sign = sign_of(signs.c[a], 0.0);
        pass.feed_sign = sign_of(signs.feed[a], 0.0);
        passes.push_back(pass);
        next_reading = pass.end;
      } else if (passes.size() > before) {
        passes.back().end = next_reading = begin + a + 1;
      }
      a = b;
    }
  }
  if (passes.size() == before) {
    passes.push_back(net_pass(stream, begin, end));
  } else {
    passes.back().end = end;
  }
}

/// Cuts passes where the spindle changes its speed.
std::vector<Pass> cut_by_speed(const ProbeStream& stream, const std::vector<Pass>& passes) {
  if (stream.time_s.empty()) return passes;
  std::vector<Pass> out;
  for (Pass pass : passes) {
    if (pass.c_sign != 0) {
      const std::size_t begin = pass.begin, count = pass.end - pass.begin;
      const auto c = std::span(stream.c_rad).subspan(begin, count);
      const auto t = std::span(stream.time_s).subspan(begin, count);
      for (const std::size_t change : find_speed_changes(c, t)) {
        if (begin + change <= pass.begin || begin + change >= pass.end) continue;
        Pass first = pass;
        first.end = pass.begin = begin + change;
        out.push_back(first);
      }
    }
    out.push_back(pass);
  }
  return out;
}

}  // namespace

std::vector<Pass> find_passes(const ProbeStream& stream) {
  const std::size_t size = stream.size();
  const auto fits = [&](std::size_t column) { return column == 0 || column == size; };
  expects(stream.c_rad.size() == size && fits(stream.position_mm.size()) &&
              fits(stream.time_s.size()) && fits(stream.pass.size()) && fits(stream.setup.size()),
          "columns of one length");
  std::vector<Pass> passes;
  const auto same = [](const std::vector<int>& column, std::size_t a, std::size_t b) {
    return column.empty() || column[a] == column[b];
  };
  for (std::size_t begin = 0; begin < size;) {
    std::size_t end = begin + 1;
    while (end < size && same(stream.setup, begin, end) && same(stream.pass, begin, end)) ++end;
    if (stream.pass.empty()) {
      passes_by_senses(stream, begin, end, passes);
    } else {
      passes.push_back(net_pass(stream, begin, end));
    }
    begin = end;
  }
  if (stream.pass.empty()) passes = cut_by_speed(stream, passes);
  for (Pass& pass : passes) describe(stream, pass);
  return passes;
}

std::vector<int> find_revolutions(const ProbeStream& stream, const std::vector<Pass>& passes) {
  // A text file rounds C: a reading this close before a whole turn has made it.
  constexpr double rounding_turns = 1e-6;
  constexpr double most_turns = std::numeric_limits<int>::max();
  std::vector<int> revolutions(stream.size(), 0);
  for (const Pass& pass : passes) {
    expects(pass.begin <= pass.end && pass.end <= stream.size(), "passes of this stream");
    for (std::size_t i = pass.begin; i < pass.end; ++i) {
      const double turns = std::abs(stream.c_rad[i] - stream.c_rad[pass.begin]) / two_pi;
      revolutions[i] = static_cast<int>(std::min(std::floor(turns + rounding_turns), most_turns));
    }
  }
  return revolutions;
}

}  // namespace trueaxis
