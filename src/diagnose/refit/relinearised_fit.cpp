// SPDX-License-Identifier: Apache-2.0
#include "diagnose/refit/relinearised_fit.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "base/threads.hpp"
#include "diagnose/refit/places_before.hpp"
#include "diagnose/refit/timing.hpp"
#include "diagnose/regression/noise.hpp"

namespace trueaxis::diagnose_detail {
namespace {

constexpr int most_rounds = 3, rounds_of_play = 6;

/// Whether a term moves the spindle angle that a reading tells of. (A backlash moves Z, in which X
/// is straight.)
bool turns(const Hypothesis& h) {
  const auto* shift = h.effect ? std::get_if<ArgumentShift>(&h.effect->term) : nullptr;
  return is_lag(h) || (shift != nullptr && shift->by != ArgumentShift::By::backlash);
}

/// By how much, per unit of the term.
double turn_per_unit(const Hypothesis& h, double speed_rad_per_s) {
  const auto* shift = std::get_if<ArgumentShift>(&h.effect->term);
  const bool constant = shift != nullptr && shift->by == ArgumentShift::By::angle;
  return constant ? 1.0 : -speed_rad_per_s;
}

void add(std::vector<double>& to, const std::vector<double>& values, double factor = 1.0) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += factor * values[i];
}

std::vector<double> contribution_of(const Hypothesis& h, const LinearisationPoint& point,
                                    const Eigen::VectorXd& linear, int threads) {
  return contribution(point, {&h, 1}, span_of(linear), threads);
}

/// Where a lag or a play is of the size that was found.
void linearise_at_sizes(std::vector<Hypothesis>& terms, const Eigen::VectorXd& found) {
  Eigen::Index at = 0;
  for (Hypothesis& h : terms) {
    if (is_linearised_at_its_size(h)) {
      const Refinement& place = *h.effect->refinement;
      h.shape.*place.parameter = std::clamp(found(at), place.low, place.high);
    }
    at += static_cast<Eigen::Index>(h.columns());
  }
}

bool is_height(const Hypothesis& h) {
  const auto* line = h.effect ? std::get_if<ProbeLine>(&h.effect->term) : nullptr;
  return line != nullptr && line->of == ProbeLine::Of::height;
}

/// Whether a term moves the part or the probe, so that what is known of both is of its size.
bool moves(const Hypothesis& h) { return moves_probe(h) || is_step_at_once(h); }

/// Whether readings stay on their side of the axis without the terms: those of an absurd model do
/// not.
bool leaves_a_part(const ProbeStream& stream, const std::vector<double>& taken_mm) {
  if (stream.kind == StreamKind::face || stream.indication == Indication::relative) return true;
  for (std::size_t i = 0; i < taken_mm.size(); ++i)
    if (!((stream.reading_mm[i] - taken_mm[i]) * stream.reading_mm[i] > 0.0)) return false;
  return true;
}

/// The height of the probe, mm.
double height_of(const std::vector<Hypothesis>& terms, const Eigen::VectorXd& found) {
  double out_mm = 0.0;
  Eigen::Index at = 0;
  for (const Hypothesis& h : terms) {
    if (is_height(h)) out_mm += found(at);
    at += static_cast<Eigen::Index>(h.columns());
  }
  return out_mm;
}

/// Takes off what a shift of the base does to X, block by block.
void subtract_base(std::vector<double>& from, const LinearisationPoint& point,
                   const Eigen::VectorXd& shift, int threads) {
  constexpr std::size_t block = 4096;
  const auto work = [&](std::size_t k) {
    const std::size_t begin = k * block, end = std::min(begin + block, point.size());
    Eigen::MatrixXd columns(static_cast<Eigen::Index>(end - begin), shift.size());
    std::vector<double*> places;
    for (Eigen::Index j = 0; j < shift.size(); ++j) places.push_back(columns.col(j).data());
    PointRoom room;
    point.fill_base(point.part(begin, end, room), places);
    for (Eigen::Index j = 0; j < shift.size(); ++j)
      for (std::size_t i = begin; i < end; ++i)
        from[i] -= shift(j) * columns(static_cast<Eigen::Index>(i - begin), j);
  };
  for_each_index((point.size() + block - 1) / block, threads, work);
}

}  // namespace

