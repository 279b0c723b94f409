// SPDX-License-Identifier: Apache-2.0
#include "job/files/feedback_files.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/counted.hpp"
#include "base/number.hpp"
#include "correct/files/table_files.hpp"
#include "format/file.hpp"
#include "format/toml_header.hpp"
#include "job/files/job_results.hpp"
#include "job/machine_loop.hpp"
#include "job/verified_cut.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

constexpr double same_speed = 0.05;  // a lag then differs by as much of itself

std::string surface_text(const char* surface, bool bore) {
  return std::string(surface) + (bore ? ", bore" : ", shaft");
}

Json actuator_object(const Actuator& a) {
  Json json{{"natural_frequency_hz", a.natural_frequency_hz},
            {"damping", a.damping},
            {"delay_s", a.delay_s},
            {"sampling_hz", a.sampling_hz},
            {"precompensate", a.precompensate},
            {"stroke_mm", a.stroke_mm}};
  json["response"] = list_of(a.measured, [](const ResponsePoint& point) {
    return Json::array({point.frequency_hz, point.gain, point.phase_rad});
  });
  return json;
}

/// All that lag and gain hang on, but for the part.
Json machine_object(const Job& job, const std::vector<ProbeStream>& streams) {
  constexpr const char* kinds[] = {"cylinder", "cone", "face"};
  const Json header = header_object(job.header);
  const FitOptions& fit = job.references.front().fit;
  return {{"machine", header.value("machine", "")},
          {"probe", header.value("probe", "")},
          {"reference", list_of(job.references,
                                [](const JobReference& r) {
                                  return surface_text(to_string(r.fit.surface), r.fit.bore);
                                })},
          {"target", surface_text(kinds[static_cast<int>(job.target->kind)], job.target->bore)},
          {"axis", to_string(job.axis_of_cut)},
          {"probing_speed_rpm", number(60.0 / two_pi * probing_speed(streams))},
          {"sense", job.tool.sense > 0 ? "+c" : "-c"},
          {"speed_rpm", job.tool.speed_rpm},
          {"angle_from_probe_rad", job.tool.angle_from_probe_rad},
          {"tool_height_mm", job.tool.height_mm},
          {"actuator", actuator_object(job.actuator)},
          {"ball_radius_mm", fit.ball_radius_mm},
          {"known", list_of(fit.influences, [](const Influence& influence) {
             return Json::array({info_of(influence.kind).key, influence.value, influence.u});
           })}};
}

Json evidence_object(const LoopEvidence& e) {
  return {{"information", e.information}, {"sum", e.sum}, {"squares", e.squares}};
}

LoopEvidence evidence_from(const Json& json) {
  return {json.at("information"), json.at("sum"), json.at("squares")};
}

Json loop_object(const LoopResponse& r) {
  Json json{{"gain", to_json(Estimate{r.gain, r.u_gain, "1", ""})},
            {"lag", to_json(Estimate{r.lag_rad, r.u_lag_rad, "rad", ""})}};
  if (!r.motion.empty())
    json["motion"] = list_of(r.motion, [](const LearnedMotion& one) -> Json {
      return {{"order", one.order},
              {"cos", to_json(Estimate{one.cos_mm, one.u_mm, "mm", ""})},
              {"sin", to_json(Estimate{one.sin_mm, one.u_mm, "mm", ""})}};
    });
  return json;
}

LoopResponse response_in(const LoopObservation& seen) {
  return {seen.gain, seen.lag_rad, seen.u_gain, seen.u_lag_rad, 0.0, seen.motion};
}

Json evidence_object(const MachineLoop& loop) {
  return {{"parts", list_of(loop.parts,
                            [](const LoopObservation& one) -> Json {
                              return {{"gain", one.gain},
                                      {"lag_rad", one.lag_rad},
                                      {"u_gain", one.u_gain},
                                      {"u_lag_rad", one.u_lag_rad},
                                      {"per_mm", one.per_mm}};
                            })},
          {"forms", loop.forms},
          {"motion", list_of(loop.motion, [](const MotionEvidence& e) -> Json {
             return {{"order", e.order},
                     {"cos", evidence_object(e.cos)},
                     {"sin", evidence_object(e.sin)}};
           })}};
}

