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
#include "infer/fitted.hpp"
#include "infer/stepwise.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr double correlation_moved = 0.02;
constexpr std::size_t fits_kept = 4;
constexpr std::size_t asked_at_once = 2;  // where the first is exchanged, the next was in vain
constexpr double hides_a_term = 0.3;      // |φ|: less hardly weakens one
constexpr double told_by_others = 0.01;   // of a column's square: less, ten times the u of its size

bool moved(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return true;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::abs(a[i] - b[i]) > correlation_moved) return true;
  return false;
}

}  // namespace

class StepwiseSearch::Engine {
 public:
  using Terms = std::vector<Hypothesis>;

  explicit Engine(Proposer& proposer)
      : proposer_(proposer),
        problem_(proposer.problem()),
        noise_(problem_.point, problem_.mask, problem_.deviation_mm,
               small_fourier_legendre_basis(problem_.point, problem_.resolution),
               problem_.threads) {}

  Model run(bool patterns, bool& pattern_was_better, std::vector<Hypothesis> first) {
    patterns_ = patterns;
    pattern_was_better_ = &pattern_was_better;
    if (!first_noise_) first_noise_ = first_noise();
    model_ = {};
    model_.phi = *first_noise_;
    model_.terms = std::move(first);
    search_stepwise(*this);
    finish();
    return std::move(model_);
  }

  Model left_of(Terms first, const Model& found) {
    bool ignored = false;
    patterns_ = false;
    pattern_was_better_ = &ignored;
    model_ = {};
    model_.family = found.family;
    model_.phi = noise_(first).phi;
    const double level = std::log(model_.family.single_level(problem_.false_alarm));
    for (const std::size_t i :
         infer::remaining(made_of(first).in, std::vector<double>(first.size(), level)))
      model_.terms.push_back(first[i]);
    const auto was_found = [&](const Hypothesis& h) {
      return std::ranges::any_of(found.terms, [&](const Hypothesis& o) { return same(o, h); });
    };
    if (model_.terms.size() == found.terms.size() && std::ranges::all_of(model_.terms, was_found))
      return found;
    search_stepwise(*this);
    finish();
    return std::move(model_);
  }

  Model unless_noise(Model model) {
    if (model.terms.empty() || problem_.resolution.sparse) return model;
    if (!free_noise_)
      free_noise_.emplace(problem_.point, problem_.mask, problem_.deviation_mm,
                          std::span<const Hypothesis>{}, problem_.threads);
    Model alone = beside_free_noise({}), with = beside_free_noise(model.terms);
    if (with.criterion < model.criterion) model.phi = with.phi, model.criterion = with.criterion;
    if (!(alone.criterion + 2.0 * std::log(problem_.false_alarm) < model.criterion)) return model;
    model.terms.clear(), model.p_values.clear();
    model.phi = std::move(alone.phi), model.criterion = alone.criterion;
    return model;
  }

  /// Terms with a noise as free as the readings show it: what a basis takes of few readings, their
  /// noise would not have.
  Model beside_free_noise(const Terms& terms) {
    model_ = {};
    model_.terms = terms;
    model_.phi = (*free_noise_)(terms).phi;
    finish();
    model_.criterion +=
        static_cast<double>(model_.phi.size()) * std::log(static_cast<double>(rows()));
    return std::move(model_);
  }

  // What infer/stepwise.hpp asks of a side.

  Terms& terms() { return model_.terms; }
  std::size_t most() const { return problem_.most_terms; }

  std::optional<Hypothesis> passing_beside(const Terms& terms) {
    model_.impossible = nullptr;
    Proposal p = proposer_.beside(terms, model_.phi);
    model_.family = p.family;
    for (std::vector<Candidate>* list : {&p.causes, &p.patterns, &p.impossible}) {
      std::erase_if(*list, [&](const Candidate& c) { return !may_be_taken(c) || !is_whole(c); });
      erase_chance(problem_, p, model_.phi, terms, *list);
    }
    const double cause = p.causes.empty() ? 1e300 : p.causes[0].criterion;
    const double pattern = p.patterns.empty() ? 1e300 : p.patterns[0].criterion + catalogue_first;
    // If only an impossible size explains something, the next best is not the cause either.
    if (!p.impossible.empty() &&
        p.impossible[0].criterion + catalogue_first < std::min(cause, pattern)) {
      model_.impossible = p.impossible[0].hypothesis.effect;
      return std::nullopt;
    }
    if (p.causes.empty() && p.patterns.empty()) return std::nullopt;
    if (!p.causes.empty() && pattern < cause) *pattern_was_better_ = true;
    const bool take_pattern = p.causes.empty() || (patterns_ && pattern < cause);
    return (take_pattern ? p.patterns : p.causes).front().hypothesis;
  }

