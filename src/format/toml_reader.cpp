// SPDX-License-Identifier: Apache-2.0
#include "format/toml_reader.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <sstream>
#include <tuple>

#include "base/text.hpp"
#include "format/file.hpp"
#include "format/nearest_key.hpp"
#include "format/toml_words.hpp"
#include "format/units.hpp"

namespace trueaxis {

struct TomlTable::State {
  TomlDocument::Impl* document = nullptr;
  const toml::table* table = nullptr;
  toml::source_position place;
  std::string name;
  bool absent = false;  // stands for a required table that is not there
  bool rest_ignored = false;
  std::vector<std::string> known;  // usual spellings, in the order of asking
  std::vector<std::string> accepted;
  std::map<std::string, std::string> renamed;  // earlier spellings, and those of today

  struct Found {
    std::string key;
    double factor = 1.0;
    const toml::node* node = nullptr;
  };
  Found find(std::string_view key);
  /// The same of a type; what is of another is noted and counts as nothing.
  Found find(std::string_view key, bool (toml::node::*is)() const noexcept,
             const std::string& give);
  void note(const toml::source_position& at, std::string message);
  void wrong(const Found& found, const std::string& message);
  void missing(std::string_view key, std::string_view what);
  /// Of a table within this one; keys of tables have no unit.
  std::string full_name(std::string_view key) const {
    return (name.empty() ? "" : name + '.') + std::string(key);
  }
  std::string where() const { return name.empty() ? "the top level" : '[' + name + ']'; }
};

struct TomlDocument::Impl {
  std::string path;
  toml::table root;
  std::deque<TomlTable::State> states;
  std::vector<Diagnostic> diagnostics;

