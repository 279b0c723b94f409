// SPDX-License-Identifier: Apache-2.0
#include "diagnose/advise/advise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "diagnose/refit/timing.hpp"
#include "diagnose/search/causes.hpp"
#include "infer/advice.hpp"
#include "infer/classes.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr double most_off_centre_mm = 2.0;  // that a part is clamped for a question
constexpr double shape_step = 0.06;         // how far a rival cause may bend in its shape

/// Whether a rival cause is one with the named cause to the first order: delay and lag.
bool are_twins(const AmbiguousFinding& question, std::size_t member) {
  const Hypothesis& named = question.found.members.front().hypothesis;
  return named.effect->second_order_twin == question.found.members[member].hypothesis.id();
}

std::optional<std::size_t> twin_of(const AmbiguousFinding& question) {
  for (std::size_t r = 1; r < question.found.members.size(); ++r)
    if (are_twins(question, r)) return r;
  return std::nullopt;
}

/// What a set of readings would tell: for every question the distances of its rival causes and the
/// probability of the right name, for every hidden effect the power to find it.
struct Outlook {
  std::vector<std::vector<double>> distances;
  std::vector<double> told;
  std::vector<double> found;
};

class Predictor {
 public:
  Predictor(const Problem& problem, const Model& model,
            const std::vector<AmbiguousFinding>& questions, const std::vector<Unobservable>& hidden,
            double sigma_mm)
      : problem_(problem),
        model_(model),
        questions_(questions),
        hidden_(hidden),
        sigma_mm_(sigma_mm) {
    // What is slow against the correlation of the noise sees this σ.
    double correlated = 1.0;
    for (const double phi : model.phi) correlated -= phi;
    sigma_mm_ /= std::clamp(correlated, 0.05, 1.0);
    list_ = model.terms;
    for (const AmbiguousFinding& q : questions) {
      for (std::size_t r = 1; r < q.found.members.size(); ++r) {
        const Hypothesis& rival = q.found.members[r].hypothesis;
        list_.push_back(rival);
        std::vector<Hypothesis> giving;  // what timing gives way in is its second order
        if (!are_twins(q, r)) giving = neighbours(rival, problem.point, shape_step);
        list_.insert(list_.end(), giving.begin(), giving.end());
        ways_.push_back(1 + giving.size());
      }
    }
    for (const Unobservable& h : hidden) list_.push_back(h.typical.hypothesis);
    const Joint joint(problem, model.phi, model.terms, model.terms.size());
    for (std::size_t t = 0; t < model.terms.size(); ++t) sizes_.push_back(joint.of(t));
  }

  /// d of delay and lag, one of them named by the question: what the base, the other terms and
  /// another size of the rival cause leave of the difference of the two, second order and all.
  double timing_distance(std::size_t question, const CandidateMeasurement& plan) const {
    const AmbiguousFinding& q = questions_[question];
    const LinearisationPoint point = point_of(plan);
    const ObservationMask mask = make_observation_mask(point);
    const Hypothesis& named = model_.terms[q.term];
    Hypothesis rival = q.found.members[*twin_of(q)].hypothesis;
    const double seconds = sizes_[q.term](0);
    if (is_lag(rival)) rival.shape.time_constant_s = seconds;
    std::vector<double> apart = timing_mm(named, seconds, point);
    const std::vector<double> other = timing_mm(rival, seconds, point);
    std::ranges::transform(apart, other, apart.begin(), std::minus{});
    NormalEquations equations(point, mask, apart, {}, 1);
    std::vector<Hypothesis> list = model_.terms;
    list[q.term] = rival;
    const std::vector<Columns> places = equations.append(list);
    const double left = project(equations.total(), infer::besides(equations.base(), places)).rss;
    return std::sqrt(plan.weight * std::max(0.0, left)) / sigma_mm_;
  }

