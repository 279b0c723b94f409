// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "report/page_data.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

std::string number(double value, const char* unit) {
  return fmt::format("{:.7g}{}{}", value, *unit == '\0' ? "" : " ", unit);
}

/// Labels and texts of one block of options, in the order in which they are shown.
class Options {
 public:
  explicit Options(const std::string& title) : block_{{"title", title}, {"lines", Json::array()}} {}
  void add(const char* label, const std::string& text) { block_["lines"].push_back({label, text}); }
  void add(const char* label, double value, const char* unit) { add(label, number(value, unit)); }
  const Json& block() const { return block_; }

 private:
  Json block_;
};

const char* loss_text(Loss loss) {
  static constexpr const char* texts[] = {"least squares", "Huber, k = 1.345 σ",
                                          "Tukey, c = 4.685 σ"};
  return texts[static_cast<std::size_t>(loss)];
}

std::string influence_text(const Influence& influence) {
  const InfluenceInfo& info = info_of(influence.kind);
  const bool angle = info.unit == "rad", time = info.unit == "s";
  const std::string unit(angle ? "°" : time ? "ms" : info.unit == "1" ? "(relative)" : info.unit);
  const double scale = angle ? 1.0 / rad_per_deg : time ? 1e3 : 1.0;
  return std::string(info.name) +
         (influence.value != 0.0 ? " " + number(influence.value * scale, unit.c_str()) : "") +
         ", u = " + number(influence.u * scale, unit.c_str());
}

std::string convention_text(const XConvention& convention) {
  const std::string taken = convention.diameter ? "a diameter" : "a radius";
  if (convention.said_by == SaidBy::nobody) return "taken as " + taken + ", which nothing says";
  return taken + ", as the " + to_string(convention.said_by) + " says";
}

void add_fit(Options& options, const FitOptions& fit) {
  options.add("surface", to_string(fit.surface) + std::string(fit.bore ? ", a bore" : ""));
  options.add("loss", loss_text(fit.loss));
  if (fit.ball_radius_mm > 0.0) options.add("ball radius", fit.ball_radius_mm, "mm");
  if (fit.noise_mm) options.add("noise of one reading", *fit.noise_mm / mm_per_um, "µm");
  for (const Influence& influence : fit.influences) {
    options.add("influence", influence_text(influence));
  }
  options.add("coverage factor k", fit.coverage_factor, "");
}

Json reference_block(const JobResult& result, std::size_t i) {
  const JobReference& reference = result.job.references[i];
  Options options("Reference: " + reference.name);
  if (i < result.streams.size()) {
    const ProbeStream& stream = result.streams[i];
    options.add("stream", stream.source);
    options.add("input hash", stream.input_hash);
    options.add("readings", std::to_string(stream.size()));
    options.add("indication", stream.indication == Indication::relative
                                  ? "relative: a gauge, the radius is not measured"
                                  : "absolute");
    if (stream.x_convention)
      options.add(stream.kind == StreamKind::face ? "X" : "X_M",
                  convention_text(*stream.x_convention));
    if (stream.nominal_radius_mm) options.add("nominal radius", *stream.nominal_radius_mm, "mm");
  }
  add_fit(options, reference.fit);
  options.add("weight", reference.weight, "");
  return options.block();
}

Json cut_block(const TargetSurface& target, const ToolSetup& tool) {
  Options options("Cut");
  const bool face = target.kind == TargetKind::face;
  const char* kind = face ? "face" : target.kind == TargetKind::cone ? "cone" : "cylinder";
  options.add("target surface", std::string(kind) + (target.bore ? ", a bore" : ""));
  if (face) {
    options.add("X from", target.radius_start_mm, "mm");
    options.add("X to", target.radius_end_mm, "mm");
    options.add("Z of the face", target.z_face_mm, "mm");
  } else {
    options.add("Z from", target.z_start_mm, "mm");
    options.add("Z to", target.z_end_mm, "mm");
    options.add("radius at the start", target.radius_mm, "mm");
  }
  options.add("run-in", target.run_in_mm, "mm");
  options.add("overrun", target.overrun_mm, "mm");
  if (target.shoulder_mm)
    options.add(face ? "shoulder at X" : "shoulder at Z", *target.shoulder_mm, "mm");
  if (target.kind == TargetKind::cone)
    options.add("taper, radius per length", target.tan_half_angle, "");
  options.add("speed", tool.speed_rpm, "rpm");
  options.add("sense of C", tool.sense >= 0 ? "+C" : "−C");
  options.add("feed", tool.feed_mm_per_rev, "mm/rev");
  options.add("tool nose radius", tool.nose_radius_mm, "mm");
  options.add("tool height", tool.height_mm, "mm");
  options.add("angle from probe to tool", tool.angle_from_probe_rad / rad_per_deg, "°");
  options.add("rows per revolution", tool.rows_per_revolution, "");
  constexpr const char* between[] = {"not stated", "straight lines", "rows are held"};
  options.add("between two rows", between[static_cast<std::size_t>(tool.interpolation)]);
  return options.block();
}

Json actuator_block(const Actuator& actuator) {
  Options options("Actuator");
  options.add("stroke", actuator.stroke_mm / mm_per_um, "µm");
  options.add("stroke kept in reserve", 100.0 * actuator.stroke_reserve, "%");
  if (actuator.measured.empty()) {
    options.add("natural frequency", actuator.natural_frequency_hz, "Hz");
    options.add("damping ratio", actuator.damping, "");
  } else {
    options.add("measured response", std::to_string(actuator.measured.size()) + " points");
  }
  options.add("delay", 1000.0 * actuator.delay_s, "ms");
  options.add("slew rate", actuator.slew_mm_per_s, "mm/s");
  options.add("set-points", actuator.sampling_hz, "Hz");
  options.add("following error accepted", actuator.following_limit_mm / mm_per_um, "µm");
  options.add("precompensation", actuator.precompensate ? "per harmonic" : "off");
  return options.block();
}

}  // namespace

Json inputs_data(const JobResult& result) {
  Json blocks = Json::array();
  for (std::size_t i = 0; i < result.job.references.size(); ++i) {
    blocks.push_back(reference_block(result, i));
  }
  if (result.job.target) {
    blocks.push_back(cut_block(*result.job.target, result.job.tool));
    blocks.push_back(actuator_block(result.job.actuator));
  }
  return blocks;
}

}  // namespace trueaxis
