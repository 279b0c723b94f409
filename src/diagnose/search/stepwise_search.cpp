// SPDX-License-Identifier: Apache-2.0
#include "diagnose/search/stepwise_search.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "diagnose/regression/noise.hpp"
#include "diagnose/regression/size_prior.hpp"
#include "diagnose/search/dictionary.hpp"
#include "infer/model_criterion.hpp"
#include "infer/stepwise.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr double correlation_moved = 0.02;
constexpr std::size_t fits_kept = 4;
constexpr std::size_t asked_at_once = 2;  // where the first is exchanged, the next was in vain
constexpr double hides_a_term = 0.3;      // |φ|: less hardly weakens one

bool moved(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return true;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::abs(a[i] - b[i]) > correlation_moved) return true;
  return false;
}

std::vector<Hypothesis> without(const std::vector<Hypothesis>& terms, std::size_t i) {
  std::vector<Hypothesis> out(terms);
  out.erase(out.begin() + static_cast<long>(i));
  return out;
}

}  // namespace

class StepwiseSearch::Engine {
 public:
  explicit Engine(Proposer& proposer)
      : proposer_(proposer),
        problem_(proposer.problem()),
        noise_(problem_.point, problem_.mask, problem_.deviation_mm,
               small_fourier_legendre_basis(problem_.point, problem_.resolution),
               problem_.threads) {}

  Model run(bool patterns, bool& pattern_was_better, std::vector<Hypothesis> first) {
    Model model;
    if (!first_noise_) first_noise_ = first_noise();
    model.phi = *first_noise_;
    model.terms = std::move(first);
    struct Side {
      Engine& engine;
      Model& model;
      bool patterns;
      bool& pattern_was_better;

      std::size_t size() const { return model.terms.size(); }
      void forward() { engine.forward(model, patterns, pattern_was_better); }
      bool exchange() {
        return (size() > 1 || engine.may_split(model, 0)) && engine.swap(model, patterns);
      }
      double log_p(std::size_t i) { return engine.log_p_if_it_stands(model, i); }
      bool passes(double log_p) const {
        return model.family.p_value(std::exp(log_p)) < engine.problem_.false_alarm;
      }
      void drop(std::size_t i) {
        model.terms.erase(model.terms.begin() + static_cast<long>(i));
        engine.renew_noise(model);
      }
    } side{*this, model, patterns, pattern_was_better};
    search_stepwise(side);
    finish(model);
    return model;
  }

  LocalFormsTaken local_forms = LocalFormsTaken::any;

 private:
  bool may_be_taken(const Candidate& c) const {
    return local_forms == LocalFormsTaken::any || !is_local(c.hypothesis);
  }
  bool is_kept(const Hypothesis& h) const {
    return local_forms == LocalFormsTaken::given && is_local(h);
  }

  /// Noise before any term. What is no noise may look like it, and whitening then takes it away: a
  /// line that is no whole order like one that rings, a step, or of few readings anything slow,
  /// like a walk. Where terms beside a noise of their own leave less than chance makes them, that
  /// noise is taken.
  std::vector<double> first_noise() {
    if (problem_.resolution.sparse) return {};
    Autoregression best = noise_({});
    std::vector<Hypothesis> terms;
    while (std::ranges::any_of(best.phi, [](double p) { return std::abs(p) > hides_a_term; }) &&
           terms.size() < problem_.most_terms) {
      const Proposal& p = proposer_.beside(terms, {});
      const Candidate* term = nullptr;
      for (const auto* list : {&p.causes, &p.patterns})
        if (!list->empty() && (!term || list->front().gain > term->gain)) term = &list->front();
      if (!term) break;
      terms.push_back(term->hypothesis);
      Autoregression with = noise_(terms);
      const double log_p =
          log_p_value(best.rss - with.rss, best.freedom - with.freedom, best.rss, best.freedom);
      if (!(p.family.p_value(std::exp(log_p)) < problem_.false_alarm)) break;
      best = std::move(with);
    }
    return best.phi;
  }

  /// Whether the other terms leave all its columns: else their sizes would share one between them.
  /// A step is one whatever is read after it; how far it went, its plausible size bounds.
  static bool is_whole(const Candidate& c) {
    const bool step = c.hypothesis.effect && is_step(c.hypothesis.effect->term);
    return c.rank > 0 && (step || c.rank == c.hypothesis.columns());
  }

  double family_p(const Family& family, const Candidate& c) const {
    return family.p_value(std::exp(c.log_p));
  }

