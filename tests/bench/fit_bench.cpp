// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include "bench/cone_stream.hpp"
#include "trueaxis/fit.hpp"

namespace trueaxis {
namespace {

void fit_cone(benchmark::State& state, Loss loss) {
  constexpr std::uint64_t seed = 1;
  const ProbeStream stream = peer::make_cone_stream(static_cast<std::size_t>(state.range(0)), seed);
  FitOptions options;
  options.loss = loss;
  for (auto _ : state) {
    const FitResult result = fit(stream, options);
    if (result.status != FitStatus::converged) state.SkipWithError(result.message.c_str());
    benchmark::DoNotOptimize(result.rms_mm);
  }
  // "items_per_second" reads as readings a second, the inverse of ns per reading.
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

BENCHMARK_CAPTURE(fit_cone, plain, Loss::plain)
    ->Arg(500)
    ->Arg(2500)
    ->Arg(100'000)
    ->Arg(1'000'000)
    ->Arg(10'000'000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit_cone, tukey, Loss::tukey)
    ->Arg(500)
    ->Arg(2500)
    ->Arg(100'000)
    ->Arg(1'000'000)
    ->Arg(10'000'000)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace trueaxis
