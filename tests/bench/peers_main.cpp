// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/cone_stream.hpp"
#include "bench/peers.hpp"

/// What scripts/bench_peers calls: one code in one process, so that its peak memory is its own.
///   write N FILE · run CODE FILE SECONDS · cost FILE x0 y0 l m k half_angle · codes
/// FILE: C (rad), Z (mm), X_M (mm) as three columns of doubles, one after the other.
namespace {

using trueaxis::ProbeStream;
namespace peer = trueaxis::peer;

constexpr std::uint64_t seed = 20240601;

void write_stream(std::size_t count, const std::string& path) {
  const ProbeStream stream = peer::make_cone_stream(count, seed);
  std::ofstream file(path, std::ios::binary);
  for (const auto* column : {&stream.c_rad, &stream.position_mm, &stream.reading_mm}) {
    file.write(reinterpret_cast<const char*>(column->data()),
               static_cast<std::streamsize>(count * sizeof(double)));
  }
  if (!file) throw std::runtime_error("cannot write " + path);
}

ProbeStream read_stream(const std::string& path) {
  const std::size_t count = std::filesystem::file_size(path) / (3 * sizeof(double));
  ProbeStream stream;
  std::ifstream file(path, std::ios::binary);
  for (auto* column : {&stream.c_rad, &stream.position_mm, &stream.reading_mm}) {
    column->resize(count);
    file.read(reinterpret_cast<char*>(column->data()),
              static_cast<std::streamsize>(count * sizeof(double)));
  }
  if (!file) throw std::runtime_error("cannot read " + path);
  return stream;
}

/// Peak resident memory. (ru_maxrss of getrusage would count the parent's before exec as well.)
double peak_mib() {
  std::ifstream status("/proc/self/status");
  std::string key;
  double kib = 0.0;
  while (status >> key) {
    if (key == "VmHWM:") status >> kib;
  }
  return kib / 1024.0;
}

/// One warm-up, then timed fits for about `seconds`, one at least.
nlohmann::json run(const peer::PeerCode& code, const ProbeStream& stream, double seconds) {
  constexpr int most_repetitions = 2000;
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  peer::PeerFit fitted = code.run(stream);
  std::vector<double> whole_ms, solver_ms;
  const Clock::time_point begin = Clock::now();
  do {
    const Clock::time_point start = Clock::now();
    fitted = code.run(stream);
    whole_ms.push_back(1e3 * since(start));
    solver_ms.push_back(fitted.solver_ms);
  } while (since(begin) < seconds && whole_ms.size() < most_repetitions);
  return {{"code", code.name},
          {"readings", stream.size()},
          {"ms", whole_ms},
          {"solver_ms", solver_ms},
          {"p", fitted.p},
          {"iterations", fitted.iterations},
          {"converged", fitted.converged},
          {"peak_mib", peak_mib()}};
}

int dispatch(const std::vector<std::string>& args) {
  const std::string command = args.empty() ? "" : args[0];
  if (command == "write" && args.size() == 3) {
    write_stream(std::stoull(args[1]), args[2]);
  } else if (command == "run" && args.size() == 4) {
    const auto codes = peer::peer_codes();
    const auto code = std::find_if(codes.begin(), codes.end(),
                                   [&](const peer::PeerCode& c) { return c.name == args[1]; });
    if (code == codes.end()) throw std::runtime_error("no code named " + args[1]);
    std::cout << run(*code, read_stream(args[2]), std::stod(args[3])) << '\n';
  } else if (command == "cost" && args.size() == 8) {
    std::array<double, 6> p{};
    for (std::size_t i = 0; i < p.size(); ++i) p[i] = std::stod(args[2 + i]);
    const nlohmann::json answer = {{"cost", peer::cone_cost(read_stream(args[1]), p)},
                                   {"lengths_mm", peer::well_conditioned_mm(p)}};
    std::cout << answer << '\n';
  } else {
    std::cerr << "write N FILE | run CODE FILE SECONDS | cost FILE p0 ... p5\n";
    return 2;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return dispatch({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
}
