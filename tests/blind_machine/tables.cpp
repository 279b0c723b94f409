// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <map>

#include "blind_machine/study.hpp"

namespace trueaxis::blind_machine {
namespace {

using Json = nlohmann::json;

struct Cell {
  std::size_t cases = 0, right = 0;
  std::map<std::string, std::size_t> outcomes;
};

/// After Clopper and Pearson, 95 %.
Json cell_json(const Cell& cell) {
  using Binomial = boost::math::binomial_distribution<>;
  const auto n = static_cast<double>(cell.cases), k = static_cast<double>(cell.right);
  const bool none = cell.right == 0, all = cell.right == cell.cases;
  return {{"cases", cell.cases},
          {"right", cell.right},
          {"rate", cell.cases > 0 ? k / n : 0.0},
          {"low", none ? 0.0 : Binomial::find_lower_bound_on_p(n, k, 0.025)},
          {"high", all ? 1.0 : Binomial::find_upper_bound_on_p(n, k, 0.025)},
          {"outcomes", cell.outcomes}};
}

void count(Cell& cell, const Result& result) {
  ++cell.cases;
  cell.right += result.outcome == Outcome::correct ? 1 : 0;
  ++cell.outcomes[to_string(result.outcome)];
}

template <class Key>
Json by(const std::map<Key, Cell>& cells) {
  Json out = Json::object();
  for (const auto& [key, cell] : cells) out[key] = cell_json(cell);
  return out;
}

/// Which of the four unknowns.
std::string what(const Result& result) {
  const std::string& truth = result.made.truth.front();
  return truth.substr(0, truth.find_first_of(" ,"));
}

double median(std::vector<double> list) {
  std::ranges::sort(list);
  return 0.5 * (list[(list.size() - 1) / 2] + list[list.size() / 2]);
}

}  // namespace

std::string to_string(Outcome outcome) {
  constexpr const char* names[] = {
      "correct",     "too wide",           "wrong name",    "missed",    "false alarm",
      "extra cause", "not called unknown", "not abstained", "no advice", "unresolved",
      "crash"};
  return names[static_cast<int>(outcome)];
}

std::string Result::line() const {
  std::string said;
  for (const auto& members : answer.classes) said += fmt::format(" {}", fmt::join(members, "|"));
  for (const std::string& one : answer.unexplained) said += " ?" + one;
  std::string text = fmt::format("{}: {}; truth {} (λ {:.0f}); said{}", made.wanted.id(),
                                 to_string(outcome), fmt::join(made.truth, " and "),
                                 fmt::join(made.lambda, ", "), said.empty() ? " nothing" : said);
  if (answer.advice) text += "; advised " + answer.advice->code;
  for (const auto& members : advised.classes)
    text += fmt::format(" then {}", fmt::join(members, "|"));
  return text + (answer.text.empty() ? "" : ": " + answer.text);
}

Json tables(const std::vector<Result>& results) {
  std::map<std::string, Cell> kinds, layouts_of, plans, unknowns;
  std::map<std::string, std::map<std::string, Cell>> grid;
  Json wrong = Json::array();
  Members members;
  double seconds = 0.0;
  for (const Result& result : results) {
    seconds += result.seconds;
    members.listed += result.members.listed;
    members.far += result.members.far;
    members.far_alone += result.members.far_alone;
    if (result.outcome == Outcome::no_advice) continue;
    const std::string kind = to_string(result.made.wanted.kind);
    count(kinds[kind], result);
    count(grid[kind][result.made.layout->name], result);
    count(plans[result.made.wanted.plan], result);
    if (result.made.wanted.kind == Kind::unknown) count(unknowns[what(result)], result);
    if (result.outcome != Outcome::correct) wrong.push_back(result.line());
  }
  std::map<std::string, std::vector<double>> calibrated, diagnosed;
  for (const Result& result : results) {
    if (!(result.calibrated_mm > 0.0)) continue;
    std::string kind = to_string(result.made.wanted.kind);
    if (result.made.wanted.kind == Kind::unknown) kind = "unknown: " + what(result);
    calibrated[kind].push_back(result.calibrated_mm);
    diagnosed[kind].push_back(result.diagnosed_mm);
  }
  Json out{{"kinds", by(kinds)}, {"plans", by(plans)}, {"unknown", by(unknowns)}};
  for (const auto& [kind, cells] : grid) out["grid"][kind] = by(cells);
  for (const auto& [kind, list] : calibrated)
    out["elsewhere"][kind] = {{"cases", list.size()},
                              {"calibrated_um", 1e3 * median(list)},
                              {"diagnosed_um", 1e3 * median(diagnosed[kind])}};
  for (const Kind kind : all_kinds()) out["goals"][to_string(kind)] = goal(kind);
  out["cases"] = results.size();
  out["members"] = {
      {"listed", members.listed}, {"far", members.far}, {"far_alone", members.far_alone}};
  out["seconds_per_diagnosis"] =
      seconds / static_cast<double>(std::max<std::size_t>(1, results.size()));
  out["not_right"] = wrong;
  return out;
}

}  // namespace trueaxis::blind_machine
