// SPDX-License-Identifier: Apache-2.0
// A program that is read and written without a change is the same bytes; one with changes differs
// in axis words only, and says the new positions to half a unit of its last decimal.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "nc/writer.hpp"
#include "support/nc_programs.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::nc {
namespace {

using trueaxis::testing::pasted;
using trueaxis::testing::ProgramMaker;
using trueaxis::testing::ugly_programs;
using trueaxis::testing::xyzac;

std::vector<NewPosition> unchanged(const Program& program) {
  std::vector<NewPosition> out;
  for (std::size_t i = 0; i < program.moves.size(); ++i)
    out.push_back({static_cast<std::uint32_t>(i), false, program.moves[i].words});
  return out;
}

WriteOptions of_xyzac() {
  WriteOptions options;
  options.axes = xyzac().axes;
  return options;
}

std::string written_unchanged(const Program& program) {
  return write_program(program, unchanged(program), of_xyzac()).text;
}

TEST(NcLossless, UglyProgramsStay) {
  int read = 0;
  for (const std::string& text : ugly_programs()) {
    try {
      const Program program = read_program(text, "ugly.nc", xyzac());
      const Written written = write_program(program, unchanged(program), of_xyzac());
      EXPECT_EQ(written.text, text) << pasted(text);
      EXPECT_EQ(written.rewritten, 0u);
      EXPECT_EQ(written.inserted, 0u);
      ++read;
    } catch (const InputError& error) {
      EXPECT_TRUE(text.starts_with("G1X1Y1Z1A1C1(c)(d)X")) << pasted(text) << error.what();
    }
  }
  EXPECT_EQ(read, static_cast<int>(ugly_programs().size()) - 1);
}

TEST(NcLossless, RandomProgramsStay) {
  constexpr std::uint64_t seed = 12;
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  ProgramMaker maker(seed);
  for (int trial = 0; trial < 2000; ++trial) {
    const std::string text = maker.next(20);
    ASSERT_EQ(written_unchanged(read_program(text, "random.nc", xyzac())), text)
        << "trial " << trial << ": " << pasted(text);
  }
}

/// Texts of the words that are not axis words, in their order.
std::vector<std::string> other_words(const Program& program) {
  std::vector<std::string> out;
  for (const Word& word : program.words)
    if (axis_of(word.letter) == axis_count)
      out.push_back(program.text.substr(word.letter_at, word.end - word.letter_at));
  return out;
}

TEST(NcLossless, ChangedWordsSayTheNewPositions) {
  constexpr std::uint64_t seed = 34;
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  ProgramMaker maker(seed);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> change(0.0, 0.02);
  int written_programs = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Program program = read_program(maker.next(20), "random.nc", xyzac());
    std::vector<NewPosition> positions = unchanged(program);
    for (NewPosition& position : positions)
      for (const std::size_t k : {0, 1, 2, 3, 5})
        if (maker.one_in(2))
          position.words[k] += change(random) * (is_rotary(k) ? rad_per_deg : 1.0);
    Written written;
    try {
      written = write_program(program, positions, of_xyzac());
    } catch (const InputError& error) {  // a new word of an axis that a '/' leaves unsure
      ASSERT_NE(std::string(error.what()).find("if the control skips"), std::string::npos);
      continue;
    }
    ++written_programs;
    const Program again = read_program(written.text, "written.nc", xyzac());
    ASSERT_EQ(other_words(again), other_words(program)) << pasted(program.text);
    ASSERT_EQ(again.lines.size(), program.lines.size());
    ASSERT_EQ(again.moves.size(), positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
      for (const std::size_t k : {0, 1, 2, 3, 5}) {
        // Half a unit of the last decimal, and the rounding of the conversion to degrees.
        const double half = 0.5 * (is_rotary(k) ? 1e-5 * rad_per_deg : 1e-4) * (1.0 + 1e-9) + 1e-12;
        ASSERT_NEAR(again.moves[i].words[k], positions[i].words[k], half)
            << "trial " << trial << " move " << i << " axis " << k << ": " << pasted(program.text)
            << "\n"
            << written.text;
        ASSERT_EQ(again.moves[i].words[k],
                  as_written(program.moves[i], positions[i].words, of_xyzac())[k]);
      }
    }
  }
  EXPECT_GT(written_programs, 100);
}

TEST(NcLossless, RandomBytesAreReadOrRefused) {
  constexpr std::uint64_t seed = 56;
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  ProgramMaker maker(seed);
  const std::string likely = "GXYZACMNFTHOPQIJKR0123456789.+-#[]()/%; \t\r\n\xC3";
  int read = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::string text = trial % 2 == 0 ? maker.next(6) : "";
    const std::size_t changes = 1 + maker.pick(trial % 2 == 0 ? 3 : 60);
    for (std::size_t i = 0; i < changes; ++i) {
      const std::size_t at = maker.pick(text.size() + 1);
      const char c =
          maker.one_in(8) ? static_cast<char>(maker.pick(256)) : likely[maker.pick(likely.size())];
      if (maker.one_in(3) && at < text.size())
        text.erase(at, 1 + maker.pick(5));
      else
        text.insert(at, 1, c);
    }
    ReadOptions options = xyzac();
    if (maker.one_in(2)) options.arc_tolerance_mm = 0.01;
    try {
      const Program program = read_program(text, "fuzz.nc", options);
      if (!options.arc_tolerance_mm) {
        ASSERT_EQ(written_unchanged(program), text) << pasted(text);
      }
      ++read;
    } catch (const InputError& error) {
      const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
      std::size_t previous = 0;
      ASSERT_FALSE(error.diagnostics().empty());
      for (const Diagnostic& one : error.diagnostics()) {
        ASSERT_GE(one.line, std::max<std::size_t>(previous, 1)) << pasted(text);
        ASSERT_LE(one.line, lines) << pasted(text);
        ASSERT_GE(one.column, 1u) << pasted(text);
        ASSERT_LE(one.column, text.size() + 1) << pasted(text);
        previous = one.line;
      }
    }
  }
  // Both ways are tried.
  EXPECT_GT(read, 1000);
  EXPECT_LT(read, 19000);
}

}  // namespace
}  // namespace trueaxis::nc
