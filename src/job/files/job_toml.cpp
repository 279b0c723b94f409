// SPDX-License-Identifier: Apache-2.0
#include "job/files/job_toml.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/angle.hpp"
#include "base/number.hpp"
#include "format/file.hpp"
#include "format/toml_header.hpp"
#include "format/toml_reader.hpp"
#include "format/units.hpp"
#include "job/files/influences_toml.hpp"
#include "job/files/job_toml_parts.hpp"
#include "surface/surface.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

const Range most_coverage{0.0, 100.0, true, false};

struct Sensor {
  double ball_radius_mm = 0.0;
  std::optional<double> noise_mm;
  std::vector<Influence> influences;
};

Sensor read_sensor(TomlTable table) {
  Sensor sensor;
  const Range stated = Range::between(0.0, most_stated);
  sensor.ball_radius_mm = table.number("ball_radius_mm", 0.0, stated);
  sensor.noise_mm = table.maybe_number("noise_mm", stated);
  sensor.influences = read_influences(table);
  return sensor;
}

/// What the file of the readings does not say of them.
void read_stream_keys(TomlTable& table, StreamFile& file) {
  file.said.read.diameter_said_by = SaidBy::job;
  if (table.has("x_convention")) {
    file.said.read.diameter =
        table.choice<bool>("x_convention", {{"radius", false}, {"diameter", true}}, false);
  }
  if (table.has("reading")) {
    file.said.read.indication = table.choice<Indication>(
        "reading", {{"absolute", Indication::absolute}, {"relative", Indication::relative}},
        Indication::absolute);
  }
  file.said.read.nominal_radius_mm = table.maybe_number("nominal_radius_mm", Range::positive());
  file.said.columns = table.text("columns", "");
  file.said.skip = static_cast<std::size_t>(table.integer("skip_lines", 0, 0, 1000000));
  file.said.read.drop_invalid = table.flag("drop_invalid", false);
  file.z.from_mm = table.maybe_number("z_from_mm").value_or(file.z.from_mm);
  file.z.to_mm = table.maybe_number("z_to_mm").value_or(file.z.to_mm);
  if (!(file.z.from_mm < file.z.to_mm))
    table.complain("z_to_mm", "is not above z_from_mm: give the lower end of Z first");
}

/// What became of the cut stays with a machine, which has a name.
void read_verification(TomlTable root, TomlTable table, JobFile& file) {
  VerificationFile& verification = file.verification.emplace();
  verification.stream.path = table.required_path("stream");
  verification.table = table.required_path("table");
  read_stream_keys(table, verification.stream);
  const Job& job = file.job;
  verification.form.path = table.maybe_path("form").value_or("");
  if (!verification.form.path.empty() && job.tool.angle_from_probe_rad != 0.0)
    table.complain("form", "is for a tool at the place of the probe: its C is that of the table");
  if (!job.target || job.target->kind == TargetKind::face)
    root.complain("verification", "needs a [target] that is turned around: a cylinder or a cone");
}

JobReference read_reference(TomlTable table, const Sensor& sensor, double coverage_factor,
                            StreamFile& file) {
  JobReference reference;
  file.path = table.required_path("stream");
  const std::string surface = table.required_text("surface");
  reference.name = table.text("name", surface);
  try {
    if (!surface.empty()) reference.fit.surface = surface_from_id(surface);
  } catch (const InputError& error) {
    table.complain("surface", "is an " + error.diagnostics().front().message);
  }
  reference.fit.loss = table.choice<Loss>(
      "loss", {{"plain", Loss::plain}, {"huber", Loss::huber}, {"tukey", Loss::tukey}},
      Loss::plain);
  reference.fit.bore = table.choice<bool>("feature", {{"shaft", false}, {"bore", true}}, false);
  read_stream_keys(table, file);
  reference.weight = table.number("weight", 1.0, Range::positive());
  reference.face_radius_mm = table.number("face_radius_mm", 0.0, Range::non_negative());
  reference.form = read_form_task(table, reference.fit.surface);
  reference.association = read_association(table, reference.fit.surface, reference.fit.bore);
  reference.fit.ball_radius_mm = sensor.ball_radius_mm;
  reference.fit.noise_mm = sensor.noise_mm;
  reference.fit.influences = sensor.influences;
  reference.fit.coverage_factor = coverage_factor;
  return reference;
}

constexpr double largest_tolerance_mm = 5.0;  // beyond it µm were meant

