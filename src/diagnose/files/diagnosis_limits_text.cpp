// SPDX-License-Identifier: Apache-2.0
#include <fmt/ranges.h>

#include <algorithm>

#include "base/never.hpp"
#include "diagnose/files/diagnosis_text.hpp"
#include "format/text_layout.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

using namespace layout;

/// "2.6 µm", "0.12 deg"; "-" where no size of it would be found.
std::string detectable_text(const NotObservable& n) {
  if (is_never(n.detectable, n.detectable_unit)) return "no size";
  const bool small = n.detectable_unit == "mm" && n.detectable < 1.0;
  const std::string unit = small                        ? "µm"
                           : n.detectable_unit == "1"   ? ""
                           : n.detectable_unit == "rad" ? "deg"
                                                        : n.detectable_unit;
  return fmt::format("{:.3g}", small ? n.detectable / mm_per_um
                                     : n.detectable * edge_factor(n.detectable_unit)) +
         (unit.empty() ? "" : " " + unit);
}

std::string shown_by(const NotObservable& n) {
  if (!n.separate_with) return "-";
  return n.separate_with->plan.empty() ? "none" : n.separate_with->plan;
}

std::string source_line(const char* name, const std::optional<double>& sigma_mm) {
  return sigma_mm ? std::string(", ") + name + " " + um(*sigma_mm) : "";
}

/// A cone whose axis the readings determine and whose taper they do not.
bool may_be_cylinder(const FitResult& fit) {
  if (fit.surface != SurfaceKind::cone || fit.status != FitStatus::rank_deficient) return false;
  for (const char* of_axis : {"x0", "y0", "l", "m"})
    if (!fit.parameter(of_axis).determined()) return false;
  return !fit.parameter("half_angle").determined();
}

std::string rejected_lines(const char* head, const std::vector<Rejected>& rejected) {
  constexpr std::size_t listed = 3;
  std::string rows;
  for (std::size_t i = 0; i < std::min(listed, rejected.size()); ++i) {
    rows += (i ? "; row " : "row ") + std::to_string(rejected[i].row) + " " + rejected[i].why;
  }
  if (rejected.size() > listed)
    rows += "; " + std::to_string(rejected.size() - listed) + " more, all in the JSON";
  return rejected.empty() ? "" : wrapped(head, std::to_string(rejected.size()) + " (" + rows + ")");
}

}  // namespace

std::string not_observable_text(const Diagnosis& d) {
  if (d.not_observable.empty()) return "";
  constexpr double harmless_mm = 1e-5;
  std::vector<NotObservable> listed;
  std::string harmless;
  for (const NotObservable& n : d.not_observable) {
    const bool biases =
        !n.axis_bias_typical.determined() || n.axis_bias_typical.value >= harmless_mm;
    if (biases)
      listed.push_back(n);
    else
      harmless += (harmless.empty() ? "" : ", ") + n.effect;
  }
  std::size_t id = 6, axis_bias = 11, found = 10;
  for (const NotObservable& n : listed) {
    id = std::max(id, width(n.effect));
    axis_bias = std::max(axis_bias, width(axis_bias_per_unit_text(n.axis_bias_per_unit)));
    found = std::max(found, width(detectable_text(n)));
  }
  axis_bias = std::min<std::size_t>(axis_bias, 22);
  const auto row = [&](const std::string& a, const std::string& b, const std::string& c,
                       const std::string& e, const std::string& why) {
    return wrapped(
        "  " + padded(a, id + 2) + padded(b, axis_bias + 2) + padded(c, found + 2) + padded(e, 9),
        why);
  };
  std::string text = "\nCannot be seen with these readings at its typical size\n";
  text += row("effect", "axis shift", "seen from", "shown by", "why");
  for (const NotObservable& n : listed) {
    text += row(n.effect, axis_bias_per_unit_text(n.axis_bias_per_unit), detectable_text(n),
                shown_by(n), n.why);
  }
  if (!harmless.empty())
    text += wrapped("  ", "Unseen too, but shifting the axis by less than 0.01 µm: " + harmless);
  return text;
}

