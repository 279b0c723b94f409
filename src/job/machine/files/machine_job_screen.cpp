// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "base/number.hpp"
#include "calibrate/files/machine_screen.hpp"
#include "compensate/files/compensation_files.hpp"
#include "format/reason_words.hpp"
#include "job/machine/files/machine_job_files.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {

std::string machine_job_screen(const MachineJobResult& result) {
  const MachineJobVerdict& verdict = result.verdict;
  std::string text =
      machine_verdict_line(verdict) + "\nnext   " + machine_next_words(verdict) + "\n";
  for (const Reason& reservation : verdict.reservations)
    text += "but    " + words_of(reservation) + "\n";
  text += machine_findings_screen(result.diagnosis);
  if (!result.tips.empty()) {
    const double U_um = verdict.U_mm / mm_per_um;
    const int decimals = decimals_of(U_um, 0);
    const double off_um = verdict.path_after_mm() / mm_per_um;
    const double left_um = verdict.not_corrected_mm / mm_per_um;
    const std::string left = left_um > 0.0 ? fmt::format(", besides {} µm that no program corrects",
                                                         significant(left_um, 2))
                                           : "";
    if (off_um <= U_um)
      text += fmt::format(
          "tip    off by less than {} µm with the new program (95 % confidence; the place of "
          "the part excluded){}\n",
          layout::bound(off_um + U_um), left);
    else
      text += fmt::format(
          "tip    off by {:.{}f} ± {:.{}f} µm with the new program (U, k = 2; the place of the "
          "part excluded){}\n",
          off_um, decimals, U_um, decimals, left);
  }
  if (result.compensation && result.compensation->unreachable.empty())
    text += changes_screen(*result.compensation);
  for (Reason remark : result.remarks) {
    remark.parts.clear();  // what it means in detail
    remark.remedies.clear();
    text += "note   " + words_of(remark) + "\n";
  }
  return text;
}

}  // namespace trueaxis
