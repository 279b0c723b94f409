// SPDX-License-Identifier: Apache-2.0
// trueaxis-blind: a blind study of the diagnosis; see --help.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>

#include "blind/detection.hpp"
#include "blind/tally.hpp"
#include "support/places.hpp"

namespace {

using namespace trueaxis::blind;

struct Arguments {
  std::size_t cases = 1000, detection = 0;
  std::uint64_t seed = 20260101;
  std::vector<std::string> kinds, plans, surfaces;
  int jobs = 2;
  std::string csv, json, command = places::command(), scratch = places::scratch(), only;
  bool keep = false, follow_advice = false, quiet = false;
};

void declare(CLI::App& app, Arguments& to) {
  app.add_option("--cases", to.cases, "how many, kinds x plans x surfaces in turn");
  app.add_option("--seed", to.seed, "of the study; printed");
  app.add_option("--kinds", to.kinds, "null one two three unknown absorbed gaps typical")
      ->delimiter(',');
  app.add_option("--plans", to.plans, "P1 ... P8")->delimiter(',');
  app.add_option("--surfaces", to.surfaces, "cone cylinder")->delimiter(',');
  app.add_option("--detection", to.detection, "cases per point of the detection curve");
  app.add_option("--jobs", to.jobs, "processes at a time");
  app.add_option("--csv", to.csv, "the confusion matrix");
  app.add_option("--json", to.json, "all tables, and the cases that are not right");
  app.add_option("--command", to.command, "the trueaxis command to judge");
  app.add_option("--scratch", to.scratch, "folder of the streams");
  app.add_option("--only", to.only, "one case by its id, as KIND-PLAN-SURFACE-SEED; kept");
  app.add_flag("--keep", to.keep, "keep streams, truths and answers");
  app.add_flag("--follow-advice", to.follow_advice, "take the recommended measurement too");
  app.add_flag("--quiet", to.quiet, "no progress");
}

template <class T, class Read>
void read_list(const std::vector<std::string>& texts, std::vector<T>& list, Read read) {
  if (texts.empty()) return;
  list.clear();
  for (const std::string& text : texts) list.push_back(read(text));
}

Wanted wanted_from(const std::string& id) {
  std::vector<std::string> words;
  std::string word;
  for (std::istringstream text(id); std::getline(text, word, '-');) words.push_back(word);
  if (words.size() != 4) throw std::invalid_argument("--only: KIND-PLAN-SURFACE-SEED");
  Wanted wanted;
  wanted.kind = kind_from(words[0]), wanted.plan = plan_from(words[1]);
  wanted.surface = surface_from(words[2]), wanted.seed = std::stoull(words[3]);
  return wanted;
}

/// Prints rate and time left, and every case that is not right.
class Progress {
 public:
  explicit Progress(std::size_t cases) : cases_(cases) {}
  void operator()(std::size_t done, const Result& result) {
    if (result.score.outcome != Outcome::correct) {
      std::fprintf(stderr, "%s\n", line_of(result).c_str());
    } else {
      ++right_;
    }
    if (done % 20 != 0 && done != cases_) return;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
    const double rate = static_cast<double>(done) / passed.count();
    std::fprintf(stderr, "%zu of %zu, %.1f %% right, %.1f a second, %.0f s left\n", done, cases_,
                 100.0 * static_cast<double>(right_) / static_cast<double>(done), rate,
                 static_cast<double>(cases_ - done) / rate);
  }

 private:
  std::size_t cases_, right_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

nlohmann::json json_of(const std::vector<DetectionPoint>& curve) {
  nlohmann::json list = nlohmann::json::array();
  for (const DetectionPoint& point : curve) {
    const Share at = share(point.found, point.cases);
    list.push_back({{"lambda", point.lambda},
                    {"cases", point.cases},
                    {"found", point.found},
                    {"rate", at.value},
                    {"low", at.low},
                    {"high", at.high},
                    {"threshold", point.threshold},
                    {"expected", point.expected}});
  }
  return list;
}

void run(const Arguments& arguments) {
  Selection selection;
  read_list(arguments.kinds, selection.kinds, kind_from);
  read_list(arguments.plans, selection.plans, plan_from);
  read_list(arguments.surfaces, selection.surfaces, surface_from);
  selection.cases = arguments.cases, selection.seed = arguments.seed;
  std::vector<Wanted> wanted = select(selection);
  if (!arguments.only.empty()) wanted = {wanted_from(arguments.only)};

  StudyOptions options;
  options.command = arguments.command;
  options.scratch = std::filesystem::path(arguments.scratch) / "blind";
  options.keep = arguments.keep || !arguments.only.empty();
  options.follow_advice = arguments.follow_advice, options.jobs = arguments.jobs;
  std::printf("seed %llu, %zu cases\n", static_cast<unsigned long long>(arguments.seed),
              wanted.size());
  Progress progress(wanted.size());
  if (!arguments.quiet) options.progress = std::ref(progress);
  const std::vector<Result> results = run_study(wanted, options);
  const Tally all = tally(results);
  std::fputs(text_of(all).c_str(), stdout);

  nlohmann::json json = json_of(all);
  json["seed"] = arguments.seed;
  nlohmann::json wrong = nlohmann::json::array(), open = nlohmann::json::array();
  for (const Result& result : results) {
    if (result.score.outcome != Outcome::correct) wrong.push_back(line_of(result));
    if (result.advice_taken && !result.advice_resolved) open.push_back(line_of(result));
  }
  json["not_right"] = wrong;
  json["not_resolved"] = open;
  if (arguments.detection > 0) {
    options.progress = nullptr;
    const auto curve = detection_curve({8, 14, 20, 26, 32, 40, 50, 64}, arguments.detection,
                                       arguments.seed, options);
    json["detection"] = json_of(curve);
    std::puts("three lobes, one helical pass of a cone: lambda, found, expected");
    for (const DetectionPoint& point : curve) {
      std::printf("%6.0f  %zu of %zu  %.3f\n", point.lambda, point.found, point.cases,
                  point.expected);
    }
  }
  if (!arguments.json.empty()) std::ofstream(arguments.json) << json.dump(1) << '\n';
  if (!arguments.csv.empty()) std::ofstream(arguments.csv) << confusion_csv(all);
  if (!arguments.only.empty()) std::printf("kept in %s\n", options.scratch.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Streams with a hidden cause from the virtual lathe; trueaxis diagnose must name it."};
  Arguments arguments;
  declare(app, arguments);
  CLI11_PARSE(app, argc, argv);
  try {
    run(arguments);
  } catch (const std::exception& wrong) {
    std::fprintf(stderr, "trueaxis-blind: %s\n", wrong.what());
    return 2;
  }
  return 0;
}
