// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "trueaxis/error.hpp"

namespace trueaxis {

/// Values a key may have, in the unit inside. Defaults: any finite number.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;   ///< low itself is not allowed
  bool high_open = false;  ///< high itself is not allowed

  static constexpr Range any() { return {}; }
  static constexpr Range positive() {
    return {0.0, std::numeric_limits<double>::infinity(), true, false};
  }
  static constexpr Range non_negative() { return {.low = 0.0}; }
  static constexpr Range fraction() { return {.low = 0.0, .high = 1.0}; }
  static constexpr Range between(double low, double high) { return {.low = low, .high = high}; }
  static constexpr Range inside(double low, double high) { return {low, high, true, true}; }
};

/// One table of a TOML file, read strictly. A view: cheap to copy, valid while its TomlDocument
/// lives.
///
/// Every reading call makes its key known. What is wrong (missing, wrong type, out of range)
/// becomes a diagnostic with line and column. The call returns the fallback (NaN, "" or 0 for a
/// required key), and reading goes on. TomlDocument::finish() then throws everything at once.
///
/// **Units in keys.** A key of a quantity is asked for with the unit inside as its suffix
/// (`"x0_mm"`, `"half_angle_rad"`, `"delay_s"`), and the file may give it in any unit of that kind:
/// `x0_mm`, `x0_um`, `x0_in`, `x0_m`; `half_angle_deg`, `_rad`, `_mrad`, `_urad`, `_arcsec`;
/// `delay_s`,
/// `_ms`, `_us`, `_min`; `_hz`, `_khz`; `_mm_per_rev`, `_um_per_rev`, `_in_per_rev`; `_mm_per_s`,
/// `_um_per_s`, `_mm_per_min`, `_um_per_min`. The value returned is in the unit inside. A key
/// without such a suffix (`l`, `speed_rpm`, `damping`) is taken as it is. The same quantity in two
/// units is an error.
class TomlTable {
 public:
  double number(std::string_view key, double fallback, const Range& range = {});
  std::optional<double> maybe_number(std::string_view key, const Range& range = {});
  double required_number(std::string_view key, const Range& range = {});
  /// An array of numbers; empty when the key is not there.
  std::vector<double> numbers(std::string_view key, const Range& range = {});
  /// An array of rows of `width` numbers each, the first `without_unit` of which are taken as they
  /// are; empty when the key is not there.
  std::vector<std::vector<double>> rows(std::string_view key, std::size_t width,
                                        std::size_t without_unit = 0);

  long long integer(std::string_view key, long long fallback,
                    long long low = std::numeric_limits<long long>::min(),
                    long long high = std::numeric_limits<long long>::max());
  std::optional<long long> maybe_integer(std::string_view key,
                                         long long low = std::numeric_limits<long long>::min(),
                                         long long high = std::numeric_limits<long long>::max());

  bool flag(std::string_view key, bool fallback);

  std::string text(std::string_view key, std::string fallback = {});
  std::optional<std::string> maybe_text(std::string_view key);
  std::string required_text(std::string_view key);
  /// A text, or a date or date and time of TOML (2026-03-14) as ISO 8601 writes it.
  std::string text_or_date(std::string_view key);
  /// An array of strings; empty when the key is not there.
  std::vector<std::string> texts(std::string_view key);
  /// A file named by a key, relative names taken from the folder of the TOML file.
  std::optional<std::string> maybe_path(std::string_view key);
  std::string required_path(std::string_view key);

  /// One of a few words: `choice("kind", {{"cone", Kind::cone}, …}, Kind::cone)`. A whole number in
  /// the file is the word of its digits.
  template <class Value>
  Value choice(std::string_view key,
               std::initializer_list<std::pair<std::string_view, Value>> words, Value fallback) {
    const std::vector<std::pair<std::string_view, Value>> list(words);
    return list_choice(key, list, false).value_or(std::move(fallback));
  }
  /// The same for a key that must be there; a wrong word is noted and gives the first one.
  template <class Value>
  Value required_choice(std::string_view key,
                        std::initializer_list<std::pair<std::string_view, Value>> words) {
    const std::vector<std::pair<std::string_view, Value>> list(words);
    return list_choice(key, list, true).value_or(list.front().second);
  }

  std::optional<TomlTable> maybe_table(std::string_view key);
  /// The table, or (after a diagnostic) an empty one whose missing keys are not reported again.
  TomlTable required_table(std::string_view key);
  /// [[key]]: an array of tables; empty when the key is not there.
  std::vector<TomlTable> tables(std::string_view key);

  /// Its keys as they are written, in alphabetical order.
  std::vector<std::string> keys() const;
  /// Whether the file has `key` in any unit of its kind. Makes the key known.
  bool has(std::string_view key);
  bool has_table(std::string_view key);  ///< and it is a table
  /// The name of a key in the file: today's, or an earlier one of the same unit, whose messages
  /// then name today's. Both are an error.
  std::string_view name_of(std::string_view now, std::string_view before);
  /// Notes a diagnostic at `key` if the file has it, else at the table. Say what to do.
  void complain(std::string_view key, std::string message);
  /// Keys that nobody asks for are not reported (after another diagnostic has said all).
  void ignore_rest();
  /// "part.axis", or "" for the file's top level.
  const std::string& name() const;
  /// Position of the table in the file, for diagnostics made later.
  Diagnostic here(std::string message) const;

 private:
  friend class TomlDocument;
  struct State;
  explicit TomlTable(State* state) : state_(state) {}

  template <class Value>
  std::optional<Value> list_choice(std::string_view key,
                                   const std::vector<std::pair<std::string_view, Value>>& words,
                                   bool required) {
    std::vector<std::string_view> names;
    for (const auto& [word, value] : words) names.push_back(word);
    const std::optional<std::size_t> index = choice_index(key, names, required);
    if (!index) return std::nullopt;
    return words[*index].second;
  }
  std::optional<std::size_t> choice_index(std::string_view key,
                                          std::span<const std::string_view> words, bool required);

  State* state_;
};

/// A TOML file: parse, read through root(), then finish().
///
///     TomlDocument document(path);
///     TomlTable root = document.root();
///     job.name = root.required_text("name");
///     if (auto tool = root.maybe_table("tool")) job.tool.height_mm = tool->number("height_mm",
///     0.0); document.finish();  // throws every diagnostic, unknown keys included
class TomlDocument {
 public:
  /// Reads and parses a file ("-": standard input). @throws InputError if it is not TOML.
  explicit TomlDocument(const std::string& path);
  /// Parses `content`; `path` names it in diagnostics and places relative file names.
  TomlDocument(std::string_view content, const std::string& path);
  ~TomlDocument();
  TomlDocument(const TomlDocument&) = delete;
  TomlDocument& operator=(const TomlDocument&) = delete;

  TomlTable root();
  /// Notes a diagnostic found outside the reader.
  void add(Diagnostic diagnostic);
  bool ok() const;  ///< nothing wrong so far (unknown keys are found by finish() only)
  /// Reports keys that no call asked for, with the nearest known one, and
  /// @throws InputError with all diagnostics, sorted by place, if there are any.
  void finish();

 private:
  friend class TomlTable;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trueaxis
