// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "report/chart_readings.hpp"
#include "report/report_data.hpp"
#include "report/thinning.hpp"
#include "trueaxis/base/units.hpp"
#include "trueaxis/effect/catalogue.hpp"

namespace trueaxis {
namespace {

using nlohmann::json;

json estimate(const Estimate& e) {
  return {{"value", e.value}, {"u", e.u}, {"unit", e.unit}, {"why_not", e.why_not}};
}

json separating(const Separating& s) {
  return {{"plan", s.plan},   {"what", s.what},       {"before", s.power_before},
          {"after", s.power}, {"minutes", s.minutes}, {"why_not", s.why_not}};
}

std::string title_of(const std::string& effect) {
  const Effect* known = find_effect(effect);
  return known == nullptr ? "" : std::string(known->title);
}

json class_data(const Finding& finding) {
  json members = json::array();
  for (const std::string& id : finding.members) {
    const auto rival = std::find_if(finding.rivals.begin(), finding.rivals.end(),
                                    [&](const Rival& r) { return r.effect == id; });
    const bool named = id == finding.effect, listed = rival != finding.rivals.end();
    members.push_back({{"effect", id},
                       {"title", title_of(id)},
                       {"probability", named    ? finding.probability
                                       : listed ? rival->probability
                                                : std::nan("")},
                       {"structural", listed && rival->structural}});
  }
  return members;
}

json finding_data(const Finding& finding) {
  json parameters = json::array();
  for (const FitParameter& p : finding.parameters) {
    json parameter = estimate(p.estimate);
    parameter["name"] = p.name;
    parameters.push_back(parameter);
  }
  json data{{"effect", finding.effect},
            {"title", title_of(finding.effect)},
            {"class", class_data(finding)},
            {"parameters", parameters},
            {"alias", finding.alias},
            {"frame", finding.frame},
            {"p_value", finding.p_value},
            {"rms_mm", finding.rms_mm},
            {"axis_shift", estimate(finding.axis_shift)},
            {"cosmetic", finding.cosmetic}};
  if (finding.separate_with) data["separate_with"] = separating(*finding.separate_with);
  return data;
}

json not_observable_data(const NotObservable& n) {
  json data{{"effect", n.effect},
            {"title", title_of(n.effect)},
            {"why", n.why},
            {"harm", estimate(n.harm_per_unit)},
            {"detectable", n.detectable},
            {"detectable_unit", n.detectable_unit}};
  if (n.separate_with) data["separate_with"] = separating(*n.separate_with);
  return data;
}

json noise_data(const NoiseReport& noise) {
  const auto maybe = [](const std::optional<double>& v) { return v.value_or(std::nan("")); };
  return {{"sigma_mm", noise.sigma_mm},
          {"u_sigma_mm", noise.u_sigma_mm},
          {"source", noise.source},
          {"note", noise.note},
          {"autoregression", noise.autoregression},
          {"stationary_mm", maybe(noise.stationary_mm)},
          {"repeated_mm", maybe(noise.repeated_mm)},
          {"revolutions_mm", maybe(noise.revolutions_mm)},
          {"stated_mm", maybe(noise.stated_mm)},
          {"masked", noise.masked.size()},
          {"gaps", noise.gaps},
          {"interruptions", noise.interruptions.size()}};
}

/// Variance of what is kept, mm².
double variance(const std::vector<double>& values, const std::vector<bool>& kept) {
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i >= kept.size() || !kept[i]) continue;
    sum += values[i];
    squares += values[i] * values[i];
    count += 1.0;
  }
  return count > 1.0 ? squares / count - sum * sum / (count * count) : std::nan("");
}

json interval(const Interval& i) { return {{"value", i.value}, {"low", i.low}, {"high", i.high}}; }

json gain_data(const Diagnosis& d, const std::vector<bool>& kept) {
  const double before = variance(d.residual_before_mm, kept),
               after = variance(d.residual_after_mm, kept);
  return {{"rms_before_mm", d.gain.rms_before_mm},
          {"rms_after_mm", d.gain.rms_after_mm},
          {"held_out_before_mm", interval(d.gain.held_out_before_mm)},
          {"held_out_after_mm", interval(d.gain.held_out_after_mm)},
          {"held_out_ratio", interval(d.gain.held_out_ratio)},
          {"blocks", d.gain.blocks},
          {"noise_floor_mm", d.gain.noise_floor_mm},
          {"axis_shift", estimate(d.gain.axis_shift)},
          {"coaxiality_before", estimate(d.gain.coaxiality_before)},
          {"coaxiality_after", estimate(d.gain.coaxiality_after)},
          {"left_share", after / before},
          {"noise_share", d.gain.noise_floor_mm * d.gain.noise_floor_mm / before}};
}

