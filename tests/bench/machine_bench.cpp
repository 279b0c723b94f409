// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <algorithm>

#include "support/random_machine.hpp"

namespace trueaxis {
namespace {

/// The trunnion with all 30 component errors, each of one kind (a quarter each constants,
/// polynomials, Fourier sums of two orders, tables), and all location errors.
struct MachineBench {
  MachineBench() : draw(1), machine(draw.machine(testing::layouts().front())) {
    ErrorModel errors = draw.errors(machine, 0.02, 5e-5);
    std::vector<ErrorTerm> once;
    for (const ErrorTerm& term : errors.terms)
      if (std::ranges::find(once, term.name, &ErrorTerm::name) == once.end()) once.push_back(term);
    errors.terms = once;
    model.emplace(machine, errors);
    setting = first_setting(machine);
    for (int i = 0; i < 1000; ++i) positions.push_back(draw.positions(machine));
  }
  testing::Draw draw;
  Machine machine;
  std::optional<MachineModel> model;
  Setting setting;
  std::vector<AxisPositions> positions;
};

template <class Ask>
void ask(benchmark::State& state, const Ask& of) {
  const MachineBench bench;
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(of(bench, bench.positions[i]));
    i = (i + 1) % bench.positions.size();
  }
}

void machine_pose_nominal(benchmark::State& state) {
  ask(state,
      [](const MachineBench& b, const AxisPositions& q) { return b.model->nominal(q, b.setting); });
}
void machine_pose_actual(benchmark::State& state) {
  ask(state,
      [](const MachineBench& b, const AxisPositions& q) { return b.model->actual(q, b.setting); });
}
void machine_compensate_exactly(benchmark::State& state) {
  ask(state, [](const MachineBench& b, const AxisPositions& q) {
    return compensate_exactly(*b.model, q, b.setting);
  });
}
void machine_compensate_at_pole(benchmark::State& state) {
  ask(state, [](const MachineBench& b, AxisPositions q) {
    q[index_of(AxisName::A)] = 0.0;
    return compensate_exactly(*b.model, q, b.setting);
  });
}
void machine_compensate_by_differential(benchmark::State& state) {
  ask(state, [](const MachineBench& b, const AxisPositions& q) {
    return compensate_by_differential(*b.model, q, b.setting);
  });
}

BENCHMARK(machine_pose_nominal);
BENCHMARK(machine_pose_actual);
BENCHMARK(machine_compensate_exactly);
BENCHMARK(machine_compensate_at_pole);
BENCHMARK(machine_compensate_by_differential);

}  // namespace
}  // namespace trueaxis
