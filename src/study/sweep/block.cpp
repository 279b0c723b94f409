// SPDX-License-Identifier: Apache-2.0
#include "study/sweep/block.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "base/threads.hpp"
#include "simulate/clean_stream.hpp"
#include "study/bound/quantities.hpp"
#include "study/sweep/cut.hpp"
#include "study/sweep/form.hpp"
#include "trueaxis/diagnosis.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis::study {

namespace {

using virtual_lathe::CleanStream;
using virtual_lathe::Scenario;

constexpr std::size_t drawn_bounds = 32;  // bounds averaged where numbers are drawn

/// Some hundredths of a second: short against the sweep, long against handing it out.
std::size_t repeats_per_block(Method method) {
  return method == Method::diagnosis ? 4 : method == Method::fit ? 100 : 50;
}

FitOptions fit_options(const Sweep& sweep, const Scenario& scenario, Method method) {
  FitOptions options;
  options.surface = fitted_surface(sweep);
  options.bore = scenario.part.bore;
  if (method == Method::huber) options.loss = Loss::huber;
  if (method == Method::tukey) options.loss = Loss::tukey;
  return options;
}

bool differ(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double rounding = 1e-9;  // mm: a picometre; rad
  return !std::ranges::equal(a, b, [](double x, double y) { return std::abs(x - y) <= rounding; });
}

/// Effects without which the clean readings would be others.
std::vector<virtual_lathe::Effect> effects_hidden_in(const Scenario& scenario,
                                                     const CleanStream& with) {
  std::vector<virtual_lathe::Effect> out;
  for (std::size_t i = 0; i < scenario.effects.size(); ++i) {
    Scenario less = scenario;
    less.effects.erase(less.effects.begin() + static_cast<std::ptrdiff_t>(i));
    const CleanStream without = virtual_lathe::simulate_clean(less);
    if (differ(with.value_mm, without.value_mm) || !(with.sensor == without.sensor) ||
        differ(with.stream.c_rad, without.stream.c_rad) ||
        differ(with.stream.position_mm, without.stream.position_mm))
      out.push_back(scenario.effects[i]);
  }
  return out;
}

/// A scenario probed without noise, and what its readings are compared with.
struct Prepared {
  Scenario scenario;
  CleanStream clean;
  std::vector<double> truth;
  std::optional<TurnForm> form;               ///< the true one, where it is compared
  std::optional<RepeatedFit> fit;             ///< none for a diagnosis
  std::vector<virtual_lathe::Effect> hidden;  ///< of a diagnosis

