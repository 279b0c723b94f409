// SPDX-License-Identifier: Apache-2.0
// trueaxis-axis: how far the axis is from the truth before and after a diagnosis;
// scripts/axis_study runs it and makes its page.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <fstream>

#include "axis/axis_case.hpp"
#include "base/threads.hpp"

using namespace trueaxis;

int main(int argc, char** argv) {
  CLI::App app{"Streams with several small effects and a sealed axis, diagnosed and judged."};
  std::size_t cases = 250;
  std::uint64_t seed = 20261122;
  std::string csv;
  std::vector<std::string> only;
  int threads = 0;
  app.add_option("--cases", cases, "streams of each group");
  app.add_option("--seed", seed, "of the first of each group");
  app.add_option("--only", only, "groups: mixture slip outside absorbed");
  app.add_option("--threads", threads, "streams at a time; 0: as many as there are processors");
  app.add_option("--csv", csv, "a line a stream")->required();
  CLI11_PARSE(app, argc, argv);
  std::ofstream out(csv);
  out << "group,seed,plan,surface,side,noise,radius_mm,readings,effects,ideal_um,u_ideal_um,"
         "covered_ideal,extended_um,u_extended_um,covered_extended,seconds,hidden,found\n";
  for (const axis::Group group : axis::groups) {
    const std::string name(axis::name_of(group));
    if (!only.empty() && std::ranges::find(only, name) == only.end()) continue;
    std::vector<axis::Outcome> outcomes(cases);
    std::atomic<std::size_t> done{0};
    for_each_index(cases, threads, [&](std::size_t i) {
      outcomes[i] = axis::run_case(group, seed + i);
      const std::size_t now = ++done;
      if (now % 100 == 0) fmt::print(stderr, "{}: {} of {}\n", name, now, cases);
    });
    for (const axis::Outcome& o : outcomes)
      out << fmt::format(
          "{},{},{},{},{},{},{:.3f},{},{},{:.5f},{:.5f},{},{:.5f},{:.5f},{},{:.4f},{},{}\n", name,
          o.made.seed, blind::to_string(o.made.plan), o.made.surface, o.made.side, o.made.noise,
          o.made.scenario.part.radius_mm, o.readings, o.made.scenario.effects.size(),
          1e3 * o.ideal.rms_mm(), 1e3 * o.ideal.u_rms_mm(), o.ideal.covered(),
          1e3 * o.extended.rms_mm(), 1e3 * o.extended.u_rms_mm(), o.extended.covered(), o.seconds,
          o.hidden, o.found);
  }
}