  std::optional<Hypothesis> best_beside(const Terms& terms) {
    const Proposal& p = proposer_.beside(terms, model_.phi);
    const Candidate* best = p.causes.empty() ? nullptr : &p.causes.front();
    const auto pattern =
        std::ranges::find_if(p.patterns, [&](const Candidate& c) { return may_be_taken(c); });
    if (pattern != p.patterns.end() && (patterns_ || best == nullptr) &&
        (best == nullptr || pattern->criterion + catalogue_first < best->criterion))
      best = &*pattern;
    if (best == nullptr || !is_whole(*best)) return std::nullopt;
    return best->hypothesis;
  }

  /// After all others; 0 for a term whose size is impossible or that does not predict.
  double log_p(std::size_t i) {
    const Made& made = made_of(model_.terms);
    return is_possible(made, i) && predicts(made, i) ? made.in.log_p(i) : 0.0;
  }
  bool passes(double log_p) const {
    return model_.family.p_value(std::exp(log_p)) < problem_.false_alarm;
  }

  double criterion(const Terms& terms) {
    const Made& made = made_of(terms);
    return made.in.criterion(
        [&](std::size_t i, const Projection& beside) {
          const Hypothesis& h = terms[i];
          Weighed weighed = weigh(h, beside, made.in.terms[i], made.in.count);
          weighed.criterion += choice_of(h);
          weighed.criterion += h.effect || h.largest_mm > 0.0 ? 0.0 : catalogue_first;
          return weighed;
        },
        problem_.resolution.sparse);
  }

  /// Asks at the same time what would stand for a term and for the next ones.
  bool may_leave(std::size_t first) {
    if (is_kept(terms()[first])) return false;
    std::vector<Terms> lists;
    for (std::size_t i = first; i < terms().size(); ++i)
      if (!is_kept(terms()[i]) && lists.size() < asked_at_once)
        lists.push_back(infer::without(terms(), i));
    proposer_.ask(std::move(lists), model_.phi);
    return true;
  }

  /// Every term against the best there is in its place, and pairs of one angular order against a
  /// single hypothesis.
  bool exchange() {
    if (terms().size() < 2 && !may_split(0)) return false;
    bool changed = infer::exchange_each(*this);
    for (std::size_t i = 0; i < terms().size(); ++i)
      if (may_split(i)) changed |= split(i);
    for (std::size_t i = 0; i + 1 < terms().size(); ++i) {
      for (std::size_t j = i + 1; j < terms().size(); ++j) {
        if (angular_order(terms()[i]) != angular_order(terms()[j]) || is_kept(terms()[i]) ||
            is_kept(terms()[j]) ||
            !infer::replace(*this, infer::without(infer::without(terms(), j), i)))
          continue;
        changed = true;
        break;
      }
    }
    return changed;
  }

  // A strong slow effect looks like autocorrelation, until it is a term.
  void taken() {
    if (model_.phi.empty()) return;
    std::vector<double> phi = noise_(model_.terms).phi;
    if (moved(phi, model_.phi)) model_.phi = std::move(phi);
  }
  void dropped() { taken(); }

  LocalFormsTaken local_forms = LocalFormsTaken::any;

 private:
  std::size_t rows() { return made_of(model_.terms).in.count; }

  bool may_be_taken(const Candidate& c) const {
    return local_forms == LocalFormsTaken::any || !is_local(c.hypothesis);
  }
  bool is_kept(const Hypothesis& h) const {
    return local_forms == LocalFormsTaken::given && is_local(h);
  }

  /// Noise before any term. What is not noise may look like it, and whitening then removes it. A
  /// line that is not a whole order looks like noise that rings; a step, or in few readings
  /// anything slow, looks like a walk. If terms with a noise of their own leave less than random
  /// ones would, that noise counts.
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

  struct Made {
    Made(std::vector<double> of_phi, Terms of, NormalEquations made, std::vector<Columns> places)
        : phi(std::move(of_phi)),
          terms(std::move(of)),
          equations(std::move(made)),
          in{equations.total(), equations.base(), std::move(places), equations.count()} {}
    Made(const Made&) = delete;

    std::vector<double> phi;
    Terms terms;
    NormalEquations equations;
    infer::Fitted in;
  };
  /// With the model's noise, or as it was made for one of the last that were asked for; lives until
  /// some more are asked for.
  const Made& made_of(const Terms& terms) {
    const auto before = std::ranges::find_if(
        made_, [&](const Made& m) { return m.phi == model_.phi && same(m.terms, terms); });
    if (before != made_.end()) return *before;
    if (made_.size() == fits_kept) made_.pop_front();
    NormalEquations equations(problem_.point, problem_.mask, problem_.deviation_mm, model_.phi,
                              problem_.threads, true);
    std::vector<Columns> places = equations.append(terms);
    return made_.emplace_back(model_.phi, terms, std::move(equations), std::move(places));
  }