MachineLoop loop_from(const Json& json) {
  MachineLoop loop;
  for (const Json& one : json.at("parts"))
    loop.parts.push_back({one.at("gain"),
                          one.at("lag_rad"),
                          one.at("u_gain"),
                          one.at("u_lag_rad"),
                          one.at("per_mm"),
                          {}});
  loop.forms = json.value("forms", 0);
  for (const Json& one : json.value("motion", Json::array()))
    loop.motion.push_back(
        {one.at("order"), evidence_from(one.at("cos")), evidence_from(one.at("sin"))});
  return loop;
}

Json response_object(const LoopResponse& r, const MachineLoop& loop) {
  Json json = loop_object(r);
  json["u_cut_mm"] = r.u_cut_mm;
  json["parts"] = loop.parts.size();
  return json;
}

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw InputError(path, why);
}

/// The feedback of a result as it was written.
Json feedback_in(const std::string& path) {
  const Json json = Json::parse(read_file(path), nullptr, false);
  if (!json.is_object() || json.value("schema", Json()) != "trueaxis.run/2")
    refuse(path, "is not a result of `trueaxis run`: give the result.json of the part before");
  if (!json.contains("feedback"))
    refuse(
        path,
        "does not hold what its cut showed: add [verification] to its job, and run it once more");
  Json feedback = json.at("feedback");
  const Json hash = feedback.is_object() ? feedback.value("hash", Json()) : Json();
  if (feedback.is_object()) feedback.erase("hash");
  if (!hash.is_string() || hash != content_hash(feedback.dump()))
    refuse(path,
           "was changed after TrueAxis wrote it, the hash of `feedback` differs: run the job "
           "of that part once more");
  if (!feedback.at("evidence").at("parts").is_array())
    refuse(path, "is of an earlier version of TrueAxis: start anew without --previous");
  if (feedback.at("verification").is_null())
    refuse(path,
           "is of a part that was not probed again after its cut: give the last one that was");
  return feedback;
}

bool same(const std::string& key, const Json& before, const Json& now) {
  if (key != "probing_speed_rpm" || !before.is_number() || !now.is_number()) return before == now;
  return std::abs(now.get<double>() - before.get<double>()) <=
         same_speed * std::abs(before.get<double>());
}

/// What differs between the machine of the part before and that of the job.
std::vector<Diagnostic> differences(const std::string& job, const std::string& previous,
                                    const Json& before, const Json& now) {
  std::vector<Diagnostic> out;
  for (const auto& [key, value] : now.items()) {
    const Json earlier = before.value(key, Json());
    if (!same(key, earlier, value))
      out.push_back(
          {job, 0, 0,
           fmt::format("{} is {}, and {} in {}: lag and gain are then other ones; run the "
                       "job without --previous",
                       key, value.dump(), earlier.dump(), previous)});
  }
  return out;
}

std::string percent_and_degrees(const LoopResponse& r) {
  std::string text =
      fmt::format("gain {:+.3g} ± {:.2g} %, lag {:+.3g} ± {:.2g}°", 100.0 * r.gain,
                  200.0 * r.u_gain, r.lag_rad / rad_per_deg, 2.0 * r.u_lag_rad / rad_per_deg);
  if (r.u_cut_mm > 0.0)
    text += fmt::format(", cuts repeat within ± {:.2g} µm", 2.0 * r.u_cut_mm / mm_per_um);
  for (const LearnedMotion& one : r.motion) {
    const double size_mm = std::hypot(one.cos_mm, one.sin_mm);
    if (size_mm > refuted_by * one.u_mm)
      text += fmt::format(", motion {:.2g} ± {:.1g} µm {} UPR", size_mm / mm_per_um,
                          2.0 * one.u_mm / mm_per_um, one.order);
  }
  return text + " (k = 2)";
}

}  // namespace