RelinearisedFit::RelinearisedFit(const IdealModel& ideal, const Model& model)
    : ideal_(ideal), terms_(model.terms) {
  if (!terms_.empty()) relinearise(model);
  solve_about(model.phi);
  const int rounds = std::ranges::any_of(terms_, plays) ? rounds_of_play : most_rounds;
  for (int round = 0; round < rounds && is_far(); ++round) {
    std::vector<double> taken_mm = taken_off_mm();
    if (!leaves_a_part(ideal.stream, taken_mm)) break;
    place(coefficients_of_terms(), cleaned(std::move(taken_mm)).fit);
    solve_about(model.phi);
  }
}

/// All about the point, or the first.
void RelinearisedFit::solve_about(const std::vector<double>& phi) {
  const Problem& first = ideal_.problem;
  deviation_mm_ = deviation_from(ideal_.stream, point_ ? *point_ : first.point, first.threads);
  if (!known_mm_.empty()) add(deviation_mm_, known_mm_);
  if (!moved_mm_.empty()) add(deviation_mm_, moved_mm_);
  problem_.emplace(first.about(point_ ? *point_ : first.point, deviation_mm_));
  joint_.emplace(*problem_, phi, terms_, terms_.size());
  const Eigen::VectorXd found = coefficients_of_terms();
  effect_mm_ = contribution(problem_->point, terms_, span_of(found), first.threads);
  if (moved_) add(effect_mm_, turned_mm_);
  if (!known_mm_.empty()) add(effect_mm_, known_mm_, -1.0);
  if (!beyond_mm_.empty()) add(effect_mm_, beyond_mm_);
}

Eigen::VectorXd RelinearisedFit::coefficients_of_terms() const {
  return joint_->solution.coefficients.tail(static_cast<Eigen::Index>(columns_of(terms_)));
}

/// Whether a size that moves part or probe has moved on by more than its u: lobes of 10 µm at nine
/// per revolution are turned nine times as far as the surface.
bool RelinearisedFit::is_far() const {
  const Eigen::VectorXd found = coefficients_of_terms();
  const Eigen::Index before = joint_->solution.coefficients.size() - found.size();
  Eigen::Index at = 0;
  for (const Hypothesis& h : terms_) {
    const Eigen::Index end = at + static_cast<Eigen::Index>(h.columns());
    for (; at < end; ++at) {
      const double u =
          joint_->sigma_mm * std::sqrt(joint_->solution.inverse(before + at, before + at));
      const double far = plays(h) ? 0.2 * u : u;
      if ((moves(h) || plays(h)) && placed_at_.size() > 0 &&
          std::abs(found(at) - placed_at_(at)) > far)
        return true;
    }
  }
  return false;
}

/// What the terms add to the readings, for the surface.
std::vector<double> RelinearisedFit::taken_off_mm() const {
  std::vector<double> out = effect_mm_;
  if (moved_) add(out, turned_mm_, -1.0);
  return out;
}

CleanedFit RelinearisedFit::cleaned(std::vector<double> taken_off_mm) const {
  return fit_cleaned(moved_ ? *moved_ : ideal_.stream, ideal_.fit_options, std::move(taken_off_mm),
                     ideal_.problem.mask, ideal_.masked, moved_ ? nullptr : &ideal_.fit);
}

FitResult RelinearisedFit::shifted(const Eigen::VectorXd& shift, BaseUncertainty base) const {
  const LinearisationPoint& point = problem_->point;
  const BaseUncertainty named = uncertainty_of(*joint_);
  base.sigma_mm = named.sigma_mm, base.whitened = named.whitened;
  if (shift.isZero(0.0)) return extended_fit(cleaned_, point, base);
  // Readings of which the surface with that base is the best one.
  std::vector<double> moved = taken_off_mm();
  subtract_base(moved, point, shift, problem_->threads);
  return extended_fit(cleaned(std::move(moved)), point, base);
}