  Outlook of(const CandidateMeasurement& plan) const {
    const LinearisationPoint point = point_of(plan);
    const ObservationMask mask = make_observation_mask(point);
    const std::vector<double> nothing(point.size(), 0.0);
    NormalEquations equations(point, mask, nothing, {}, 1);
    const std::vector<Columns> places = equations.append(list_);
    const std::span<const Columns> own{places.data(), model_.terms.size()};
    const Eigen::MatrixXd gram = plan.weight * equations.total();
    Outlook out;
    std::size_t next = model_.terms.size(), rival = 0;
    for (std::size_t k = 0; k < questions_.size(); ++k) {
      const AmbiguousFinding& q = questions_[k];
      const Columns others = infer::besides(equations.base(), own, q.term);
      std::vector<double> distances;
      for (std::size_t r = 1; r < q.found.members.size(); ++r, ++rival) {
        Columns taken = others;
        for (std::size_t way = 0; way < ways_[rival]; ++way, ++next)
          taken.insert(taken.end(), places[next].begin(), places[next].end());
        const Projection p = project(gram, taken);
        const double d2 = left_of(p, places[q.term], sizes_[q.term]);
        // More readings never tell less, also if a rival cause had no way to bend before.
        const double apart = are_twins(q, r) ? timing_distance(k, plan) : std::sqrt(d2) / sigma_mm_;
        distances.push_back(std::max(q.found.rivals[r - 1].distance, apart));
      }
      out.told.push_back(right_name_of(q.found.rivals, distances));
      out.distances.push_back(std::move(distances));
    }
    const Projection p = project(gram, infer::besides(equations.base(), own));
    for (const Unobservable& h : hidden_) {
      const double lambda = typical_lambda(p, places[next], h.typical.size, sigma_mm_);
      out.found.push_back(detection_power(lambda, std::min<std::size_t>(places[next].size(), 2),
                                          model_.family, problem_.false_alarm));
      ++next;
    }
    return out;
  }

 private:
  LinearisationPoint point_of(const CandidateMeasurement& plan) const {
    BaseKind base = problem_.point.base;
    base.axes = plan.clampings.back().axis + 1;
    LinearisationPoint out = linearise_at(plan.stream, plan.clampings, base, problem_.point.bore);
    out.as_read = problem_.point.as_read;
    out.ball_radius_mm = problem_.point.ball_radius_mm;
    return out;
  }

  const Problem& problem_;
  const Model& model_;
  const std::vector<AmbiguousFinding>& questions_;
  const std::vector<Unobservable>& hidden_;
  double sigma_mm_;
  std::vector<Hypothesis> list_;
  std::vector<std::size_t> ways_;  ///< of each rival cause: itself and its neighbours in shape
  std::vector<Eigen::VectorXd> sizes_;
};

/// The slowest second speed at which delay and lag are told apart; where none of those that the
/// readings a second allow does it, the least eccentricity at the fastest.
std::optional<CandidateMeasurement> timing_measurement(const Predictor& predictor,
                                                       std::size_t question,
                                                       const ProbeStream& stream,
                                                       const LinearisationPoint& point,
                                                       const std::vector<Clamping>& clampings) {
  if (!point.has_time || !point.base.tilts || point.base.face) return std::nullopt;
  const auto plan = [&](double ratio, double off_centre_mm) {
    return faster_measurement(stream, point, clampings, ratio, off_centre_mm);
  };
  const auto tells = [&](const CandidateMeasurement& p) {
    return every_line_meets(p.stream, p.clampings) &&
           right_name(predictor.timing_distance(question, p)) >= told_for_sure;
  };
  const auto least = [&](double low, double high, const auto& plan_of) {
    for (int round = 0; round < 7; ++round) {  // to 1 % of the way
      const double middle = std::sqrt(low * high);
      (tells(plan_of(middle)) ? high : low) = middle;
    }
    return plan_of(high);
  };
  const double fastest = fastest_ratio(point);
  const auto at_speed = [&](double ratio) { return plan(ratio, 0.0); };
  const auto off_centre = [&](double mm) { return plan(fastest, mm); };
  if (tells(at_speed(fastest))) return least(1.05, fastest, at_speed);
  const double largest = std::min(most_off_centre_mm, 0.05 * clampings.back().shape.radius_mm);
  if (point.base.offset || !tells(off_centre(largest))) return std::nullopt;
  return least(0.01 * largest, largest, off_centre);
}

double longest_wave(const std::vector<AmbiguousFinding>& questions) {
  for (const AmbiguousFinding& q : questions)
    for (const Candidate& c : q.found.members)
      if (c.hypothesis.effect->line && c.hypothesis.effect->line->in == SpectralLine::In::length)
        return c.hypothesis.shape.period_mm;
  return 0.0;
}

}  // namespace

