// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "base/number.hpp"
#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/options.hpp"
#include "cli/run.hpp"
#include "cli/terminal.hpp"
#include "format/outputs.hpp"
#include "job/files/stream_job.hpp"
#include "live/files/arriving_text.hpp"
#include "measure/files/stream_csv_write.hpp"
#include "platform/arriving_bytes.hpp"
#include "platform/terminal.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::cli {
namespace {

using platform::ArrivingBytes;
using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds between_pictures{150};

struct WatchArguments {
  RunArguments run;
  double until_U_um = 0.0, idle_s = 10.0;
  int most_kept = 1000000;
  bool json_lines = false, hal = false;

  std::optional<double> wanted_U_mm() const {
    return until_U_um > 0.0 ? std::optional(until_U_um * mm_per_um) : std::nullopt;
  }
};

volatile std::sig_atomic_t stopped = 0;  // what has arrived is written and evaluated

/// Where the readings come from: a growing file, standard input, or halsampler.
class Source {
 public:
  explicit Source(const WatchArguments& options)
      : bytes_(options.hal ? ArrivingBytes::of_program("halsampler")
                           : ArrivingBytes::of_file(options.run.stream.path)),
        idle_s_(options.idle_s) {
    path_ = options.run.stream.path;
    if (!bytes_.is_open()) throw InputError(path_, "cannot be opened: give a file that is there");
    grows_ = !options.hal && path_ != "-" && std::filesystem::is_regular_file(path_);
  }

  /// Waits at most a fifth of the time between two pictures; false: there is no more.
  bool read(ArrivingText& text) {
    if (!bytes_.wait(40)) return stopped == 0;
    static char buffer[1 << 16];
    const std::size_t got = bytes_.read(buffer, sizeof buffer);
    overwritten_ = grows_ && is_another();
    if (overwritten_) return false;
    if (got > 0) {
      text.add({buffer, got});
      read_ += got;
      tail_.append(buffer, got).erase(0, tail_.size() - std::min<std::size_t>(tail_.size(), 256));
      last_ = Clock::now();
    } else if (!grows_ || Clock::now() - last_ > std::chrono::duration<double>(idle_s_)) {
      return false;
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return stopped == 0;
  }

  bool overwritten() const { return overwritten_; }

 private:
  /// Whether the last that was read of the file is no longer there.
  bool is_another() const {
    std::ifstream file(path_, std::ios::binary);
    if (!file) return false;
    std::string there(tail_.size(), '\0');
    file.seekg(static_cast<std::streamoff>(read_ - tail_.size()));
    file.read(there.data(), static_cast<std::streamsize>(there.size()));
    return there != tail_;
  }

  ArrivingBytes bytes_;
  std::string path_, tail_;
  std::size_t read_ = 0;
  bool grows_ = false, overwritten_ = false;
  double idle_s_;
  Clock::time_point last_ = Clock::now();
};

/// The surface of the options, or the one that the readings show so far.
FitOptions fit_of(const WatchArguments& options, const ProbeStream& sample) {
  const FitOptions chosen = options.run.association.chosen(sample);
  if (options.run.surface->count() > 0) return chosen;
  Job job = job_of_stream(options.run.stream.file(), chosen).job;
  std::vector<ProbeStream> streams{sample};
  choose_surfaces(job, streams);
  return job.references.front().fit;
}

class Watch {
 public:
  explicit Watch(const WatchArguments& options)
      : options_(options), live_(static_cast<std::size_t>(options.most_kept)) {}

  /// What is there so far; prints it.
  void update(ArrivingText& text) {
    if (wrong_) return;
    take(text);
    try {
      if (live_.size() < fewest) return;
      constexpr std::size_t enough_to_choose = 5000;
      const FitOptions fit = fit_of(options_, live_.sample(enough_to_choose));
      const LiveState state = live_state(live_, fit, known_, ++looks_);
      show(state);
      if (state.fit.axis_known() && !state.deaf) {
        known_ = state.fit;
        live_.average_about(ideal_reading(known_));
      }
    } catch (const Refusal&) {     // not one surface yet, or never: `run` says which
    } catch (const InputError&) {  // too little of it yet
    }
    if (live_.stride() > 1) text.forget();
  }