std::vector<double> RelinearisedFit::residual_mm() const {
  return remainder(problem_->point, deviation_mm_, terms_, joint_->solution.coefficients,
                   problem_->threads);
}

LinearisationPoint RelinearisedFit::point_at(const ProbeStream& stream, const Place& place) const {
  const LinearisationPoint& first = ideal_.point;
  LinearisationPoint out =
      linearise_at(stream, place.after, first.base, first.bore, ideal_.problem.threads,
                   place.before, place.height_mm, first.passes);
  out.play_side = play_side_;
  out.as_read = std::ranges::none_of(terms_, plays);
  out.ball_radius_mm = first.ball_radius_mm;
  return out;
}

/// About the extended surface, where the terms leave one.
void RelinearisedFit::relinearise(const Model& model) {
  const Problem& first = ideal_.problem;
  FitOptions bare = ideal_.fit_options;  // a place is wanted, not its uncertainty
  bare.influences.clear();
  const Joint near(first, model.phi, terms_, terms_.size());
  const Eigen::VectorXd found =
      near.solution.coefficients.tail(static_cast<Eigen::Index>(columns_of(terms_)));
  std::vector<double> taken_mm = contribution(first.point, terms_, span_of(found), first.threads);
  if (!leaves_a_part(ideal_.stream, taken_mm)) return;
  place(found,
        fit_cleaned(ideal_.stream, bare, std::move(taken_mm), first.mask, ideal_.masked).fit);
}

/// Takes the point to where part and probe are with these sizes.
/// @param extended the surface then
void RelinearisedFit::place(const Eigen::VectorXd& found, const FitResult& extended) {
  if (!is_diagnosable(extended)) return;
  const LinearisationPoint& about = point_ ? *point_ : ideal_.point;
  Place place{.after = clampings_of(extended, ideal_.ball_mm)};
  if (!about.base.face) {
    place.before = places_before(about, terms_, found, place.after);
    place.height_mm = height_of(terms_, found);
  }
  if (!every_line_meets(ideal_.stream, place.after, place.before, place.height_mm))
    place = {.after = std::move(place.after)};
  const bool behind = std::ranges::any_of(terms_, plays);
  if (behind || std::ranges::any_of(terms_, moves)) placed_at_ = found;
  linearise_at_sizes(terms_, found);
  play_side_ = SharedColumn();
  moved_.reset();
  if (std::ranges::any_of(terms_, turns)) {
    turn(found, place);
  } else {
    point_ = point_at(ideal_.stream, place);
  }
  if (behind) take_up_play(found, place);
  note_moved(found, place);
}

/// Moves what all terms are about to the angles that delays and lags make true, and notes what is
/// known of X: X(a) = X(a') + (a − a') ∂X/∂a.
void RelinearisedFit::turn(const Eigen::VectorXd& found, const Place& place) {
  const LinearisationPoint& first = ideal_.point;
  moved_ = ideal_.stream;
  Eigen::Index at = 0;
  for (const Hypothesis& h : terms_) {
    const double by = found(at);
    for (std::size_t p = 0; turns(h) && p < first.passes.size(); ++p) {
      const Pass& pass = first.passes[p];
      for (std::size_t i = pass.begin; i < pass.end; ++i)
        moved_->c_rad[i] += by * turn_per_unit(h, pass.speed_rad_per_s);
    }
    at += static_cast<Eigen::Index>(h.columns());
  }
  const LinearisationPoint recorded = point_at(ideal_.stream, place);
  point_ = point_at(*moved_, place);
  turned_mm_ = point_->column(&PointPart::x);
  add(turned_mm_, recorded.column(&PointPart::x), -1.0);
  known_mm_.assign(first.size(), 0.0);
  at = 0;
  for (const Hypothesis& h : terms_) {
    const Eigen::VectorXd by = found.segment(at, static_cast<Eigen::Index>(h.columns()));
    at += by.size();
    if (is_lag(h)) {
      add(known_mm_, contribution_of(h, *point_, by, ideal_.problem.threads));
      add(known_mm_, timing_mm(h, h.shape.time_constant_s, recorded), -1.0);
      add(known_mm_, turned_mm_);
    } else if (turns(h)) {
      for (const Pass& pass : first.passes) {
        const double per_rad = by(0) * turn_per_unit(h, pass.speed_rad_per_s);
        const auto work = [&](const PointPart& at) {
          for (std::size_t k = 0; k < at.size(); ++k)
            known_mm_[at.begin + k] += per_rad * at.dx_dc[k];
        };
        point_->for_each_part(work, pass.begin, pass.end);
      }
    }
  }
}

