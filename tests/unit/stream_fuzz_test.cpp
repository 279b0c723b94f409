// SPDX-License-Identifier: Apache-2.0
// Mutated streams are read, or refused with places inside the file; what is read survives a round
// trip. TRUEAXIS_FUZZ_COUNT and TRUEAXIS_FUZZ_SEED change what is tried.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "measure/files/stream_csv.hpp"
#include "measure/files/stream_csv_write.hpp"
#include "measure/passes.hpp"
#include "support/places.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

const std::vector<std::string> valid_streams = {
    "# x_convention: diameter\n# sensor_noise: 2 um\nX_M[mm],C[deg],Z[mm],t[s]\n"
    "80.1,0,5,0\n80.2,90,5,0.25\n80.3,180,5.1,0.5\n80.2,270,5.2,0.75\n80.1,0,5.3,1\n",
    "\xEF\xBB\xBFX_M[\xC2\xB5m dia];C[rev];Z[in];pass;setup\r\n80100;0;1;1;1\r\n80200;.25;1;1;1\r\n"
    "80300;.5;2;2;1\r\n80100;.75;2;2;2",
    "# reading: relative\n# nominal_radius: 14.5 mm\nX_M   C[rad]\n0.1  0.0\n-0.2  2.1 # "
    "chip\n1e-3 4.2\n",
    "# Note: probed after lunch\n## units: inch\nX_M[mm dia],C[deg],Z[mm]\n"
    "80.1,0,5\n80.2,90,5 # again\n80.3,180,5.1\n80.2,270,5.2\n",
    "Z_M\tC\tX\n5\t0\t20\n5.001\t120\t20\n4.999\t240\t+20.5\n"};

std::size_t setting(const char* name, std::size_t otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  std::string next() {
    std::string text = valid_streams[pick(valid_streams.size())];
    for (std::size_t k = 1 + pick(4); k > 0; --k) mutate(text);
    return text;
  }

 private:
  std::size_t pick(std::size_t count) { return random_() % count; }

  void mutate(std::string& text) {
    static const std::vector<std::string> words = {"nan",
                                                   "inf",
                                                   "-",
                                                   "1e999",
                                                   "1e-999",
                                                   "#",
                                                   "# x_convention: radius\n",
                                                   ",",
                                                   ";",
                                                   "\t",
                                                   "  ",
                                                   "\n",
                                                   "\r",
                                                   "\n\n",
                                                   std::string(1, '\0'),
                                                   "\xFF",
                                                   "\xC2",
                                                   "dia",
                                                   "[",
                                                   "]",
                                                   "[mm]",
                                                   "X_M",
                                                   "Z",
                                                   "\xEF\xBB\xBF",
                                                   "1,5",
                                                   "# a: b\n",
                                                   "# x convention = diameter\n",
                                                   " = ",
                                                   "# units: mm\n",
                                                   "99999999999999999999",
                                                   "0x1p3",
                                                   "\"",
                                                   "e",
                                                   ".",
                                                   "running"};
    const std::size_t at = pick(text.size() + 1);
    const std::size_t length = std::min(pick(12), text.size() - at);
    switch (pick(6)) {
      case 0:
        text.insert(at, words[pick(words.size())]);
        break;
      case 1:
        text.replace(at, length, words[pick(words.size())]);
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(pick(text.size() + 1), text.substr(at, length));
        break;
      case 4:
        text.resize(at);
        break;
      default:
        if (at < text.size()) text[at] = static_cast<char>(pick(256));
    }
  }
  std::mt19937_64 random_;
};

/// The text as a C++ literal that can be pasted into a test.
std::string literal(const std::string& text) {
  std::string out = "\"";
  char escaped[8];
  for (const char c : text) {
    std::snprintf(escaped, sizeof escaped, "\\%03o",
                  static_cast<unsigned>(static_cast<unsigned char>(c)));
    out += c >= ' ' && c < 127 && c != '"' && c != '\\' ? std::string(1, c) : std::string(escaped);
  }
  return out + '"';
}

void expect_places_inside(const InputError& error, const std::string& text) {
  const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  EXPECT_FALSE(error.diagnostics().empty());
  std::size_t previous = 0;
  for (const Diagnostic& diagnostic : error.diagnostics()) {
    EXPECT_LE(diagnostic.line, lines);
    const bool remedy = &diagnostic == &error.diagnostics().back() && diagnostic.line == 0;
    EXPECT_TRUE(remedy || diagnostic.line >= previous);
    EXPECT_LE(diagnostic.column, text.size() + 1);
    EXPECT_FALSE(diagnostic.message.empty());
    previous = diagnostic.line;
  }
}

void expect_sound(const ProbeStream& stream, const std::string& round_trip) {
  EXPECT_GT(stream.size(), 0u);
  EXPECT_EQ(stream.c_rad.size(), stream.size());
  for (const auto* column :
       {&stream.reading_mm, &stream.c_rad, &stream.position_mm, &stream.time_s}) {
    EXPECT_TRUE(column->empty() || column->size() == stream.size());
    EXPECT_TRUE(
        std::all_of(column->begin(), column->end(), [](double v) { return std::isfinite(v); }));
  }
  const std::vector<Pass> passes = find_passes(stream);
  EXPECT_EQ(passes.back().end, stream.size());
  write_stream_csv(stream, round_trip);
  const ProbeStream again = read_stream_csv(round_trip);
  EXPECT_EQ(again.reading_mm, stream.reading_mm);
  EXPECT_EQ(again.c_rad, stream.c_rad);
  EXPECT_EQ(again.position_mm, stream.position_mm);
  EXPECT_EQ(again.metadata, stream.metadata);
}

TEST(StreamFuzz, MutatedStreamsAreReadOrRefused) {
  const std::size_t seed = setting("TRUEAXIS_FUZZ_SEED", 2025);
  const std::size_t count = setting("TRUEAXIS_FUZZ_COUNT", 20000);
  std::printf("seed %zu, %zu mutations\n", seed, count);
  const auto folder = std::filesystem::path(places::scratch()) / "stream_fuzz";
  std::filesystem::create_directories(folder);
  const std::string path = (folder / "in.csv").string(), again = (folder / "again.csv").string();
  Mutator mutator(seed);
  std::size_t read = 0;
  for (std::size_t trial = 0; trial < count; ++trial) {
    const std::string text = mutator.next();
    // New files each time: replacing one makes a journalling file system wait for the disk.
    std::filesystem::remove(path);
    std::filesystem::remove(again);
    std::ofstream(path, std::ios::binary) << text;
    try {
      expect_sound(read_stream_csv(path), again);
      ++read;
    } catch (const InputError& error) {
      expect_places_inside(error, text);
    }
    ASSERT_FALSE(testing::Test::HasFailure()) << "trial " << trial << ": " << literal(text);
  }
  // Both ways are tried: some of the mutations leave a stream that can be read.
  EXPECT_GT(read, count / 20);
  EXPECT_LT(read, count - count / 20);
}

}  // namespace
}  // namespace trueaxis