MachineFeedback feedback_before(const JobFile& file, const std::vector<ProbeStream>& streams,
                                const std::string& previous) {
  const Job& job = file.job;
  if (!job.target || job.target->kind == TargetKind::face)
    refuse(file.path, "has no [target] that is turned around: --previous is for a cut");
  const Json machine = machine_object(job, streams);
  if (machine.at("machine") == "")
    refuse(file.path,
           "does not name the machine, and lag and gain are those of one: add machine to [header]");
  MachineFeedback out;
  out.machine = machine.dump();
  constexpr double per_rpm = two_pi / 60.0;
  const double cutting = job.tool.speed_rpm * per_rpm, probing = probing_speed(streams);
  out.prior = loop_prior(probing == 0.0 ? cutting : probing, cutting);
  if (!previous.empty()) {
    const Json before = feedback_in(previous);
    std::vector<Diagnostic> wrong = differences(file.path, previous, before.at("machine"), machine);
    out.streams = before.at("streams").get<std::vector<std::string>>();
    for (const ProbeStream& stream : streams)
      if (std::ranges::find(out.streams, stream.input_hash) != out.streams.end())
        wrong.push_back({stream.source, 0, 0,
                         "is of a part that " + previous +
                             " has learned from already: a part does not come before itself; give "
                             "the result of the part before"});
    if (!wrong.empty()) throw InputError(std::move(wrong));
    out.corrected = before.at("corrected_causes").get<std::vector<std::string>>();
    out.before = loop_from(before.at("evidence"));
    if (out.before.forms > 0 && !job.include.empty())
      refuse(file.path,
             "includes a motion in [cut] that " + previous +
                 " has learned from the form of the parts: take `include` out, or run the job "
                 "without --previous");
  }
  out.after = out.before;
  for (const ProbeStream& stream : streams) out.streams.push_back(stream.input_hash);
  return out;
}

namespace {

std::string trouble_words(LoopTrouble trouble, const LoopResponse& used,
                          const LoopObservation& seen, const std::string& previous) {
  const std::string stays = percent_and_degrees(response_in(seen));
  switch (trouble) {
    case LoopTrouble::none:
      break;
    case LoopTrouble::beyond_machines:
      return "shows an error that no machine has: " + stays +
             ". The servo or the probe is inverted, or C has another zero than at the references";
    case LoopTrouble::wrong_sign:
      return "shows the wrong sign: the error grew where the table should have shrunk it. The "
             "table was corrected for " +
             percent_and_degrees(used) + ", and what stays is " + stays +
             ". Look for what inverts C, probe or servo between table and cut, and start anew "
             "without --previous";
    case LoopTrouble::changed:
      return "shows that the machine changed since " + previous + ": what stays is " + stays +
             ", beyond what the parts before allow. Start anew without --previous";
  }
  return "";
}

/// The table of the cut is the one that this job makes.
void expect_table(const JobResult& result, const JobFile& file) {
  const std::string& table = file.verification->table;
  if (!has_table(result))
    refuse(file.path, "does not make a table (" + std::string(to_string(result.verdict.decision)) +
                          "): a verification needs the job of the cut");
  if (read_file(table) != correction_csv(*result.correction))
    refuse(table, "is not the table that this job makes: give the job, and --previous, of the cut");
}

}  // namespace

