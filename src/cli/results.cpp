// SPDX-License-Identifier: Apache-2.0
#include "cli/results.hpp"

#include <algorithm>

#include "cli/options.hpp"
#include "format/file.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis::cli {

CLI::Option* Results::add(CLI::App& command, const std::string& option, const std::string& schema,
                          const std::string& help) {
  Result& one = all_.emplace_back(Result{option.substr(option.rfind(',') + 1), schema, ""});
  return add_place(command, option, one.place, help)
      ->group(results_group)
      ->check([this](const std::string& place) {
        const auto other = std::ranges::find(all_, place, &Result::place);
        return other == all_.end() ? std::string() : "cannot go where " + other->option + " goes";
      });
}

std::size_t Results::at(const std::string& option) const {
  const auto found = std::ranges::find(all_, option, &Result::option);
  expects(found != all_.end(), "a result of this command");
  return static_cast<std::size_t>(found - all_.begin());
}

void Results::say(const std::string& option, const std::string& schema) {
  all_[at(option)].schema = schema;
}

void Results::is_filled_in(const std::string& option) { all_[at(option)].filled_in = true; }

const std::string& Results::operator[](const std::string& option) const {
  return all_[at(option)].place;
}

bool Results::printed() const {
  return std::ranges::any_of(all_, [](const Result& one) { return is_standard_output(one.place); });
}

void Results::name_to(Outputs& outputs, const std::vector<std::string>& read) const {
  for (const std::string& path : read) outputs.reads(path);
  for (const Result& one : all_) {
    if (one.filled_in)
      outputs.may_begin(one.place, "", one.schema);
    else
      outputs.may_write(one.place, one.schema);
  }
}

void add_json(CLI::App& command, Results& results, const std::string& schema) {
  results.add(command, "--json", schema, "result (JSON); - prints it");
}

void add_stream_results(CLI::App& command, Results& results, const std::string& schema,
                        const std::string& residuals_hold) {
  add_json(command, results, schema);
  results.add(command, "--residuals", "trueaxis.residuals",
              "every reading with " + residuals_hold + " (CSV)");
  results.add(command, "--report", "trueaxis.report", "report page (HTML)");
  add_force(command, results.force);
}

}  // namespace trueaxis::cli
