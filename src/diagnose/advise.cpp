// SPDX-License-Identifier: Apache-2.0
#include "diagnose/advise.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "diagnose/plan.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr double share_of_best = 0.8;  // of the largest rise: among these the fastest is taken
constexpr double worth_taking = 0.02;

double phi_half(double d) { return cdf(boost::math::normal(), 0.5 * d); }

/// What a set of readings would tell: for every question the least Φ(d/2) over its rivals, for
/// every hidden effect the power of finding it.
struct Outlook {
  std::vector<double> told;
  std::vector<double> found;
};

class Predictor {
 public:
  Predictor(const Problem& problem, const Model& model, const std::vector<Question>& questions,
            const std::vector<Hidden>& hidden, double sigma_mm)
      : problem_(problem),
        model_(model),
        questions_(questions),
        hidden_(hidden),
        sigma_mm_(sigma_mm) {
    list_ = model.terms;
    for (const Question& q : questions)
      for (std::size_t r = 1; r < q.found.members.size(); ++r)
        list_.push_back(q.found.members[r].hypothesis);
    for (const Hidden& h : hidden) list_.push_back(h.typical.hypothesis);
    const Joint joint(problem, model.phi, model.terms, model.terms.size());
    for (std::size_t t = 0; t < model.terms.size(); ++t) sizes_.push_back(joint.of(t));
  }

  Outlook of(const ProbeStream& stream, const std::vector<Clamping>& clampings,
             double weight) const {
    BaseKind base = problem_.scene.base;
    base.axes = clampings.back().axis + 1;
    const Scene scene = make_scene(stream, clampings, base, problem_.scene.bore);
    const Rows rows = make_rows(scene);
    const std::vector<double> nothing(scene.size(), 0.0);
    Evidence evidence(scene, rows, nothing, {}, 1);
    const std::vector<Columns> places = evidence.append(list_);
    const Eigen::MatrixXd gram = weight * evidence.total();
    Outlook out;
    std::size_t next = model_.terms.size();
    for (const Question& q : questions_) {
      Columns others = evidence.base();
      for (std::size_t t = 0; t < model_.terms.size(); ++t)
        if (t != q.term) others.insert(others.end(), places[t].begin(), places[t].end());
      double least = 1.0;
      for (std::size_t r = 1; r < q.found.members.size(); ++r, ++next) {
        Columns taken = others;
        taken.insert(taken.end(), places[next].begin(), places[next].end());
        const Projection p = project(gram, taken);
        double d2 = 0.0;
        for (std::size_t a = 0; a < places[q.term].size(); ++a) {
          for (std::size_t b = 0; b < places[q.term].size(); ++b)
            d2 += sizes_[q.term](static_cast<Eigen::Index>(a)) *
                  sizes_[q.term](static_cast<Eigen::Index>(b)) *
                  p.gram(static_cast<Eigen::Index>(places[q.term][a]),
                         static_cast<Eigen::Index>(places[q.term][b]));
        }
        least = std::min(least, phi_half(std::sqrt(std::max(0.0, d2)) / sigma_mm_));
      }
      out.told.push_back(least);
    }
    Columns taken = evidence.base();
    for (std::size_t t = 0; t < model_.terms.size(); ++t)
      taken.insert(taken.end(), places[t].begin(), places[t].end());
    const Projection p = project(gram, taken);
    for (const Hidden& h : hidden_) {
      const double lambda = typical_lambda(p, places[next], h.typical.size, sigma_mm_);
      out.found.push_back(detection_power(lambda, std::min<std::size_t>(places[next].size(), 2),
                                          model_.family, problem_.false_alarm));
      ++next;
    }
    return out;
  }

 private:
  const Problem& problem_;
  const Model& model_;
  const std::vector<Question>& questions_;
  const std::vector<Hidden>& hidden_;
  double sigma_mm_;
  std::vector<Hypothesis> list_;
  std::vector<Eigen::VectorXd> sizes_;
};

/// The plan to take for something that each plan raises from `before` to `after[plan]`: among those
/// that raise it nearly as much as any, the fastest.
std::optional<Separating> choose(const std::vector<Plan>& plans, double before,
                                 const std::vector<double>& after) {
  double most = 0.0;
  for (const double a : after) most = std::max(most, a - before);
  if (most < worth_taking) return std::nullopt;
  const Plan* best = nullptr;
  double power = 0.0;
  for (std::size_t p = 0; p < plans.size(); ++p) {
    if (after[p] - before < share_of_best * most) continue;
    if (best && plans[p].minutes >= best->minutes) continue;
    best = &plans[p], power = after[p];
  }
  Separating out{best->code, best->what, before, power, best->minutes, "", {}};
  for (std::size_t p = 0; p < plans.size(); ++p) {
    if (&plans[p] == best || after[p] - before < share_of_best * most) continue;
    out.others.push_back({plans[p].code, plans[p].what, after[p], plans[p].minutes});
  }
  std::ranges::stable_sort(out.others, {}, &Separating::Other::minutes);
  return out;
}

