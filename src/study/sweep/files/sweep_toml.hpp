// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "format/toml_reader.hpp"
#include "study/sweep/sweep.hpp"

namespace trueaxis {

/// The numbers of a `set` table as the scenario knows them, set before those of the axes.
using ReadSet = std::function<std::vector<study::Setting>(const TomlTable&)>;

/// A table of the file that a study outside the library reads once the sweep itself is whole.
struct SweepExtension {
  std::string key;  ///< of the table, at the top level
  std::function<void(TomlTable, const study::Sweep&, const ReadSet&)> read;
};

/// Reads a sweep; `path` names it in diagnostics and places the scenario's file:
///
///     name = "…"   seed = 1   repeats = 2000
///     methods = ["fit", "huber", "tukey", "diagnosis"]      (["fit"])
///     surface = "section"                 a circle off-centre ("part": the surface that it is)
///     scenario = "cone_shaft.toml"       or the scenario's own tables here: [part], [[pass]] …
///     [[axis]]     key = "noise.sigma_um"   values = [2, 5, 10]
///     [[axis]]     key = "pass.length_mm"   from = 10  to = 50  count = 5   spacing = "log"
///     [[axis]]     key = "effect.0.phase_deg"  distribution = "uniform"  low = 0  high = 360
///                  distribution = "log-uniform" low high | "normal" mean sd
///     [[axis]]     name = "noise"
///     [[axis.case]]  label = "uniform"   set = { "noise.sigma_um" = 0, "noise.uniform_um" = 5 }
///     [[axis.case.pass]], [[axis.case.setup]], [[axis.case.effect]]   as in a scenario: the whole
///                  list; effect = [] for none; `set` may then be missing
///
/// A key is a scenario's table, its place in the list where there are several ("pass.1.",
/// "effect.0."; "pass." is every pass), and its key there in any unit; "pass.length_mm" moves the
/// end. A number is written by one axis only, a list replaced by one only, and keys exist in every
/// case of a list.
///
/// @throws InputError with every diagnostic: file, line, column, what to do.
study::Sweep parse_sweep_toml(std::string_view content, const std::string& path,
                              const std::vector<SweepExtension>& extensions = {});

}  // namespace trueaxis