TargetSurface read_target(TomlTable table, Job& job) {
  TargetSurface target;
  target.kind = table.required_choice<TargetKind>(
      "surface",
      {{"cylinder", TargetKind::cylinder}, {"cone", TargetKind::cone}, {"face", TargetKind::face}});
  target.bore = table.choice<bool>("feature", {{"shaft", false}, {"bore", true}}, false);
  if (target.kind == TargetKind::face) {
    if (target.bore)
      table.complain("feature", "has no effect: a face is neither shaft nor bore; remove it");
    target.z_face_mm = table.required_number("z_mm");
    target.radius_start_mm = table.required_number("radius_start_mm", Range::non_negative());
    target.radius_end_mm = table.required_number("radius_end_mm", Range::non_negative());
    target.z_start_mm = target.z_end_mm = target.z_face_mm;
    if (target.radius_start_mm == target.radius_end_mm)
      table.complain("radius_end_mm", "equals the start: give the cut a length");
  } else {
    target.z_start_mm = table.required_number("z_start_mm");
    target.z_end_mm = table.required_number("z_end_mm");
    target.radius_mm = table.required_number("radius_mm", Range::positive());
    if (target.z_start_mm == target.z_end_mm)
      table.complain("z_end_mm", "equals the start: give the cut a length");
  }
  if (target.kind == TargetKind::cone) {
    const double half_angle =
        table.required_number("half_angle_rad", Range::inside(0.0, 80.0 * rad_per_deg));
    const double sign = table.required_choice<double>("opens", {{"+z", 1.0}, {"-z", -1.0}});
    target.tan_half_angle = sign * std::tan(half_angle);
  }
  job.coaxiality_tolerance_mm = table.maybe_number(
      target.kind == TargetKind::face ? "runout_tolerance_mm" : "coaxiality_tolerance_mm",
      {.low = 0.0, .high = largest_tolerance_mm, .low_open = true});
  job.stock_mm = table.maybe_number("stock_mm", Range::positive());
  const bool face = target.kind == TargetKind::face;
  target.run_in_mm = table.number("run_in_mm", 0.0, Range::non_negative());
  target.overrun_mm = table.number("overrun_mm", 0.0, Range::non_negative());
  target.shoulder_mm = table.maybe_number(face ? "shoulder_radius_mm" : "shoulder_z_mm");
  for (const auto& [key, end_mm] : {std::pair("run_in_mm", target.path_start_mm()),
                                    std::pair("overrun_mm", target.path_end_mm())})
    if (face && end_mm < 0.0)
      table.complain(
          key, fmt::format("moves the tool {:.6g} mm past the spindle axis: lower it", -end_mm));
  return target;
}

constexpr double largest_nose_mm = 50.0;  // beyond it µm were meant
constexpr double most_turns = 1e6;        // of C: a double then tells 1e-9 rad

ToolSetup read_tool(TomlTable table) {
  ToolSetup tool;
  tool.nose_radius_mm =
      table.number("nose_radius_mm", tool.nose_radius_mm, Range::between(0.0, largest_nose_mm));
  tool.height_mm = table.number("tool_height_mm", tool.height_mm);
  tool.angle_from_probe_rad = table.number("angle_from_probe_rad", tool.angle_from_probe_rad,
                                           Range::between(-two_pi, two_pi));
  const double angle_deg = tool.angle_from_probe_rad / rad_per_deg;
  if (std::ranges::count(table.keys(), "angle_from_probe_deg") && is_quarters_in_radians(angle_deg))
    table.complain(
        "angle_from_probe_rad",
        "looks like quarters of a turn in radians: write angle_from_probe_rad. If degrees are "
        "meant, write them in radians");
  tool.speed_rpm = table.required_number("speed_rpm", Range::positive());
  tool.sense = table.required_choice<int>("sense", {{"+c", 1}, {"-c", -1}});
  tool.feed_mm_per_rev = table.required_number("feed_mm_per_rev", Range::positive());
  tool.c_start_rad = table.number("c_start_rad", tool.c_start_rad,
                                  Range::between(-most_turns * two_pi, most_turns * two_pi));
  tool.rows_per_revolution =
      static_cast<int>(table.integer("rows_per_revolution", tool.rows_per_revolution, 8, 100000));
  tool.interpolation = table.choice<Interpolation>(
      "interpolation", {{"linear", Interpolation::linear}, {"none", Interpolation::none}},
      tool.interpolation);
  return tool;
}

