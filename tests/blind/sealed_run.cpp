// SPDX-License-Identifier: Apache-2.0
#include "blind/sealed_run.hpp"

#include <chrono>

#include "diagnose/files/diagnosis_json.hpp"
#include "measure/files/stream_csv.hpp"
#include "measure/files/stream_csv_write.hpp"
#include "support/case_runs.hpp"

namespace trueaxis::blind {
namespace {

using Json = nlohmann::json;
using std::filesystem::path;

}  // namespace

void write_sealed(const BlindCase& blind_case, const path& folder) {
  std::filesystem::create_directories(folder);
  write_stream_csv(make_stream(blind_case), (folder / "stream.csv").string());
  Json effects = Json::array();
  for (std::size_t i = 0; i < blind_case.scenario.effects.size(); ++i) {
    const Effect& effect = blind_case.scenario.effects[i];
    effects.push_back(
        {{"id", effect.id}, {"parameters", effect.parameters}, {"lambda", blind_case.lambdas[i]}});
  }
  const Json truth{{"case", blind_case.id},
                   {"kind", to_string(blind_case.wanted.kind)},
                   {"noise", blind_case.noise},
                   {"sigma_mm", blind_case.scenario.noise.sigma_mm},
                   {"effects", effects}};
  testing::write_text(testing::truth_path(folder), truth.dump(2) + '\n');
}

Sealed open_truth(const path& folder) {
  const Json json = testing::read_json(testing::truth_path(folder));
  Sealed truth;
  truth.kind = kind_from(json.at("kind").get<std::string>());
  truth.sigma_mm = json.at("sigma_mm");
  for (const Json& effect : json.at("effects")) {
    truth.effects.push_back({effect.at("id"), effect.at("parameters")});
  }
  return truth;
}

Answer read_answer(const Json& json) {
  Answer answer;
  for (const Json& finding : json.at("findings")) {
    answer.classes.push_back(finding.at("class").get<std::vector<std::string>>());
    std::vector<double>& probabilities = answer.probabilities.emplace_back();
    probabilities.push_back(finding.value("probability", 1.0));
    for (const Json& rival : finding.value("rivals", Json::array()))
      probabilities.push_back(rival.value("probability", 0.0));
    const Json with = finding.value("separate_with", Json());
    answer.separators.push_back(with.is_object() ? with.value("plan", "") : "");
    const std::string named = finding.at("effect");
    if (answer.classes.back().empty() || answer.classes.back().front() != named) {
      throw std::runtime_error("class of " + named + " does not begin with it");
    }
  }
  for (const Json& cell : json.at("unexplained")) {
    answer.unexplained.push_back(cell.at("harmonic").get<std::string>() + ", " +
                                 cell.at("dependence").get<std::string>());
  }
  for (const Json& absorbed : json.at("not_observable")) {
    const Json with = absorbed.value("separate_with", Json());
    answer.not_observable[absorbed.at("effect")] = with.is_object() ? with.value("plan", "") : "";
  }
  if (json.contains("threshold") && json.at("threshold").is_number()) {
    answer.threshold = json.at("threshold");
  }
  answer.exit_code = 0;
  return answer;
}

Answer run_library(const path& folder, SurfaceId surface) {
  DiagnoseOptions options;
  options.fit.surface = surface == SurfaceId::cone ? SurfaceKind::cone : SurfaceKind::cylinder;
  options.threads = 1;
  const auto start = std::chrono::steady_clock::now();
  Answer answer;
  try {
    answer = read_answer(
        diagnosis_object(diagnose(read_stream_csv((folder / "stream.csv").string()), options)));
  } catch (const std::exception& wrong) {
    answer.text = wrong.what();
  }
  answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return answer;
}

Answer run_command(const std::string& command, const path& folder, SurfaceId surface) {
  if (command.empty()) return run_library(folder, surface);
  const path out = folder / "diagnosis.json";
  std::filesystem::remove(out);
  return testing::timed_answer<Answer>('"' + command + "\" diagnose \"" +
                                           (folder / "stream.csv").string() + "\" --surface " +
                                           to_string(surface) + " --json \"" + out.string() + '"',
                                       out, read_answer);
}

}  // namespace trueaxis::blind