  const LiveStream& live() const { return live_; }

 private:
  static constexpr std::size_t fewest = 20;
  static constexpr int most_refused = 20;  // pictures: what a few lines do not show, more may

  void take(ArrivingText& text) {
    try {
      if (std::optional<ProbeStream> next = text.take(options_.run.stream.said())) {
        live_.add(std::move(*next));
        refused_ = 0;
      }
    } catch (const InputError& error) {
      wrong_ = ++refused_ > most_refused;  // `run` lists all that is wrong
      if (wrong_)
        std::cerr << "wrong  " << error.diagnostics().front().message
                  << ". There is no picture; what arrives is kept" << std::endl;
    }
  }

  void show(const LiveState& state) {
    const std::optional<double> wanted = options_.wanted_U_mm();
    if (options_.json_lines)
      std::cout << live_json_line(state, wanted) << std::flush;
    else if (platform::is_terminal(platform::Stream::output))
      std::cout << (pictures_++ > 0 ? "\x1b[20A\x1b[J" : "") << live_picture(state, wanted)
                << std::flush;
    const std::string alarm = live_alarm(state);
    if (!alarm.empty() && alarm_.empty()) std::cerr << "STOP   " << alarm << std::endl;
    alarm_ = alarm;
    if (is_enough(state, wanted) && !enough_)
      std::cerr << "enough U of the axis is reached after " << state.readings
                << " readings: probing may stop" << std::endl;
    enough_ = enough_ || is_enough(state, wanted);
  }