Advice advise(const Problem& problem, const Model& model, const ProbeStream& stream,
              const std::vector<Clamping>& clampings,
              const std::vector<AmbiguousFinding>& questions,
              const std::vector<Unobservable>& hidden, double sigma_mm) {
  Advice out;
  std::vector<CandidateMeasurement> plans =
      candidate_measurements(stream, problem.point, clampings, longest_wave(questions));
  const Predictor predictor(problem, model, questions, hidden, sigma_mm);
  for (std::size_t k = 0; k < questions.size(); ++k) {
    if (!twin_of(questions[k])) continue;
    auto plan = timing_measurement(predictor, k, stream, problem.point, clampings);
    if (plan) plans.push_back(std::move(*plan));
  }
  std::vector<Outlook> after;
  for (const CandidateMeasurement& p : plans) after.push_back(predictor.of(p));

  std::vector<Measure> measures;
  for (const CandidateMeasurement& p : plans) measures.push_back({p.code, p.what, p.minutes});
  Ranking ranking(measures);
  const auto column = [&](auto member, std::size_t k, double before) {
    std::vector<double> values;
    for (const Outlook& o : after) values.push_back(std::max(before, (o.*member)[k]));
    return values;
  };
  bool open = false;
  for (std::size_t k = 0; k < questions.size(); ++k) {
    if (questions[k].found.rivals.empty()) {
      out.questions.emplace_back();
      continue;
    }
    const std::vector<Rival>& rivals = questions[k].found.rivals;
    std::vector<double> distances;
    for (std::size_t r = 0; r < rivals.size(); ++r)
      distances.push_back(
          are_twins(questions[k], r + 1)
              ? predictor.timing_distance(k, measurement_at_hand(stream, problem.point, clampings))
              : rivals[r].distance);
    const double before = right_name_of(rivals, distances);
    const std::vector<double> values = column(&Outlook::told, k, before);
    out.questions.push_back(choose(measures, before, values, told_for_sure,
                                   "no single measurement of this part tells them apart"));
    open |= !out.questions.back()->plan.empty();
    if (!out.questions.back()->plan.empty()) ranking.count(before, values, told_for_sure, 1.0);
  }
  for (std::size_t k = 0; k < hidden.size(); ++k) {
    const std::vector<double> values = column(&Outlook::found, k, hidden[k].power);
    const bool master = std::ranges::any_of(hidden[k].typical.hypothesis.effect->separations,
                                            [](const Separation& s) { return s.code == "MS"; });
    out.hidden.push_back(choose(measures, hidden[k].power, values, found_for_sure,
                                master ? "no measurement of this part shows it, a master does (MS),"
                                       : "no single measurement of this part shows it"));
    if (!open && !out.hidden.back()->plan.empty())
      ranking.count(hidden[k].power, values, found_for_sure, hidden[k].axis_bias_mm);
  }
  const std::vector<std::size_t> order = ranking.order();
  for (const std::size_t p : order) {
    out.runs.push_back(std::move(plans[p].runs));
    out.plans.push_back({plans[p].code,
                         plans[p].what,
                         ranking.before(),
                         ranking.after(p),
                         plans[p].minutes,
                         "",
                         {}});
  }
  if (!ranking.any()) {
    out.next.why_not = questions.empty() && hidden.empty()
                           ? "all causes are told apart"
                           : "no single measurement of this part tells for sure";
    return out;
  }
  const Separating& best = out.plans.front();
  out.next = {best.plan, best.what, {}, best.power_before, best.power, best.minutes, ""};
  for (std::size_t k = 0; k < questions.size(); ++k) {
    if (questions[k].found.rivals.empty()) continue;
    if (after[order[0]].told[k] < told_for_sure) continue;
    const std::vector<Candidate>& members = questions[k].found.members;
    for (std::size_t c = 0; c < members.size(); ++c) {
      const std::string id = members[c].hypothesis.id();
      if (c > 0 && right_name(after[order[0]].distances[k][c - 1]) < told_for_sure) continue;
      if (std::ranges::find(out.next.separates, id) == out.next.separates.end())
        out.next.separates.push_back(id);
    }
  }
  if (!open) {
    for (std::size_t k = 0; k < hidden.size(); ++k)
      if (after[order[0]].found[k] >= found_for_sure)
        out.next.separates.push_back(hidden[k].entry.effect);
  }
  return out;
}

}  // namespace trueaxis::diagnose_detail