  void forward(Model& model, bool patterns, bool& pattern_was_better) {
    model.impossible = nullptr;
    while (model.terms.size() < problem_.most_terms) {
      Proposal p = proposer_.beside(model.terms, model.phi);
      model.family = p.family;
      const auto passes = [&](const Candidate& c) {
        return may_be_taken(c) && is_whole(c) && family_p(p.family, c) < problem_.false_alarm;
      };
      std::erase_if(p.causes, [&](const Candidate& c) { return !passes(c); });
      std::erase_if(p.patterns, [&](const Candidate& c) { return !passes(c); });
      const double cause = p.causes.empty() ? 1e300 : p.causes[0].criterion;
      const double pattern = p.patterns.empty() ? 1e300 : p.patterns[0].criterion + catalogue_first;
      // Of what only a size explains that cannot be, the next best is not the cause either.
      if (p.impossible && passes(*p.impossible) &&
          p.impossible->criterion + catalogue_first < std::min(cause, pattern)) {
        model.impossible = p.impossible->hypothesis.effect;
        return;
      }
      if (p.causes.empty() && p.patterns.empty()) return;
      if (!p.causes.empty() && pattern < cause) pattern_was_better = true;
      const bool take_pattern = p.causes.empty() || (patterns && pattern < cause);
      model.terms.push_back((take_pattern ? p.patterns : p.causes).front().hypothesis);
      renew_noise(model);
    }
  }

  // A strong slow effect looks like autocorrelation, until it is a term.
  void renew_noise(Model& model) const {
    if (model.phi.empty()) return;
    std::vector<double> phi = noise_(model.terms).phi;
    if (moved(phi, model.phi)) model.phi = std::move(phi);
  }

  struct Fitted {
    std::vector<Hypothesis> terms;
    NormalEquations equations;
    std::vector<Columns> places;
  };
  /// Of the model, or as it was made for one of the last that were asked for; lives until some more
  /// are asked for.
  const Fitted& fitted(const Model& model) {
    const auto made = std::ranges::find_if(fitted_, [&](const Fitted& f) {
      return f.equations.autoregression() == model.phi && same(f.terms, model.terms);
    });
    if (made != fitted_.end()) return *made;
    if (fitted_.size() == fits_kept) fitted_.pop_front();
    Fitted& out = fitted_.emplace_back(
        Fitted{model.terms,
               NormalEquations(problem_.point, problem_.mask, problem_.deviation_mm, model.phi,
                               problem_.threads, true),
               {}});
    out.places = out.equations.append(model.terms);
    return out;
  }

  static Columns besides(const Fitted& f, std::size_t i) {
    return infer::besides(f.equations.base(), f.places, i);
  }

  double term_log_p(const Fitted& f, std::size_t i) const {
    const Projection projection = project(f.equations.total(), besides(f, i));
    const Score s = score(projection, f.places[i]);
    return log_p_value(s.gain, static_cast<double>(s.rank), projection.rss,
                       static_cast<double>(f.equations.count() - projection.rank));
  }

  /// Pooled held-out sum of squares.
  static double held_out_by(const Fitted& f, const Columns& columns) {
    double sum = 0.0;
    for (const Eigen::MatrixXd& fold : f.equations.folds())
      sum += held_out_fast(f.equations.total(), fold, columns);
    return sum;
  }

  /// Whether it is less with a term than without it.
  bool predicts(const Fitted& f, std::size_t i, const Hypothesis& h) const {
    // Of a step and of a local form the other blocks may hold nothing.
    if (h.effect ? is_step(h.effect->term) : h.pattern.kind == Pattern::Kind::bump) return true;
    return held_out_by(f, besides(f, f.places.size())) < held_out_by(f, besides(f, i));
  }

  /// Whether its sizes beside all others are.
  static bool is_possible(const Fitted& f, std::size_t i) {
    Columns taken = besides(f, i);
    taken.insert(taken.end(), f.places[i].begin(), f.places[i].end());
    const Eigen::VectorXd all = solve(f.equations.total(), taken).coefficients;
    return size_prior(f.terms[i]).allows(all.tail(static_cast<Eigen::Index>(f.places[i].size())));
  }

  /// Beside all others; 0 of a term whose size cannot be or that does not predict.
  double log_p_if_it_stands(const Model& model, std::size_t i) {
    const Fitted& f = fitted(model);
    return is_possible(f, i) && predicts(f, i, model.terms[i]) ? term_log_p(f, i) : 0.0;
  }

  double criterion(const Model& model) {
    const Fitted& f = fitted(model);
    return model_criterion(
        f.equations.total(), f.equations.base(), f.places, f.equations.count(),
        [&](std::size_t i, const Projection& beside) {
          const Hypothesis& h = model.terms[i];
          Weighed weighed = weigh(h, beside, f.places[i], f.equations.count());
          weighed.criterion += choice_of(h, weighed.mean);
          weighed.criterion += h.effect || h.largest_mm > 0.0 ? 0.0 : catalogue_first;
          return weighed;
        },
        problem_.resolution.sparse);
  }

  /// The same with what the noise alone takes: models with another noise are compared by it, for
  /// every innovation counts as one reading of the same volume but where a run begins (Eq. 81).
  double evidence(const Model& model) {
    const Fitted& f = fitted(model);
    const auto freedom = static_cast<double>(f.equations.count() - f.equations.base().size());
    return criterion(model) + freedom * std::log(f.equations.total()(0, 0)) -
           f.equations.log_volume();
  }