/// What a play does to X on its way over the part with all other terms.
BehindPlay RelinearisedFit::behind_play_on(const LinearisationPoint& way,
                                           const Eigen::VectorXd& found) const {
  Eigen::VectorXd others = found;
  double play_mm = 0.0;
  Eigen::Index at = 0;
  for (const Hypothesis& h : terms_) {
    const auto own = static_cast<Eigen::Index>(h.columns());
    if (plays(h)) play_mm = h.shape.*h.effect->refinement->parameter;
    if (plays(h) || turns(h) || is_step_at_once(h) || is_height(h))
      others.segment(at, own).setZero();
    at += own;
  }
  return behind_play(way, terms_, span_of(others), play_mm);
}

/// Moves readings to where X took the play up.
void RelinearisedFit::take_up_play(const Eigen::VectorXd& found, const Place& place) {
  const std::vector<double> straight_mm = point_->column(&PointPart::x);
  BehindPlay behind = behind_play_on(*point_, found);
  ProbeStream moved = moved_ ? *moved_ : ideal_.stream;
  moved.c_rad = std::move(behind.c_rad);
  if (moved.has_position()) moved.position_mm = std::move(behind.z_mm);
  if (!moved.time_s.empty()) moved.time_s = std::move(behind.time_s);
  play_side_ = SharedColumn(std::move(behind.side));
  if (!moved_) turned_mm_.assign(straight_mm.size(), 0.0);
  moved_ = std::move(moved);
  point_ = point_at(*moved_, place);
  add(turned_mm_, point_->column(&PointPart::x));
  add(turned_mm_, straight_mm, -1.0);
}

/// Readings before a slip are about where the part was then, and all readings about the height of
/// the probe. So what both do to X is known to all orders: (dx² + dy²)/2R and h dy/R beyond the
/// first.
void RelinearisedFit::note_moved(const Eigen::VectorXd& found, const Place& place) {
  moved_mm_.clear(), beyond_mm_.clear();
  if (place.before.empty() && place.height_mm == 0.0) return;
  const Problem& first = ideal_.problem;
  moved_mm_.assign(first.point.size(), 0.0);
  Eigen::Index at = 0;
  for (const Hypothesis& h : terms_) {
    const Eigen::VectorXd by = found.segment(at, static_cast<Eigen::Index>(h.columns()));
    at += by.size();
    if (is_step_at_once(h) || is_height(h))
      add(moved_mm_, contribution_of(h, *point_, by, first.threads));
  }
  beyond_mm_ = point_->column(&PointPart::x);
  const LinearisationPoint alone =
      point_at(moved_ ? *moved_ : ideal_.stream, {.after = place.after});
  add(beyond_mm_, alone.column(&PointPart::x), -1.0);
  add(beyond_mm_, moved_mm_, -1.0);
}

bool moves_probe(const Hypothesis& h) { return turns(h) || is_height(h); }

bool plays(const Hypothesis& h) { return is_linearised_at_its_size(h) && !turns(h); }

}  // namespace trueaxis::diagnose_detail
