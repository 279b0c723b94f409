// SPDX-License-Identifier: Apache-2.0
#include "blind/tally.hpp"

#include <cstdarg>
#include <cstdio>
#include <set>
#include <sstream>

namespace trueaxis::blind {
namespace {

using Json = nlohmann::json;

std::string printed(const char* format, ...) {
  char buffer[400];
  va_list values;
  va_start(values, format);
  std::vsnprintf(buffer, sizeof buffer, format, values);
  va_end(values);
  return buffer;
}

void count(Cell& cell, Outcome outcome) {
  ++cell.cases;
  ++cell.outcomes[outcome];
}

std::string row_of(const std::string& name, const Cell& cell) {
  const Share at = share(cell.right(), cell.cases);
  std::string row =
      printed("%-22s %6zu %6zu  %6.1f %%  [%5.1f, %5.1f]  goal %4.0f %%%s ", name.c_str(),
              cell.cases, cell.right(), 100.0 * at.value, 100.0 * at.low, 100.0 * at.high,
              100.0 * cell.goal_share, at.high < cell.goal_share ? "  BELOW" : "");
  for (const auto& [outcome, number] : cell.outcomes) {
    if (outcome != Outcome::correct)
      row += "  " + to_string(outcome) + " " + std::to_string(number);
  }
  return row + '\n';
}

Json json_of(const std::string& name, const Cell& cell) {
  const Share at = share(cell.right(), cell.cases);
  Json outcomes = Json::object();
  for (const auto& [outcome, number] : cell.outcomes) outcomes[to_string(outcome)] = number;
  return {
      {"name", name},  {"cases", cell.cases}, {"right", cell.right()},   {"rate", at.value},
      {"low", at.low}, {"high", at.high},     {"goal", cell.goal_share}, {"outcomes", outcomes}};
}

}  // namespace

/// Whether causes that are given the probability p are true in p of all.
void add_reliability(const Result& result, Tally& all) {
  const auto is_true = [&](const std::string& id) {
    return std::ranges::find(result.made.scenario.effects, id, &Effect::id) !=
           result.made.scenario.effects.end();
  };
  for (std::size_t c = 0; c < result.answer.probabilities.size(); ++c) {
    const auto& members = result.answer.classes[c];
    if (members.size() < 2 || std::ranges::count_if(members, is_true) != 1) continue;
    for (std::size_t m = 0; m < members.size(); ++m) {
      const double p = result.answer.probabilities[c][m];
      Tally::Stated& bin =
          all.reliability[std::min<std::size_t>(9, static_cast<std::size_t>(10.0 * p))];
      ++bin.members, bin.sum += p, bin.true_ones += is_true(members[m]);
    }
  }
}

Tally tally(const std::vector<Result>& results) {
  Tally all;
  for (const Result& result : results) {
    add_reliability(result, all);
    const Wanted& wanted = result.made.wanted;
    const Outcome outcome = result.score.outcome;
    Cell& cell = all.cells[{wanted.kind, wanted.plan}];
    cell.goal_share = goal(wanted.kind, wanted.plan);
    count(cell, outcome);
    Cell& kind = all.kinds[wanted.kind];
    kind.goal_share = goal(wanted.kind, PlanId::p3);
    count(kind, outcome);
    if (wanted.kind == Kind::null) {
      Cell& noise = all.noises[result.made.noise];
      noise.goal_share = goal(Kind::null, wanted.plan);
      count(noise, outcome);
    }
    for (std::size_t i = 0; i < result.score.named.size(); ++i) {
      const auto& effects = result.made.scenario.effects;
      ++all.confusion[effects.empty() ? "no effect" : effects[i].id][result.score.named[i]];
    }
    for (const Member& member : result.score.members) {
      ++all.members;
      if (member.distance < demanded_distance) ++all.members_strict;
      if (!(member.distance < allowed_distance)) ++all.members_excluded;
    }
    all.advice_wanted += result.advice_wanted;
    if (result.advice_taken) {
      ++all.advice_taken, ++all.advice[result.advice].first;
      if (result.advice_resolved) ++all.advice_resolved, ++all.advice[result.advice].second;
    }
    all.seconds += result.answer.seconds;
    ++all.cases;
  }
  return all;
}

std::string text_of(const Tally& all) {
  std::string text;
  for (const auto& [at, cell] : all.cells) {
    text += row_of(to_string(at.first) + ' ' + to_string(at.second), cell);
  }
  text += "over the plans\n";
  for (const auto& [kind, cell] : all.kinds) text += row_of(to_string(kind), cell);
  if (!all.noises.empty()) text += "no effect, by noise\n";
  for (const auto& [noise, cell] : all.noises) text += row_of(noise, cell);
  text += printed("class members besides the truth: %zu; %zu within 3.29 sigma, %zu beyond 6.6\n",
                  all.members, all.members_strict, all.members_excluded);
  if (all.advice_taken > 0) {
    const Share at = share(all.advice_resolved, all.advice_taken);
    text += printed(
        "a measurement wanted %zu times, recommended and taken %zu, resolved %zu: %.1f %% "
        "[%.1f, %.1f], goal %.0f %%\n",
        all.advice_wanted, all.advice_taken, all.advice_resolved, 100.0 * at.value, 100.0 * at.low,
        100.0 * at.high, 100.0 * advice_goal);
  }
  text += printed("%.0f ms a diagnosis, its process included\n",
                  1e3 * all.seconds / static_cast<double>(std::max<std::size_t>(1, all.cases)));
  return text;
}

Json json_of(const Tally& all) {
  Json cells = Json::array(), kinds = Json::array(), noises = Json::array();
  for (const auto& [at, cell] : all.cells) {
    Json row = json_of(to_string(at.first) + ' ' + to_string(at.second), cell);
    row["kind"] = to_string(at.first), row["plan"] = to_string(at.second);
    cells.push_back(row);
  }
  for (const auto& [kind, cell] : all.kinds) kinds.push_back(json_of(to_string(kind), cell));
  for (const auto& [noise, cell] : all.noises) noises.push_back(json_of(noise, cell));
  Json advice = Json::object();
  for (const auto& [plan, counts] : all.advice) advice[plan] = {counts.first, counts.second};
  const Share resolved = share(all.advice_resolved, all.advice_taken);
  Json reliability = Json::array();
  for (const Tally::Stated& bin : all.reliability) {
    const Share at = share(bin.true_ones, bin.members);
    reliability.push_back({{"members", bin.members},
                           {"true", bin.true_ones},
                           {"mean", bin.members ? bin.sum / static_cast<double>(bin.members) : 0.0},
                           {"low", at.low},
                           {"high", at.high}});
  }
  return {{"cases", all.cases},
          {"reliability", reliability},
          {"cells", cells},
          {"kinds", kinds},
          {"noises", noises},
          {"confusion", all.confusion},
          {"members",
           {{"listed", all.members},
            {"strict", all.members_strict},
            {"excluded", all.members_excluded}}},
          {"advice",
           {{"wanted", all.advice_wanted},
            {"taken", all.advice_taken},
            {"resolved", all.advice_resolved},
            {"rate", resolved.value},
            {"low", resolved.low},
            {"high", resolved.high},
            {"goal", advice_goal},
            {"plans", advice}}},
          {"seconds_per_diagnosis",
           all.seconds / static_cast<double>(std::max<std::size_t>(1, all.cases))}};
}

std::string confusion_csv(const Tally& all) {
  std::set<std::string> names;
  for (const auto& [truth, row] : all.confusion) {
    for (const auto& [named, number] : row) names.insert(named);
  }
  std::ostringstream text;
  text << "truth";
  for (const std::string& named : names) text << ',' << named;
  text << '\n';
  for (const auto& [truth, row] : all.confusion) {
    text << truth;
    for (const std::string& named : names) {
      const auto found = row.find(named);
      text << ',' << (found == row.end() ? 0 : found->second);
    }
    text << '\n';
  }
  return text.str();
}

std::string line_of(const Result& result) {
  std::string line = result.made.id + ": " + to_string(result.score.outcome) + "; truth";
  const auto& effects = result.made.scenario.effects;
  if (effects.empty()) line += " no effect (" + result.made.noise + ')';
  for (std::size_t i = 0; i < effects.size(); ++i) {
    line += ' ' + effects[i].id;
    for (const auto& [name, value] : effects[i].parameters) {
      line += printed(" %s=%.4g", name.c_str(), value);
    }
    line += printed(" lambda=%.0f;", result.made.lambdas[i]);
  }
  line += printed(" sigma=%.4f mm; said", result.made.scenario.noise.sigma_mm);
  for (const auto& members : result.answer.classes) {
    line += " [";
    for (const std::string& id : members) line += ' ' + id;
    line += " ]";
  }
  for (const std::string& cell : result.answer.unexplained) line += " unexplained (" + cell + ')';
  if (result.advice_taken) {
    line += "; with " + result.advice + ':';
    for (const auto& members : result.advised.classes) {
      line += " [";
      for (const std::string& id : members) line += ' ' + id;
      line += " ]";
    }
    if (result.advised.classes.empty()) line += " nothing";
  }
  for (const Member& member : result.score.members) {
    if (member.distance >= demanded_distance) {
      line += printed(" d(%s)=%.1f", member.effect.c_str(), member.distance);
    }
  }
  if (result.answer.broken())
    line += " exit " + std::to_string(result.answer.exit_code) + ": " + result.answer.text;
  return line;
}

}  // namespace trueaxis::blind