Separating nothing_helps(double before, const char* why) {
  return {"", "", before, before, 0.0, why, {}};
}

double longest_wave(const std::vector<Question>& questions) {
  for (const Question& q : questions)
    for (const Candidate& c : q.found.members)
      if (c.hypothesis.effect && c.hypothesis.effect->id == "part.waviness")
        return c.hypothesis.shape.period_mm;
  return 0.0;
}

}  // namespace

Advice advise(const Problem& problem, const Model& model, const ProbeStream& stream,
              const std::vector<Clamping>& clampings, const std::vector<Question>& questions,
              const std::vector<Hidden>& hidden, double sigma_mm) {
  Advice out;
  const std::vector<Plan> plans =
      candidate_plans(stream, problem.scene, clampings, longest_wave(questions));
  const Predictor predictor(problem, model, questions, hidden, sigma_mm);
  std::vector<Outlook> after;
  for (const Plan& p : plans) after.push_back(predictor.of(p.stream, p.clampings, p.weight));

  std::vector<double> gains(plans.size(), 0.0), total_after(plans.size(), 0.0);
  double weight_sum = 0.0, before_sum = 0.0;
  const auto column = [&](auto member, std::size_t k) {
    std::vector<double> values;
    for (const Outlook& o : after) values.push_back((o.*member)[k]);
    return values;
  };
  const auto count = [&](double before, const std::vector<double>& values, double weight) {
    weight_sum += weight, before_sum += weight * before;
    for (std::size_t p = 0; p < plans.size(); ++p) {
      gains[p] += weight * (values[p] - before), total_after[p] += weight * values[p];
    }
  };
  bool open = false;
  for (std::size_t k = 0; k < questions.size(); ++k) {
    if (questions[k].found.rivals.empty()) {
      out.questions.emplace_back();
      continue;
    }
    double nearest = 1e9;
    for (const Rival& r : questions[k].found.rivals) nearest = std::min(nearest, r.distance);
    const double before = phi_half(nearest);
    const std::vector<double> values = column(&Outlook::told, k);
    out.questions.push_back(choose(plans, before, values));
    if (!out.questions.back())
      out.questions.back() =
          nothing_helps(before, "no single measurement of this part tells them apart");
    else
      open = true, count(before, values, 1.0);
  }
  for (std::size_t k = 0; k < hidden.size(); ++k) {
    const std::vector<double> values = column(&Outlook::found, k);
    out.hidden.push_back(choose(plans, hidden[k].power, values));
    if (!out.hidden.back()) {
      const bool master = std::ranges::any_of(hidden[k].typical.hypothesis.effect->separations,
                                              [](const Separation& s) { return s.code == "MS"; });
      out.hidden.back() = nothing_helps(
          hidden[k].power, master ? "no measurement of this part shows it; a master does (MS)"
                                  : "no single measurement of this part shows it");
    } else if (!open) {
      count(hidden[k].power, values, hidden[k].harm_mm);
    }
  }
  std::vector<std::size_t> order(plans.size());
  for (std::size_t p = 0; p < order.size(); ++p) order[p] = p;
  double most = 0.0;
  for (const double g : gains) most = std::max(most, g);
  const auto rank = [&](std::size_t p) {
    return std::pair(gains[p] < share_of_best * most,
                     gains[p] < share_of_best * most ? -gains[p] : plans[p].minutes);
  };
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  for (const std::size_t p : order) {
    out.plans.push_back({plans[p].code,
                         plans[p].what,
                         weight_sum > 0.0 ? before_sum / weight_sum : 0.0,
                         weight_sum > 0.0 ? total_after[p] / weight_sum : 0.0,
                         plans[p].minutes,
                         "",
                         {}});
  }
  if (!(most > 0.0) || order.empty()) {
    out.next.why_not = questions.empty() && hidden.empty()
                           ? "nothing is left to tell apart"
                           : "no single measurement of this part tells more";
    return out;
  }
  const Separating& best = out.plans.front();
  out.next = {best.plan, best.what, {}, best.power_before, best.power, best.minutes, ""};
  for (std::size_t k = 0; k < questions.size(); ++k) {
    if (questions[k].found.rivals.empty()) continue;
    if (after[order[0]].told[k] - out.questions[k]->power_before < worth_taking) continue;
    for (const Candidate& c : questions[k].found.members)
      if (std::ranges::find(out.next.separates, c.hypothesis.id()) == out.next.separates.end())
        out.next.separates.push_back(c.hypothesis.id());
  }
  if (!open) {
    for (std::size_t k = 0; k < hidden.size(); ++k)
      if (after[order[0]].found[k] - hidden[k].power > worth_taking)
        out.next.separates.push_back(hidden[k].entry.effect);
  }
  return out;
}

}  // namespace trueaxis::diagnose_detail
