// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <tuple>

#include "format/file.hpp"
#include "format/toml_state.hpp"
#include "format/toml_units.hpp"

namespace trueaxis {

std::string join_words(std::span<const std::string> words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

void TomlDocument::Impl::parse(std::string_view content) {
  try {
    root = toml::parse(content, path);
  } catch (const toml::parse_error& error) {
    throw InputError({{path, error.source().begin.line, error.source().begin.column,
                       "is no TOML: " + std::string(error.description())}});
  }
  open(&root, "", {1, 1});
}

void TomlDocument::Impl::report_unknown(const TomlTable::State& state) {
  if (!state.table || state.rest_ignored) return;
  for (const auto& [key, node] : *state.table) {
    const std::string word(key.str());
    const auto& accepted = state.accepted;
    if (std::find(accepted.begin(), accepted.end(), word) != accepted.end()) continue;
    const std::string near = nearest_word(word, accepted);
    const toml::source_position at = key.source().begin ? key.source().begin : node.source().begin;
    diagnostics.push_back({path, at.line, at.column,
                           state.where() + " has no key `" + word + "`" +
                               (near.empty() ? "." : ", did you mean `" + near + "`?") +
                               " Known keys: " + join_words(state.known)});
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
