// SPDX-License-Identifier: Apache-2.0
// trueaxis-risk: the risk of a GO; scripts/go_risk_study runs it and keeps its page in docs.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <boost/math/distributions/binomial.hpp>
#include <cstdio>
#include <fstream>

#include "base/threads.hpp"
#include "risk/risk_case.hpp"

namespace {

using namespace trueaxis;
using Binomial = boost::math::binomial_distribution<double>;

constexpr double far_from_the_edge = 3.0;  // times the smallest tolerance of a GO

struct Row {
  std::size_t jobs = 0, go = 0, out = 0, far_out = 0, reserved = 0, reserved_out = 0,
              not_proven = 0, no_go = 0;

  void add(const risk::Outcome& o) {
    const bool is_out = o.coaxiality_mm > o.upper_mm;
    ++jobs;
    not_proven += o.decision == Decision::not_proven;
    no_go += o.decision == Decision::no_go;
    if (o.decision != Decision::untoleranced) return;
    (o.reserved ? reserved : go) += 1;
    (o.reserved ? reserved_out : out) += is_out;
    far_out += o.coaxiality_mm > far_from_the_edge * o.upper_mm;
  }
  void add(const Row& r) {
    jobs += r.jobs, go += r.go, out += r.out, far_out += r.far_out, reserved += r.reserved;
    reserved_out += r.reserved_out, not_proven += r.not_proven, no_go += r.no_go;
  }
};

std::string line_of(std::string_view name, const Row& r) {
  const auto n = static_cast<double>(r.go), k = static_cast<double>(r.out);
  const std::string share = r.go == 0
                                ? "–"
                                : fmt::format("{:.1f} ({:.1f} – {:.1f})", 100.0 * k / n,
                                              100.0 * Binomial::find_lower_bound_on_p(n, k, 0.025),
                                              100.0 * Binomial::find_upper_bound_on_p(n, k, 0.025));
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} of {} | {} | {} |\n", name, r.jobs, r.go,
                     r.out, share, r.far_out, r.reserved_out, r.reserved, r.not_proven, r.no_go);
}

constexpr std::string_view head = R"(# The risk of a GO

This page shows how often a GO is wrong, on simulated jobs. The virtual lathe draws jobs whose truth is sealed, `run_job`
decides, and the study compares the cut axis with the drawn one. Parts are cylinders and cones of 2–20°, R 10–80 mm, of
which 20–60 mm are probed in one pass at 18–40 readings per revolution, σ 0.5–2 µm. The cut is 2–25 mm away from the
probed length.

A GO at the edge has exactly the tolerance that the job states as the largest coaxiality; the part is out if its cut
exceeds that. ISO 14253-1 allows 5 %. Far from the edge is three times that tolerance. Waves that keep step with the
eccentricity, less than one beat over the stream, look like the axis in a single pass. No data show them, and the study
does not draw them.

| | jobs | GO | out at the edge | % (95 % interval) | out far from it | with reservations, out | NOT PROVEN | NO-GO |
|---|---|---|---|---|---|---|---|---|
)";

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Jobs with a sealed truth, decided and judged."};
  std::size_t cases = 250;
  std::uint64_t seed = 20261122;
  std::string csv, page;
  std::vector<std::string> only;
  app.add_option("--cases", cases, "jobs of each group");
  app.add_option("--seed", seed, "of the first of each group");
  app.add_option("--only", only, "groups by their names");
  app.add_option("--csv", csv, "a line a job")->required();
  app.add_option("--page", page, "the table (Markdown)");
  CLI11_PARSE(app, argc, argv);
  std::ofstream out(csv);
  out << "group,seed,decision,reserved,upper_um,coaxiality_um,hidden,found\n";
  std::string table(head);
  Row all;
  for (const risk::Group group : risk::groups) {
    const std::string name(risk::name_of(group));
    if (!only.empty() && std::ranges::find(only, name) == only.end()) continue;
    std::vector<risk::Outcome> outcomes(cases);
    for_each_index(cases, 0, [&](std::size_t i) { outcomes[i] = risk::judge(group, seed + i); });
    Row row;
    for (std::size_t i = 0; i < cases; ++i) {
      const risk::Outcome& o = outcomes[i];
      row.add(o);
      out << fmt::format("{},{},{},{},{:.4f},{:.4f},{},{}\n", name, seed + i, to_string(o.decision),
                         o.reserved ? 1 : 0, 1e3 * o.upper_mm, 1e3 * o.coaxiality_mm, o.hidden,
                         o.found);
    }
    all.add(row);
    table += line_of(name, row);
    std::fputs(line_of(name, row).c_str(), stderr);
  }
  table += line_of("all", all);
  table += fmt::format(
      "\nMade by `scripts/go_risk_study --cases {} --seed {}`, which writes a line per job to "
      "build/go_risk.csv.\n",
      cases, seed);
  if (!page.empty()) std::ofstream(page) << table;
}
