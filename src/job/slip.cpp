// SPDX-License-Identifier: Apache-2.0
#include "job/slip.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace trueaxis {
namespace {

bool is_slip(const Diagnosis& diagnosis, std::string_view id) {
  const Effect* effect = diagnosis.entry(id);
  return effect && is_step(effect->term);
}

/// Whether it is a part that moves over the whole stream: where it ends, no reading tells.
bool goes_on(const Diagnosis& diagnosis, std::string_view id) {
  return is_slip(diagnosis, id) &&
         std::ranges::any_of(diagnosis.entry(id)->typical, [](const ShapeValues& v) {
           return v.parameter == &TermShape::duration_s;
         });
}

Estimate parameter_of(const Finding& finding, std::string_view name) {
  for (const FitParameter& p : finding.parameters) {
    if (p.name == name) return p.estimate;
  }
  return {};
}

/// Length of the vector of two parameters, its u along its own direction; none without both.
Estimate length_of(const Estimate& x, const Estimate& y) {
  if (!x.determined() || !y.determined()) return {};
  const double length = std::hypot(x.value, y.value);
  return {length, length > 0.0 ? std::hypot(x.value * x.u, y.value * y.u) / length : x.u, x.unit,
          ""};
}

/// Step across and along the axis, tilt and turn, as far as the readings show each.
Reasons how_far(const Finding& finding, double k) {
  Reasons parts;
  const auto add = [&](ReasonCode code, const Estimate& e, const char* unit) {
    if (e.determined()) parts.push_back({code, {}, {{"by", e.value, unit, k * e.u}}});
  };
  const auto of = [&](std::string_view name) { return parameter_of(finding, name); };
  add(ReasonCode::moved_across, length_of(of("dx"), of("dy")), "mm");
  add(ReasonCode::moved_along_z, of("dz"), "mm");
  add(ReasonCode::moved_tilt, length_of(of("tilt_x"), of("tilt_y")), "rad");
  add(ReasonCode::moved_turn, of("turn"), "rad");
  add(ReasonCode::moved_radius, of("dr"), "mm");
  add(ReasonCode::moved_taper, of("taper"), "rad");
  return parts;
}

Reason slipped(std::size_t i, const Finding& finding, double k, ReasonCode code) {
  Reason reason{code, {i}, {}, {}, how_far(finding, k)};
  const Estimate onset = parameter_of(finding, "onset");
  if (!onset.determined()) return reason;
  const auto add = [&](const char* by_time, const char* by_reading, double value) {
    reason.numbers.push_back(onset.unit == "s" ? ReasonNumber{by_time, value, "s"}
                                               : ReasonNumber{by_reading, value + 1.0});
  };
  const double duration_s = finding.term.shape.duration_s;
  if (duration_s > 0.0) {
    add("begin_time", "begin_reading", onset.value);
    add("end_time", "end_reading", onset.value + duration_s);
  } else {
    add("onset_time", "onset_reading", onset.value);
  }
  return reason;
}

constexpr Threshold may_have_moved{"probability", nonconformity_risk, "1",
                                   "the risk that a verdict takes; U holds what is less probable"};
constexpr Threshold of_slip[] = {may_have_moved};
constexpr double negligible = 0.01;  // probability of a rival cause: a fifth of that risk

/// At an instant, with sizes that what was read after it shows, nothing unexplained, and no other
/// cause that may be a slip.
bool is_one_step(const Diagnosis& diagnosis, const Finding& slip) {
  if (slip.term.shape.duration_s > 0.0 || !diagnosis.unexplained.empty()) return false;
  if (std::ranges::any_of(slip.parameters,
                          [](const FitParameter& p) { return !p.estimate.determined(); }))
    return false;
  return std::ranges::none_of(diagnosis.findings, [&](const Finding& finding) {
    return &finding != &slip && std::ranges::any_of(finding.members(), [&](const std::string& id) {
      return is_slip(diagnosis, id);
    });
  });
}

/// Whether the axis is the same within U for the named and the rival causes: the average is
/// over all of them.
bool axis_is_of_all(const Diagnosis& diagnosis, const Finding& finding) {
  const FitResult& fit = diagnosis.extended;
  if (!fit.axis_known()) return false;
  const double U_mm = fit.coverage_factor * std::max(fit.axis.u_at(fit.position_min_mm),
                                                     fit.axis.u_at(fit.position_max_mm));
  return std::ranges::all_of(finding.rivals, [&](const Rival& rival) {
    const auto is_near = [&](const AxisShare& share) {
      return share.instead_of == finding.effect() && share.effect == rival.effect &&
             share.axis_shift.value <= U_mm;
    };
    return rival.probability < negligible ||
           (!goes_on(diagnosis, rival.effect) && std::ranges::any_of(diagnosis.shares, is_near));
  });
}

/// That it is a part that moved, if another cause is named.
double moved_instead(const Diagnosis& diagnosis, const Finding& finding) {
  double probability = 0.0;
  for (const Rival& rival : finding.rivals)
    if (is_slip(diagnosis, rival.effect)) probability += rival.probability;
  return probability;
}

/// As rival causes of another name.
std::optional<Reason> possible(const Diagnosis& diagnosis, std::size_t i, const Finding& finding) {
  const double probability = moved_instead(diagnosis, finding);
  if (probability < may_have_moved.value) return {};
  return Reason{ReasonCode::part_may_have_slipped,
                {i},
                {{"probability", probability}},
                {{"effect", finding.effect()}}};
}

Reasons find_unsure_slip(const CheckInput& in) {
  const IdentifiedJob& job = in.job;
  std::optional<Reason> perhaps;
  for (std::size_t i = 0; i < job.diagnoses.size(); ++i) {
    if (!job.diagnoses[i] || is_sure_slip(*job.diagnoses[i]) || job.diagnoses[i]->late_s) continue;
    const Diagnosis& diagnosis = *job.diagnoses[i];
    const Finding* slip = diagnosis.slip();
    if (slip && !leaves_axis_known(diagnosis)) {
      perhaps = slipped(i, *slip, diagnosis.baseline.coverage_factor, ReasonCode::part_slipped);
      break;
    }
    for (const Finding& finding : diagnosis.findings)
      if (!perhaps && !axis_is_of_all(diagnosis, finding))
        perhaps = possible(diagnosis, i, finding);
  }
  if (perhaps) perhaps->remedies = {{ReasonCode::clamp_again}};
  return perhaps ? Reasons{std::move(*perhaps)} : Reasons{};
}

}  // namespace