  /// Every term against the best there is in its place, and pairs of one angular order against a
  /// single hypothesis.
  bool swap(Model& model, bool patterns) {
    bool changed = false;
    for (std::size_t i = 0; i < model.terms.size(); ++i) {
      if (is_kept(model.terms[i])) continue;
      ask_without_each(model, i);
      Model other = model;
      other.terms = without(model.terms, i);
      changed |= replace(model, std::move(other), patterns);
    }
    for (std::size_t i = 0; i < model.terms.size(); ++i)
      if (may_split(model, i)) changed |= split(model, i);
    for (std::size_t i = 0; i + 1 < model.terms.size(); ++i) {
      for (std::size_t j = i + 1; j < model.terms.size(); ++j) {
        if (angular_order(model.terms[i]) != angular_order(model.terms[j]) ||
            is_kept(model.terms[i]) || is_kept(model.terms[j]))
          continue;
        Model other = model;
        other.terms = without(without(model.terms, j), i);
        if (!replace(model, std::move(other), patterns)) continue;
        changed = true;
        break;
      }
    }
    return changed;
  }

  /// Asks at the same time what would stand for a term and for the next ones.
  void ask_without_each(const Model& model, std::size_t first) {
    std::vector<std::vector<Hypothesis>> lists;
    for (std::size_t i = first; i < model.terms.size(); ++i)
      if (!is_kept(model.terms[i]) && lists.size() < asked_at_once)
        lists.push_back(without(model.terms, i));
    proposer_.ask(std::move(lists), model.phi);
  }

  /// Lobes of the jaws with their second harmonic take two orders at once, and a line next to the
  /// surface's own columns the forms of several causes at a size that hardly is: two causes may do
  /// so too.
  bool may_split(const Model& model, std::size_t i) {
    if (i >= model.terms.size() || splits(model.terms[i])) return i < model.terms.size();
    const Fitted& f = fitted(model);
    const Projection beside = project(f.equations.total(), besides(f, i));
    return weigh(model.terms[i], beside, f.places[i], f.equations.count()).extraordinary;
  }
  static bool splits(const Hypothesis& h) {
    return h.effect && has_two_orders(h.effect->term) && h.columns() == 4;
  }
  bool split(Model& model, std::size_t term) {
    Model other = model;
    other.terms = without(model.terms, term);
    for (int half = 0; half < 2; ++half) {
      const Proposal& p = proposer_.beside(other.terms, model.phi);
      const auto next = std::ranges::find_if(p.causes, [](const Candidate& c) {
        return !splits(c.hypothesis) && !c.extraordinary && c.rank > 0;
      });
      if (next == p.causes.end()) return false;
      other.terms.push_back(next->hypothesis);
    }
    if (criterion(other) > criterion(model)) return false;
    model.terms = std::move(other.terms);
    return true;
  }

  bool replace(Model& model, Model reduced, bool patterns) {
    const Proposal& p = proposer_.beside(reduced.terms, model.phi);
    const Candidate* best = p.causes.empty() ? nullptr : &p.causes.front();
    const auto pattern =
        std::ranges::find_if(p.patterns, [&](const Candidate& c) { return may_be_taken(c); });
    if (pattern != p.patterns.end() && (patterns || best == nullptr) &&
        (best == nullptr || pattern->criterion + catalogue_first < best->criterion))
      best = &*pattern;
    if (best == nullptr || !is_whole(*best)) return false;
    reduced.terms.push_back(best->hypothesis);
    if (criterion(reduced) > criterion(model) - better_by) return false;
    model.terms = std::move(reduced.terms);
    return true;
  }

  static double angular_order(const Hypothesis& h) {
    if (!h.effect)
      return h.pattern.kind == Pattern::Kind::fourier_legendre ? h.pattern.order : -1.0;
    if (is_line(h)) return -1.0;
    const auto* harmonic = std::get_if<Harmonic>(&h.effect->term);
    if (harmonic) return harmonic->fixed_order > 0.0 ? harmonic->fixed_order : h.shape.order;
    return 0.0;
  }

  void finish(Model& model) {
    model.criterion = evidence(model);
    const Fitted& f = fitted(model);
    model.p_values.clear();
    for (std::size_t i = 0; i < model.terms.size(); ++i)
      model.p_values.push_back(model.family.p_value(std::exp(term_log_p(f, i))));
  }

  Proposer& proposer_;
  const Problem& problem_;
  NoiseEstimator noise_;
  std::optional<std::vector<double>> first_noise_;
  std::deque<Fitted> fitted_;
};

StepwiseSearch::StepwiseSearch(Proposer& proposer) : engine_(std::make_unique<Engine>(proposer)) {}
StepwiseSearch::~StepwiseSearch() = default;

void StepwiseSearch::take_local_forms(LocalFormsTaken which) { engine_->local_forms = which; }

Model StepwiseSearch::run(bool patterns, bool& pattern_was_better, std::vector<Hypothesis> first) {
  return engine_->run(patterns, pattern_was_better, std::move(first));
}

}  // namespace trueaxis::diagnose_detail