void learn_from_cut(JobResult& result, const JobFile& file, const std::string& previous) {
  MachineFeedback& feedback = *result.feedback;
  const std::vector<std::string> corrected = corrected_causes(result);
  if (!feedback.before.parts.empty() && corrected != feedback.corrected)
    refuse(file.path,
           fmt::format("the diagnosis corrects the references for [{}], and in {} for [{}]: a lag "
                       "or gain would count twice; state it in [sensor] of all jobs, or run this "
                       "one without --previous",
                       fmt::join(corrected, ", "), previous, fmt::join(feedback.corrected, ", ")));
  feedback.corrected = corrected;
  if (!file.verification) return;
  const std::string& path = file.verification->stream.path;
  expect_table(result, file);
  const ProbeStream again = read_stream(file.verification->stream);
  if (std::ranges::find(feedback.streams, again.input_hash) != feedback.streams.end())
    refuse(path, "has the readings of a reference or of an earlier cut: give those of this cut");
  const double before = probing_speed(result.streams), now = probing_speed({again});
  if (before != 0.0 && now != 0.0 && std::abs(now - before) > same_speed * std::abs(before))
    refuse(path,
           fmt::format("was probed at {:.4g} rpm, and the references at {:.4g} rpm: probe the "
                       "cut at their speed and in their sense",
                       60.0 / two_pi * now, 60.0 / two_pi * before));
  VerifiedCut cut;
  std::optional<ProbeStream> form;
  if (!file.verification->form.path.empty()) form = read_stream(file.verification->form);
  try {
    cut = verified_cut(result, again, form ? &*form : nullptr);
  } catch (const Refusal& refusal) {
    refuse(path, refusal.what());
  }
  const LoopTrouble trouble =
      trouble_with(feedback.before, result.job.loop, cut.seen, feedback.prior);
  // An error that no machine has may look like a cause in the probe, too.
  if (trouble != LoopTrouble::beyond_machines && cut.corrected != corrected)
    refuse(path, fmt::format("the axis of the cut is corrected for [{}], those of the references "
                             "for [{}]: probe both by the same plan, or state what is known in "
                             "[sensor]",
                             fmt::join(cut.corrected, ", "), fmt::join(corrected, ", ")));
  if (trouble != LoopTrouble::none)
    refuse(path, trouble_words(trouble, result.job.loop, cut.seen, previous));
  feedback.after = learned(feedback.before, result.job.loop, cut.seen);
  feedback.seen = cut.seen, feedback.off_mm = cut.off_mm, feedback.U_off_mm = cut.U_off_mm;
  feedback.streams.push_back(again.input_hash);
  if (form) feedback.streams.push_back(form->input_hash);
}

Json feedback_object(const JobResult& result) {
  const MachineFeedback& f = *result.feedback;
  Json json{{"machine", Json::parse(f.machine)},
            {"corrected_causes", f.corrected},
            {"corrected_for", response_object(result.job.loop, f.before)}};
  json["verification"] = nullptr;
  if (f.seen) {
    json["verification"] = loop_object(response_in(*f.seen));
    json["verification"]["off"] =
        to_json(Estimate{f.off_mm, f.U_off_mm / result.verdict.coverage_factor, "mm", ""});
  }
  json["learned"] = response_object(response_of(f.after, f.prior), f.after);
  json["evidence"] = evidence_object(f.after);
  json["streams"] = f.streams;
  json["hash"] = content_hash(json.dump());
  return json;
}

std::string feedback_screen(const JobResult& result) {
  if (!result.feedback) return "";
  const MachineFeedback& f = *result.feedback;
  std::string text;
  if (!f.before.parts.empty())
    text +=
        fmt::format("loop   The table is corrected for what {} showed of the machine: {}\n",
                    counted(f.before.parts.size(), "part"), percent_and_degrees(result.job.loop));
  const std::optional<double> least_mm = coaxiality_of_cut_not_met_mm(result);
  if (f.seen)
    text += fmt::format(
        "cut    {}s probed again, its axis is {} ± {} µm off the target axis\n"
        "loop   Learned from {}, for the next table: {}\n",
        least_mm ? fmt::format("NOT MET, coaxiality at least {} µm: a",
                               significant(*least_mm / mm_per_um, 2))
                 : "A",
        significant(f.off_mm / mm_per_um, 2), significant(f.U_off_mm / mm_per_um, 2),
        counted(f.after.parts.size(), "part"), percent_and_degrees(response_of(f.after, f.prior)));
  return text;
}

}  // namespace trueaxis
