// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "format/toml_reader.hpp"
#include "study/sweep/files/sweep_keys.hpp"
#include "study/sweep/sweep.hpp"

namespace trueaxis {

/// The tables [[axis]] of a sweep whose scenario is read.
class SweepAxes {
 public:
  SweepAxes(TomlDocument& document, TomlTable root, study::Sweep& sweep);

  /// Numbers of a `set` that are set before those of the axes.
  std::vector<study::Setting> read_set_before_axes(TomlTable set) const;

 private:
  struct Axis {
    TomlTable table;
    std::vector<TomlTable> cases;
    std::string name;       ///< or key
    study::GridAxis lists;  ///< labels and lists of the cases, where any replaces one
    bool replaces = false;  ///< any list
  };

  study::Sweep& sweep_;
  std::vector<Axis> axes_;
  bool readable_ = false;  ///< the scenario and the lists
  SweepKeys keys_;
  std::vector<WrittenKey> taken_;  ///< by the axes so far

  void read_lists(Axis& axis);
  std::vector<study::GridAxis> lists_but_of(const Axis* without) const;
  const WrittenKey* taken_by(const std::string& path, const std::vector<WrittenKey>& list) const;
  void take(TomlTable& table, std::string_view at, const WrittenKey& written);
  std::vector<study::Setting> read_set(TomlTable& set, const SweepKeys& keys) const;
  void read_axis(Axis& axis);
  SweepKeys keys_of_case(const Axis& axis, const study::AxisPoint& point) const;
  void read_cases(Axis& axis);
  void read_grid(TomlTable table, const std::string& key, const std::optional<KnownKey>& known);
  void read_distribution(TomlTable table, const std::string& key,
                         const std::optional<KnownKey>& known);
  void check_autoregression(TomlDocument& document) const;
  void check_gauge(TomlTable root) const;
};

}  // namespace trueaxis
