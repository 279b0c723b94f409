// SPDX-License-Identifier: Apache-2.0
#include "blind_machine/cases.hpp"

#include <fmt/format.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "blind_machine/unknown.hpp"

namespace trueaxis::blind_machine {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

double between(std::mt19937_64& engine, double low, double high) {
  return low + (high - low) * std::uniform_real_distribution<>(0.0, 1.0)(engine);
}
std::size_t below(std::mt19937_64& engine, std::size_t count) {
  return std::uniform_int_distribution<std::size_t>(0, count - 1)(engine);
}

ErrorModel location_errors(const Machine& machine, std::mt19937_64& engine) {
  ErrorModel errors;
  std::normal_distribution<> normal;
  std::vector<std::size_t> bodies{spindle_body};
  for (const MachineAxis& axis : machine.axes) bodies.push_back(index_of(axis.name));
  for (const std::size_t body : bodies)
    for (std::size_t direction = 0; direction < 6; ++direction) {
      const ErrorName name{false, direction, body};
      if (without_effect(name) || (body == spindle_body && direction == 5)) continue;
      errors.terms.push_back(
          {name, ConstantError{normal(engine) * (name.angular() ? 50e-6 : 0.02)}});
    }
  return errors;
}

struct Drawn {
  Effect effect;
  VectorXd coefficients, mu;
};

/// An effect of the catalogue with λ drawn between 60 and 400, of plausible size; a slip in twenty.
Drawn drawn_effect(const Judge& judge, const Plan& plan, std::mt19937_64& engine) {
  for (;;) {
    Drawn out;
    Eigen::MatrixXd columns;
    if (below(engine, 20) == 0) {
      const std::size_t visit = plan.visits.size() / 4 + below(engine, plan.visits.size() / 2);
      out.effect = {"ball.slip", {}, false};
      for (std::size_t k = 0; k < 3; ++k) {
        Fault unit;
        unit.slip_at = visit + 1;
        unit.slip_mm[k] = 1.0;
        out.effect.units.push_back(unit);
      }
      columns = judge.slip_columns(visit);
    } else {
      const std::size_t t = below(engine, judge.effects().size());
      out.effect = judge.effects()[t];
      columns = judge.columns(t);
    }
    VectorXd direction(columns.cols());
    for (double& one : direction) one = std::normal_distribution<>()(engine);
    const double norm = (columns * direction).norm();
    const double wanted = std::sqrt(between(engine, 60.0, 400.0));
    if (!(norm > 1e-6)) continue;
    out.coefficients = direction * (wanted / norm);
    if (out.coefficients.norm() > (out.effect.angle ? largest_rad : largest_mm)) continue;
    out.mu = columns * out.coefficients;
    return out;
  }
}

/// Each of two effects has 50 and more after the other.
bool told_apart(const Drawn& a, const Drawn& b, const Judge& judge) {
  const auto columns = [&](const Drawn& one) {
    for (const Fault& unit : one.effect.units)
      if (unit.slip_at > 0) return judge.slip_columns(unit.slip_at - 1);
    return judge.columns(judge.index(one.effect.name));
  };
  return a.effect.name != b.effect.name && Judge::left(a.mu, columns(b)) >= 50.0 &&
         Judge::left(b.mu, columns(a)) >= 50.0;
}

void hide(Case& out, const Drawn& drawn) {
  out.fault = with(out.fault, drawn.effect, drawn.coefficients);
  Effect hidden = drawn.effect;
  Fault whole = with({}, drawn.effect, drawn.coefficients);
  hidden.units = {whole};
  out.hidden.push_back(hidden);
  out.truth.push_back(drawn.effect.name);
  out.lambda.push_back(drawn.mu.squaredNorm());
}

// λ of 200 to 600, of which no two effects of the catalogue leave less than 50.
void hide_unknown(Case& out, const Judge& judge, std::mt19937_64& engine) {
  const int which = static_cast<int>(out.wanted.seed % 4);
  for (;;) {
    Drawn drawn{drawn_unknown(out.layout->machine, out.plan, which, engine), VectorXd(1), {}};
    const double step = drawn.effect.angle ? 1e-5 : 1e-3;
    const VectorXd unit = judge.effect_of(with({}, drawn.effect, VectorXd::Constant(1, step)));
    const double size = std::sqrt(between(engine, 200.0, 600.0)) / unit.norm() * step;
    if (!(size <= (drawn.effect.angle ? largest_rad : largest_mm))) continue;
    drawn.coefficients[0] = size;
    drawn.mu = unit * (size / step);
    if (judge.left_by_two(drawn.mu) < 50.0) continue;
    hide(out, drawn);
    return;
  }
}

// An effect of the size that matters, of which the positions show less than λ = 2.
bool hide_absorbed(Case& out, const Judge& judge, std::mt19937_64& engine) {
  for (int tries = 0; tries < 2000; ++tries) {
    const std::size_t t = below(engine, judge.effects().size());
    const Effect& effect = judge.effects()[t];
    VectorXd direction(judge.columns(t).cols());
    for (double& one : direction) one = std::normal_distribution<>()(engine);
    direction *= (effect.angle ? typical_rad : typical_mm) / direction.norm();
    const VectorXd mu = judge.columns(t) * direction;
    if (mu.squaredNorm() > 2.0) continue;
    hide(out, {effect, direction, mu});
    return true;
  }
  return false;
}

}  // namespace