  /// Whether the blocks but one tell a term: two of three sections hold nothing about a bend.
  static bool others_tell(const Made& made, std::size_t i, const Eigen::MatrixXd& fold) {
    const Eigen::MatrixXd others = made.in.gram - fold;
    const Projection in_others = project(others, made.in.besides(i)), in_all = made.in.beside(i);
    return std::ranges::any_of(made.in.terms[i], [&](std::size_t column) {
      const auto c = static_cast<Eigen::Index>(column);
      return in_others.gram(c, c) > told_by_others * in_all.gram(c, c);
    });
  }

  /// Whether the pooled held-out sum of squares is less with a term than without it.
  static bool predicts(const Made& made, std::size_t i) {
    const Hypothesis& h = made.terms[i];
    // Of a step and of a local form the other blocks may hold nothing.
    if (h.effect ? is_step(h.effect->term) : h.pattern.kind == Pattern::Kind::bump) return true;
    const Columns all = made.in.besides(), others = made.in.besides(i);
    double gain = 0.0, told_gain = 0.0;
    for (const Eigen::MatrixXd& fold : made.equations.folds())
      gain += held_out_fast(made.in.gram, fold, others) - held_out_fast(made.in.gram, fold, all);
    if (gain > 0.0) return true;
    bool told = false;
    for (const Eigen::MatrixXd& fold : made.equations.folds()) {
      if (!others_tell(made, i, fold)) continue;
      told = true;
      told_gain +=
          held_out_fast(made.in.gram, fold, others) - held_out_fast(made.in.gram, fold, all);
    }
    return !told || told_gain > 0.0;
  }

  /// Whether its sizes after all others are.
  static bool is_possible(const Made& made, std::size_t i) {
    return size_prior(made.terms[i]).allows(made.in.of(i));
  }

  /// Lobes of the jaws with their second harmonic explain two orders at once. A line next to the
  /// surface's own columns explains the forms of several causes at an implausible size. Two causes
  /// may do so too.
  bool may_split(std::size_t i) {
    if (i >= terms().size() || splits(terms()[i])) return i < terms().size();
    const Made& made = made_of(terms());
    return weigh(terms()[i], made.in.beside(i), made.in.terms[i], made.in.count).extraordinary;
  }
  static bool splits(const Hypothesis& h) {
    return h.effect && has_two_orders(h.effect->term) && h.columns() == 4;
  }
  bool split(std::size_t term) {
    Terms other = infer::without(terms(), term);
    for (int half = 0; half < 2; ++half) {
      const Proposal& p = proposer_.beside(other, model_.phi);
      const auto next = std::ranges::find_if(p.causes, [](const Candidate& c) {
        return !splits(c.hypothesis) && !c.extraordinary && c.rank > 0;
      });
      if (next == p.causes.end()) return false;
      other.push_back(next->hypothesis);
    }
    if (criterion(other) > criterion(terms())) return false;
    terms() = std::move(other);
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

  /// Its criterion has what the noise alone takes: models with another noise are compared by it,
  /// for every innovation counts as one reading of the same volume but where a run begins (Eq. 81).
  void finish() {
    const Made& made = made_of(terms());
    const auto freedom = static_cast<double>(made.in.count - made.in.base.size());
    model_.criterion =
        criterion(terms()) + freedom * std::log(made.in.gram(0, 0)) - made.equations.log_volume();
    for (std::size_t i = 0; i < terms().size(); ++i)
      model_.p_values.push_back(model_.family.p_value(std::exp(made.in.log_p(i))));
  }

  Proposer& proposer_;
  const Problem& problem_;
  NoiseEstimator noise_;
  std::optional<std::vector<double>> first_noise_;
  std::optional<NoiseEstimator> free_noise_;  ///< of the residuals of the surface, without a basis
  std::deque<Made> made_;
  Model model_;  ///< of the run
  bool patterns_ = false;
  bool* pattern_was_better_ = nullptr;
};

StepwiseSearch::StepwiseSearch(Proposer& proposer) : engine_(std::make_unique<Engine>(proposer)) {}
StepwiseSearch::~StepwiseSearch() = default;

void StepwiseSearch::take_local_forms(LocalFormsTaken which) { engine_->local_forms = which; }

Model StepwiseSearch::left_of(std::vector<Hypothesis> first, const Model& found) {
  return engine_->left_of(std::move(first), found);
}

Model StepwiseSearch::unless_noise(Model model) { return engine_->unless_noise(std::move(model)); }

Model StepwiseSearch::run(bool patterns, bool& pattern_was_better, std::vector<Hypothesis> first) {
  return engine_->run(patterns, pattern_was_better, std::move(first));
}

}  // namespace trueaxis::diagnose_detail