  TomlTable::State* open(const toml::table* table, std::string name, toml::source_position place) {
    states.push_back({this, table, place, std::move(name), false, false, {}, {}, {}});
    return &states.back();
  }
  void parse(std::string_view content);
  void report_unknown(const TomlTable::State& state);
};

TomlTable::State::Found TomlTable::State::find(std::string_view key) {
  const std::vector<KeySpelling> spellings = key_spellings(key);
  const bool first_time =
      std::find(known.begin(), known.end(), spellings.front().key) == known.end();
  if (first_time) known.push_back(spellings.front().key);
  Found found{spellings.front().key, spellings.front().factor, nullptr};
  for (const KeySpelling& spelling : spellings) {
    if (first_time) accepted.push_back(spelling.key);
    const toml::node* node = table ? table->get(spelling.key) : nullptr;
    if (!node) continue;
    if (found.node && first_time) {
      note(node->source().begin, "`" + spelling.key + "` repeats `" + found.key +
                                     "` in another unit: keep one of the two");
    }
    if (!found.node) found = {spelling.key, spelling.factor, node};
  }
  return found;
}

TomlTable::State::Found TomlTable::State::find(std::string_view key,
                                               bool (toml::node::*is)() const noexcept,
                                               const std::string& give) {
  Found found = find(key);
  if (!found.node || (found.node->*is)()) return found;
  wrong(found, "is " + type_text(*found.node) + ": give " + give);
  found.node = nullptr;
  return found;
}

void TomlTable::State::note(const toml::source_position& at, std::string message) {
  document->diagnostics.push_back({document->path, at.line, at.column, std::move(message)});
}

void TomlTable::State::wrong(const Found& found, const std::string& message) {
  const auto earlier = renamed.find(found.key);
  const std::string now =
      earlier == renamed.end() ? "" : ", an earlier name of `" + earlier->second + "`,";
  note(found.node->source().begin, "`" + found.key + "`" + now + ' ' + message);
}

void TomlTable::State::missing(std::string_view key, std::string_view what) {
  if (absent) return;
  note(place, where() + " needs `" + key_spellings(key).front().key + "` (" + std::string(what) +
                  "): add it");
}

std::optional<double> TomlTable::maybe_number(std::string_view key, const Range& range) {
  const State::Found found = state_->find(key, &toml::node::is_number, "a number");
  if (!found.node) return std::nullopt;
  const double value = found.node->value<double>().value_or(0.0) * found.factor;
  if (!std::isfinite(value)) {
    state_->wrong(found, "must be finite");
    return std::nullopt;
  }
  if (!contains(range, value)) {
    state_->wrong(found, "is " + number_text(value / found.factor) + " but must be " +
                             range_text(range, found.factor));
    return std::nullopt;
  }
  return value;
}

double TomlTable::number(std::string_view key, double fallback, const Range& range) {
  return maybe_number(key, range).value_or(fallback);
}

double TomlTable::required_number(std::string_view key, const Range& range) {
  if (!state_->find(key).node) state_->missing(key, "a number");
  return maybe_number(key, range).value_or(std::numeric_limits<double>::quiet_NaN());
}

std::vector<double> TomlTable::numbers(std::string_view key, const Range& range) {
  const State::Found found =
      state_->find(key, &toml::node::is_array, "a list of numbers [a, b, …]");
  if (!found.node) return {};
  std::vector<double> values;
  for (const toml::node& node : *found.node->as_array()) {
    const State::Found item{found.key, found.factor, &node};
    const double value = node.value<double>().value_or(0.0) * found.factor;
    if (!node.is_number() || !std::isfinite(value)) {
      state_->wrong(item, "holds " + type_text(node) + ": give finite numbers only");
    } else if (!contains(range, value)) {
      state_->wrong(item, "holds " + number_text(value / found.factor) + " but each must be " +
                              range_text(range, found.factor));
    } else {
      values.push_back(value);
    }
  }
  return values;
}

std::vector<std::vector<double>> TomlTable::rows(std::string_view key, std::size_t width,
                                                 std::size_t without_unit) {
  const std::string give = "a list of rows of " + std::to_string(width) + " numbers [[…], …]";
  const State::Found found = state_->find(key, &toml::node::is_array, give);
  if (!found.node) return {};
  std::vector<std::vector<double>> rows;
  for (const toml::node& node : *found.node->as_array()) {
    const toml::array* array = node.as_array();
    std::vector<double> row;
    for (std::size_t i = 0; array != nullptr && i < array->size(); ++i) {
      const toml::node& item = (*array)[i];
      const double value = item.value<double>().value_or(0.0);
      if (item.is_number() && std::isfinite(value))
        row.push_back(i < without_unit ? value : value * found.factor);
    }
    if (array == nullptr || array->size() != width || row.size() != width)
      state_->wrong({found.key, 1.0, &node}, "has an entry that is not a row: give " + give);
    else
      rows.push_back(std::move(row));
  }
  return rows;
}

std::optional<long long> TomlTable::maybe_integer(std::string_view key, long long low,
                                                  long long high) {
  const State::Found found = state_->find(key, &toml::node::is_integer, "a whole number");
  if (!found.node) return std::nullopt;
  const long long value = found.node->value<int64_t>().value_or(0);
  if (value < low || value > high) {
    state_->wrong(found, "is " + std::to_string(value) + " but must be in [" + std::to_string(low) +
                             ", " + std::to_string(high) + "]");
    return std::nullopt;
  }
  return value;
}

long long TomlTable::integer(std::string_view key, long long fallback, long long low,
                             long long high) {
  return maybe_integer(key, low, high).value_or(fallback);
}

bool TomlTable::flag(std::string_view key, bool fallback) {
  const State::Found found = state_->find(key, &toml::node::is_boolean, "true or false");
  return found.node ? *found.node->value<bool>() : fallback;
}

std::optional<std::string> TomlTable::maybe_text(std::string_view key) {
  const State::Found found = state_->find(key, &toml::node::is_string, "a text in quotes");
  return found.node ? found.node->value<std::string>() : std::nullopt;
}

std::string TomlTable::text(std::string_view key, std::string fallback) {
  return maybe_text(key).value_or(std::move(fallback));
}

std::string TomlTable::required_text(std::string_view key) {
  if (!state_->find(key).node) state_->missing(key, "a text in quotes");
  return maybe_text(key).value_or("");
}

std::string TomlTable::text_or_date(std::string_view key) {
  const State::Found found = state_->find(key);
  std::ostringstream date;
  if (found.node && found.node->is_date()) date << *found.node->as_date();
  if (found.node && found.node->is_date_time()) date << *found.node->as_date_time();
  return date.str().empty() ? text(key) : date.str();
}

std::vector<std::string> TomlTable::texts(std::string_view key) {
  const State::Found found = state_->find(key, &toml::node::is_array, "a list [\"a\", \"b\"]");
  if (!found.node) return {};
  std::vector<std::string> values;
  for (const toml::node& node : *found.node->as_array()) {
    if (node.is_string()) {
      values.push_back(*node.value<std::string>());
    } else {
      state_->wrong({found.key, 1.0, &node}, "holds " + type_text(node) + ": texts only");
    }
  }
  return values;
}

std::optional<std::string> TomlTable::maybe_path(std::string_view key) {
  const std::optional<std::string> name = maybe_text(key);
  if (!name || name->empty() || *name == "-") return name;
  if (holds_control_character(*name)) {  // "b\temp.csv" is TOML, with a tab
    state_->wrong(state_->find(key), std::string("holds a control character: ") + backslash_advice);
    return std::nullopt;
  }
  return path_next_to(state_->document->path, *name);
}

std::string TomlTable::required_path(std::string_view key) {
  const State::Found found = state_->find(key);
  if (!found.node) state_->missing(key, "a file name in quotes");
  const std::optional<std::string> path = maybe_path(key);
  if (path && path->empty()) state_->wrong(found, "is empty: name a file");
  return path.value_or("");
}

std::optional<std::size_t> TomlTable::choice_index(std::string_view key,
                                                   std::span<const std::string_view> words,
                                                   bool required) {
  const std::string one_of = "one of: " + word_list(words);
  const State::Found found = state_->find(key);
  if (!found.node && required) state_->missing(key, one_of);
  const auto whole = found.node ? found.node->value_exact<int64_t>() : std::nullopt;
  const auto word = whole ? std::optional(std::to_string(*whole)) : maybe_text(key);
  if (!word) return std::nullopt;
  const auto place = std::ranges::find(words, *word);
  if (place != words.end()) return static_cast<std::size_t>(place - words.begin());
  state_->wrong(found, "is \"" + *word + "\" but must be " + one_of);
  return std::nullopt;
}

std::optional<TomlTable> TomlTable::maybe_table(std::string_view key) {
  const std::string full = state_->full_name(key);
  const State::Found found = state_->find(key, &toml::node::is_table, "a table [" + full + "]");
  if (!found.node) return std::nullopt;
  return TomlTable(
      state_->document->open(found.node->as_table(), full, found.node->source().begin));
}

TomlTable TomlTable::required_table(std::string_view key) {
  if (!state_->find(key).node) state_->missing(key, "a table");
  if (const std::optional<TomlTable> table = maybe_table(key)) return *table;
  TomlTable empty(state_->document->open(nullptr, std::string(key), state_->place));
  empty.state_->absent = true;
  return empty;
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
  const State::Found found = state_->find(key);
  if (!found.node) return {};
  const std::string full = state_->full_name(key);
  const toml::array* array = found.node->as_array();
  std::vector<TomlTable> views;
  if (array) {
    for (const toml::node& node : *array) {
      const toml::table* table = node.as_table();
      if (!table) break;
      views.push_back(TomlTable(state_->document->open(table, full, table->source().begin)));
    }
  }
  if (!array || views.size() != array->size()) {
    state_->wrong(found, "must be a list of tables: begin each with [[" + full + "]]");
  }
  return views;
}

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::string> keys;
  if (state_->table == nullptr) return keys;
  for (const auto& [key, node] : *state_->table) keys.emplace_back(key.str());
  return keys;
}

