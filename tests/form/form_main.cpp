// SPDX-License-Identifier: Apache-2.0
// The table of docs/evidence/form_study.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <vector>

#include "form/form_case.hpp"

namespace {

using namespace trueaxis;
using namespace trueaxis::form_study;

/// Coverage and sizes of one quantity over a group.
struct Tally {
  std::vector<double> U_um, square_um2;
  int cases = 0, held = 0, bounds = 0;

  void add(const Judged& one) {
    ++cases;
    held += one.holds ? 1 : 0;
    bounds += one.bound ? 1 : 0;
    if (one.bound) return;
    U_um.push_back(1e3 * one.U_mm);
    square_um2.push_back(1e6 * one.off_mm * one.off_mm);
  }
  static double median(std::vector<double> of) {
    if (of.empty()) return 0.0;
    std::ranges::sort(of);
    return of[of.size() / 2];
  }
  std::string text() const {
    double sum = 0.0;
    for (const double one : square_um2) sum += one;
    const double rms =
        square_um2.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(square_um2.size()));
    return fmt::format("{:.1f} | {:.2f} | {:.2f} | {}", 100.0 * held / std::max(cases, 1), rms,
                       median(U_um), bounds);
  }
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Coverage and RMS error of RONt and CYLt of a surface");
  int cases = 100;
  std::uint64_t seed = 1;
  app.add_option("--cases", cases, "streams of each size");
  app.add_option("--seed", seed, "of the first stream");
  bool lines = false;
  app.add_flag("--lines", lines, "a line a stream on standard error");
  CLI11_PARSE(app, argc, argv);
  constexpr const char* courses[] = {"no form", "constant", "growing", "local"};
  Tally of_course[4][2], all[2];
  fmt::print(
      "| | streams | RONt: % | RMS µm | U µm | bounds | CYLt: % | RMS µm | U µm | bounds | U by "
      "turns µm |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::size_t readings : {96U, 400U, 1469U, 6000U, 20000U}) {
    Tally of_size[2];
    std::vector<double> by_turns;
    for (int k = 0; k < cases; ++k) {
      const Drawn one = draw(seed++, readings);
      if (one.high_upr < 2.0) continue;
      const FormResult result = assessed(one);
      const Judged of[] = {judged(result, "RONt", "MZCI", one.ront_mm),
                           judged(result, "CYLt", "MZCY", one.cylt_mm)};
      if (lines)
        fmt::print(stderr,
                   "{} {} {} {} upr {} largest {:.2f} RONt {:.3f} off {:+.3f} U {:.3f} {} CYLt "
                   "{:.3f} off {:+.3f} U {:.3f} {}\n",
                   seed - 1, one.stream.size(), courses[static_cast<int>(one.course)],
                   one.sections ? "sections" : "helix", one.high_upr, one.largest_um,
                   1e3 * one.ront_mm, 1e3 * of[0].off_mm, 1e3 * of[0].U_mm,
                   of[0].holds ? "" : "OUT", 1e3 * one.cylt_mm, 1e3 * of[1].off_mm,
                   1e3 * of[1].U_mm, of[1].holds ? "" : "OUT");
      for (const int q : {0, 1}) {
        of_size[q].add(of[q]);
        of_course[static_cast<int>(one.course)][q].add(of[q]);
        all[q].add(of[q]);
      }
      if (const double U = U_by_turns_mm(one); U > 0.0) by_turns.push_back(1e3 * U);
    }
    fmt::print("| {} readings | {} | {} | {} | {:.2f} |\n", readings, of_size[0].cases,
               of_size[0].text(), of_size[1].text(), Tally::median(by_turns));
  }
  for (int c = 0; c < 4; ++c)
    fmt::print("| {} | {} | {} | {} | |\n", courses[c], of_course[c][0].cases,
               of_course[c][0].text(), of_course[c][1].text());
  fmt::print("| all | {} | {} | {} | |\n", all[0].cases, all[0].text(), all[1].text());
}