  Prepared(const Sweep& sweep, std::size_t cell, std::size_t repeat, Method method)
      : scenario(scenario_of(sweep, cell, repeat)),
        clean(virtual_lathe::simulate_clean(scenario)),
        truth(true_values(scenario, probed_length(clean.stream), fitted_surface(sweep))) {
    if (sweep.form_upr) form = true_form_of_middle_turn(scenario, *sweep.form_upr);
    if (method == Method::diagnosis) {
      hidden = effects_hidden_in(scenario, clean);
    } else {
      fit.emplace(clean.stream, fit_options(sweep, scenario, method));
    }
  }
};

/// Bit 1: something was found; 2: all that is hidden is in the class of a cause.
std::uint8_t found_by(const Diagnosis& diagnosis,
                      const std::vector<virtual_lathe::Effect>& hidden) {
  const auto in_a_class = [&](const virtual_lathe::Effect& effect) {
    return std::ranges::any_of(diagnosis.findings,
                               [&](const Finding& finding) { return finding.may_be(effect.id); });
  };
  const bool all = std::ranges::all_of(hidden, in_a_class);
  return static_cast<std::uint8_t>((diagnosis.verdict != DiagnosisVerdict::ideal ? 1 : 0) +
                                   (all ? 2 : 0));
}

/// @param spread see CellFacts::bound_spread
Bound mean_bound(const Sweep& sweep, std::size_t cell, std::vector<double>& spread) {
  if (sweep.drawn.empty()) return bound_of(scenario_of(sweep, cell, 0), fitted_surface(sweep));
  Bound mean;
  std::vector<double> fourth;  // mean of sd⁴
  const std::size_t count = std::min(drawn_bounds, sweep.repeats);
  for (std::size_t repeat = 0; repeat < count; ++repeat) {
    const Bound one = bound_of(scenario_of(sweep, cell, repeat), fitted_surface(sweep));
    mean.kind = one.kind;
    if (mean.missing == Bound::Missing::nothing) mean.missing = one.missing;
    mean.covariance.resize(one.covariance.size(), 0.0);
    for (std::size_t i = 0; i < one.covariance.size(); ++i)
      mean.covariance[i] += one.covariance[i] / static_cast<double>(count);
    mean.sd.resize(one.sd.size());
    fourth.resize(one.sd.size(), 0.0);
    for (std::size_t i = 0; i < one.sd.size(); ++i)
      fourth[i] += std::pow(one.sd[i], 4) / static_cast<double>(count);
  }
  for (std::size_t i = 0; i < mean.sd.size(); ++i) {
    const double square = mean.covariance[i * mean.sd.size() + i];
    mean.sd[i] = std::sqrt(square);
    spread.push_back(std::max(fourth[i] / (square * square) - 1.0, 0.0) /
                     (static_cast<double>(count) - 1.0));
  }
  return mean;
}

CellFacts facts_of(const Sweep& sweep, std::size_t cell) {
  const Scenario scenario = scenario_of(sweep, cell);
  CellFacts facts;
  const std::size_t count = quantities(fitted_surface(sweep)).size();
  const std::size_t left = compared_quantities(sweep).size() - count;  // of a cut: 0 is perfect
  facts.truth.assign(count + left, std::numeric_limits<double>::quiet_NaN());
  facts.bound.sd.assign(count, std::numeric_limits<double>::quiet_NaN());
  facts.bound.covariance.assign(count * count, std::numeric_limits<double>::quiet_NaN());
  try {
    const CleanStream clean = virtual_lathe::simulate_clean(scenario);
    facts.readings = clean.value_mm.size();
    facts.truth = true_values(scenario, probed_length(clean.stream), fitted_surface(sweep));
    facts.truth.resize(count + left, 0.0);
    if (sweep.form_upr)
      std::ranges::copy(true_form_of_middle_turn(scenario, *sweep.form_upr).value_mm,
                        facts.truth.end() - static_cast<std::ptrdiff_t>(form_quantities().size()));
    if (cell_at(sweep, cell).method == Method::diagnosis) {
      const Scenario first = scenario_of(sweep, cell, 0);
      facts.hidden = effects_hidden_in(first, virtual_lathe::simulate_clean(first)).size();
    }
    facts.bound = mean_bound(sweep, cell, facts.bound_spread);
  } catch (const InputError&) {  // its repeats say why
  }
  return facts;
}

/// Runs the repeats of one cell.
struct CellRunner {
  const Sweep& sweep;
  std::size_t cell;
  Method method;
  std::size_t quantity_count;
  std::optional<Prepared> shared;  ///< where every repeat probes the same
  std::vector<double> reading_mm;

  void run_repeat(std::size_t repeat, BlockResult& out) {
    const bool alone = !sweep.drawn.empty();
    std::optional<Prepared> own;
    if (alone) own.emplace(sweep, cell, repeat, method);
    if (!alone && !shared) shared.emplace(sweep, cell, 0, method);
    Prepared& prepared = alone ? *own : *shared;
    reading_mm.resize(prepared.clean.value_mm.size());
    virtual_lathe::draw_readings(prepared.clean, prepared.scenario.noise,
                                 seed_of(sweep, cell, repeat), reading_mm);
    if (prepared.fit) {
      note((*prepared.fit)(reading_mm), prepared, out);
      note_form(prepared, out);
      return;
    }
    ProbeStream stream = prepared.clean.stream;
    stream.reading_mm = reading_mm;
    DiagnoseOptions options;
    options.fit = fit_options(sweep, prepared.scenario, method);
    options.threads = 1;
    const Diagnosis diagnosis = diagnose(stream, options);
    out.found.back() = found_by(diagnosis, prepared.hidden);
    note(diagnosis.extended, prepared, out);
    note_form(prepared, out);
  }

