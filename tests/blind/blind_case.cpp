// SPDX-License-Identifier: Apache-2.0
#include "blind/blind_case.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <stdexcept>
#include <tuple>

#include "blind/size.hpp"

namespace trueaxis::blind {
namespace {

using virtual_lathe::Noise;

constexpr int most_draws = 400;
constexpr double least_seen = 15.0;  // λ that one search in seven finds

double unit(std::mt19937_64& random) { return static_cast<double>(random() >> 11U) * 0x1p-53; }

double log_between(std::mt19937_64& random, double low, double high) {
  return low * std::pow(high / low, unit(random));
}

template <class T>
const T& any_of(const std::vector<T>& list, std::mt19937_64& random) {
  return list[random() % list.size()];
}

std::shared_ptr<const Bench> shared_bench(const Wanted& wanted, int variant) {
  static std::mutex mutex;
  static std::map<std::tuple<PlanId, SurfaceId, int>, std::shared_ptr<const Bench>> made;
  const std::lock_guard lock(mutex);
  auto& bench = made[{wanted.plan, wanted.surface, variant}];
  if (!bench) {
    bench = std::make_shared<const Bench>(plain_scenario(wanted.plan, wanted.surface, variant));
  }
  return bench;
}

// A sector of 60 deg of the spindle's angle is missing on every revolution.
std::vector<std::size_t> without_sector(const Bench& bench, double from_rad) {
  constexpr double two_pi = 2.0 * std::numbers::pi, missing_rad = two_pi / 6.0;
  std::vector<std::size_t> rows;
  for (Eigen::Index i = 0; i < bench.size(); ++i) {
    const double at = (bench.c_rad()[i] - from_rad) / two_pi;
    if ((at - std::floor(at)) * two_pi >= missing_rad) rows.push_back(static_cast<std::size_t>(i));
  }
  return rows;
}

Noise null_noise(const std::string& name, double sigma_mm, std::mt19937_64& random) {
  Noise noise;
  noise.sigma_mm = sigma_mm;
  if (name == "AR(1) 0.5") noise.rho = 0.5;
  if (name == "AR(1) 0.8") noise.rho = 0.8;
  if (name == "Student t 4") noise.student_dof = 4.0;
  if (name == "outliers") {
    noise.outlier_fraction = 0.01 + 0.01 * unit(random);
    noise.outlier_size_mm = sigma_mm * log_between(random, 8.0, 40.0);
    noise.outliers_one_sided = unit(random) < 0.5;
  }
  return noise;
}

/// Draws one case.
class Maker {
 public:
  Maker(const Wanted& wanted, BlindCase& out) : wanted_(wanted), out_(out), random_(wanted.seed) {
    bench_ = shared_bench(wanted, static_cast<int>(random_() % 4));
    sigma_mm_ = log_between(random_, 0.002, 0.010);
  }

  void make() {
    if (wanted_.kind == Kind::gaps) {
      const double from = 2.0 * std::numbers::pi * unit(random_);
      out_.rows = without_sector(*bench_, from);
      bench_ = std::make_shared<const Bench>(bench_->scenario(), out_.rows);
    }
    out_.bench = bench_;
    out_.scenario = bench_->scenario();
    out_.scenario.seed = random_();
    out_.scenario.probe.states_noise = false;
    out_.scenario.noise.sigma_mm = sigma_mm_;
    switch (wanted_.kind) {
      case Kind::null:
        out_.noise = null_noises()[wanted_.seed % null_noises().size()];
        out_.scenario.noise = null_noise(out_.noise, sigma_mm_, random_);
        return;
      case Kind::one:
      case Kind::gaps:
        return add_several(1, 60.0);
      case Kind::two:
        return add_several(2, 60.0);
      case Kind::three:
        return add_several(3, 100.0);
      case Kind::unknown:
        return add_unknown();
      case Kind::absorbed:
        return add_absorbed();
      case Kind::typical:
        return add_typical();
    }
  }

 private:
  double wanted_lambda(double least, double most) {
    return wanted_.lambda.value_or(log_between(random_, least, most));
  }

  Effect drawn_cause() {
    if (wanted_.effect) return *wanted_.effect;
    if (wanted_.kind != Kind::gaps) {
      return draw_effect(any_of(families(), random_).id, *bench_, random_);
    }
    Effect oval = draw_effect("part.roundness", *bench_, random_);
    oval.parameters["order"] = 2.0, oval.parameters["growth_mm"] = 0.0;
    return oval;
  }

  // A cause with the wanted λ whose sizes are still those of real machines.
  std::optional<Effect> cause(double wanted) {
    const Effect drawn = drawn_cause();
    // P8's lead is so long that feeds of the typical range alias.
    const auto feed = drawn.parameters.find("feed_mm_per_rev");
    if (feed != drawn.parameters.end() && feed->second > 0.5) return std::nullopt;
    const double most = largest_stretch * largest_stretch * at(drawn);
    if (most < 0.5 * wanted) return std::nullopt;
    const Effect sized = sized_for(*bench_, drawn, sigma_mm_, wanted);
    if (over_typical(sized) > largest_stretch) return std::nullopt;
    if (std::abs(at(sized) / wanted - 1.0) > 0.02) return std::nullopt;
    return sized;
  }