/// No more bins than a chart has pixels: the highest of each group stands for it.
json spectrum_data(const std::vector<SpectrumBin>& bins) {
  constexpr std::size_t most = 1000;
  const std::size_t group = (bins.size() + most - 1) / most;
  std::vector<double> order, before, after;
  for (std::size_t i = 0; i < bins.size(); i += group) {
    const std::size_t end = std::min(bins.size(), i + group);
    SpectrumBin highest = bins[i];
    for (std::size_t j = i; j < end; ++j) {
      if (bins[j].before_mm > highest.before_mm) highest.order = bins[j].order;
      highest.before_mm = std::max(highest.before_mm, bins[j].before_mm);
      highest.after_mm = std::max(highest.after_mm, bins[j].after_mm);
    }
    order.push_back(highest.order);
    before.push_back(highest.before_mm / mm_per_um);
    after.push_back(highest.after_mm / mm_per_um);
  }
  return {{"order", column(order, 5)},
          {"before_um", column(before, 4)},
          {"after_um", column(after, 4)},
          {"grouped", group > 1}};
}

/// Lines of the spectrum that have a name: orders of harmonics, found or unexplained.
json lines_data(const Diagnosis& d) {
  json lines = json::array();
  for (const Finding& finding : d.findings) {
    for (const FitParameter& p : finding.parameters) {
      if (p.name == "order" && p.estimate.determined())
        lines.push_back({{"order", p.estimate.value}, {"name", finding.effect}});
    }
  }
  for (const Unexplained& u : d.unexplained) {
    if (u.order != 0.0) lines.push_back({{"order", std::abs(u.order)}, {"name", "unexplained"}});
  }
  return lines;
}

constexpr const char* map_keys[] = {"before_um", "after_um", "effect_um"};

std::vector<double> in_um(const std::vector<double>& values_mm) {
  std::vector<double> um;
  um.reserve(values_mm.size());
  for (const double v : values_mm) um.push_back(v / mm_per_um);
  return um;
}

/// Columns for the maps of the reference's own readings: one value a reading, or means of cells.
json maps_data(const Diagnosis& d, const ChartReadings& all, bool thinned) {
  const std::vector<double>* sources[] = {&d.residual_before_mm, &d.residual_after_mm,
                                          &d.effect_mm};
  json data = json::object();
  for (std::size_t k = 0; k < 3; ++k) {
    const std::vector<double> um = in_um(*sources[k]);
    if (!thinned) {
      data[map_keys[k]] = column(um, 3);
    } else if (all.has_position) {
      CellMeans cells(map_columns, map_rows(all));
      for (std::size_t i = 0; i < um.size(); ++i) {
        if (all.kept[i]) cells.add(all.c_deg[i], all.position_mm[i], um[i]);
      }
      data[map_keys[k]] = cells.to_json(3);
    }
  }
  if (!thinned) {
    data["rejected"] = json::array();
    for (std::size_t i = 0; i < all.kept.size(); ++i) {
      if (!all.kept[i]) data["rejected"].push_back(i);
    }
  }
  return data;
}

template <class T>
json list_of(const std::vector<T>& items, json (*write)(const T&)) {
  json list = json::array();
  for (const T& item : items) list.push_back(write(item));
  return list;
}

json unexplained_data(const Unexplained& u) {
  return {{"harmonic", u.harmonic},
          {"dependence", u.dependence},
          {"amplitude", estimate(u.amplitude)},
          {"p_value", u.p_value}};
}

json check_data(const QualityCheck& c) {
  return {
      {"effect", c.effect}, {"title", title_of(c.effect)}, {"found", c.found}, {"text", c.text}};
}

}  // namespace

json diagnosis_data(const ProbeStream& stream, const Diagnosis& d) {
  json data{{"verdict", to_string(d.verdict)},
            {"status", to_string(d.extended.status)},
            {"message", d.extended.message},
            {"k", d.baseline.coverage_factor},
            {"surface", d.baseline.surface},
            {"false_alarm", d.false_alarm},
            {"hypotheses", d.hypotheses},
            {"findings", list_of(d.findings, finding_data)},
            {"unexplained", list_of(d.unexplained, unexplained_data)},
            {"not_observable", list_of(d.not_observable, not_observable_data)},
            {"noise", noise_data(d.noise)},
            {"checks", list_of(d.checks, check_data)},
            {"plans", list_of(d.plans, separating)},
            {"spectrum", spectrum_data(d.spectrum)},
            {"lines", lines_data(d)},
            {"next",
             {{"plan", d.next.plan},
              {"what", d.next.what},
              {"separates", d.next.separates},
              {"before", d.next.power_before},
              {"after", d.next.power_after},
              {"minutes", d.next.minutes},
              {"why_not", d.next.why_not}}}};
  const std::size_t count = stream.size();
  const bool complete = d.residual_before_mm.size() == count &&
                        d.residual_after_mm.size() == count && d.effect_mm.size() == count;
  if (!complete || count == 0) {
    data["gain"] = gain_data(d, std::vector<bool>(d.residual_before_mm.size(), false));
    return data;
  }
  ChartReadings all = chart_readings(stream, d.baseline, CoaxialNominal(stream, d.baseline));
  for (const Rejected& r : d.noise.masked) {
    if (r.row >= 1 && r.row <= count) all.kept[r.row - 1] = false;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!std::isfinite(d.residual_before_mm[i] + d.residual_after_mm[i])) all.kept[i] = false;
  }
  data["gain"] = gain_data(d, all.kept);
  data["maps"] = maps_data(d, all, count > max_points);
  return data;
}

}  // namespace trueaxis