  const WatchArguments& options_;
  LiveStream live_;
  FitResult known_;  ///< the last one with an axis
  std::string alarm_;
  int pictures_ = 0, refused_ = 0;
  std::size_t looks_ = 0;
  bool enough_ = false, wrong_ = false;
};

/// What the options say of the readings, as the lines of a stream: the file is then read as they
/// were.
std::string said_lines(const RunArguments& options, std::string_view text) {
  std::string out;
  const auto say = [&](const char* key, const std::string& value) {
    const std::string line = fmt::format("# {}:", key);
    if (text.find(line) == std::string_view::npos) out += line + " " + value + "\n";
  };
  const StreamOptions& stream = options.stream;
  const auto length = [](double value_mm) { return exact_text(value_mm) + " mm"; };
  if (stream.diameter || stream.radius)
    say("x_convention", stream.diameter ? "diameter" : "radius");
  if (stream.relative) say("reading", "relative");
  if (stream.nominal_radius_mm > 0.0) say("nominal_radius", length(stream.nominal_radius_mm));
  if (options.association.fit.bore) say("feature", "bore");
  if (options.association.fit.ball_radius_mm > 0.0)
    say("ball_radius", length(options.association.fit.ball_radius_mm));
  return out;
}

/// The recording of a pipe goes into the folder of the results, and `run` reads it there.
std::string written_stream(const std::string& path, const RunArguments& options, ArrivingText& text,
                           const LiveStream& live) {
  if (text.all().empty() && live.readings() == 0)
    throw InputError("-", "nothing arrived: look at the program that writes the readings");
  Outputs outputs(options.force);
  outputs.into(std::filesystem::path(path).parent_path().string());
  outputs.may_write(path, "trueaxis.stream");
  outputs.check();
  if (live.stride() > 1)
    write_stream_csv(live.kept(), outputs.open(path));
  else {
    std::string all(text.all());
    const std::size_t first = all.starts_with("## schema:") ? all.find('\n') + 1 : 0;
    outputs.write(path, all.insert(first, said_lines(options, all)));
  }
  outputs.commit();
  return path;
}

int execute(WatchArguments& options) {
  const bool from_pipe = options.hal || options.run.stream.path == "-";
  const std::string recording = (std::filesystem::path(options.run.folder) / "stream.csv").string();
  if (from_pipe && !options.run.force && std::filesystem::exists(recording))
    throw InputError(recording, "is there already: give another folder (-o), or --force");
  if (options.run.check && !from_pipe) return run(options.run);
  if (options.run.check) {
    Outputs outputs(options.run.force);
    outputs.may_write(recording, "trueaxis.stream");
    outputs.check();
    return checked(outputs, "watch what arrives, and then run it");
  }
  std::optional<ArrivingText> arriving;
  std::optional<Watch> watching;
  for (bool again = true; again;) {
    ArrivingText& text = arriving.emplace(
        options.run.stream.path, options.hal ? TextForm::halsampler : TextForm::csv, from_pipe);
    Watch& watch = watching.emplace(options);
    Source source(options);
    platform::on_stop([](int) { stopped = 1; });
    Clock::time_point due = Clock::now();
    while (source.read(text)) {
      if (Clock::now() < due) continue;
      due = Clock::now() + between_pictures;
      watch.update(text);
    }
    again = source.overwritten();
    if (again)
      std::cerr << "new    " << options.run.stream.path
                << " was overwritten: TrueAxis watches the new file from its start" << std::endl;
    else
      watch.update(text);
    platform::on_stop(nullptr);
  }
  ArrivingText& text = *arriving;
  const Watch& watch = *watching;
  if (text.lost() > 0)
    std::cerr << "lost   halsampler reports " << text.lost()
              << " overruns: raise its depth, or sample more seldom\n";
  if (from_pipe) {
    if (!text.torn().empty()) std::cerr << "torn   the last line has no end and is excluded\n";
    if (watch.live().stride() > 1)
      std::cerr << "thinned "
                << (watch.live().averages() ? "each reading kept is the mean of "
                                            : "one is kept of ")
                << watch.live().stride() << " neighbours among the " << watch.live().readings()
                << " that arrived\n";
    options.run.stream.path = written_stream(recording, options.run, text, watch.live());
  }
  return run(options.run);
}

}  // namespace

void add_watch(CLI::App* command, int& exit_code) {
  auto options = std::make_shared<WatchArguments>();
  RunArguments& run = options->run;
  run.stream.add_to(*command, "growing probe stream, or - for standard input");
  command->get_option("stream")->required(false);
  for (const char* of_whole_files : {"--columns", "--skip"})
    command->get_option(of_whole_files)->group("");  // refused below, and not in the help
  run.surface = run.association.add_to(*command);
  add_place(*command, "-o,--output", run.folder,
            "folder for the results (default INPUT_result, of a pipe `result`)");
  command->add_flag("--hal", options->hal,
                    "read halsampler: columns X_M (mm, radius), C (deg) and Z (mm)");
  add_option(*command, "--until-u-um", options->until_U_um, a_length(),
             "U of the axis at which probing may stop, µm (default none)");
  command->add_flag("--json-lines", options->json_lines, "a line of JSON instead of a picture");
  add_option(*command, "--idle-s", options->idle_s, a_length(),
             "time without growth after which a file has ended, s (default 10)");
  add_option(*command, "--most-readings", options->most_kept, CLI::Range(1000, 100000000),
             "readings that are kept before they are thinned (default 1000000)");
  add_json(*command, run.results, "trueaxis.run");
  add_usual(*command, run.force, run.check, &run.verbose);
  command->callback([=, &exit_code] {
    RunArguments& run_options = options->run;
    if (options->hal == !run_options.stream.path.empty())
      throw CLI::RequiredError("FILE, - or --hal, one of them");
    if (!run_options.stream.columns.empty() || run_options.stream.skip > 0)
      throw CLI::ValidationError(
          "--columns", "is for whole files: watch a stream, or --hal, or use import afterwards");
    if (options->json_lines && run_options.results.printed())
      throw CLI::ValidationError("--json", "cannot go where --json-lines go");
    if (options->hal) run_options.stream.path = "-";
    if (run_options.folder.empty())
      run_options.folder =
          run_options.stream.path == "-"
              ? "result"
              : std::filesystem::path(run_options.stream.path).stem().string() + "_result";
    exit_code = execute(*options);
  });
}

}  // namespace trueaxis::cli
