// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <toml++/toml.h>

#include <deque>

#include "format/toml_reader.hpp"

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

  struct Found {
    std::string key;
    double factor = 1.0;
    const toml::node* node = nullptr;
  };
  Found find(std::string_view key);
  void note(const toml::source_position& at, std::string message);
  void wrong(const Found& found, const std::string& message);
  void missing(std::string_view key, std::string_view what);
  std::string where() const { return name.empty() ? "the top level" : '[' + name + ']'; }
};

struct TomlDocument::Impl {
  std::string path;
  toml::table root;
  std::deque<TomlTable::State> states;
  std::vector<Diagnostic> diagnostics;

  TomlTable::State* open(const toml::table* table, std::string name, toml::source_position place) {
    states.push_back({this, table, place, std::move(name), false, false, {}, {}});
    return &states.back();
  }
  void parse(std::string_view content);
  void report_unknown(const TomlTable::State& state);
};

}  // namespace trueaxis
