// SPDX-License-Identifier: Apache-2.0
#include "job/machine/files/machine_job_screen.hpp"

#include <fmt/format.h>

#include "calibrate/files/machine_screen.hpp"
#include "compensate/files/compensation_screen.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {

std::string machine_job_screen(const MachineJobResult& result) {
  const MachineJobVerdict& verdict = result.verdict;
  std::string text = verdict.line + "\n";
  for (const std::string& reservation : verdict.reservations)
    text += "but    " + reservation + "\n";
  text += machine_findings_screen(result.diagnosis);
  if (!result.tips.empty()) {
    const double U_um = verdict.U_mm / mm_per_um;
    const int decimals = decimals_of(U_um, 0);
    text += fmt::format(
        "tip    off by {:.{}f} ± {:.{}f} µm with the new program (U, k = 2, without where the part "
        "stands)\n",
        verdict.path_after_mm() / mm_per_um, decimals, U_um, decimals);
  }
  if (result.compensation && result.compensation->unreachable.empty())
    text += changes_screen(*result.compensation);
  for (const std::string& remark : result.remarks)
    text += "note   " + remark.substr(0, remark.find(": ")) + "\n";
  return text + "next   " + verdict.next + "\n";
}

}  // namespace trueaxis
