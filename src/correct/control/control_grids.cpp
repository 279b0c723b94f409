// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>

#include "correct/control/as_read.hpp"
#include "correct/control/control_table.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

/// `value` as a number of `unit`s, and the node set to it.
long long rounded_to(double& value_mm, double unit_mm) {
  const long long units = std::llround(value_mm / unit_mm);
  value_mm = static_cast<double>(units) * unit_mm;
  return units;
}

}  // namespace

MadeControlTable grid_csv(const Correction& correction, const ControlTable& table) {
  constexpr double unit_mm = 1e-7;  // 0.1 nm
  CorrectionGrid grid = correction_grid(correction, table.c_step_rad, table.position_step_mm);
  const bool face = correction.target.kind == TargetKind::face;
  std::string text = "# schema: trueaxis.control_grid/1\n";
  put(text,
      "# {}_fts in um, wanted (not precompensated), positive {}; C as in the probe stream; linear "
      "in between\n",
      face ? "Z" : "X", face ? "along +Z" : "away from the spindle axis");
  text += face ? "C[deg]\\X[mm]" : "C[deg]\\Z[mm]";
  for (const double position : grid.position_mm) put(text, ",{:.6f}", position);
  text += '\n';
  for (std::size_t i = 0; i < grid.angles; ++i) {
    put(text, "{:.6f}", static_cast<double>(i) * table.c_step_rad / rad_per_deg);
    for (std::size_t j = 0; j < grid.position_mm.size(); ++j)
      put(text, ",{:.4f}",
          static_cast<double>(rounded_to(grid.at(j, i), unit_mm)) * unit_mm / mm_per_um);
    text += '\n';
  }
  const Deviation off = grid_as_read(correction, text);
  return {std::move(text), 0.5 * unit_mm, off};
}

MadeControlTable sinumerik_cec(const Correction& correction, const ControlTable& table) {
  constexpr double unit_mm = 1e-6;
  const auto [low, high] = std::minmax(correction.position_start_mm, correction.position_end_mm);
  const std::size_t bands =
      std::max<std::size_t>(1, nodes_of_length(high - low, table.position_step_mm) - 1);
  const double band_mm = (high - low) / static_cast<double>(bands);
  std::string text = "; schema: trueaxis.sinumerik_cec/1\n";
  text +=
      "; X over C, mm, positive away from the spindle axis, wanted (not precompensated).\n"
      "; The sign that the control gives a compensation is set in its machine data: try it with\n"
      "; one table first. Enable one table at a time, by the Z of the cut.\n"
      "%_N_NC_CEC_INI\nCHANDATA(1)\n";
  // What a band has is that of its middle: a grid of two equal lines each.
  const CorrectionGrid whole = correction_grid(correction, table.c_step_rad, 0.5 * band_mm);
  for (std::size_t band = 0; band < bands; ++band) {
    const std::size_t middle = 2 * band + 1;
    put(text, "; table {}: Z {:.4f} to {:.4f}\n", band + 1,
        low + band_mm * static_cast<double>(band), low + band_mm * static_cast<double>(band + 1));
    for (std::size_t i = 0; i < whole.angles; ++i) {
      double value = whole.at(middle, i);
      rounded_to(value, unit_mm);
      put(text, "$AN_CEC[{},{}]={:.6f}\n", band, i, value == 0.0 ? 0.0 : value);
    }
    put(text,
        "$AN_CEC_INPUT_AXIS[{0}]=(C1)\n$AN_CEC_OUTPUT_AXIS[{0}]=(X1)\n$AN_CEC_STEP[{0}]={1:.6f}\n"
        "$AN_CEC_MIN[{0}]=0.0\n$AN_CEC_MAX[{0}]=360.0\n$AN_CEC_DIRECTION[{0}]=0\n"
        "$AN_CEC_MULT_BY_TABLE[{0}]=0\n$AN_CEC_IS_MODULO[{0}]=1\n",
        band, table.c_step_rad / rad_per_deg);
  }
  text += "M17\n";
  const Deviation off = sinumerik_as_read(correction, text);
  return {std::move(text), 0.5 * unit_mm, off};
}

MadeControlTable beckhoff_crosscomp2(const Correction& correction, const ControlTable& table) {
  constexpr double unit_mm = 1e-4;  // 0.1 µm
  CorrectionGrid grid = correction_grid(correction, table.c_step_rad, table.position_step_mm);
  // The control counts its places in intervals from the start: the last may lie past the cut.
  const double low = grid.position_mm.front();
  const std::size_t places = grid.position_mm.size();
  Correction longer = correction;
  longer.position_start_mm = low;
  longer.position_end_mm = low + table.position_step_mm * static_cast<double>(places - 1);
  grid = correction_grid(longer, table.c_step_rad, table.position_step_mm);
  const auto interval = std::llround(table.position_step_mm / unit_mm);
  std::string text = "# schema: trueaxis.beckhoff_crosscomp/1\n";
  put(text,
      "# X over C (master 1) and Z (master 2), positive away from the spindle axis, wanted (not "
      "precompensated)\n"
      "kopf.achs_nr                           {0}\nkopf.log_achs_name                     X\n"
      "kw.crosscomp2.max_points               {1}\nkw.crosscomp2.interval                 {2}\n"
      "kw.crosscomp2.last_index_master1       {3}\nkw.crosscomp2.last_index_master2       {4}\n"
      "kw.crosscomp2.start_position_master1   0\nkw.crosscomp2.start_position_master2   {5}\n"
      "kw.crosscomp2.unit                     1\nkw.crosscomp2.n_cycles                 20\n"
      "kw.crosscomp2.master1_ax_nr            {6}\nkw.crosscomp2.master2_ax_nr            {7}\n",
      table.x_axis, grid.angles * places, interval, grid.angles - 1, places - 1,
      std::llround(low / unit_mm), table.c_axis, table.z_axis);
  for (std::size_t j = 0; j < places; ++j)
    for (std::size_t i = 0; i < grid.angles; ++i)
      put(text, "kw.crosscomp2.table[{}][{}].correction  {}\n", j, i,
          rounded_to(grid.at(j, i), unit_mm));
  text += "# to be enabled in the axis' parameters: lr_param.crosscomp2 1\nEnde\n";
  const Deviation off = beckhoff_as_read(correction, text);
  return {std::move(text), 0.5 * unit_mm, off};
}

}  // namespace trueaxis