constexpr double most_rows = 5e7;  // 2 GB of text; a bar of a metre at 0.02 mm/rev has 1.8e7

/// The nose of a boring tool stays on its own side of the axis, at the bore's narrow end too: its
/// centre lies r/√(1+s²) off the wall X, s the wall's slope at the tool's height. (A target that
/// the tool's line does not meet is refused by the correction.)
void check_nose(TomlTable cut, const TargetSurface& target, const ToolSetup& tool) {
  if (!target.bore) return;
  for (const double z_mm : {target.path_start_mm(), target.path_end_mm()}) {
    const double radius_mm = target.radius_mm + target.tan_half_angle * (z_mm - target.z_start_mm);
    if (!(radius_mm > std::abs(tool.height_mm))) return;
    const double wall_mm = std::sqrt(radius_mm * radius_mm - tool.height_mm * tool.height_mm);
    const double slope = target.tan_half_angle * radius_mm / wall_mm;
    if (tool.nose_radius_mm < wall_mm * std::hypot(1.0, slope)) continue;
    cut.complain("nose_radius_mm",
                 fmt::format("does not fit into the bore, of radius {:.6g} mm at Z = {:.6g} mm: "
                             "give the radius of the tool's nose",
                             radius_mm, z_mm));
    return;
  }
}

/// The rows that the table of this cut would have must fit a file that a control can be given.
void check_rows(TomlTable cut, const TargetSurface& target, const ToolSetup& tool) {
  const double travel = target.path_end_mm() - target.path_start_mm();
  if (tool.feed_mm_per_rev > std::abs(travel)) {
    cut.complain("feed_mm_per_rev", fmt::format("is more than the length of the cut, {:.6g} mm: "
                                                "the cut would take less than one revolution",
                                                std::abs(travel)));
    return;
  }
  const double rows = std::abs(travel) / tool.feed_mm_per_rev * tool.rows_per_revolution;
  if (rows <= most_rows || std::isnan(rows)) return;
  cut.complain("feed_mm_per_rev",
               fmt::format("makes a table of {} rows, more than {}: raise the feed, shorten "
                           "the cut or lower rows_per_revolution",
                           significant(rows, 2), significant(most_rows, 2)));
}

Actuator read_actuator(TomlTable table) {
  Actuator a;
  constexpr double longest_mm = 50.0;  // fast tool servos have some mm, the longest known 30 mm
  a.stroke_mm = table.number("stroke_mm", a.stroke_mm, {0.0, longest_mm, true, false});
  a.natural_frequency_hz =
      table.number("natural_frequency_hz", a.natural_frequency_hz, Range::positive());
  a.damping = table.number("damping", a.damping, Range::positive());
  a.delay_s = table.number("delay_s", a.delay_s, Range::between(0.0, 1.0));
  a.slew_mm_per_s = table.number("slew_mm_per_s", a.slew_mm_per_s, Range::positive());
  a.sampling_hz = table.number("sampling_hz", a.sampling_hz, Range::positive());
  a.stroke_reserve = table.number("stroke_reserve", a.stroke_reserve, Range::between(0.0, 0.99));
  a.following_limit_mm =
      table.number("following_limit_mm", a.following_limit_mm, Range::positive());
  a.precompensate = table.flag("precompensate", a.precompensate);
  for (TomlTable point : table.tables("response")) {
    ResponsePoint response;
    response.frequency_hz = point.required_number("frequency_hz", Range::non_negative());
    response.gain = point.required_number("gain", Range::positive());
    response.phase_rad = point.required_number("phase_rad");
    if (!a.measured.empty() && response.frequency_hz <= a.measured.back().frequency_hz) {
      point.complain("frequency_hz", "frequencies must rise from point to point");
    }
    a.measured.push_back(response);
  }
  if (!a.measured.empty()) {
    for (const char* key : {"natural_frequency_hz", "damping", "delay_s"}) {
      if (table.has(key))
        table.complain(key, "would count twice with a measured response: remove it");
    }
  }
  if (!a.measured.empty() && a.measured.back().frequency_hz == 0.0)
    table.complain("response", "has one point at 0 Hz: add measured frequencies above it");
  if (a.leads())
    table.complain("response",
                   "has a phase that leads the set-point, which no servo does: a lag is "
                   "negative");
  return a;
}

