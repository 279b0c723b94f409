// SPDX-License-Identifier: Apache-2.0
// trueaxis-risk: the risk of a GO, see scripts/go_risk_study.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>

#include "base/threads.hpp"
#include "risk/risk_case.hpp"

int main(int argc, char** argv) {
  using namespace trueaxis;
  CLI::App app{"Jobs with a sealed truth, decided and judged."};
  std::size_t cases = 250;
  std::uint64_t seed = 20261122;
  std::string csv;
  app.add_option("--cases", cases, "jobs of each group");
  app.add_option("--seed", seed, "of the first; printed");
  app.add_option("--csv", csv, "a line a job")->required();
  CLI11_PARSE(app, argc, argv);
  std::ofstream out(csv);
  out << "group,seed,decision,reserved,upper_um,coaxiality_um\n";
  for (const risk::Group group : risk::groups) {
    std::vector<risk::Outcome> outcomes(cases);
    for_each_index(cases, 0, [&](std::size_t i) { outcomes[i] = risk::judge(group, seed + i); });
    for (std::size_t i = 0; i < cases; ++i) {
      const risk::Outcome& o = outcomes[i];
      char line[160];
      std::snprintf(line, sizeof line, "%s,%llu,%s,%d,%.4f,%.4f\n",
                    std::string(risk::name_of(group)).c_str(),
                    static_cast<unsigned long long>(seed + i), to_string(o.decision), o.reserved,
                    1e3 * o.upper_mm, 1e3 * o.coaxiality_mm);
      out << line;
    }
    std::fprintf(stderr, "%s: %zu jobs\n", std::string(risk::name_of(group)).c_str(), cases);
  }
}
