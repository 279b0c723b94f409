// SPDX-License-Identifier: Apache-2.0
// trueaxis-axis: how far the axis is from the truth before and after a diagnosis;
// scripts/axis_study runs it and makes its page.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "axis/axis_case.hpp"
#include "base/threads.hpp"
#include "diagnose/files/diagnosis_text.hpp"
#include "measure/files/stream_csv_write.hpp"

using namespace trueaxis;

namespace {

constexpr std::size_t slice = 100;

std::string line_of(std::string_view group, const axis::Outcome& o) {
  return fmt::format(
      "{},{},{},{},{},{},{:.3f},{},{},{:.5f},{:.5f},{},{:.5f},{:.5f},{:.5f},{},{:.5f},{:d},{:.4f},{"
      "},{}"
      "\n",
      group, o.made.seed, blind::to_string(o.made.plan), o.made.surface, o.made.side, o.made.noise,
      o.made.scenario.part.radius_mm, o.readings, o.made.scenario.effects.size(),
      1e3 * o.ideal.rms_mm(), 1e3 * o.ideal.u_rms_mm(), o.ideal.covered(),
      1e3 * o.ideal.interval_score_mm(), 1e3 * o.extended.rms_mm(), 1e3 * o.extended.u_rms_mm(),
      o.extended.covered(), 1e3 * o.extended.interval_score_mm(), o.stated, o.seconds, o.hidden,
      o.found);
}

/// One case for a person: what was drawn, where the axis is, what the diagnosis says of it.
/// @param csv the stream; empty: it is not written
void show(axis::Group group, std::uint64_t seed, const std::string& csv) {
  const axis::Case of = axis::draw_case(group, seed);
  fmt::print("{} {}, {}, {}, {}, R {:.2f} mm, half angle {:.2f} deg, Z {:.1f} to {:.1f} mm\n",
             axis::name_of(group), seed, blind::to_string(of.plan), of.surface, of.side,
             of.scenario.part.radius_mm, of.scenario.part.half_angle_rad * 180.0 / std::numbers::pi,
             of.low_mm, of.high_mm);
  fmt::print("  {} noise, sigma {:.2f} um, rho {:.2f}\n", of.noise,
             1e3 * of.scenario.noise.sigma_mm, of.scenario.noise.rho);
  for (const virtual_lathe::Effect& effect : of.scenario.effects) {
    fmt::print("  hidden {}", effect.id);
    for (const auto& [name, value] : effect.parameters) fmt::print("  {} {:.6g}", name, value);
    fmt::print("\n");
  }
  const ProbeStream stream = virtual_lathe::simulate(of.scenario);
  if (!csv.empty()) write_stream_csv(stream, csv);
  const Diagnosis d = axis::diagnosed(of, stream);
  for (const auto& [name, fit] :
       {std::pair("ideal", &d.baseline), {"named", &d.named}, {"stated", &d.extended}}) {
    const axis::Judged judged = axis::judge(of, fit->axis);
    fmt::print("  {:8}", name);
    for (std::size_t i = 0; i < judged.error_mm.size(); ++i)
      fmt::print(" {:8.3f} ± {:.3f}", 1e3 * judged.error_mm[i], 2e3 * judged.u_mm[i]);
    fmt::print(" um off (x, y at both ends, U)\n");
  }
  fmt::print("{}", diagnosis_text(d));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Streams with several small effects and a sealed axis, diagnosed and judged."};
  std::size_t cases = 250;
  std::uint64_t seed = 20261122;
  std::string csv;
  std::vector<std::string> only;
  int threads = 0;
  app.add_option("--cases", cases, "streams of each group");
  app.add_option("--seed", seed, "of the first of each group");
  app.add_option("--only", only, "groups: mixture slip outside absorbed noise known");
  app.add_option("--threads", threads, "streams at a time; 0: as many as there are processors");
  std::optional<std::uint64_t> shown;
  app.add_option("--csv", csv, "a line a stream; with --show the stream itself");
  app.add_option("--show", shown, "instead: the case of this seed for a person, of each group");
  CLI11_PARSE(app, argc, argv);
  const auto wanted = [&](axis::Group group) {
    return only.empty() || std::ranges::find(only, axis::name_of(group)) != only.end();
  };
  if (shown) {
    for (const axis::Group group : axis::groups)
      if (wanted(group)) show(group, *shown, csv);
    return 0;
  }
  std::ofstream out(csv);
  out << "group,seed,plan,surface,side,noise,radius_mm,readings,effects,ideal_um,u_ideal_um,"
         "covered_ideal,score_ideal_um,extended_um,u_extended_um,covered_extended,score_extended_"
         "um,stated,"
         "seconds,hidden,found\n";
  for (const axis::Group group : axis::groups) {
    if (!wanted(group)) continue;
    const std::string_view name = axis::name_of(group);
    // Slices, so that a run that is stopped keeps the lines of what is done.
    for (std::size_t first = 0; first < cases; first += slice) {
      std::vector<axis::Outcome> outcomes(std::min(slice, cases - first));
      for_each_index(outcomes.size(), threads,
                     [&](std::size_t i) { outcomes[i] = axis::run_case(group, seed + first + i); });
      for (const axis::Outcome& o : outcomes) out << line_of(name, o);
      out.flush();
      fmt::print(stderr, "{}: {} of {}\n", name, first + outcomes.size(), cases);
    }
  }
}
