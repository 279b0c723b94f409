// SPDX-License-Identifier: Apache-2.0
// Reading and writing of streams: bytes per second of text, and the passes of what was read.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>

#include "measure/files/stream_csv.hpp"
#include "measure/files/stream_csv_write.hpp"
#include "measure/passes.hpp"
#include "trueaxis/units.hpp"

namespace {

namespace fs = std::filesystem;

/// A helical pass of `rows` readings, 29 bytes each, wrapped C; removed at the end.
class StreamFile {
 public:
  explicit StreamFile(std::int64_t rows)
      : path_((fs::temp_directory_path() / ("trueaxis_bench_" + std::to_string(rows) + ".csv"))
                  .string()) {
    std::FILE* out = std::fopen(path_.c_str(), "w");
    if (out == nullptr) return;
    std::fputs("X_M,C,Z\n", out);
    for (std::int64_t i = 0; i < rows; ++i) {
      const double c_deg = std::fmod(0.36 * static_cast<double>(i), 360.0);
      std::fprintf(out, "%.6f,%.4f,%.6f\n", 40.0 + 0.2 * std::cos(c_deg * trueaxis::rad_per_deg),
                   c_deg, 6e-6 * static_cast<double>(i));
    }
    std::fclose(out);
  }
  ~StreamFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  StreamFile(const StreamFile&) = delete;
  StreamFile& operator=(const StreamFile&) = delete;
  const std::string& path() const { return path_; }
  std::int64_t bytes() const { return static_cast<std::int64_t>(fs::file_size(path_)); }

 private:
  std::string path_;
};

void read_stream(benchmark::State& state) {
  const StreamFile file(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(trueaxis::read_stream_csv(file.path()));
  state.SetBytesProcessed(state.iterations() * file.bytes());
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(read_stream)->RangeMultiplier(10)->Range(1000, 10000000)->Unit(benchmark::kMillisecond);

void write_stream(benchmark::State& state) {
  const StreamFile file(state.range(0));
  const trueaxis::ProbeStream stream = trueaxis::read_stream_csv(file.path());
  const std::string copy = file.path() + ".copy";
  for (auto _ : state) trueaxis::write_stream_csv(stream, copy);
  state.SetItemsProcessed(state.iterations() * state.range(0));
  fs::remove(copy);
}
BENCHMARK(write_stream)->Arg(1000000)->Unit(benchmark::kMillisecond);

void find_passes(benchmark::State& state) {
  const StreamFile file(state.range(0));
  const trueaxis::ProbeStream stream = trueaxis::read_stream_csv(file.path());
  for (auto _ : state) benchmark::DoNotOptimize(trueaxis::find_passes(stream));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(find_passes)->Arg(1000000)->Unit(benchmark::kMillisecond);

}  // namespace
