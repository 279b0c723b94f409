// SPDX-License-Identifier: Apache-2.0
// What a fit notes of a stream that was read from a file: at which numbers each note begins.
#include <gtest/gtest.h>

#include <string>

#include "fit/describe.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis::input_notes_test {
namespace {

/// A stream of angles and places; its file says that X is a radius.
ProbeStream stream_of(const std::vector<double>& c_deg, std::vector<double> z_mm = {}) {
  ProbeStream stream;
  stream.x_convention = XConvention{.said_by = SaidBy::stream};
  for (const double c : c_deg) stream.c_rad.push_back(c * rad_per_deg);
  stream.reading_mm.assign(c_deg.size(), 20.0);
  stream.position_mm = std::move(z_mm);
  return stream;
}

/// The notes of a section, which does not use Z, or of a cylinder.
std::string notes_of(const ProbeStream& stream, bool section = false) {
  SurfaceInfo info;
  info.needs_position = !section;
  std::string all;
  for (const std::string& note : notes_on_input(stream, info)) all += note + '\n';
  return all;
}

std::vector<double> steps(std::size_t count, double step, double first = 0.0) {
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(first + step * static_cast<double>(i));
  return out;
}

bool says(const std::string& notes, const char* text) {
  return notes.find(text) != std::string::npos;
}

// Half of the ten steps or more are longer than half a revolution; forwards or backwards.
TEST(FitInputNotes, LongStepsOfCMayBeDegrees) {
  for (const double sense : {1.0, -1.0}) {
    EXPECT_EQ(notes_of(stream_of(steps(11, sense * 179.0))), "");
    EXPECT_TRUE(says(notes_of(stream_of(steps(11, sense * 182.0, 40.0))),
                     "C runs over 5.056 turns in 11 readings, mostly more than half a turn"));
    for (const std::size_t longer : {4U, 5U}) {
      std::vector<double> c{7.0};
      for (std::size_t i = 1; i < 11; ++i)
        c.push_back(c.back() + sense * (i <= longer ? 200.0 : 100.0));
      EXPECT_EQ(says(notes_of(stream_of(c)), "C runs over"), longer == 5U);
    }
  }
}

TEST(FitInputNotes, LessThanThirtyDegreesMayBeRadians) {
  EXPECT_TRUE(says(notes_of(stream_of(steps(11, 2.9, 50.0))), "C covers only 29° of the part"));
  EXPECT_EQ(notes_of(stream_of(steps(11, 3.1, 50.0))), "");
  EXPECT_EQ(notes_of(stream_of(steps(11, 4.1, 50.0))), "");
  EXPECT_TRUE(says(notes_of(stream_of({10.0})), "C covers only 0°"));
}

// Three jumps of more than half the range of Z while C goes on in one sense, within a revolution.
TEST(FitInputNotes, ZThatJumpsWhileCCreepsMayBeC) {
  const std::vector<double> jumps{7.0, 7.6, 7.0, 7.6, 7.0, 8.0},
      fewer{7.0, 7.4, 7.0, 7.4, 8.0, 8.0};
  for (const double sense : {1.0, -1.0}) {
    const auto exchanged = [&](std::vector<double> c_deg, const std::vector<double>& z_mm) {
      for (double& c : c_deg) c *= sense;
      return says(notes_of(stream_of(c_deg, z_mm)), "are the columns C and Z exchanged?");
    };
    EXPECT_TRUE(exchanged(steps(6, 0.7, 12.0), jumps));
    EXPECT_FALSE(exchanged(steps(6, 0.7, 12.0), fewer)) << "one jump";
    EXPECT_FALSE(exchanged(steps(6, 0.7, 12.0), {7.0, 8.0, 7.0, 7.1, 7.2, 7.3})) << "two jumps";
    EXPECT_TRUE(exchanged(steps(6, 0.7, 12.0), {7.0, 8.0, 7.0, 8.0, 8.1, 8.1})) << "three";
    EXPECT_TRUE(exchanged(steps(6, 71.0), jumps));
    EXPECT_FALSE(exchanged(steps(6, 73.0), jumps)) << "C goes round";
    EXPECT_FALSE(exchanged({12.0, 13.0, 14.0, 13.9, 15.0, 16.0}, jumps)) << "C goes back";
  }
  EXPECT_TRUE(says(notes_of(stream_of(steps(6, 5.0, 12.0), jumps)),
                   "C runs once through 25° while Z jumps 5 times"));
  ProbeStream face = stream_of(steps(6, 5.0), jumps);
  face.kind = StreamKind::face;
  EXPECT_FALSE(says(notes_of(face), "exchanged"));
  EXPECT_FALSE(says(notes_of(stream_of(steps(6, 5.0))), "exchanged"));
  EXPECT_FALSE(says(notes_of(stream_of({1.0}, {2.0})), "exchanged"));
}

// Places within 1 µm are one section; three readings in each or more are sections.
TEST(FitInputNotes, ASectionDoesNotUseZ) {
  const auto note = [](double jitter_mm, std::size_t readings) {
    std::vector<double> z;
    for (std::size_t i = 0; i < readings; ++i)
      z.push_back(30.0 - 4.0 * static_cast<double>(i % 5) + jitter_mm * static_cast<double>(i / 5));
    return notes_of(stream_of(steps(readings, 30.0), z), true);
  };
  EXPECT_TRUE(says(note(9e-4, 15), "15 readings from Z = 14 to 30.0018 mm in 5 sections are"));
  EXPECT_TRUE(says(note(0.0, 14), "14 readings from Z = 14 to 30 mm are fitted as one section"));
  EXPECT_TRUE(says(note(1.1e-3, 15), "15 readings from Z = 14 to 30.0022 mm are fitted"));
  EXPECT_EQ(notes_of(stream_of(steps(15, 30.0), std::vector<double>(15, 3.0)), true), "");
  EXPECT_EQ(notes_of(stream_of(steps(15, 30.0), steps(15, 3.0))), "") << "a cylinder uses it";
}

TEST(FitInputNotes, AnXThatNobodyExplainedIsARadius) {
  ProbeStream stream = stream_of(steps(11, 40.0));
  stream.x_convention->said_by = SaidBy::nobody;
  EXPECT_TRUE(says(notes_of(stream), "TrueAxis assumes that X_M is a radius"));
  stream.kind = StreamKind::face;
  EXPECT_TRUE(says(notes_of(stream), "TrueAxis assumes that X is a radius"));
  stream.x_convention.reset();
  stream.read_as = {"of a spreadsheet"};
  EXPECT_EQ(notes_of(stream), "of a spreadsheet\n") << "a program knows";
}

/// Readings of which nine in ten lie within 0.1 mm of their median, 30 mm, but some.
std::string gross(std::size_t count, const std::vector<double>& off_mm) {
  ProbeStream stream = stream_of(steps(count, 40.0));
  for (std::size_t i = 0; i < count; ++i)
    stream.reading_mm[i] = 29.9 + 0.1 * static_cast<double>(i % 3);
  for (std::size_t k = 0; k < off_mm.size(); ++k) stream.reading_mm[4 * k + 6] = 30.0 + off_mm[k];
  return gross_readings(stream);
}

// More than ten times as far from the median as nine in ten are, one in twenty, three at most.
TEST(FitInputNotes, FewReadingsFarOffAreAMistake) {
  EXPECT_EQ(gross(41, {0.98}), "");
  const std::string one = gross(41, {-1.5});
  EXPECT_TRUE(
      one.starts_with("row 7 reads 28.5 mm, 1.5 mm from the median of all, while nine "
                      "readings in ten lie within 0.1 mm: correct or remove it, or reduce "
                      "the weight of it with"))
      << one;
  const std::string two = gross(41, {1.5, 27.0});
  EXPECT_TRUE(
      two.starts_with("rows 7, 11 read 31.5 mm and the like, 1.5 mm from the median of "
                      "all, while nine readings in ten lie within 0.1 mm: correct or "
                      "remove them, or reduce the weight of them with"))
      << two;
  EXPECT_EQ(gross(39, {1.5, 27.0}), "") << "more than one in twenty";
  EXPECT_EQ(gross(59, {1.5, 27.0, 1.5}), "");
  EXPECT_NE(gross(61, {1.5, 27.0, 1.5}), "");
  EXPECT_EQ(gross(101, {1.5, 27.0, 1.5, 1.5}), "") << "a step of the part";
  EXPECT_EQ(gross(19, {}), "");
  EXPECT_NE(gross(21, {1.5}), "");
  ProbeStream same = stream_of(steps(41, 40.0));
  same.reading_mm[3] = 21.0;
  EXPECT_EQ(gross_readings(same), "") << "nothing tells how far is far";
}

}  // namespace
}  // namespace trueaxis::input_notes_test