std::string to_string(Kind kind) {
  constexpr const char* names[] = {"silent", "one", "two", "unknown", "absorbed", "advised"};
  return names[static_cast<int>(kind)];
}

std::vector<Kind> all_kinds() {
  return {Kind::silent, Kind::one, Kind::two, Kind::unknown, Kind::absorbed, Kind::advised};
}

double goal(Kind kind) {
  constexpr double goals[] = {0.99, 0.97, 0.94, 0.95, 0.98, 0.90};
  return goals[static_cast<int>(kind)];
}

std::string Wanted::id() const {
  return fmt::format("{}-{}-{}-{}", to_string(kind), layout, plan, seed);
}

Case make_case(const Wanted& wanted) {
  std::mt19937_64 engine(wanted.seed);
  Case out{wanted, &layouts()[wanted.layout], {}, {}, {}, {}, {}};
  const Machine& machine = out.layout->machine;
  out.plan = plan_of(wanted.plan, *out.layout, engine());
  out.fault.errors = location_errors(machine, engine);
  out.fault.end_s = out.plan.visits.back().time_s;
  if (wanted.kind == Kind::silent) return out;
  const Judge judge(machine, out.plan);
  // What the advice is asked about: in turn an effect with rival causes or none, and one that is
  // absorbed.
  const bool absorbed =
      wanted.kind == Kind::absorbed || (wanted.kind == Kind::advised && wanted.seed % 2 == 0);
  if (wanted.kind == Kind::unknown) {
    hide_unknown(out, judge, engine);
  } else if (absorbed) {
    if (!hide_absorbed(out, judge, engine) && wanted.kind == Kind::advised)
      hide(out, drawn_effect(judge, out.plan, engine));
  } else {
    const Drawn first = drawn_effect(judge, out.plan, engine);
    hide(out, first);
    while (wanted.kind == Kind::two && out.hidden.size() < 2) {
      const Drawn second = drawn_effect(judge, out.plan, engine);
      if (told_apart(first, second, judge)) hide(out, second);
    }
  }
  return out;
}

std::string measurement_text(const Case& one, const Plan& plan, std::uint64_t noise_seed) {
  const auto read = readings(one.layout->machine, plan, one.fault);
  std::mt19937_64 engine(noise_seed);
  std::normal_distribution<> noise(0.0, plan.noise_mm);
  std::string text = fmt::format("# kind: {}\n# noise: {:.9g} um\nsetup,ball",
                                 plan.bar ? "bar" : "ball", plan.noise_mm / mm_per_um);
  std::vector<std::size_t> axes;
  for (std::size_t k = 0; k < axis_count; ++k)
    if (one.layout->machine.find(static_cast<AxisName>(k)) != nullptr) axes.push_back(k);
  for (const std::size_t k : axes)
    text += fmt::format(",{}[{}]", "XYZABC"[k], k < 3 ? "mm" : "deg");
  text += plan.bar ? ",L[mm]" : ",dX[um],dY[um],dZ[um]";
  text += ",tool_length[mm],t[s]\n";
  const std::size_t n = plan.numbers();
  for (std::size_t i = 0; i < plan.visits.size(); ++i) {
    const Visit& visit = plan.visits[i];
    text += fmt::format("1,{}", visit.ball);
    for (const std::size_t k : axes)
      text += fmt::format(",{:.12g}", visit.axes[k] / (k < 3 ? 1.0 : rad_per_deg));
    for (std::size_t k = 0; k < n; ++k) {
      const double value = read[n * i + k] + noise(engine);
      text += plan.bar ? fmt::format(",{:.12g}", value) : fmt::format(",{:.9g}", value / mm_per_um);
    }
    text += fmt::format(",{:.9g},{:.9g}\n", visit.tool_mm, visit.time_s);
  }
  return text;
}

}  // namespace trueaxis::blind_machine
