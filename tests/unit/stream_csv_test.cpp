// SPDX-License-Identifier: Apache-2.0
#include "measure/files/stream_csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <string>

#include "base/number.hpp"
#include "format/file.hpp"
#include "measure/files/stream_csv_write.hpp"
#include "support/places.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/units.hpp"

namespace trueaxis {
namespace {

namespace fs = std::filesystem;

class StreamCsv : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(places::scratch()) /
              ("stream_csv_" +
               std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  std::string path(const char* name = "stream.csv") const { return (folder_ / name).string(); }
  ProbeStream read(const std::string& text, const StreamReadOptions& options = {}) const {
    std::ofstream(path(), std::ios::binary) << text;
    return read_stream_csv(path(), options);
  }
  fs::path folder_;
};

// One unit in the last place of the largest value below, for conversions of two roundings.
constexpr double rounding = 2e-13;

TEST_F(StreamCsv, DefaultsAreRadiusMmDegSeconds) {
  const ProbeStream s = read("X_M,C,Z,t\n40.5,0,-3,0\n40.25,90,-3,0.5\n");
  EXPECT_EQ(s.kind, StreamKind::lateral);
  EXPECT_EQ(s.indication, Indication::absolute);
  EXPECT_EQ(s.reading_mm, (std::vector<double>{40.5, 40.25}));
  EXPECT_EQ(s.position_mm, (std::vector<double>{-3, -3}));
  EXPECT_EQ(s.time_s, (std::vector<double>{0, 0.5}));
  EXPECT_DOUBLE_EQ(s.c_rad[1], two_pi / 4);
  EXPECT_EQ(s.source, path());
  EXPECT_EQ(s.input_hash, content_hash(read_file(path())));
}

TEST_F(StreamCsv, ColumnsInAnyOrderAndCaseWithPassAndSetup) {
  const ProbeStream s = read("setup,z,C,PASS,x_m,T\n1,5,0,1,40,0\n2,6,90,1.0,41,1\n");
  EXPECT_EQ(s.reading_mm, (std::vector<double>{40, 41}));
  EXPECT_EQ(s.position_mm, (std::vector<double>{5, 6}));
  EXPECT_EQ(s.setup, (std::vector<int>{1, 2}));
  EXPECT_EQ(s.pass, (std::vector<int>{1, 1}));
}

TEST_F(StreamCsv, EveryUnitOfLength) {
  const std::pair<const char*, double> units[] = {
      {"mm", 1.0}, {"um", 1e-3}, {"\xC2\xB5m", 1e-3}, {"\xCE\xBCm", 1e-3}, {"\xB5m", 1e-3},
      {"m", 1e3},  {"in", 25.4}, {"inch", 25.4},      {" mm ", 1.0}};
  for (const auto& [unit, factor] : units) {
    const ProbeStream s =
        read(std::string("X_M[") + unit + "],C,Z [" + unit + "]\n2,0,3\n2,90,3\n");
    EXPECT_DOUBLE_EQ(s.reading_mm[0], 2 * factor) << unit;
    EXPECT_DOUBLE_EQ(s.position_mm[0], 3 * factor) << unit;
  }
}

TEST_F(StreamCsv, EveryUnitOfAngleAndTime) {
  EXPECT_DOUBLE_EQ(read("X_M,C[rad]\n1,0\n1,2\n").c_rad[1], 2.0);
  EXPECT_DOUBLE_EQ(read("X_M,C[rev]\n1,0\n1,0.25\n").c_rad[1], two_pi / 4);
  EXPECT_DOUBLE_EQ(read("X_M,C[deg],t[ms]\n1,0,0\n1,2,5\n").time_s[1], 0.005);
}

TEST_F(StreamCsv, DiametersAreHalved) {
  const std::string rows = "\n80,0,1\n80.5,90,1\n";
  const std::vector<double> radii{40, 40.25};
  EXPECT_EQ(read("X_M[mm dia],C,Z" + rows).reading_mm, radii);
  EXPECT_EQ(read("X_M[mm dia],C,Z" + rows + "# x_convention: diameter\n").reading_mm, radii);
  EXPECT_EQ(read("#X_Convention:diameter\nX_M[mm],C,Z" + rows).reading_mm, radii);
  StreamReadOptions options;
  options.diameter = true;
  EXPECT_EQ(read("X_M,C,Z" + rows, options).reading_mm, radii);
  const ProbeStream face = read("Z_M,C,X[mm dia]\n5,0,80\n5,90,80.5\n");
  EXPECT_EQ(face.kind, StreamKind::face);
  EXPECT_EQ(face.reading_mm, (std::vector<double>{5, 5}));
  EXPECT_EQ(face.position_mm, radii);
}

TEST_F(StreamCsv, EverySeparator) {
  const ProbeStream comma = read("X_M[mm dia],C,Z\n80,0,1\n82,90,-1\n");
  for (const char* text :
       {"X_M[mm dia];C;Z\n80;0;1\n82;90;-1\n", "X_M[mm dia]\tC\tZ\n80\t0\t1\n82\t90\t-1\n",
        "X_M[mm dia] C Z\n80 0 1\n82 90 -1\n", "  X_M [mm dia]   C  Z \n  80  0 1 \n82\t90   -1",
        " X_M [mm dia] , C ,\tZ\n80 , 0 ,\t1 \n 82,+90,-1.0e0"}) {
    const ProbeStream s = read(text);
    EXPECT_EQ(s.reading_mm, comma.reading_mm) << text;
    EXPECT_EQ(s.c_rad, comma.c_rad) << text;
    EXPECT_EQ(s.position_mm, comma.position_mm) << text;
  }
}

TEST_F(StreamCsv, ByteOrderMarkLineEndsCommentsAndBlankLines) {
  const ProbeStream s = read(
      "\xEF\xBB\xBF# made by hand\r\n\r\nX_M,C,Z # what\r\n\r\n40,0,1\r\n# between\r\n41,90,1 # "
      "chip\r\n"
      "   \r\n42,180,1");
  EXPECT_EQ(s.reading_mm, (std::vector<double>{40, 41, 42}));
  EXPECT_TRUE(s.metadata.empty());
}

TEST_F(StreamCsv, MetadataIsKeptAndRead) {
  const ProbeStream s = read(
      "# measured: a tube, 12 angles: five sections\n#reading:relative\n# nominal_radius: 0.5 in\n"
      "X_M,C\n1,0\n2,90\n# sensor_noise: 2 um\n# spindle_rpm: -60 rpm\n# setup.1.x_jog: 0.1 mm\n"
      "# note: one\n# note: two\n# no key here\n# not a key: value\n");
  EXPECT_EQ(s.indication, Indication::relative);
  EXPECT_DOUBLE_EQ(s.nominal_radius_mm.value(), 12.7);
  EXPECT_DOUBLE_EQ(s.sensor_noise_mm.value(), 0.002);
  EXPECT_EQ(s.spindle_rpm, -60.0);
  const std::map<std::string, std::string> wanted{{"measured", "a tube, 12 angles: five sections"},
                                                  {"reading", "relative"},
                                                  {"nominal_radius", "0.5 in"},
                                                  {"sensor_noise", "2 um"},
                                                  {"spindle_rpm", "-60 rpm"},
                                                  {"setup.1.x_jog", "0.1 mm"},
                                                  {"note", "one; two"}};
  EXPECT_EQ(s.metadata, wanted);
  EXPECT_FALSE(s.has_position());
}

TEST_F(StreamCsv, SetUpsAreReadInOrderOfNumber) {
  const ProbeStream s = read(
      "# setup.3.side: rear\n# SETUP.2.ReIndex: 0.25 rev\n# setup.2.z_shift: 0.5 in\n"
      "# setup.2.x_jog: -100 um\n# setup.2.clamp_force_ratio: 0.6\n# setup.3.side: rear\n"
      "X_M,C,setup\n1,0,3\n2,90,1\n3,180,2\n4,270,3\n");
  const std::vector<trueaxis::SetUp> wanted{{1, 0.0, 0.0, false, 0.0, 1.0},
                                            {2, two_pi / 4.0, 12.7, false, -0.1, 0.6},
                                            {3, 0.0, 0.0, true}};
  EXPECT_EQ(s.setups, wanted);
  EXPECT_EQ(set_up_of(s, 0), wanted[2]);
  EXPECT_EQ(set_up_of(s, 2), wanted[1]);
  EXPECT_FALSE(wanted[2].moved());  // only the probe went elsewhere
  EXPECT_TRUE(wanted[1].moved());
  EXPECT_EQ(read("X_M,C\n1,0\n2,90\n").setups, std::vector<trueaxis::SetUp>{{}});
}

TEST_F(StreamCsv, WhatFileAndCallerSayOfAGaugeMustAgree) {
  StreamReadOptions options;
  options.indication = Indication::relative;
  options.nominal_radius_mm = 12.7;
  const std::string rows = "X_M,C\n1,0\n2,90\n";
  for (const char* agreeing : {"", "# nominal_radius: 0.5 in\n# reading: relative\n"}) {
    const ProbeStream s = read(agreeing + rows, options);
    EXPECT_EQ(s.indication, Indication::relative);
    EXPECT_DOUBLE_EQ(*s.nominal_radius_mm, 12.7);
  }
  const auto refusal = [&](const std::string& text) -> std::string {
    try {
      read(text, options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(
      refusal("# nominal_radius: 30 mm\n" + rows),
      testing::HasSubstr(
          ":1: nominal_radius is 30 mm in the file, but the option says 12.7 mm: keep one"));
  options.diameter_said_by = SaidBy::job;
  EXPECT_THAT(refusal("# nominal_radius: 12.7 mm\n# reading: absolute\n" + rows),
              testing::HasSubstr(
                  ":2: reading is absolute in the file, but the job says relative: keep one"));
}

/// C of a column that turns by `step` degrees, wrapped into [low, low + 360).
std::string wrapped_rows(double step, double low, int count) {
  std::string text = "X_M,C\n";
  for (int i = 0; i < count; ++i) {
    const double c = i * step;
    text += "40," + std::to_string(c - 360.0 * std::floor((c - low) / 360.0)) + "\n";
  }
  return text;
}

TEST_F(StreamCsv, WrappedColumnsAreUnwrapped) {
  for (const double step :
       {1.0, 30.0, 33.3, 120.0, 144.0, 179.0, -1.0, -30.0, -33.3, -120.0, -179.0}) {
    for (const double low : {0.0, -180.0}) {
      const ProbeStream s = read(wrapped_rows(step, low, 800));
      for (std::size_t i = 1; i < s.size(); ++i) {
        // The rows are printed with six decimals: two roundings of 5e-7 degrees.
        ASSERT_NEAR(s.c_rad[i] - s.c_rad[i - 1], step * rad_per_deg, 2e-8) << step << " " << low;
      }
    }
  }
}

TEST_F(StreamCsv, TwelveAnglesRepeatedOverSectionsRunOn) {
  std::string text = "X_M,C,Z\n";
  for (int i = 0; i < 60; ++i) {
    text += "75," + std::to_string(30 * (i % 12)) + "," + std::to_string(34 * (i / 12)) + "\n";
  }
  const ProbeStream s = read(text);
  for (std::size_t i = 0; i < 60; ++i) {
    EXPECT_NEAR(s.c_rad[i], static_cast<double>(i) * two_pi / 12, 60 * rounding);
  }
}

TEST_F(StreamCsv, RunningColumnsStayAsTheyAre) {
  // Beyond one turn, back by a turn between sections; and within one turn but declared running.
  const ProbeStream beyond = read("X_M,C\n1,0\n1,180\n1,370\n1,10\n1,200\n");
  EXPECT_DOUBLE_EQ(beyond.c_rad[3], 10 * rad_per_deg);
  const ProbeStream declared = read("X_M,C[deg running]\n1,0\n1,200\n1,0\n");
  EXPECT_DOUBLE_EQ(declared.c_rad[1], 200 * rad_per_deg);
}

void expect_same(const ProbeStream& a, const ProbeStream& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.indication, b.indication);
  EXPECT_EQ(a.reading_mm, b.reading_mm);
  EXPECT_EQ(a.c_rad, b.c_rad);
  EXPECT_EQ(a.position_mm, b.position_mm);
  EXPECT_EQ(a.time_s, b.time_s);
  EXPECT_EQ(a.pass, b.pass);
  EXPECT_EQ(a.setup, b.setup);
  EXPECT_EQ(a.setups, b.setups);
  EXPECT_EQ(a.nominal_radius_mm, b.nominal_radius_mm);
  EXPECT_EQ(a.sensor_noise_mm, b.sensor_noise_mm);
  EXPECT_EQ(a.spindle_rpm, b.spindle_rpm);
}

TEST_F(StreamCsv, RoundTripIsBitwise) {
  const unsigned seed = 4711;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> fraction(-1.0, 1.0);
  const auto value = [&] {
    return std::ldexp(fraction(random), static_cast<int>(random() % 80) - 40);
  };
  for (int trial = 0; trial < 60; ++trial) {
    ProbeStream s;
    s.kind = trial % 3 == 0 ? StreamKind::face : StreamKind::lateral;
    s.indication = trial % 2 == 0 ? Indication::relative : Indication::absolute;
    // Running within one turn with steps beyond half a turn: would look wrapped without its mark.
    const double c_span = trial % 4 == 0 ? two_pi : 100.0;
    for (int i = 0; i < 200; ++i) {
      s.reading_mm.push_back(value());
      s.c_rad.push_back(c_span * std::abs(fraction(random)));
      if (s.kind == StreamKind::face || trial % 5 != 0) s.position_mm.push_back(value());
      if (trial % 2 == 0) s.time_s.push_back(0.1 * i + 0.05 * fraction(random));
      if (trial % 7 == 0) s.pass.push_back(static_cast<int>(random() % 5));
      if (trial % 6 == 0) s.setup.push_back(static_cast<int>(random() % 3) - 1);
    }
    if (trial % 3 == 1) s.nominal_radius_mm = std::abs(value());
    if (trial % 3 == 2) s.sensor_noise_mm = std::abs(value());
    if (trial % 4 == 1) s.spindle_rpm = value();
    s.setups.front().x_jog_mm = value();
    if (!s.setup.empty()) {
      // An angle of more than three turns is refused.
      s.setups.push_back(
          {0, std::fmod(value(), 18.0), value(), trial % 4 == 0, value(), std::abs(value())});
      s.metadata["setup.0.reindex"] = "70 deg";  // the member decides
      s.metadata["setup.0.side"] = "rear";
    }
    s.setups = list_set_ups(s);
    s.metadata["setup.9.reindex"] = "70 deg";  // no reading: not written
    if (trial % 5 == 1) s.metadata["x_convention"] = "diameter";
    if (trial % 5 == 2) s.metadata["reading"] = "relative";  // the member decides
    write_stream_csv(s, path("once.csv"));
    const ProbeStream once = read_stream_csv(path("once.csv"));
    SCOPED_TRACE("trial " + std::to_string(trial));
    expect_same(once, s);
    write_stream_csv(once, path("twice.csv"));
    const ProbeStream twice = read_stream_csv(path("twice.csv"));
    expect_same(twice, once);
    EXPECT_EQ(twice.metadata, once.metadata);
    EXPECT_EQ(twice.input_hash, once.input_hash);
  }
}

TEST_F(StreamCsv, WriterLeavesNothingHalfWrittenAndKeepsItsContract) {
  ProbeStream s = read("X_M,C\n1,0\n2,90\n");
  fs::create_directories(folder_ / "sub");
  write_stream_csv(s, path("sub/out.csv"));
  EXPECT_EQ(read_file(path("sub/out.csv")),
            "## schema: trueaxis.stream/1\nX_M[mm],C[rad]\n1,0\n2,1.5707963267948966\n");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "sub"), {}), 1);
  EXPECT_THROW(write_stream_csv(s, path("no/folder/out.csv")), InputError);
  fs::create_directories(folder_ / "taken/full");
  EXPECT_THROW(write_stream_csv(s, path("taken")), InputError);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 3);  // stream.csv, sub, taken
  s.reading_mm[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(write_stream_csv(s, path("nan.csv")), ContractViolation);
  EXPECT_FALSE(fs::exists(path("nan.csv")));
  s.reading_mm[0] = 1.0;
  s.metadata["two words"] = "x";
  EXPECT_THROW(write_stream_csv(s, path("key.csv")), ContractViolation);
  s.metadata = {{"units", "inch"}};  // would not be read again
  EXPECT_THROW(write_stream_csv(s, path("key.csv")), ContractViolation);
}

TEST_F(StreamCsv, RowsAcrossChunksAreWhole) {
  std::string text = "X_M,C,Z\n";
  for (int i = 0; i < 300000; ++i) text += std::to_string(i) + ",0." + std::to_string(i) + ",1\n";
  text.pop_back();
  const ProbeStream s = read(text);
  ASSERT_EQ(s.size(), 300000u);
  for (std::size_t i = 0; i < s.size(); ++i) ASSERT_EQ(s.reading_mm[i], static_cast<double>(i));
  EXPECT_EQ(s.input_hash, content_hash(text));
}

/// The parser against strtod, which is correctly rounded.
void expect_exact(const std::string& text) {
  double value = 0.0;
  std::errc error{};
  const char* end = read_number(text.data(), text.data() + text.size(), value, error);
  ASSERT_EQ(end, text.data() + text.size()) << text;
  ASSERT_EQ(error, std::errc{}) << text;
  const double wanted = std::strtod(text.c_str(), nullptr);
  EXPECT_EQ(value, wanted) << text;
  EXPECT_EQ(std::signbit(value), std::signbit(wanted)) << text;
}

TEST(CsvNumber, IsTheNearestDouble) {
  for (const char* text : {"0", "-0", "-0.0", "+1.5", ".5", "5.", "9007199254740993", "0.1",
                           "9007199254740992", "123456789012345678", "1234567890123456789",
                           "0.000000000000000000000001", "3.0000000000000000000000000000001",
                           "1e22", "1e23", "1.7976931348623157e308", "-4.9e-320"}) {
    expect_exact(text);
  }
  const unsigned seed = 99;
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (int trial = 0; trial < 200000; ++trial) {
    std::string text = random() % 2 != 0 ? "-" : "";
    const std::size_t whole = random() % 12,
                      behind = whole == 0 ? 1 + random() % 12 : random() % 12;
    for (std::size_t i = 0; i < whole; ++i) text += static_cast<char>('0' + random() % 10);
    if (behind > 0) text += '.';
    for (std::size_t i = 0; i < behind; ++i) text += static_cast<char>('0' + random() % 10);
    if (random() % 8 == 0) text += "e" + std::to_string(static_cast<int>(random() % 40) - 20);
    expect_exact(text);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(CsvNumber, RefusesWhatIsNone) {
  for (const std::string text : {"", "-", "+", ".", "-.", "+-1", "--1", "e5", "x", " 1"}) {
    double value = 0.0;
    std::errc error{};
    EXPECT_EQ(read_number(text.data(), text.data() + text.size(), value, error), text.data())
        << text;
  }
}

}  // namespace
}  // namespace trueaxis
