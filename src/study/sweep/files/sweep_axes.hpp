// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "format/toml_reader.hpp"
#include "study/sweep/scenario_parameters.hpp"
#include "study/sweep/sweep.hpp"

namespace trueaxis {

/// A key of the file as the scenario knows it.
struct KnownKey {
  study::ScenarioParameter parameter;
  double factor = 1.0;  ///< from the unit of the key to the unit inside
};

/// A number that something sets: its path, and the key as it is written.
struct WrittenKey {
  std::string path, key;
};

/// The numbers that a sweep can set: those of the scenario and, of a list that the cases of an axis
/// replace, those that every case has.
class SweepKeys {
 public:
  /// Knows nothing and complains of nothing: the scenario could not be read.
  SweepKeys() = default;
  /// @param lists axes whose cases replace lists, each list by one axis at most
  /// @param of    what `base` is: "", or the case that its lists come from
  SweepKeys(const virtual_lathe::Scenario& base, const std::vector<study::GridAxis>& lists,
            const std::string& of);

  /// Notes at `at` what is wrong with a key that the scenario or one of the cases does not have.
  std::optional<KnownKey> find(TomlTable& table, std::string_view at, const std::string& key) const;

  /// Whether two paths write one number in any of the scenarios.
  bool same_number(const std::string& a, const std::string& b) const;

  /// Notes at `at` where `value` (in the key's unit) is outside the number's range.
  static void check_range(TomlTable& table, std::string_view at, const KnownKey& known,
                          double value);

 private:
  struct Variant {
    virtual_lathe::Scenario scenario;
    std::string of;
    bool passes = false, setups = false, effects = false;  ///< lists that its axis replaces
    std::map<std::string, KnownKey, std::less<>> known;
    std::vector<std::string> usual;  ///< the keys in their usual spelling
  };
  std::vector<Variant> variants_;  ///< the scenario without lists first
  mutable std::map<std::pair<std::string, std::string>, bool> same_;

  void add(Variant variant);
  std::vector<const Variant*> that_matter_for(const std::string& key) const;
};

/// "5", in ten digits.
std::string sweep_label(double value);

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