std::string noise_text(const NoiseReport& noise) {
  std::string text = "\nNoise\n";
  text +=
      wrapped("  σ           ",
              plus_minus({noise.sigma_mm, noise.u_sigma_mm, "mm", ""}, 2.0, 1.0 / mm_per_um, "µm") +
                  " (U, k = 2), from " + to_string(noise.source) +
                  source_line("stationary", noise.stationary_mm) +
                  source_line("repeated passes", noise.repeated_mm) +
                  source_line("revolution differences", noise.revolutions_mm) +
                  source_line("stated", noise.stated_mm));
  if (!noise.note.empty()) text += wrapped("  note        ", noise.note);
  if (!noise.autoregression.empty()) {
    text += wrapped(
        "  correlated  ",
        fmt::format("autoregression {:.2f}: TrueAxis widens every test and uncertainty by it",
                    fmt::join(noise.autoregression, " ")));
  }
  text += rejected_lines("  masked      ", noise.masked);
  for (const std::string& gap : noise.gaps) text += wrapped("  gap         ", gap);
  return text + rejected_lines("  interrupted ", noise.interruptions);
}

std::string remarks_text(const std::vector<std::string>& remarks) {
  std::string text;
  for (const std::string& remark : remarks) text += wrapped("  ", remark);
  return text.empty() ? "" : "\nNot an effect\n" + text;
}

std::string checks_text(const std::vector<QualityCheck>& checks) {
  std::string text;
  for (const QualityCheck& check : checks) {
    if (check.found) text += wrapped("  " + check.effect + ": ", check.text);
  }
  return text.empty() ? "" : "\nChecks of the data\n" + text;
}

std::string next_text(const NextMeasurement& next) {
  if (next.plan.empty() && next.why_not.empty()) return "";
  std::string text = "\nNext measurement\n";
  if (next.plan.empty()) return text + wrapped("  ", "none: " + next.why_not);
  const std::string separates = fmt::format("{}", fmt::join(next.separates, ", "));
  text += wrapped("  " + next.plan + "  ",
                  next.what + fmt::format("; {:.3g} min; right name ", next.minutes) +
                      probability(next.power_before) + " → " + probability(next.power_after) +
                      (separates.empty() ? "" : "; separates " + separates));
  return text;
}

std::string advice_text(const Diagnosis& d) {
  std::string text = wrapped("", diagnosis_line(d));
  // What a measurement would tell of a cone says nothing of what is a cylinder.
  if (may_be_cylinder(d.baseline))
    return text + "\nNext\n" +
           wrapped("  ",
                   "fit a cylinder: --surface cylinder, in a job surface = \"cylinder\"; this "
                   "needs no other measurement");
  const std::string next = next_text(d.next);
  text += next.empty() ? "\nNext measurement\n  none: all causes are told apart\n" : next;
  const bool either = std::ranges::any_of(d.findings, [&](const Finding& finding) {
    bool form = false, motion = false;
    for (const std::string& id : finding.members()) {
      const Effect* effect = d.entry(id);
      form = form || (effect && effect->separated_as == SeparatedAs::form);
      motion = motion || (effect && effect->separated_as == SeparatedAs::motion);
    }
    return form && motion;
  });
  if (either)
    text += '\n' + wrapped("",
                           "Roundness of the part or motion of the spindle: several sensors at "
                           "once or a reversal separate them, order by order (`trueaxis spindle "
                           "--advise` says where to place them)");
  if (d.plans.empty()) return text;
  std::size_t widest = 4;
  for (const Separating& plan : d.plans) widest = std::max(widest, width(plan.plan));
  const auto row = [&](const std::string& plan, const std::string& before, const std::string& after,
                       const std::string& minutes, const std::string& what) {
    return wrapped(
        "  " + padded(plan, widest + 2) + padded(before, 8) + padded(after, 8) + padded(minutes, 7),
        what);
  };
  text += "\nAll plans, probability of the right name before and after\n";
  text += row("plan", "before", "after", "min", "what");
  for (const Separating& p : d.plans) {
    const bool possible = p.why_not.empty();
    text += row(p.plan, probability(p.power_before), possible ? probability(p.power) : "-",
                possible ? fmt::format("{:.3g}", p.minutes) : "-",
                possible ? p.what : (p.what.empty() ? "" : p.what + ": ") + p.why_not);
  }
  return text;
}

}  // namespace trueaxis