  double at(const Effect& effect) { return lambda(*bench_, effect, {}, sigma_mm_, false); }

  // Each keeps four fifths of its λ after what the others can do: together they are still several.
  bool come_apart(const std::vector<Effect>& effects) {
    for (std::size_t i = 0; i < effects.size(); ++i) {
      std::vector<Effect> others = effects;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      const double left = lambda(*bench_, effects[i], others, sigma_mm_, true);
      if (left < 0.8 * out_.lambdas[i]) return false;
    }
    return true;
  }

  void add_several(std::size_t count, double least_lambda) {
    std::vector<Effect>& effects = out_.scenario.effects;
    for (int draw = 0; draw < most_draws; ++draw) {
      const double wanted = wanted_lambda(least_lambda, 400.0);
      const std::optional<Effect> next = cause(wanted);
      if (!next) continue;
      const auto same = [&](const Effect& other) { return other.id == next->id; };
      if (std::ranges::any_of(effects, same)) continue;
      effects.push_back(*next);
      out_.lambdas.push_back(at(*next));
      if (effects.size() > 1 && !come_apart(effects)) {
        effects.pop_back(), out_.lambdas.pop_back();
      }
      if (effects.size() == count) return;
    }
    throw std::runtime_error(out_.id + ": no such effects with this plan");
  }

  // With one helical pass, or reversed on the way back, a spiral is a line of fractional order; at
  // one speed a beat is two lines.
  void add_unknown() {
    std::vector<std::string> ids{"extra.dent"};
    if (wanted_.plan != PlanId::p1 && wanted_.plan != PlanId::p4) ids.emplace_back("extra.spiral");
    const bool speeds =
        wanted_.plan != PlanId::p1 && wanted_.plan != PlanId::p2 && wanted_.plan != PlanId::p4;
    if (speeds) ids.push_back(std::string("extra.beat"));
    const double wanted = wanted_lambda(200.0, 600.0);
    const Effect drawn = draw_effect(any_of(ids, random_), *bench_, random_);
    out_.scenario.effects = {sized_for(*bench_, drawn, sigma_mm_, wanted)};
    out_.lambdas = {at(out_.scenario.effects.front())};
  }

  void add_absorbed() {
    for (int draw = 0; draw < most_draws; ++draw) {
      const Effect drawn = drawn_cause();
      // On a cone a taper is the angle itself, no error of it.
      if (drawn.id == "part.taper" && wanted_.surface == SurfaceId::cone) continue;
      const double seen = at(drawn);
      if (seen > absorbed_lambda) continue;
      out_.scenario.effects = {drawn};
      out_.lambdas = {seen};
      return;
    }
    throw std::runtime_error(out_.id + ": this plan absorbs nothing");
  }

  // One cause of the size that the catalogue expects of it, where it is not far too small to be
  // seen: what the probabilities of a class are stated for.
  void add_typical() {
    for (int draw = 0; draw < most_draws; ++draw) {
      const Effect sized = of_typical_size(drawn_cause(), [this] { return unit(random_); });
      const double seen = at(sized);
      if (seen < least_seen) continue;
      out_.scenario.effects = {sized};
      out_.lambdas = {seen};
      return;
    }
    throw std::runtime_error(out_.id + ": this plan shows nothing");
  }

  const Wanted& wanted_;
  BlindCase& out_;
  std::mt19937_64 random_;
  std::shared_ptr<const Bench> bench_;
  double sigma_mm_ = 0.0;
};

constexpr const char* kind_names[] = {"null",    "one",      "two",  "three",
                                      "unknown", "absorbed", "gaps", "typical"};

}  // namespace

std::string to_string(Kind kind) { return kind_names[static_cast<int>(kind)]; }

std::vector<Kind> all_kinds() {
  return {Kind::null, Kind::one, Kind::two, Kind::three, Kind::unknown, Kind::absorbed, Kind::gaps};
}

Kind kind_from(std::string_view text) {
  for (std::size_t i = 0; i < std::size(kind_names); ++i) {
    if (kind_names[i] == text) return static_cast<Kind>(i);
  }
  throw std::invalid_argument("no kind `" + std::string(text) + '`');
}

std::vector<std::string> null_noises() {
  return {"white", "AR(1) 0.5", "AR(1) 0.8", "Student t 4", "outliers"};
}

BlindCase make_case(const Wanted& wanted) {
  BlindCase made;
  made.wanted = wanted;
  made.id = to_string(wanted.kind) + '-' + to_string(wanted.plan) + '-' +
            to_string(wanted.surface) + '-' + std::to_string(wanted.seed);
  Maker(made.wanted, made).make();
  return made;
}

ProbeStream make_stream(const BlindCase& blind_case) {
  ProbeStream stream = virtual_lathe::simulate(blind_case.scenario);
  if (blind_case.rows.empty()) return stream;
  const auto keep = [&](auto& column) {
    auto kept = column;
    kept.clear();
    for (const std::size_t row : blind_case.rows) kept.push_back(column[row]);
    column = std::move(kept);
  };
  keep(stream.reading_mm), keep(stream.c_rad), keep(stream.position_mm), keep(stream.time_s);
  keep(stream.pass), keep(stream.setup);
  return stream;
}

}  // namespace trueaxis::blind