  /// The values of the readings as they are, whatever the method; the last quantities of the row.
  void note_form(const Prepared& prepared, BlockResult& out) const {
    if (!sweep.form_upr) return;
    ProbeStream stream = prepared.clean.stream;
    stream.reading_mm = reading_mm;
    const TurnForm found =
        form_of_middle_turn(stream, *sweep.form_upr, prepared.scenario.part.bore);
    const std::size_t count = found.value_mm.size(), first = out.error.size() - count;
    for (std::size_t c = 0; c < count; ++c) {
      out.error[first + c] = found.value_mm[c] - prepared.form->value_mm[c];
      out.u[first + c] = found.u_mm[c];
    }
  }

  void note(const FitResult& fit, const Prepared& prepared, BlockResult& out) const {
    const std::vector<double>& truth = prepared.truth;
    if (fit.status != FitStatus::converged) {
      ++out.failures;
      if (out.why.empty()) out.why = std::string(to_string(fit.status)) + ": " + fit.message;
      return;
    }
    const Estimated estimate = estimated(fit);
    const std::size_t row = out.error.size() - quantity_count;
    for (std::size_t i = 0; i < std::min(truth.size(), estimate.value.size()); ++i) {
      out.error[row + i] = estimate.value[i] - truth[i];
      out.u[row + i] = estimate.u[i];
    }
    if (!prepared.scenario.cut) return;
    const double n = std::sqrt(1.0 - truth[2] * truth[2] - truth[3] * truth[3]);
    const Axis axis{truth[0], truth[1], truth[2] / n, truth[3] / n, 0.0};
    const CutOutcome left = cut_about(*prepared.scenario.cut, fit.axis, axis);
    out.error[row + truth.size()] = left.coaxiality_mm;
    out.u[row + truth.size()] = 0.5 * left.at_most_mm;  // U = 2 u is what a run states
    out.error[row + truth.size() + 1] = left.residual_mm;
  }
};

}  // namespace

struct Worker::Impl {
  const Sweep& sweep;
  std::optional<CellRunner> runner;
};

Worker::Worker(const Sweep& sweep) : impl_(std::make_unique<Impl>(Impl{sweep, {}})) {}
Worker::~Worker() = default;

BlockResult Worker::run(const Block& block) {
  const Sweep& sweep = impl_->sweep;
  expects(block.first_repeat + block.count <= sweep.repeats, "repeats of the sweep");
  const auto begun = std::chrono::steady_clock::now();
  if (!impl_->runner || impl_->runner->cell != block.cell)
    impl_->runner.emplace(CellRunner{sweep,
                                     block.cell,
                                     cell_at(sweep, block.cell).method,
                                     compared_quantities(sweep).size(),
                                     {},
                                     {}});
  CellRunner& runner = *impl_->runner;
  BlockResult out;
  out.block = block;
  out.quantities = runner.quantity_count;
  if (block.first_repeat == 0) out.facts.push_back(facts_of(sweep, block.cell));
  for (std::size_t i = 0; i < block.count; ++i) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    out.error.insert(out.error.end(), out.quantities, none);
    out.u.insert(out.u.end(), out.quantities, none);
    if (runner.method == Method::diagnosis) out.found.push_back(0);
    try {
      runner.run_repeat(block.first_repeat + i, out);
    } catch (const InputError& error) {
      ++out.failures;
      if (out.why.empty()) out.why = error.what();
    }
  }
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return out;
}

std::vector<Block> blocks_of(const Sweep& sweep) {
  std::vector<Block> blocks;
  for (std::size_t cell = 0; cell < cell_count(sweep); ++cell) {
    const std::size_t most = repeats_per_block(cell_at(sweep, cell).method);
    for (std::size_t first = 0; first < sweep.repeats; first += most)
      blocks.push_back({cell, first, std::min(most, sweep.repeats - first)});
  }
  return blocks;
}

void run_blocks(const Sweep& sweep, std::span<const Block> blocks, int threads,
                const std::function<void(BlockResult&&)>& finished) {
  std::mutex one_at_a_time;
  for_each_index_with(blocks.size(), threads, [&]() -> IndexedWork {
    return [&, worker = std::make_shared<Worker>(sweep)](std::size_t i) {
      BlockResult result = worker->run(blocks[i]);
      const std::lock_guard lock(one_at_a_time);
      finished(std::move(result));
    };
  });
}

}  // namespace trueaxis::study