/// Of motions only what repeats at the tool may be asked for.
void read_correction(TomlTable table, Job& job) {
  job.axis_of_cut = table.choice<AxisOfCut>(
      "axis",
      {{"stated", AxisOfCut::stated}, {"named", AxisOfCut::named}, {"ideal", AxisOfCut::ideal}},
      AxisOfCut::stated);
  job.include = table.texts("include");
  for (const std::string& id : job.include) {
    const auto known = repeating_effects();
    if (std::find(known.begin(), known.end(), id) != known.end()) continue;
    table.complain("include", fmt::format("contains '{}', which a correction must not follow; "
                                          "those that repeat at the tool are {}",
                                          id, fmt::join(known, ", ")));
  }
}

/// Every `[[output]]`, compared with its cut and the other names.
void read_outputs(TomlTable root, JobFile& file) {
  Job& job = file.job;
  for (TomlTable table : root.tables("output")) {
    ControlTable output = read_output(table, file.templates);
    if (!std::isnan(output.position_step_mm)) {  // else there is a message already
      const std::string why = objection_to(output, *job.target, job.tool);
      if (!why.empty()) table.complain("format", why);
    }
    const bool taken = std::ranges::any_of(
        job.outputs, [&](const ControlTable& other) { return other.file == output.file; });
    if (taken || output.file == "table.csv" || output.file == "result.json" ||
        output.file == "report.html")
      table.complain("file", "is the name of another result: use another name");
    job.outputs.push_back(std::move(output));
  }
}

void read_cut(TomlTable root, JobFile& file, bool required) {
  Job& job = file.job;
  auto target =
      required ? std::optional(root.required_table("target")) : root.maybe_table("target");
  if (target) {
    job.target = read_target(*target, job);
    if (!required) job.datums = read_datums(*target, job);
    const TomlTable cut = root.required_table("cut");
    job.tool = read_tool(cut);
    check_rows(cut, *job.target, job.tool);
    check_nose(cut, *job.target, job.tool);
    if (auto actuator = root.maybe_table("actuator")) job.actuator = read_actuator(*actuator);
    if (auto correction = root.maybe_table("correction")) read_correction(*correction, job);
    read_outputs(root, file);
  } else {
    for (TomlTable table : root.tables("output")) {
      table.complain("format", "has no effect without a [target]: add it, or remove this table");
      table.ignore_rest();
    }
    for (const char* key : {"cut", "actuator", "correction"}) {
      if (auto table = root.maybe_table(key)) {
        root.complain(key, "has no effect without a [target]: add it, or remove this table");
        table->ignore_rest();
      }
    }
  }
}

}  // namespace

JobFile read_job_toml(const std::string& path) { return read_job_toml(read_file(path), path); }

JobFile read_job_toml(std::string_view content, const std::string& path) {
  TomlDocument document(content, path);
  TomlTable root = document.root();
  JobFile file{path};
  Job& job = file.job;
  job.name = root.text("name", path);
  job.header = read_header(root);
  const double coverage = root.number("coverage_factor", 2.0, most_coverage);
  Sensor sensor;
  if (auto table = root.maybe_table("sensor")) sensor = read_sensor(*table);
  for (const TomlTable& table : root.tables("reference"))
    job.references.push_back(read_reference(table, sensor, coverage, file.streams.emplace_back()));
  if (!root.has("reference"))
    root.complain("reference",
                  "is missing: add a [[reference]] with stream and surface, or, for a machine of "
                  "several axes, a [machine]");
  check_runout_datums(root, job);
  read_cut(root, file, false);
  if (auto table = root.maybe_table("verification")) read_verification(root, *table, file);
  for (const JobReference& reference : job.references) {
    if (!is_diagnosed(reference.fit.surface))
      root.complain("reference", "reference '" + reference.name + "' is a " +
                                     to_string(reference.fit.surface) +
                                     ", which `trueaxis fit` can fit but a job cannot use: a job's "
                                     "references are cones, cylinders, faces and sections");
    if (job.target && reference.fit.surface == SurfaceKind::section) {
      root.complain("target", "reference '" + reference.name +
                                  "' is one section, which does not show the direction of an axis: "
                                  "probe it along Z as a cylinder or cone");
    }
  }
  document.finish();
  return file;
}

Job read_target_toml(const std::string& path) {
  TomlDocument document(path);
  JobFile file{path};
  TomlTable root = document.root();
  // A whole job will do: what it says beyond the cut is not asked for here.
  for (const char* key :
       {"name", "coverage_factor", "sensor", "reference", "header", "verification"})
    root.has(key);
  read_cut(root, file, true);
  document.finish();
  return file.job;
}

}  // namespace trueaxis
