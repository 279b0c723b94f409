// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "report/report_data.hpp"

namespace trueaxis {
namespace {

nlohmann::json parameters_data(const std::vector<FitParameter>& parameters) {
  nlohmann::json list = nlohmann::json::array();
  for (const FitParameter& parameter : parameters) {
    const Estimate& estimate = parameter.estimate;
    list.push_back({{"name", parameter.name},
                    {"value", estimate.value},
                    {"u", estimate.u},
                    {"unit", estimate.unit},
                    {"why_not", estimate.why_not}});
  }
  return list;
}

nlohmann::json budget_data(const std::vector<BudgetLine>& budget) {
  nlohmann::json list = nlohmann::json::array();
  for (const BudgetLine& line : budget) {
    list.push_back({{"source", line.source}, {"type", std::string(1, line.type)}, {"u", line.u}});
  }
  return list;
}

nlohmann::json rejected_data(const std::vector<Rejected>& rejected) {
  nlohmann::json listed = nlohmann::json::array();
  const std::size_t count = std::min(rejected.size(), max_rejected_listed);
  for (std::size_t i = 0; i < count; ++i) {
    listed.push_back({{"row", rejected[i].row}, {"why", rejected[i].why}});
  }
  return {{"count", rejected.size()}, {"listed", listed}};
}

}  // namespace

nlohmann::json fit_data(const FitResult& fit) {
  return {{"surface", to_string(fit.surface)},
          {"bore", fit.bore},
          {"criterion", fit.criterion},
          {"status", to_string(fit.status)},
          {"message", fit.message},
          {"not_determined", fit.not_determined},
          {"k", fit.coverage_factor},
          {"parameters", parameters_data(fit.parameters)},
          {"derived", parameters_data(fit.derived)},
          {"budget", budget_data(fit.budget)},
          {"rejected", rejected_data(fit.rejected)},
          {"rms_mm", fit.rms_mm},
          {"sigma_mm", fit.sigma_mm},
          {"sigma_source", fit.sigma_source},
          {"autocorrelation", fit.autocorrelation},
          {"u_factor", fit.u_factor},
          {"points", fit.points},
          {"iterations", fit.iterations},
          {"position_min_mm", fit.position_min_mm},
          {"position_max_mm", fit.position_max_mm}};
}

}  // namespace trueaxis
