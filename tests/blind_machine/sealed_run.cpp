// SPDX-License-Identifier: Apache-2.0
#include "blind_machine/study.hpp"
#include "machine/files/machine_toml.hpp"
#include "support/case_runs.hpp"

namespace trueaxis::blind_machine {
namespace {

using Json = nlohmann::json;

Advice advice_from(const Json& next) {
  Advice out{next.at("plan"), {}, {}};
  for (const char* const list : {"shows", "separates"})
    for (const Json& one : next.at(list)) out.promised.insert(one);
  if (!next.contains("measurement")) return out;
  const Json& measurement = next.at("measurement");
  const auto columns = measurement.at("columns").get<std::vector<std::string>>();
  for (const Json& row : measurement.at("rows")) {
    Visit visit;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const double value = row.at(k);
      if (columns[k] == "ball")
        visit.ball = static_cast<int>(value);
      else if (columns[k] == "tool_length[mm]")
        visit.tool_mm = value;
      else if (const auto axis = std::string("XYZABC").find(columns[k][0]); axis < 6)
        visit.axes[axis] = value * (axis < 3 ? 1.0 : rad_per_deg);
    }
    for (const Json& ball : measurement.at("balls"))
      if (ball.at("ball") == visit.ball) visit.centre_mm = ball.at("centre_mm").get<Vector3>();
    out.visits.push_back(visit);
  }
  return out;
}

Answer answer_from(const Json& json) {
  Answer out;
  for (const Json& finding : json.at("findings"))
    out.classes.push_back(finding.at("class").get<std::vector<std::string>>());
  for (const Json& one : json.at("unexplained")) out.unexplained.push_back(one.at("pattern"));
  for (const Json& one : json.at("not_observable")) out.not_observable.insert(one.at("effect"));
  if (json.at("next_measurement").at("plan") != "")
    out.advice = advice_from(json.at("next_measurement"));
  out.exit_code = 0;
  return out;
}

}  // namespace

Answer run_command(const Case& one, const Plan& plan, std::uint64_t noise_seed,
                   const std::string& command, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  testing::write_text(folder / "machine.toml", machine_toml(one.layout->machine));
  testing::write_text(folder / "data.csv", measurement_text(one, plan, noise_seed));
  testing::write_text(testing::truth_path(folder),
                      Json{{"truth", one.truth}, {"lambda", one.lambda}}.dump(1) + '\n');
  const std::string at = folder.string();
  return testing::timed_answer<Answer>(
      '"' + command + "\" machine diagnose \"" + at + "/data.csv\" --machine \"" + at +
          "/machine.toml\" --json \"" + at + "/diagnosis.json\" --force",
      folder / "diagnosis.json", answer_from);
}

}  // namespace trueaxis::blind_machine