constinit const JobCheck part_slipped{"part_slipped", CheckedAt::references, Weight::forbids,
                                      of_slip, find_unsure_slip};

bool is_likely_slip(const Diagnosis& diagnosis) {
  return std::ranges::any_of(diagnosis.findings, [&](const Finding& finding) {
    return is_slip(diagnosis, finding.effect()) || moved_instead(diagnosis, finding) > 0.5;
  });
}

bool is_sure_slip(const Diagnosis& diagnosis) {
  const Finding* slip = diagnosis.slip();
  return slip && slip->rivals.empty() && is_one_step(diagnosis, *slip);
}

bool leaves_axis_known(const Diagnosis& diagnosis) {
  const Finding* slip = diagnosis.slip();
  return slip && is_one_step(diagnosis, *slip) && axis_is_of_all(diagnosis, *slip);
}

std::optional<std::size_t> slipped_since(const IdentifiedJob& job, std::size_t reference) {
  const ProbeStream& own = job.streams[reference];
  for (std::size_t k = 0; k < job.diagnoses.size(); ++k) {
    const Finding* slip = job.diagnoses[k] ? job.diagnoses[k]->slip() : nullptr;
    if (k == reference || slip == nullptr) continue;
    const ProbeStream& of_slip = job.streams[k];
    const bool one_clock =
        own.source == of_slip.source && !own.time_s.empty() && !of_slip.time_s.empty();
    const double ended_s = slip->term.shape.onset_s + slip->term.shape.duration_s;
    if (!one_clock || own.time_s.front() < ended_s) return k;
  }
  return {};
}

Reasons moved_part(const IdentifiedJob& job) {
  Reasons moved;
  for (std::size_t i = 0; i < job.diagnoses.size(); ++i)
    if (job.diagnoses[i] && is_sure_slip(*job.diagnoses[i]))
      moved.push_back(slipped(i, *job.diagnoses[i]->slip(), job.fits[i].coverage_factor,
                              ReasonCode::part_moved));
  return moved;
}

}  // namespace trueaxis