bool TomlTable::has(std::string_view key) { return state_->find(key).node != nullptr; }

std::string_view TomlTable::name_of(std::string_view now, std::string_view before) {
  const std::vector<KeySpelling> today = key_spellings(now), earlier = key_spellings(before);
  for (std::size_t i = 0; i < earlier.size(); ++i)
    state_->renamed[earlier[i].key] = today.at(i).key;
  if (has(before) && has(now)) complain(before, "is given as well: keep that one");
  return has(before) ? before : now;
}

bool TomlTable::has_table(std::string_view key) {
  return state_->find(key).node && state_->find(key).node->is_table();
}

void TomlTable::complain(std::string_view key, std::string message) {
  const State::Found found = state_->find(key);
  if (found.node) {
    state_->wrong(found, message);
  } else if (!state_->absent) {
    state_->note(state_->place, "`" + found.key + "` in " + state_->where() + ' ' + message);
  }
}

void TomlTable::ignore_rest() { state_->rest_ignored = true; }

const std::string& TomlTable::name() const { return state_->name; }

Diagnostic TomlTable::here(std::string message) const {
  return {state_->document->path, state_->place.line, state_->place.column, std::move(message)};
}

void TomlDocument::Impl::parse(std::string_view content) {
  try {
    root = toml::parse(content, path);
  } catch (const toml::parse_error& error) {
    throw InputError({{path, error.source().begin.line, error.source().begin.column,
                       "is not valid TOML: " + std::string(error.description()) +
                           backslash_hint(content, error.source().begin.line)}});
  }
  open(&root, "", {1, 1});
}

void TomlDocument::Impl::report_unknown(const TomlTable::State& state) {
  if (!state.table || state.rest_ignored) return;
  for (const auto& [key, node] : *state.table) {
    const std::string word(key.str());
    if (std::ranges::find(state.accepted, word) != state.accepted.end()) continue;
    std::string near = nearest_key(word, state.accepted);
    if (const auto now = state.renamed.find(near); now != state.renamed.end()) near = now->second;
    const toml::source_position at = key.source().begin ? key.source().begin : node.source().begin;
    diagnostics.push_back({path, at.line, at.column,
                           state.where() + " has no key `" + word + "`" +
                               (near.empty() ? "." : ", did you mean `" + near + "`?") +
                               " Known keys: " + word_list(state.known)});
  }
}

TomlDocument::TomlDocument(const std::string& path) : TomlDocument(read_file(path), path) {}

TomlDocument::TomlDocument(std::string_view content, const std::string& path)
    : impl_(std::make_unique<Impl>()) {
  impl_->path = path;
  impl_->parse(content);
}

TomlDocument::~TomlDocument() = default;

TomlTable TomlDocument::root() { return TomlTable(&impl_->states.front()); }

void TomlDocument::add(Diagnostic diagnostic) {
  impl_->diagnostics.push_back(std::move(diagnostic));
}

bool TomlDocument::ok() const { return impl_->diagnostics.empty(); }

void TomlDocument::finish() {
  for (const TomlTable::State& state : impl_->states) impl_->report_unknown(state);
  std::vector<Diagnostic>& all = impl_->diagnostics;
  const auto by_place = [](const Diagnostic& a, const Diagnostic& b) {
    return std::tie(a.line, a.column) < std::tie(b.line, b.column);
  };
  std::stable_sort(all.begin(), all.end(), by_place);
  if (!all.empty()) throw InputError(std::move(all));
}

}  // namespace trueaxis
